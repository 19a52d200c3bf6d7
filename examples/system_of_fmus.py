#!/usr/bin/env python3
"""A bearing and an elastic rotor, two FMUs wired in an SSP file: error over casing, algorithm, wiring and step, as Markdown.

    python examples/system_of_fmus.py [--build] [--ssp 2.0] [--short] [-o target/examples]

The rotor is `examples/system/rotor.c`, an overhung mass of 3 kg on a shaft of 1e7 N/m without a damper, compiled here
with the C compiler that CC names, else `cc`. It rests in the bearing under half of its 500 N; at the start the other
half is added. The error is that of its position, rms over rms of its way, against one FMU that holds mass and spring:
the scene's own `shaft.mass_kg` and `shaft.stiffness_n_m`, no coupling at all.

Its casing is the scene's, `free` on springs with a damper; or the same without a damper; or `fixed`: it stands.

`--build` writes the systems of the free casing only, bearing and rotor in one `.ssp` each (System Structure and
Parameterization 1.0, or 2.0 by `--ssp`), healthy and spalled, by what the rotor gets: `healthy-force.ssp`, `healthy-mean_force.ssp`,
`healthy-next_mean_force.ssp`, and `spalled-…`.

Masters that read them:
  ours      parallel (Jacobi) and sequential (Gauss-Seidel, in the order of the file), inputs held, continued with the
            derivatives that the other FMU gives, or interpolated; parallel and iterated, each step four times from the
            same point with what came out (`host.repeated_inputs`); nothing but the standard's functions
  fmpy      fmpy.ssp.simulation: parallel, held, and every input 0 in the first step
"""

import os
import shlex
import subprocess
import uuid
import zipfile
from contextlib import contextmanager
from ctypes import c_int
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import numpy as np
from bearing import SCENES, Instance, Numbers, build, changed_scene, parser, percent, unzipped, whole
from fmpy.fmi1 import FMICallException
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd

HERE = Path(__file__).resolve().parent / "system"
MASS, STIFFNESS, LOAD = 3.0, 1e7, 500.0  # kg, N/m, N
GRID = 1e-4  # s between the positions that are compared
# The body whose position is compared; coordinates, and by which length [m] a unit of each counts.
ROTOR = "rotor", {"x": 1.0, "y": 1.0}
PASSES, END = 4, 2  # of each step, iterated; number of the item `end` of `host.repeated_inputs`
MOTION = {"x": "shaft.x", "y": "shaft.y", "vx": "shaft.vx", "vy": "shaft.vy", "ax": "shaft.ax", "ay": "shaft.ay"}


def unit_fmu(folder, name, description, values=None):
    """Compiles `system/<name>.c` and packs it with this model description; gives the FMU's path.

    `values` become start values of the FMU itself, for there are players that pass over those of an SSP file.
    """
    root, given = ElementTree.fromstring(description), []
    for variable in root.iter("ScalarVariable"):
        if variable.get("name") in (values or {}):
            value = float(values[variable.get("name")])
            variable.find("Real").set("start", repr(value))
            given.append(f"{{{variable.get('valueReference')}, {value!r}}}")
    if given:
        root.set("guid", f"{{{uuid.uuid5(uuid.UUID(root.get('guid')), ','.join(given))}}}")
        description = ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)
    headers = Path(fmpy.__file__).parent / "c-code"
    library = Path(folder) / f"{name}{fmpy.sharedLibraryExtension}"
    compiler = shlex.split(os.environ.get("CC", "cc"))
    words = ["-std=c11", "-O2", "-shared", "-fPIC", f'-DUNIT_GUID="{root.get("guid")}"', "-I", headers]
    words += [f"-DUNIT_START={','.join(given)}"] * bool(given) + [HERE / f"{name}.c"]
    try:
        subprocess.run([*compiler, *map(str, words), "-lm", "-o", str(library)], check=True)
    except FileNotFoundError:
        raise SystemExit(f"{compiler[0]}: no such C compiler; name one by the environment's CC") from None
    path = Path(folder) / f"{name}.fmu"
    with whole(path) as part, zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as fmu:
        fmu.writestr("modelDescription.xml", description)
        for source in (f"{name}.c", "unit.h"):
            fmu.write(HERE / source, f"sources/{source}")
        fmu.write(library, f"binaries/{fmpy.platform}/{library.name}")
    library.unlink()
    return path


CASINGS = {
    "free": {},
    "no damper": {"housing.damping_n_s_m": 0.0},
    "fixed": {"housing": None, "housing.motion": "fixed", "sensor": None},
}


