#!/usr/bin/env python3
"""A rotor with unbalance in a pair of bearings, run up through its critical speed: against one in linear bearings.

    python examples/run_up.py [--build] [--ssp 2.0] [--short] [--step 2e-5] [-o target/examples]

A disk of 10 kg in the middle of an elastic shaft of 2e7 N/m, its journals of 1 kg in two healthy ER16K bearings in a
casing that stands. It carries 1000 N and is run up by 150 Hz per second with 0.6 um of unbalance.

Hosts:
  python    in this file: bearings first, then the rotor under their mean force over the step (sequential)
  ssp       the same system as three FMUs in `run-up.ssp`, the rotor examples/system/disk.c, by the parallel algorithm
            of system_of_fmus.py with `shaft.next_mean_force`; `--build` writes that file only
  linear    the Python host with springs and dampers in place of the bearings: `shaft.stiffness` and the contacts'
            damping at rest under half the load, their mean over the cage's angle
Without rotation the linear rotor's modes are those of its matrices, printed with their frequencies.
"""

import json

import numpy as np
from bearing import SCENES, Bearing, build, changed_scene
from pair_of_bearings import description
from system_of_fmus import CASINGS, asked, component, connector, ours, structure, unit_fmu, write_system

MASS, JOURNAL, STIFFNESS = 10.0, 1.0, 2e7  # kg, kg, N/m
DAMPING = 2 * 0.02 * np.sqrt(STIFFNESS * MASS)  # N s/m on the disk, from outside
ECCENTRICITY, LOAD = 6e-7, 1000.0  # m, N
FROM, RATE = 2 * np.pi * 170.0, 2 * np.pi * 150.0  # rad/s, rad/s2
SIDES = ("left", "right")
MOTION = ("x", "y", "vx", "vy", "ax", "ay")


def turning(t):
    """Force of the unbalance [N]."""
    speed, angle = FROM + RATE * t, (FROM + 0.5 * RATE * t) * t
    radial, along = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    return MASS * ECCENTRICITY * (speed**2 * radial + RATE * along)


class Linear:
    """Springs and dampers in place of a bearing, about where it rests."""

    def __init__(self, rest, load, stiffness, damping):
        self.rest, self.load, self.k, self.c = rest, load, stiffness, damping

    def force(self, position, velocity):
        return -self.load - self.k @ (position - self.rest) - self.c @ velocity

    def advance(self, position, velocity, acceleration, h):
        mean = position + h / 2 * velocity + h * h / 6 * acceleration, velocity + h / 2 * acceleration
        end = position + h * velocity + h * h / 2 * acceleration, velocity + h * acceleration
        return self.force(*mean), self.force(*end)

    def write(self, names, values):
        """It has no speed."""

    def close(self):
        """Nor anything to give back."""


def matrices():
    """M and K of (left, right, disk) along one axis, without bearings."""
    shape = np.array([-0.5, -0.5, 1.0])
    return np.diag([JOURNAL, JOURNAL, MASS]), STIFFNESS * np.outer(shape, shape)


def propagators(h):
    """Over a step under constant forces: state' = E state + G forces, by the exponential series of both at once."""
    masses, stiffness = matrices()
    whole_step = np.zeros((9, 9))
    whole_step[:3, 3:6] = np.eye(3)
    whole_step[3:6, :3] = -np.linalg.solve(masses, stiffness)
    whole_step[5, 5] = -DAMPING / MASS
    whole_step[3:6, 6:] = np.linalg.inv(masses)
    term, found = np.eye(9), np.eye(9)
    for n in range(1, 30):
        term = term @ (h * whole_step) / n
        found += term
    return found[:6, :6], found[:6, 6:]


