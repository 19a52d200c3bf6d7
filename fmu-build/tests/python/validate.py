"""Validates FMUs with fmpy: schema, names, units, model structure. Fails with everything that was found."""

import sys

from fmpy.validation import validate_fmu

problems = [problem for fmu in sys.argv[1:] for problem in validate_fmu(fmu)]
if problems:
    sys.exit("fmpy validate_fmu: " + "; ".join(problems))
