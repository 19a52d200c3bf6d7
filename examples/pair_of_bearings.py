#!/usr/bin/env python3
"""A rigid shaft in two preloaded angular contact bearings: error over host and step, and the system as an SSP file.

    python examples/pair_of_bearings.py [--build] [--ssp 2.0] [--short] [--mounted O] [-o target/examples]

Both bearings are one FMU, of scenes/7205-pair.toml; the right one is mounted the other way by its parameter
`bearing.contact_angle`. `--mounted` says how: O back to back, X face to face, T in tandem. The shaft (3 kg, 60 mm
between the bearings) is closer to each by 5 um than where it just closes; in tandem a load of 300 N along the axis
preloads both. It rests; at the start 300 N across, 100 N along the axis and 2 N m are added.

`--build` writes the system only, `pair-O.ssp`: the two bearings and examples/system/shaft.c, compiled here with the C
compiler that CC names, else `cc`.

Hosts:
  tangent   a plain host in this file: the shaft's motion over a step by the bearings' tangent stiffness, 5 x 5, its
            velocity then by the mean forces and moments that came out
  ours      algorithms of system_of_fmus.py on the SSP file: parallel and sequential, with the standard's functions
  fmpy      fmpy.ssp.simulation: parallel, held, and every input 0 in the first step
The error is that of all five coordinates of the shaft, rms over rms of their way, tilts times half the distance of the
bearings, against `tangent` at half a microsecond.
"""

import math

import numpy as np
from bearing import SCENES, Instance, build, changed_scene
from system_of_fmus import (
    GRID, asked, by_fmpy, component, connector, error, head, ours, row, structure, unit_fmu, write_system
)  # fmt: skip

MASS, TRANSVERSE, POLAR = 3.0, 8e-3, 2e-3  # kg, kg m2
SPEED = 100.0 * math.pi  # rad/s
PLACES = {"left": -0.03, "right": 0.03}  # m
PRELOAD = 5e-6  # m
ADDED = np.array([0.0, -300.0, 100.0, 2.0, 0.0])  # N, N m
ANGLE = math.radians(25.0)
AXES = ("x", "y", "z", "tilt.x", "tilt.y")
# Of one bearing: its inputs in the order of the shaft's outputs, and what it gives back.
MOTION = [f"shaft.{order}{axis}" for order in ("", "v", "a") for axis in "xyz"]
MOTION += [f"shaft.tilt.{order}{axis}" for order in ("", "v", "a") for axis in "xy"]
FORCES = {
    kind: [f"shaft.{kind}force.{axis}" for axis in "xyz"] + [f"shaft.{kind}moment.{axis}" for axis in "xy"]
    for kind in ("", "mean_", "next_mean_")
}
SIZES = np.array([1.0, 1.0, 1.0, PLACES["right"], PLACES["right"]])
SHAFT = "shaft", dict(zip(AXES, SIZES))


def angles(mounted):
    """Contact angle of each bearing: a positive one carries pushes of the shaft towards +z."""
    left, right = {"O": (1, -1), "X": (-1, 1), "T": (1, 1)}[mounted]
    return {"left": left * ANGLE, "right": right * ANGLE}


def offsets(mounted):
    """By how much farther along z each inner ring sits than the shaft: so that a pair closes."""
    return {name: 0.0 if mounted == "T" else math.copysign(PRELOAD, angle) for name, angle in angles(mounted).items()}


def standing_load(mounted):
    return np.array([0.0, 0.0, 300.0 if mounted == "T" else 0.0, 0.0, 0.0])


def moved(name, mounted):
    """How a bearing's ring follows the shaft: position = matrix @ shaft + offset."""
    b, matrix = PLACES[name], np.eye(5)
    matrix[0, 4], matrix[1, 3] = b, -b
    return matrix, np.array([0.0, 0.0, offsets(mounted)[name], 0.0, 0.0])