def run(bearings, rest, h, stop):
    """Positions of the disk after each step [m], x and y from where it rests; bearings as `Bearing`."""
    masses, stiffness = matrices()
    step_state, step_forces = propagators(h)
    weight = np.array([0.0, -LOAD])
    # Rows are left, right, disk; columns x and y.
    x, v = np.array([rest, rest, rest + weight / STIFFNESS]), np.zeros((3, 2))
    still, ends = x[2].copy(), [-weight / 2, -weight / 2]
    found = []
    for count in range(round(stop / h)):
        t = count * h
        a = np.linalg.solve(masses, np.array([*ends, weight + turning(t)]) - stiffness @ x)
        means = []
        for i, bearing in enumerate(bearings):
            bearing.write(["shaft.speed"], [FROM + RATE * t])
            mean, ends[i] = bearing.advance(x[i], v[i], a[i], h)
            means.append(mean)
        unbalance = (turning(t) + 4 * turning(t + h / 2) + turning(t + h)) / 6
        state = step_state @ np.vstack([x, v]) + step_forces @ np.array([*means, weight + unbalance])
        x, v = state[:3], state[3:]
        if not np.all(np.abs(x) < 1e-3):
            raise RuntimeError(f"unstable at {t:.4g} s")
        found.append(x[2] - still)
    for bearing in bearings:
        bearing.close()
    return np.array(found)


def settled(fmu, start, name="bearing"):
    """A bearing that carries half the load, still in initialization, and where its shaft then is."""
    bearing = Bearing(fmu, name, start)
    return bearing, bearing.rest([0.0, -LOAD / 2])


def linear_bearing(fmu, positions=16):
    """A bearing's stiffness and damping at rest, mean over the cage's angle within one element spacing."""
    found = []
    for angle in np.arange(positions) / positions * 2 * np.pi / 9:
        bearing, _ = settled(fmu, {"shaft.speed": FROM, "cage.initial_angle": angle})
        found.append(bearing.linear())
        bearing.close()
    stiffness, damping = (np.mean(part, axis=0) for part in zip(*found))
    return stiffness, damping


def frequencies(stiffness):
    """Of the linear rotor along x and y [Hz], lowest first, without damping."""
    masses, own = matrices()
    found = []
    for axis in range(2):
        k = own + np.diag([stiffness[axis, axis]] * 2 + [0.0])
        found.append(np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(masses, k)).real)[0]) / 2 / np.pi)
    return found


def variables():
    """Name, causality and start value of the rotor's FMU by reference, as in disk.c."""
    found = [(f"{side}.force.{axis}", "input", 0.0) for side in SIDES for axis in "xy"]
    found += [("speed", "output", None)]
    found += [(f"{side}.{motion}", "output", None) for side in SIDES for motion in MOTION]
    found += [(name, "output", None) for name in ("x", "y", "vx", "vy", "angle")]
    parameters = {"mass": MASS, "journal_mass": JOURNAL, "stiffness": STIFFNESS, "damping": 0.0, "eccentricity": 0.0}
    parameters.update({"rate": 0.0, "load": 0.0, "start.speed": 0.0, "start.x": 0.0, "start.y": 0.0})
    return found + [(name, "parameter", value) for name, value in parameters.items()]


def disk_values(rest):
    """The rotor's parameters, where it starts at rest."""
    values = {"damping": DAMPING, "eccentricity": ECCENTRICITY, "rate": RATE, "load": -LOAD}
    return {**values, "start.speed": FROM, "start.x": rest[0], "start.y": rest[1]}


def pair_and_disk(bearing, rest):
    """The system: bearings first, then the rotor."""
    elements, wires, own = [], [], [connector("speed", "output")]
    for side in SIDES:
        moves = ["shaft.speed", *(f"shaft.{motion}" for motion in MOTION)]
        gives = [f"shaft.next_mean_force.{axis}" for axis in "xy"]
        connectors = [connector(name, "input") for name in moves] + [connector(name, "output") for name in gives]
        values = {"shaft.speed": FROM, "shaft.x": rest[0], "shaft.y": rest[1]}
        elements.append(component(side, f"resources/{bearing}", connectors, values))
        own += [connector(f"{side}.force.{axis}", "input") for axis in "xy"]
        own += [connector(f"{side}.{motion}", "output") for motion in MOTION]
        wires += [(side, gave, "disk", f"{side}.force.{axis}") for gave, axis in zip(gives, "xy")]
        wires += [("disk", "speed", side, "shaft.speed")]
        wires += [("disk", f"{side}.{motion}", side, f"shaft.{motion}") for motion in MOTION]
    own += [connector(axis, "output") for axis in "xy"]
    elements.append(component("disk", "resources/disk.fmu", own, disk_values(rest)))
    return structure("run_up", elements, wires, 0.7)


