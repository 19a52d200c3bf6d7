"""Executes notebooks cell after cell in a folder and stores what comes out.

    python notebook_execute.py FOLDER NOTEBOOK...
"""

import sys

import nbformat
from nbclient import NotebookClient

folder, *notebooks = sys.argv[1:]
for path in notebooks:
    notebook = nbformat.read(path, as_version=4)
    bare = dict(notebook.metadata)
    NotebookClient(notebook, timeout=1200, record_timing=False, resources={"metadata": {"path": folder}}).execute()
    # Which Python it was is of no interest to the next.
    notebook.metadata = nbformat.from_dict(bare)
    nbformat.write(notebook, path)