class Plain:
    """The plain host: a rigid shaft in two bearings, by Newton's law and the bearings' tangent stiffness."""

    def __init__(self, fmu, mounted):
        self.bearings = {name: Instance(fmu, name) for name in PLACES}
        for name, bearing in self.bearings.items():
            bearing.enter({"bearing.contact_angle": angles(mounted)[name], "shaft.speed": SPEED})
        self.seats = {name: moved(name, mounted) for name in PLACES}
        self.load = standing_load(mounted)
        self.mass = np.diag([MASS] * 3 + [TRANSVERSE] * 2)
        self.turning = np.zeros((5, 5))
        self.turning[3, 4], self.turning[4, 3] = POLAR * SPEED, -POLAR * SPEED
        self.q, self.v = self.rest(), np.zeros(5)
        for bearing in self.bearings.values():
            bearing.run()

    def say(self, acceleration):
        for name, bearing in self.bearings.items():
            matrix, offset = self.seats[name]
            at, speed, change = matrix @ self.q + offset, matrix @ self.v, matrix @ acceleration
            values = [*at[:3], *speed[:3], *change[:3], *at[3:], *speed[3:], *change[3:]]
            bearing.write(MOTION, values)

    def force(self, kind=""):
        """Of both bearings on the shaft: forces, and moments about its middle."""
        pushes = ((self.seats[name][0], bearing.read(FORCES[kind])) for name, bearing in self.bearings.items())
        return sum(matrix.T @ push for matrix, push in pushes)

    def stiffness(self):
        total = np.zeros((5, 5))
        short = [axis.replace(".", "_") for axis in AXES]
        for name, bearing in self.bearings.items():
            matrix, _ = self.seats[name]
            own = bearing.read([stiffness_name(a, b) for a in short for b in short]).reshape(5, 5)
            total += matrix.T @ own @ matrix
        return total

    def rest(self):
        """Newton's iteration during initialization: elements and housing are in balance at every try."""
        self.q, self.v = np.array([0.0, 0.0, 5e-6 if self.load[2] else 0.0, 0.0, 0.0]), np.zeros(5)
        for _ in range(50):
            self.say(np.zeros(5))
            change = np.linalg.solve(self.stiffness(), self.force() + self.load)
            self.q = self.q + change
            if np.abs(change * SIZES).max() < 1e-15:
                break
        self.say(np.zeros(5))
        return self.q

    def step(self, h):
        force, k = self.force() + self.load - self.turning @ self.v, self.stiffness()
        # Trapezoidal rule on the linearized force.
        left = self.mass + 0.25 * h * h * k + 0.5 * h * self.turning
        change = np.linalg.solve(left, h * force - 0.5 * h * h * k @ self.v)
        self.say(change / h)
        for bearing in self.bearings.values():
            bearing.step(h)
        self.q = self.q + h * (self.v + 0.5 * change)
        turned = self.turning @ (self.v + 0.5 * change)
        self.v = self.v + h * np.linalg.solve(self.mass, self.force("mean_") + self.load - turned)

    def close(self):
        for bearing in self.bearings.values():
            bearing.close()


def stiffness_name(a, b):
    return f"shaft.stiffness.{a}{b}" if len(a) == len(b) == 1 else f"shaft.stiffness.{a}_{b}"


def by_tangent(fmu, mounted, h, stop):
    host = Plain(fmu, mounted)
    host.load = host.load + ADDED
    found, every = [host.q], round(GRID / h)
    for count in range(1, round(stop / h) + 1):
        host.step(h)
        if not np.all(np.abs(host.q * SIZES) < 1e-3):
            raise RuntimeError(f"unstable at {count * h:.4g} s")
        if count % every == 0:
            found.append(host.q)
    host.close()
    return np.array(found)


def variables():
    """Of the shaft's FMU, in the order of examples/system/shaft.c: name, causality, start."""
    found = []
    for name in PLACES:
        found += [(f"{name}.force.{axis}", "input", 0.0) for axis in "xyz"]
        found += [(f"{name}.moment.{axis}", "input", 0.0) for axis in "xy"]
    found += [(f"{name}.{motion[6:]}", "output", None) for name in PLACES for motion in MOTION]
    found += [(axis, "output", None) for axis in AXES]
    found += [(axis[:-1] + "v" + axis[-1], "output", None) for axis in AXES]
    parameters = {"mass": MASS, "transverse_inertia": TRANSVERSE, "polar_inertia": POLAR, "speed": SPEED}
    parameters.update({f"load.{axis}": 0.0 for axis in AXES})
    parameters.update({f"{name}.place": place for name, place in PLACES.items()})
    parameters.update({f"{name}.offset": 0.0 for name in PLACES})
    parameters.update({f"start.{axis}": 0.0 for axis in AXES})
    return found + [(name, "parameter", value) for name, value in parameters.items()]


def description(name, guid, what, variables):
    """Model description of a unit compiled from `system/<name>.c`, its variables in the order of their references."""
    kinds = {
        "input": 'variability="continuous"',
        "output": 'variability="continuous" initial="calculated"',
        "parameter": 'variability="fixed" initial="exact"',
    }
    lines, listed = "", ""
    for index, (variable, causality, value) in enumerate(variables):
        real = "<Real/>" if value is None else f'<Real start="{value!r}"/>'
        about = f'name="{variable}" valueReference="{index}" causality="{causality}" {kinds[causality]}'
        lines += f"<ScalarVariable {about}>{real}</ScalarVariable>"
        listed += f'<Unknown index="{index + 1}"/>' * (causality == "output")
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{name}" guid="{guid}"
    description="{what}" variableNamingConvention="structured">
<CoSimulation modelIdentifier="{name}" canHandleVariableCommunicationStepSize="true" canInterpolateInputs="true"
    canGetAndSetFMUstate="true"/>