def run_system(ssp, h, stop):
    """As `run`, of the SSP file by the parallel algorithm that holds inputs."""
    places = ours("parallel", "held", ("disk", {"x": 1.0, "y": 1.0}), h)(ssp, h, stop)
    return places[1:] - places[0]


def peaks(found, h):
    """Largest displacement along x and y [m], and the speed at which it is [Hz]."""
    at = np.abs(found).argmax(axis=0)
    speeds = (FROM + RATE * h * (at + 1)) / 2 / np.pi
    return {f"{what}_{axis}": float(value) for axis, one, speed in zip("xy", np.abs(found).max(axis=0), speeds)
            for what, value in (("um", 1e6 * one), ("hz", speed))}  # fmt: skip


def draw(runs, h, stem):
    from figures import BLUE, ORANGE, legend, plots, save

    figure, axes = plots(2, 6, sharex=True)
    for axis, name, k in zip(axes, "xy", range(2)):
        for label, colour in (("linear", ORANGE), ("python", BLUE)):
            found = runs[label][:, k]
            hertz = (FROM + RATE * h * np.arange(1, len(found) + 1)) / 2 / np.pi
            what = "linear bearings" if label == "linear" else "bearings of the FMU"
            axis.plot(hertz, 1e6 * found, color=colour, label=what, linewidth=0.5, alpha=0.8)
        axis.set_ylabel(f"disk, {name} (µm)")
        legend(axis)
    axes[0].set_title("Rotor with unbalance, run up by 150 Hz per second", loc="left")
    axes[1].set_xlabel("speed (Hz)")
    save(figure, stem)


def main():
    step = {"type": float, "default": 2e-5, "help": "communication step [s]"}
    options = asked(__doc__, "the first 20 ms only", ("--step", step))
    folder, h, stop = options.output, options.step, 0.02 if options.short else 0.7
    changes = {"defect": None, "contact": None, **CASINGS["fixed"]}
    scene = changed_scene(SCENES / "er16k-tb1-hosted-shaft.toml", "run-up-bearing", changes, folder)
    (fmu,) = build([scene], folder)
    guid = "{0c1d7a52-8f3e-4f0b-9d0e-6b1f7a2c9e54}"
    settle, rest = settled(fmu, {"shaft.speed": FROM})
    settle.close()
    about = description("disk", guid, "A disk on an elastic shaft, run up", variables())
    disk = unit_fmu(folder, "disk", about, disk_values(rest))
    ssp = folder / "run-up.ssp"
    write_system(ssp, pair_and_disk(fmu.name, rest), [fmu, disk], options.ssp)
    print(ssp)
    if options.build:
        return
    pairs = [settled(fmu, {"shaft.speed": FROM}, side) for side in SIDES]
    for bearing, _ in pairs:
        bearing.run()
    stiffness, damping = linear_bearing(fmu)
    half = np.array([0.0, -LOAD / 2])
    springs = [Linear(rest, half, stiffness, damping) for _ in SIDES]
    runs = {
        "python": run([bearing for bearing, _ in pairs], rest, h, stop),
        "linear": run(springs, rest, h, stop),
        "ssp": run_system(ssp, h, stop),
    }
    apart = runs["ssp"] - runs["python"]
    said = {name: peaks(found, h) for name, found in runs.items()}
    said["modes_hz"] = [float(mode) for mode in frequencies(stiffness)]
    said["stiffness_n_m"] = np.diag(stiffness).tolist()
    said["ssp_apart"] = float(np.sqrt(np.mean(apart**2) / np.mean(runs["python"] ** 2)))
    draw(runs, h, folder / "run_up")
    print(json.dumps(said))


if __name__ == "__main__":
    main()
