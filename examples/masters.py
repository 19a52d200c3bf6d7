#!/usr/bin/env python3
"""Which force for which master? Error of a rotor coupled to the bearing over the communication step, as Markdown.

    python examples/masters.py [--short]

Two units that a master couples: the bearing, told position, velocity and acceleration of its shaft, and a rotor of 3
kg, told one force. The rotor rests under half its load; at the start the other half is added, so that it swings in the
bearing. It has no damper of its own that would hide what energy the coupling makes. The error is that of its position,
rms over rms of its way, against one FMU that holds the same mass: no coupling at all.

Masters:
  parallel     both are told what the other gave at the step's start, and step together (Jacobi);
  sequential   the bearing steps first, and the rotor is told what came out (Gauss-Seidel).
Forces:
  held         the force stands still over the rotor's step;
  derivative   it goes on with the derivative that the FMU gives (fmi2GetRealOutputDerivatives), set for the rotor;
  interpolated it runs from the force at the step's start to that at its end, which only a sequential master knows.
"""

import argparse
from ctypes import c_int
from pathlib import Path

import numpy as np
from bearing import SCENES, Bearing, Instance, Numbers, build, changed_scene, percent

MASS, LOAD, SPEED = 3.0, 500.0, 2 * np.pi * 30.0  # kg, N, rad/s
TOLERANCE = 1e-9  # the FMU's own errors stay below those of the coupling
START = {"shaft.speed": SPEED, "solver.tolerance": TOLERANCE}
GRID = 1e-4  # s between the positions that are compared


class Rotor:
    """A mass that is told a force, which may change evenly in time: its step is exact."""

    def __init__(self, position, force):
        self.position, self.velocity = np.array(position), np.zeros(2)
        self.tell(force)

    def tell(self, force, rate=0.0):
        self.force, self.rate = force, rate

    def motion(self):
        """What the unit gives: the acceleration is that of the force it knows."""
        return self.position, self.velocity, (self.force + [0.0, -LOAD]) / MASS

    def step(self, h):
        _, v, a = self.motion()
        jerk = self.rate / MASS
        self.position = self.position + h * v + h**2 / 2 * a + h**3 / 6 * jerk
        self.velocity = v + h * a + h**2 / 2 * jerk
        self.force = self.force + h * self.rate


class Hosted(Bearing):
    """The bearing with the outputs that a master may wire."""

    def __init__(self, fmu):
        super().__init__(fmu, start={**START, "housing.load.y": 0.0})
        self.orders = (c_int * 2)(1, 1)
        forces = ("force", "mean_force")
        self.wired = {name: Numbers(self, [f"shaft.{name}.{axis}" for axis in "xy"]) for name in forces}

    def give(self, name):
        numbers = self.wired[name]
        self.call(self.slave.fmi2GetReal, *numbers.arguments)
        return numbers.array.copy()

    def derivative(self, name):
        component, references, count, values = self.wired[name].arguments
        self.call(self.slave.fmi2GetRealOutputDerivatives, component, references, count, self.orders, values)
        return self.wired[name].array.copy()

    def tell(self, position, velocity, acceleration):
        self.motion.array[:] = *position, *velocity, *acceleration
        self.call(self.slave.fmi2SetReal, *self.motion.arguments)


def parallel(name, derivative=False):
    def step(bearing, rotor, h):
        force, rate = bearing.give(name), bearing.derivative(name) if derivative else 0.0
        bearing.tell(*rotor.motion())
        rotor.tell(force, rate)
        bearing.step(h)
        rotor.step(h)

    return step


def sequential(name, interpolated=False):
    def step(bearing, rotor, h):
        bearing.tell(*rotor.motion())
        begin = bearing.give("force")
        bearing.step(h)
        end = bearing.give(name)
        rotor.tell(begin, (end - begin) / h) if interpolated else rotor.tell(end)
        rotor.step(h)

    return step


MASTERS = {
    ("parallel", "`mean_force`, held"): parallel("mean_force"),
    ("parallel", "`mean_force` and its derivative, which is 0"): parallel("mean_force", derivative=True),
    ("parallel", "`force`, held"): parallel("force"),
    ("parallel", "`force` and its derivative"): parallel("force", derivative=True),
    ("sequential", "`force`, held"): sequential("force"),
    ("sequential", "`force`, interpolated"): sequential("force", interpolated=True),
    ("sequential", "`mean_force`, held"): sequential("mean_force"),
}


def coupled(master, fmu, h, stop):
    """Positions of the rotor, every GRID seconds."""
    bearing = Hosted(fmu)
    try:
        position = bearing.rest([0.0, -LOAD / 2])
        rotor = Rotor(position, bearing.force_at(position))
        bearing.run()
        positions, every = [rotor.position], round(GRID / h)
        for count in range(1, round(stop / h) + 1):
            master(bearing, rotor, h)
            if not np.all(np.abs(rotor.position) < 1e-3):
                raise RuntimeError(f"unstable at {count * h:.4g} s")
            if count % every == 0:
                positions.append(rotor.position)
    finally:
        bearing.close()
    return np.array(positions)


def whole(fmu, stop):
    """The same of one FMU that holds the mass."""
    instance = Instance(fmu)
    instance.enter({**START, "shaft.load.y": -LOAD / 2})
    instance.run()
    instance.write(["shaft.load.y"], [-LOAD])
    seen = ["shaft.x", "shaft.y"]
    positions = [instance.read(seen)]
    for _ in range(round(stop / GRID)):
        instance.step(GRID)
        positions.append(instance.read(seen))
    instance.close()
    return np.array(positions)


def fmus_in(folder):
    """Healthy and spalled: the bearing below a shaft that the host moves, and the same with the rotor's mass inside."""
    base = SCENES / "er16k-tb1-hosted-shaft.toml"
    ring = {"shaft.motion": "internal", "shaft.mass_kg": MASS, "shaft.damping_n_s_m": 0.0}
    inside = {**ring, "housing.load_n": [0.0, 0.0]}
    healthy = {"defect": None, "contact": None}
    scenes = []
    for name, changes in (("healthy", healthy), ("spalled", {})):
        scenes.append(changed_scene(base, f"masters-{name}", changes, folder))
        scenes.append(changed_scene(base, f"masters-{name}-whole", {**changes, **inside}, folder))
    paths = build(scenes, folder)
    return {"healthy": paths[:2], "spalled": paths[2:]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--short", action="store_true", help="two steps, 5 ms")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    options = parser.parse_args()
    steps = (1e-5, 1e-4) if options.short else (1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4)
    stop = 5e-3 if options.short else 0.02
    print("| bearing | master | the rotor is told | " + " | ".join(f"{h * 1e6:g} µs" for h in steps) + " |")
    print("|---|---|---|" + "---|" * len(steps))
    for name, (hosted, inside) in fmus_in(options.output).items():
        exact = whole(inside, stop)
        way = np.sqrt(np.mean(np.sum((exact - exact[0]) ** 2, axis=1)))
        for (kind, told), master in MASTERS.items():
            cells = []
            for h in steps:
                try:
                    apart = coupled(master, hosted, h, stop) - exact
                except RuntimeError:
                    cells.append("unstable")
                    continue
                error = np.sqrt(np.mean(np.sum(apart**2, axis=1))) / way
                cells.append(percent(error))
            print(f"| {name} | {kind} | {told} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