<ModelVariables>{lines}</ModelVariables>
<ModelStructure><Outputs>{listed}</Outputs><InitialUnknowns>{listed}</InitialUnknowns></ModelStructure>
</fmiModelDescription>
""".encode()


def shaft_values(mounted, start):
    """The shaft's parameters, where it starts at rest."""
    values = {"mass": MASS, "transverse_inertia": TRANSVERSE, "polar_inertia": POLAR, "speed": SPEED}
    values.update({f"load.{axis}": load for axis, load in zip(AXES, standing_load(mounted) + ADDED)})
    values.update({f"{name}.place": place for name, place in PLACES.items()})
    values.update({f"{name}.offset": offset for name, offset in offsets(mounted).items()})
    return {**values, **{f"start.{axis}": place for axis, place in zip(AXES, start)}}


def bearings(mounted, folder):
    """A bearing for each place as it is mounted there, by place."""
    base, speed = SCENES / "7205-pair.toml", SPEED / (2 * math.pi)
    scenes = [
        changed_scene(
            base,
            f"7205-{name}",
            {"bearing.contact_angle_deg": math.degrees(angle), "shaft.speed_hz": speed},
            folder,
        )
        for name, angle in angles(mounted).items()
    ]
    return dict(zip(angles(mounted), build(scenes, folder)))


def pair(fmus, mounted, kind, start):
    """The system of these FMUs of bearings by place: bearings first."""
    elements, wires = [], []
    shaft_connectors = []
    for name in PLACES:
        gives = [force.replace("shaft.", "").replace(kind, "") for force in FORCES[kind]]
        connectors = [connector(motion, "input") for motion in MOTION]
        connectors += [connector(force, "output") for force in FORCES[kind]]
        values = {"bearing.contact_angle": angles(mounted)[name], "shaft.speed": SPEED}
        elements.append(component(name, f"resources/{fmus[name].name}", connectors, values))
        shaft_connectors += [connector(f"{name}.{force}", "input") for force in gives]
        shaft_connectors += [connector(f"{name}.{motion[6:]}", "output") for motion in MOTION]
        wires += [(name, a, "shaft", f"{name}.{b}") for a, b in zip(FORCES[kind], gives)]
        wires += [("shaft", f"{name}.{motion[6:]}", name, motion) for motion in MOTION]
    shaft_connectors += [connector(axis, "output") for axis in AXES]
    elements.append(component("shaft", "resources/shaft.fmu", shaft_connectors, shaft_values(mounted, start)))
    return structure("pair_of_bearings", elements, wires, 0.01)


ALGORITHMS = [
    ("ours", "parallel", "`force`, held", "", ours("parallel", "held", SHAFT)),
    ("ours", "parallel", "`next_mean_force`, held", "next_mean_", ours("parallel", "held", SHAFT)),
    ("ours", "parallel", "`force` and its derivative", "", ours("parallel", "derivative", SHAFT)),
    ("ours", "sequential", "`force`, interpolated", "", ours("sequential", "interpolated", SHAFT)),
    ("ours", "sequential", "`mean_force`, held", "mean_", ours("sequential", "held", SHAFT)),
    ("fmpy", "parallel, begins with 0", "`force`, held", "", by_fmpy(SHAFT)),
]


def main():
    mounted = {"choices": ["O", "X", "T"], "default": "O", "help": "back to back, face to face, tandem"}
    options = asked(__doc__, "two steps, 2 ms", ("--mounted", mounted))
    steps = (5e-6, 2e-5) if options.short else (1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4)
    stop = 2e-3 if options.short else 0.01
    options.output.mkdir(parents=True, exist_ok=True)
    fmus = bearings(options.mounted, options.output)
    host = Plain(fmus["left"], options.mounted)
    start, stiffness = host.q, host.stiffness()
    host.close()
    guid = "{5f6f5a0e-2a4b-4a0f-8a55-0f3c5d9d7b21}"
    text = description("shaft", guid, "A rigid shaft in two bearings", variables())
    shaft = unit_fmu(options.output, "shaft", text, shaft_values(options.mounted, start))
    systems = {}
    for kind in FORCES:
        path = options.output / f"pair-{options.mounted}{'-' * bool(kind)}{kind.strip('_')}.ssp"
        text = pair(fmus, options.mounted, kind, start)
        systems[kind] = write_system(path, text, [*fmus.values(), shaft], options.ssp)
        print(path)
    print(f"stiffness: {stiffness[2, 2]:.4g} N/m along the axis, {stiffness[3, 3]:.4g} N m/rad against tilt")
    if options.build:
        return
    exact = by_tangent(fmus["left"], options.mounted, 5e-7, stop)
    head(steps, "whose", "algorithm", "the shaft gets")
    cells = [error(exact, by_tangent, fmus["left"], options.mounted, h, stop, body=SHAFT) for h in steps]
    row("plain host", "tangent stiffness", "`mean_force`", *cells)
    for whose, algorithm, handover, kind, run in ALGORITHMS:
        row(whose, algorithm, handover, *(error(exact, run, systems[kind], h, stop, body=SHAFT) for h in steps))


if __name__ == "__main__":
    main()
