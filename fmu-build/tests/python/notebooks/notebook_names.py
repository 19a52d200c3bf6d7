"""Whether names that notebooks take from the package are in its sources, and keywords of its functions theirs.

    python notebook_names.py MODULE NOTEBOOK...      prints how many calls were looked at
"""

import ast
import json
import sys
from pathlib import Path

module, *notebooks = map(Path, sys.argv[1:])


def names(file):
    """What a file defines or imports, functions with their definitions."""
    found = {}
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            found[node.name] = node
        elif isinstance(node, (ast.Import, ast.ImportFrom)):
            found.update((alias.asname or alias.name, None) for alias in node.names)
    return found


def looked_at(notebook):
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    tree = ast.parse("\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"))
    ours, known = {}, names(module / "__init__.py")
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module.startswith("brinell."):
            there = names(module / f"{node.module.partition('.')[2]}.py")
            ours.update((alias.name, there[alias.name]) for alias in node.names)
    count = 0
    for node in ast.walk(tree):
        function = None
        if isinstance(node, ast.Attribute) and getattr(node.value, "id", None) == "brinell":
            assert node.attr in known, f"{notebook.name}: no brinell.{node.attr}"
        if isinstance(node, ast.Call):
            of_package = isinstance(node.func, ast.Attribute) and getattr(node.func.value, "id", None) == "brinell"
            function = known[node.func.attr] if of_package else ours.get(getattr(node.func, "id", None))
        if isinstance(function, ast.FunctionDef):
            there = function.args.posonlyargs + function.args.args + function.args.kwonlyargs
            takes = {argument.arg for argument in there}
            for keyword in node.keywords:
                known_word = function.args.kwarg is not None or keyword.arg in takes
                assert known_word, f"{notebook.name}: {function.name} has no {keyword.arg}"
            count += 1
    return count


print(sum(map(looked_at, notebooks)))
