"""Which of the files are valid by the schema: one line of `name valid|message` each."""

import json
import sys

import jsonschema

schema, *files = sys.argv[1:]
with open(schema, encoding="utf-8") as file:
    schema = json.load(file)
jsonschema.Draft202012Validator.check_schema(schema)
validator = jsonschema.Draft202012Validator(schema)
for name in files:
    with open(name, encoding="utf-8") as file:
        errors = [error.message for error in validator.iter_errors(json.load(file))]
    print(name, errors[0] if errors else "valid", sep="\t")
