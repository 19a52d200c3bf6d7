"""Directional derivatives through fmpy against central differences, for every input and real output of each FMU.

At communication points in and beside the defect: an input is set, the outputs are read, no step between. Near a defect
the map's second derivatives are differences themselves; where an input feeds through only first ones enter. 1e-5 leaves
room for the curvature of a contact over a thousandth of a typical approach.
"""

import sys

import numpy as np

from host import Host

NUDGE = {"m": 1e-10, "m/s": 1e-6, "m/s2": 1.0, "N": 0.05, "rad/s": 1e-3, "N.m": 1e-3, "rad": 1e-8, "rad/s2": 1.0}
PRESS = {"shaft.y": -18e-6, "shaft.x": 2e-6, "shaft.vy": 5e-4, "housing.vx": 3e-4}

for fmu in sys.argv[1:]:
    host = Host(fmu)
    variables = host.description.modelVariables
    inputs = [v for v in variables if v.causality == "input"]
    outputs = [v.name for v in variables if v.causality == "output" and v.type == "Real"]
    unknowns = [host.reference[name] for name in outputs]
    for point in range(8):
        for name, value in PRESS.items():
            if any(v.name == name for v in inputs):
                host.write([name], [value])
        middle = np.array(host.read(outputs))
        for variable in inputs:
            at, step = host.read([variable.name])[0], NUDGE[variable.unit]
            sides = []
            for value in (at - step, at + step):
                host.write([variable.name], [value])
                sides.append(np.array(host.read(outputs)))
            host.write([variable.name], [at])
            found = (sides[1] - sides[0]) / (2 * step)
            given = np.array(host.unit.getDirectionalDerivative(unknowns, [variable.valueReference], [1.0]))
            # A part of the stiffness is rounded as its largest one is.
            stiff = np.array([name.startswith("shaft.stiffness") for name in outputs])
            size = np.where(stiff, np.abs(middle[stiff]).max(initial=0.0), np.abs(middle))
            allowed = 1e-5 * np.abs(given) + 1e-11 * np.maximum(size, 1.0) / step
            bad = np.flatnonzero(np.abs(found - given) > allowed)
            assert not len(bad), (
                f"{fmu}: {outputs[bad[0]]} by {variable.name}: {given[bad[0]]} given, {found[bad[0]]} found"
            )
        host.step(1.1e-3)
    host.close()