def fmus_in(folder, casings):
    """The bearings, healthy and spalled: below a shaft that the host moves, and with mass and spring inside."""
    base = SCENES / "er16k-tb1-hosted-shaft.toml"
    common = {"shaft.speed_hz": 30.0, "solver.tolerance": 1e-9}
    ring = {"mass_kg": MASS, "stiffness_n_m": STIFFNESS, "damping_n_s_m": 0.0, "load_n": [0.0, -LOAD / 2]}
    inside = {"shaft.motion": "internal", **{f"shaft.{key}": value for key, value in ring.items()}}
    scenes, cases = [], []
    for name, defect in (("healthy", {"defect": None, "contact": None}), ("spalled", {})):
        for casing in casings:
            loads = {} if casing == "fixed" else {"housing.load_n": [0.0, 0.0]}
            changes = {**defect, **CASINGS[casing], **common, **loads}
            stem = f"system-{name}" if casing == "free" else f"system-{name}-{casing.replace(' ', '-')}"
            scenes.append(changed_scene(base, stem, changes, folder))
            scenes.append(changed_scene(base, f"{stem}-whole", {**changes, **inside}, folder))
            cases.append((name, casing))
    paths = build(scenes, folder)
    return {case: paths[2 * i : 2 * i + 2] for i, case in enumerate(cases)}


def whole_run(fmu, stop):
    """Positions of the mass inside one FMU, every GRID seconds."""
    instance = Instance(fmu)
    instance.enter()
    seen = ["shaft.x", "shaft.y"]
    positions = [instance.read(seen)]
    instance.run()
    instance.write(["shaft.load.y"], [-LOAD])
    for _ in range(round(stop / GRID)):
        instance.step(GRID)
        positions.append(instance.read(seen))
    instance.close()
    return np.array(positions)


def connector(name, kind):
    return f'<ssd:Connector name="{name}" kind="{kind}"><ssc:Real/></ssd:Connector>'


def component(name, source, connectors, values):
    """An FMU of a system with its connectors, and the values of its parameters if there are any: the FMU has the same
    as start values, for fmpy's `simulate_ssp` reads none of an SSP file."""
    listed = "".join(
        f'<ssv:Parameter name="{parameter}"><ssv:Real value="{float(value)!r}"/></ssv:Parameter>'
        for parameter, value in values.items()
    )
    bindings = (
        "<ssd:ParameterBindings><ssd:ParameterBinding><ssd:ParameterValues>"
        f'<ssv:ParameterSet version="1.0" name="{name}"><ssv:Parameters>{listed}</ssv:Parameters></ssv:ParameterSet>'
        "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>\n"
    )
    return (
        f'<ssd:Component name="{name}" type="application/x-fmu-sharedlibrary" source="{source}">\n'
        f"<ssd:Connectors>{''.join(connectors)}</ssd:Connectors>\n{bindings if values else ''}</ssd:Component>\n"
    )


def structure(name, components, wires, stop):
    """SystemStructure.ssd until `stop` [s]; components in the order in which a sequential algorithm steps."""
    connections = "".join(
        f'<ssd:Connection startElement="{a}" startConnector="{b}" endElement="{c}" endConnector="{d}"/>\n'
        for a, b, c, d in wires
    )
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="{name}" version="1.0"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues">
<ssd:System name="system">
<ssd:Elements>
{"".join(components)}</ssd:Elements>
<ssd:Connections>
{connections}</ssd:Connections>
</ssd:System>
<ssd:DefaultExperiment startTime="0" stopTime="{stop}"/>
</ssd:SystemStructureDescription>
"""


def rotor_values(start):
    """The rotor's parameters, where it starts at rest."""
    return {"mass": MASS, "stiffness": STIFFNESS, "load.y": -LOAD, "start.x": start[0], "start.y": start[1]}


def bearing_and_rotor(bearing, force, start):
    """The system: bearing first."""
    forces = {f"shaft.{force}.{axis}": f"force.{axis}" for axis in "xy"}
    to_bearing = [connector(name, "input") for name in MOTION.values()]
    from_bearing = [connector(name, "output") for name in forces]
    to_rotor = [connector(name, "input") for name in forces.values()]
    from_rotor = [connector(name, "output") for name in MOTION]
    wires = [("bearing", a, "rotor", b) for a, b in forces.items()]
    wires += [("rotor", a, "bearing", b) for a, b in MOTION.items()]
    components = [
        component("bearing", f"resources/{bearing}", to_bearing + from_bearing, {}),
        component("rotor", "resources/rotor.fmu", to_rotor + from_rotor, rotor_values(start)),
    ]
    return structure("bearing_and_rotor", components, wires, 0.02)


def in_version(structure, ssp):
    """The same structure in a version of SSP: from 1.0 to 2.0 what these systems use has stayed."""
    first, rest = structure.split("\n", 1)
    return first + "\n" + rest.replace('version="1.0"', f'version="{ssp}"')


