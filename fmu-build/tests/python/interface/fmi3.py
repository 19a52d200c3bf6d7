"""FMUs of FMI 3.0 through fmpy: states, derivatives, dependencies, intermediate updates with an early return,
terminals."""

import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
from differences import jacobian, press
from host3 import Host3
from lxml import etree

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
    host = Host3(fmu)
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
    units, outputs = {name: host.variables[name].unit for name in host.names("input")}, host.names("output")
    numbers = [name for name in outputs for _ in range(host.size(name))]
    references = lambda names: [host.variables[name].valueReference for name in names]  # noqa: E731
    unknowns, knowns = references(outputs), references(units)
    given = lambda name: host.unit.getDirectionalDerivative(  # noqa: E731
        unknowns, references([name]), [1.0], len(numbers)
    )
    press(host, units)
    for _ in range(13):
        host.step(1e-4)
    found = jacobian(host, units, numbers, given)
    seed = np.sin(np.arange(len(numbers)) + 0.5)
    adjoint = np.array(host.unit.getAdjointDerivative(unknowns, knowns, list(seed), len(units)))
    # Roundings of a sum of some sixty products.
    assert np.all(np.abs(adjoint - seed @ found) <= 1e-12 * (np.abs(seed) @ np.abs(found))), fmu
    # What is not listed as a dependency has derivative 0, element by element.
    rows = iter(found)
    for name in outputs:
        listed = host.dependencies(name)
        for element in range(host.size(name)):
            number, row = element + 1 if host.variables[name].shape else 0, next(rows)
            for known, input, derivative in zip(knowns, units, row):
                assert (number, known) in listed or derivative == 0.0, f"{fmu}: {name} by {input}"
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
