"""Validates an FMU with fmpy: schema, names, units, model structure. Fails with everything that was found."""

import sys

from fmpy.validation import validate_fmu

problems = validate_fmu(sys.argv[1])
if problems:
    sys.exit("fmpy validate_fmu: " + "; ".join(problems))
