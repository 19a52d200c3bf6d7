"""Directional derivatives that FMUs of either version give against central differences of their outputs.

An input is set, the outputs are read, no step between. Near a defect the map's second derivatives are differences
themselves; where an input feeds through only first ones enter. 1e-5 leaves room for the curvature of a contact over a
thousandth of a typical approach.
"""

import numpy as np

NUDGE = {"m": 1e-10, "m/s": 1e-6, "m/s2": 1.0, "N": 0.05, "rad/s": 1e-3, "N.m": 1e-3, "rad": 1e-8, "rad/s2": 1.0}
# Where the host moves a ring: pressed into the elements, moving a little.
PRESS = {"shaft.y": -18e-6, "shaft.x": 2e-6, "shaft.vy": 5e-4, "housing.vx": 3e-4}


def press(host, inputs):
    for name, value in PRESS.items():
        if name in inputs:
            host.write([name], [value])


def jacobian(host, inputs, numbers, given):
    """What `given` says of each input; `inputs` are units by name, `numbers` the outputs' names, arrays' repeated."""
    names = list(dict.fromkeys(numbers))
    middle = np.array(host.read(names))
    # A part of the stiffness is rounded as its largest one is.
    stiff = np.array([name.startswith("shaft.stiffness") for name in numbers])
    size = np.where(stiff, np.abs(middle[stiff]).max(initial=0.0), np.abs(middle))
    columns = []
    for name, unit in inputs.items():
        at, step = host.read([name])[0], NUDGE[unit]
        sides = []
        for value in (at - step, at + step):
            host.write([name], [value])
            sides.append(np.array(host.read(names)))
        host.write([name], [at])
        found, said = (sides[1] - sides[0]) / (2 * step), np.array(given(name))
        allowed = 1e-5 * np.abs(said) + 1e-11 * np.maximum(size, 1.0) / step
        bad = np.flatnonzero(~(np.abs(found - said) <= allowed))
        where = host.description.modelName
        assert not len(bad), f"{where}: {numbers[bad[0]]} by {name}: {said[bad[0]]} given, {found[bad[0]]} found"
        columns.append(said)
    return np.column_stack(columns)