def write_system(path, text, fmus, ssp="1.0"):
    with whole(path) as part, zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as system:
        system.writestr("SystemStructure.ssd", in_version(text, ssp))
        for fmu in fmus:
            system.write(fmu, f"resources/{fmu.name}")
    return path


class Unit(Instance):
    """A component of a system: its values and derivatives by connector."""

    def __init__(self, component, folder, iterated=False):
        super().__init__(os.path.join(folder, component.source), component.name)
        if iterated and "host.repeated_inputs" in self.reference:
            self.unit.setInteger([self.reference["host.repeated_inputs"]], [END])
        self.enter({parameter.name: float(parameter.value) for parameter in parameters_of(component)})
        names = {kind: [c.name for c in component.connectors if c.kind == kind] for kind in ("input", "output")}
        self.inputs, self.outputs = (Numbers(self, names[kind]) for kind in ("input", "output"))
        self.names = names["output"]
        self.orders = (c_int * max(map(len, names.values())))(*[1] * max(map(len, names.values())))
        what = self.description.coSimulation
        self.gives_derivatives, self.takes_derivatives = what.maxOutputDerivativeOrder > 0, what.canInterpolateInputs

    def give(self):
        self.call(self.unit.fmi2GetReal, *self.outputs.arguments)
        return self.outputs.array.copy()

    def derivatives(self):
        component, references, count, values = self.outputs.arguments
        self.call(self.unit.fmi2GetRealOutputDerivatives, component, references, count, self.orders, values)
        return self.outputs.array.copy()

    def tell(self, values, slopes=None):
        self.inputs.array[:] = values
        component, references, count, pointer = self.inputs.arguments
        self.call(self.unit.fmi2SetReal, component, references, count, pointer)
        if slopes is not None:
            self.inputs.array[:] = slopes
            self.call(self.unit.fmi2SetRealInputDerivatives, component, references, count, self.orders, pointer)


@contextmanager
def running(ssp, iterated=False):
    """The units of a system and their wires, with what they start from, running; closed at the end.

    Each gets what those before it in the file make of theirs: what the last starts from moves the bearings, whose
    forces it then gets.
    """
    system, folder = read_ssd(str(ssp)).system, unzipped(str(ssp))
    units = {one.name: Unit(one, folder, iterated) for one in system.elements}
    ends = {(c.endElement, c.endConnector): (c.startElement, c.startConnector) for c in system.connections}
    wires = {}
    for one in system.elements:
        sources = [ends[one.name, c.name] for c in one.connectors if c.kind == "input"]
        wires[one.name] = [(name, units[name].names.index(output)) for name, output in sources]
    try:
        for name in units:
            given = {other: unit.give() for other, unit in units.items()}
            units[name].tell([given[other][i] for other, i in wires[name]])
        for unit in units.values():
            unit.run()
        yield units, wires
    finally:
        for unit in units.values():
            unit.close()


def ours(kind, handover, body=ROTOR, grid=GRID):
    """An algorithm: `kind` parallel, iterated or sequential; inputs by `handover` held, with derivative, or
    interpolated. It gives the positions of the `body` every `grid` seconds."""
    name, sizes = body

    def run(ssp, h, stop):
        with running(ssp, kind == "iterated") as (units, wires):
            places = [units[name].names.index(axis) for axis in sizes]
            found, every = [units[name].give()[places]], round(grid / h)
            for count in range(1, round(stop / h) + 1):
                step(units, wires, h, kind, handover)
                position = units[name].give()[places]
                if not np.all(np.abs(position * list(sizes.values())) < 1e-3):
                    raise RuntimeError(f"unstable at {count * h:.4g} s")
                if count % every == 0:
                    found.append(position)
        return np.array(found)

    return run


def step(units, wires, h, kind, handover):
    """One communication step of all units."""
    if kind == "iterated":
        return iterate(units, wires, h)
    begin = {name: unit.give() for name, unit in units.items()}
    slopes = {name: np.zeros(len(values)) for name, values in begin.items()}
    if handover == "derivative":
        slopes.update({name: unit.derivatives() for name, unit in units.items() if unit.gives_derivatives})
    known = dict(begin)
    for name, unit in units.items():
        values = [known[other][i] for other, i in wires[name]]
        if handover == "interpolated":
            # Of those that have stepped already: from where they were to where they are.
            values = [begin[other][i] for other, i in wires[name]]
            slopes = {other: (known[other] - begin[other]) / h for other in known}
        rates = [slopes[other][i] for other, i in wires[name]]
        unit.tell(values, rates if unit.takes_derivatives and any(rates) else None)
        unit.step(h)
        if kind == "sequential":
            known[name] = unit.give()


