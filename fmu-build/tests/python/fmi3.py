"""FMUs of FMI 3.0 through fmpy: states, derivatives, dependencies, intermediate updates with an early return,
terminals."""

import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
from host3 import Host3
from lxml import etree

NUDGE = {"m": 1e-10, "m/s": 1e-6, "m/s2": 1.0, "N": 0.05, "rad/s": 1e-3, "N.m": 1e-3, "rad": 1e-8, "rad/s2": 1.0}
# Where the host moves a ring: pressed into the elements, moving a little.
PRESS = {"shaft.y": -18e-6, "shaft.x": 2e-6, "shaft.vy": 5e-4, "housing.vx": 3e-4}
SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"


def terminals(fmu):
    """Both rings have a terminal that keeps to the schema and names variables that there are."""
    with zipfile.ZipFile(fmu) as archive:
        tree = etree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        assert archive.read("terminalsAndIcons/icon.png").startswith(b"\x89PNG")
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(tree)
    variables = fmpy.read_model_description(fmu).modelVariables
    names = {variable.name for variable in variables}
    found = {terminal.get("name"): terminal for terminal in tree.find("Terminals")}
    assert set(found) == {"shaft", "housing"}
    for ring, terminal in found.items():
        flanges = {part.get("name"): [member.get("memberName") for member in part] for part in terminal.iter("Terminal")}
        moves = f"{ring}.x" in names
        assert flanges["x"] == flanges["y"] == (["s", "v", "a", "f"] if moves else ["f"]), flanges
        # In space the axis has one more, and with five degrees of freedom each tilt.
        if f"{ring}.force.z" in names:
            assert flanges["z"] == flanges["x"], flanges
            assert flanges["tilt_x"] == flanges["tilt_y"], flanges
            assert flanges["tilt_x"] == (["phi", "w", "a", "tau"] if f"{ring}.tilt.x" in names else ["tau"]), flanges
        within = [member.get("variableName") for member in terminal.iter("TerminalMemberVariable")]
        signals = {v.name for v in variables if v.causality in ("input", "output") and v.name.startswith(f"{ring}.")}
        # All that a body outside exchanges with the ring; a tangent stiffness it does not.
        assert set(within) == {name for name in signals if ".stiffness." not in name}, signals ^ set(within)
        terminal = terminal.findall("TerminalMemberVariable")
        members = [member.get("variableName") for member in terminal]
        assert f"{ring}.force.x" in members and f"{ring}.force.y" in members
        assert set(members) <= names, set(members) - names
        assert all(member.get("variableName") == f"{ring}.{member.get('memberName')}" for member in terminal)


def states(fmu):
    """A state put back, and one from bytes, repeat every bit."""
    host, outputs = Host3(fmu), None
    outputs = host.names("output")
    step = float(host.description.defaultExperiment.stepSize)
    for _ in range(20):
        host.step(step)
    state, time = host.unit.getFMUState(), host.time
    copy = host.unit.deserializeFMUState(host.unit.serializeFMUState(state))
    runs = []
    for start in (state, state, copy):
        host.unit.setFMUState(start)
        host.time = time
        run = []
        for _ in range(20):
            host.step(step)
            run.append(list(host.read(outputs)))
        runs.append(run)
    assert runs[0] == runs[1] == runs[2], fmu
    host.unit.freeFMUState(state)
    host.close()


def derivatives(fmu):
    """Directional derivatives are central differences, adjoint ones the transposed product; dependencies cover both."""
    host = Host3(fmu)
    inputs, outputs = host.names("input"), host.names("output")
    reference = {name: v.valueReference for name, v in host.variables.items()}
    unknowns, knowns = [reference[n] for n in outputs], [reference[n] for n in inputs]
    for name, value in PRESS.items():
        if name in inputs:
            host.write([name], [value])
    for _ in range(13):
        host.step(1e-4)
    middle = np.array(host.read(outputs))
    stiff = np.array([n.startswith("shaft.stiffness") for n in outputs for _ in range(host.size(n))])
    jacobian = np.zeros((len(middle), len(inputs)))
    for k, name in enumerate(inputs):
        at, step = host.read([name])[0], NUDGE[host.variables[name].unit]
        sides = []
        for value in (at - step, at + step):
            host.write([name], [value])
            sides.append(np.array(host.read(outputs)))
        host.write([name], [at])
        found = (sides[1] - sides[0]) / (2 * step)
        given = np.array(host.unit.getDirectionalDerivative(unknowns, [knowns[k]], [1.0], len(middle)))
        # As in directional.py; a part of the stiffness is rounded as its largest one is.
        size = np.where(stiff, np.abs(middle[stiff]).max(initial=0.0), np.abs(middle))
        allowed = 1e-5 * np.abs(given) + 1e-11 * np.maximum(size, 1.0) / step
        assert np.all(np.abs(found - given) <= allowed), f"{fmu}: {name}"
        jacobian[:, k] = given
    seed = np.sin(np.arange(len(middle)) + 0.5)
    adjoint = np.array(host.unit.getAdjointDerivative(unknowns, knowns, list(seed), len(inputs)))
    # Roundings of a sum of some sixty products.
    assert np.all(np.abs(adjoint - seed @ jacobian) <= 1e-12 * (np.abs(seed) @ np.abs(jacobian))), fmu
    # What is not listed as a dependency has derivative 0, element by element.
    row = 0
    for name in outputs:
        listed = host.dependencies(name)
        for element in range(host.size(name)):
            number = element + 1 if host.variables[name].shape else 0
            for k, known in enumerate(knowns):
                assert (number, known) in listed or jacobian[row, k] == 0.0, f"{fmu}: {name} by {inputs[k]}"
            row += 1
    host.close()


def updates(fmu):
    """Intermediate updates show outputs, and a step returns early where it is asked."""
    seen = []
    outputs = ["shaft.force.x", "shaft.force.y", "element.path"]

    def update(environment, time, set_requested, get_allowed, finished, can_return, requested, return_time):
        assert get_allowed and finished and not set_requested
        seen.append((time, list(host.read(outputs))))
        if can_return and time > 0.4e-3:
            requested[0], return_time[0] = True, time

    host = Host3(fmu, update, outputs, early_return=True)
    assert host.step(1e-3), "no early return"
    assert seen[-1] == (host.time, list(host.read(outputs))) and 0.4e-3 < host.time < 1e-3
    host.close()


for fmu in sys.argv[1:]:
    for check in (terminals, states, derivatives, updates):
        check(fmu)
print(len(sys.argv) - 1, "FMUs")
