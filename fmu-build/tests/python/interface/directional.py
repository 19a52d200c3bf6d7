"""Directional derivatives through fmpy for every input and real output of each FMU, in and beside the defect."""

import sys

from differences import jacobian, press
from host import started

for fmu in sys.argv[1:]:
    host = started(fmu)
    variables = host.description.modelVariables
    inputs = {v.name: v.unit for v in variables if v.causality == "input"}
    outputs = [v.name for v in variables if v.causality == "output" and v.type == "Real"]
    unknowns = [host.reference[name] for name in outputs]
    given = lambda name: host.unit.getDirectionalDerivative(unknowns, [host.reference[name]], [1.0])  # noqa: E731
    for point in range(8):
        press(host, inputs)
        jacobian(host, inputs, outputs, given)
        host.step(1.1e-3)
    host.close()