def iterate(units, wires, h):
    """One communication step of all units in parallel, taken again and again with what the others came to."""
    for repeat in range(PASSES):
        known = {name: unit.give() for name, unit in units.items()}
        for name, unit in units.items():
            unit.restore() if repeat else unit.save()
            unit.tell([known[other][i] for other, i in wires[name]])
            unit.step(h)


def parameters_of(component):
    sets = [values for binding in component.parameterBindings for values in binding.parameterValues]
    return [parameter for values in sets for parameter in values.parameters]


def by_fmpy(body=ROTOR):
    """fmpy's algorithm, as `ours` gives one."""
    name, sizes = body

    def run(ssp, h, stop):
        (body,) = (one for one in read_ssd(str(ssp)).system.elements if one.name == name)
        given = {parameter.name: float(parameter.value) for parameter in parameters_of(body)}
        start = [given[f"start.{axis}"] for axis in sizes]
        # It adds up the time: half a step less ends where the last step does. Its rows are those after each step.
        found = simulate_ssp(str(ssp), stop_time=stop - 0.5 * h, step_size=h)
        positions = np.column_stack([found[f"{name}.{axis}"] for axis in sizes])
        return np.vstack([start, positions[round(GRID / h) - 1 :: round(GRID / h)]])

    return run


# Whose algorithm, how it steps, what the rotor gets, and of which system.
ALGORITHMS = [
    ("ours", "parallel", "`mean_force`, held", "mean_force", ours("parallel", "held")),
    ("ours", "parallel", "`force`, held", "force", ours("parallel", "held")),
    ("ours", "parallel", "`next_mean_force`, held", "next_mean_force", ours("parallel", "held")),
    ("ours", "parallel", "`force` and its derivative", "force", ours("parallel", "derivative")),
    ("ours", "iterated", "`mean_force`, held; the end repeated", "mean_force", ours("iterated", "held")),
    ("ours", "sequential", "`force`, held", "force", ours("sequential", "held")),
    ("ours", "sequential", "`force`, interpolated", "force", ours("sequential", "interpolated")),
    ("ours", "sequential", "`mean_force`, held", "mean_force", ours("sequential", "held")),
    ("fmpy", "parallel, begins with 0", "`force`, held", "force", by_fmpy()),
]


def error(exact, run, *arguments, body=ROTOR):
    """Of what `run` finds, as a cell of the table."""
    sizes = list(body[1].values())
    try:
        apart = (run(*arguments) - exact) * sizes
    except (RuntimeError, FMICallException, np.linalg.LinAlgError):
        return "unstable"
    way = (exact - exact[0]) * sizes
    return percent(np.sqrt(np.mean(np.sum(apart**2, axis=1)) / np.mean(np.sum(way**2, axis=1))))


def row(*cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def head(steps, *words):
    """First lines of a table of errors by step."""
    row(*words, *(f"{h * 1e6:g} µs" for h in steps))
    print("|" + "---|" * (len(words) + len(steps)))


def asked(about, short, *more):
    """Options of an example that writes SSP files, with `more` of its own."""
    words = parser(about)
    for name, how in more:
        words.add_argument(name, **how)
    words.add_argument("--build", action="store_true", help="write the SSP files, run nothing")
    words.add_argument("--short", action="store_true", help=short)
    words.add_argument("--ssp", choices=("1.0", "2.0"), default="1.0", help="version of the SSP files")
    options = words.parse_args()
    if options.ssp != "1.0" and not options.build:
        words.error("fmpy reads SSP 1.0 only: add --build")
    return options


def main():
    options = asked(__doc__, "two steps, 5 ms")
    steps = (1e-5, 1e-4) if options.short else (1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4)
    stop = 5e-3 if options.short else 0.02
    casings = ["free"] if options.build or options.short else list(CASINGS)
    fmus = fmus_in(options.output, casings)
    if not options.build:
        head(steps, "bearing", "casing", "whose", "algorithm", "the rotor gets")
    for (name, casing), (bearing, inside) in fmus.items():
        exact = whole_run(inside, GRID if options.build else stop)
        rotor = unit_fmu(options.output, "rotor", (HERE / "rotor.xml").read_bytes(), rotor_values(exact[0]))
        systems = {}
        for force in ("force", "mean_force", "next_mean_force"):
            path = options.output / f"{bearing.stem.removeprefix('system-')}-{force}.ssp"
            text = bearing_and_rotor(bearing.name, force, exact[0])
            systems[force] = write_system(path, text, [bearing, rotor], options.ssp)
            if options.build:
                print(path)
        for whose, kind, handover, force, run in ALGORITHMS if not options.build else ():
            row(name, casing, whose, kind, handover, *(error(exact, run, systems[force], h, stop) for h in steps))


if __name__ == "__main__":
    main()
