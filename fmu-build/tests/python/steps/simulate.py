"""simulate_fmu runs each FMU over its default experiment with its default inputs, and every result is finite."""

import sys

import numpy as np
from fmpy import read_model_description, simulate_fmu

for fmu in sys.argv[1:]:
    experiment = read_model_description(fmu).defaultExperiment
    result = simulate_fmu(fmu, relative_tolerance=float(experiment.tolerance))
    assert np.isclose(result["time"][-1], float(experiment.stopTime), rtol=1e-9), f"{fmu} ends at {result['time'][-1]}"
    for name in result.dtype.names:
        assert np.all(np.isfinite(result[name])), f"{fmu}: {name}"
    outer = [name for name in result.dtype.names if name.endswith("force.outer")]
    assert outer, f"{fmu}: no element forces among the outputs"
    print(fmu, len(result), "points")
