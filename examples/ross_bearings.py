"""Rotors of ROSS in bearings that FMUs compute.

    from ross_bearings import simulate
    run = simulate(rotor, [0, 12], ["left.toml", "er16k-tb1-hosted-shaft"], speed=314.16, stop=0.5)
    run.at(12)          # x and y of that node from rest [m], one row per step; run.time, run.outputs[1]["housing.ay"]

`rotor` is a `ross.Rotor` with all but these bearings, which are at the nodes of its shaft that come next, each from a
scene (a file, a shipped one's name, or an FMU) whose shaft the host moves. There may be one or many, and other
bearings of ROSS's beside them or none.

Everything is counted from static rest: z = y − y₀. Bearings are aligned so that each carries at rest what it would if
none yielded. A linear bearing with the FMU's stiffness K and damping C at rest stands in for it in the rotor's
matrices, and what the FMU says beyond it goes to the right-hand side:
    d = F − F₀ + K z + C ż        at the motion that the FMU was told
so that a difference between the motion told and the motion found is answered by the stand-in, at once. Without it a
shaft node of 0.1 kg against 9e7 N/m is stable with tiny steps only.

Two hosts:
  `ross`   ROSS's own integrate_system(add_to_RHS=…). It asks once per step, with the last accepted state, and starts
           from zeros; the force at the end of the step belongs to its equation.
  `exact`  ours: ROSS's matrices propagated exactly over a step. FMUs are told the motion that the rotor makes if d goes
           on changing as it did, and give their mean force and that at the end. Then they go back and are told the
           motion found, unless there is one pass: that is faster, and a coarse step leaves noise in the spectra.
"""

import contextlib
import copy
import io
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Callable

import fmpy
import numpy as np
from bearing import ROOT, SCENES, Bearing, build
from scipy.linalg import expm

if sys.version_info < (3, 10):
    sys.exit("ROSS 2.3 needs Python 3.10 or newer")
with contextlib.redirect_stdout(sys.stderr):  # it greets on standard output
    import ross

GRAVITY = 9.81
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6  # weights of start, middle and end in a mean

Force = Callable  # of times [s] and shaft speed [rad/s]; gives x and y [N], one column per time


@dataclass(frozen=True)
class Machine:
    """A rotor, and where it runs in bearings that FMUs compute."""

    rotor: ross.Rotor  # without these bearings
    nodes: tuple  # of the shaft, in these bearings
    loads: dict = field(default_factory=dict)  # N, x and y, that stand on nodes of the shaft beside its weight
    forces: dict = field(default_factory=dict)  # Force at nodes of the shaft; 0 at the start

    def __post_init__(self):
        there = range(len(self.rotor.nodes))
        for what, nodes in (("bearing", self.nodes), ("load", self.loads), ("force", self.forces)):
            for node in nodes:
                if node not in there:
                    raise ValueError(f"a {what} at node {node}: the shaft has nodes 0 to {there[-1]}")
        if not self.nodes or len(set(self.nodes)) < len(self.nodes):
            raise ValueError(f"bearings at nodes {list(self.nodes)}: at least one, each at a node of its own")


@dataclass(frozen=True)
class Run:
    """What came out, one row per communication point."""

    time: np.ndarray  # s
    motion: np.ndarray  # m and rad from rest: x, y and two tilts of each node
    outputs: list  # of each bearing, by name

    def at(self, node):
        """x and y of a node from rest [m]."""
        return self.motion[:, 4 * node : 4 * node + 2]


def simulate(
    rotor, nodes, scenes, speed, stop, step=5e-5, *, loads=None, forces=None, seen=("housing.ay",), passes=2,
    host="exact", folder=ROOT / "target/examples",
):  # fmt: skip
    """Runs a rotor at `speed` [rad/s] in the bearings of `scenes` at `nodes` of its shaft until `stop` [s].

    `loads` are N, x and y, that stand on nodes beside the weight; `forces` functions of times and speed at nodes, as
    `unbalance` makes them, 0 at the start. `seen` are the outputs kept of each bearing. FMUs are built in `folder`.
    Hosts, passes: at the top of this file.
    """
    if host not in ("exact", "ross") or passes < 1:
        raise ValueError(f"host {host!r}, {passes} passes: exact or ross, at least one pass")
    machine = Machine(rotor, tuple(nodes), dict(loads or {}), dict(forces or {}))
    fmus = fmus_of(scenes, folder)
    if len(fmus) != len(machine.nodes):
        raise ValueError(f"{len(fmus)} scenes for {len(machine.nodes)} nodes")
    if host == "ross":
        found = with_ross(machine, fmus, speed, step, stop, list(seen))
    else:
        found = exact(machine, fmus, speed, step, stop, passes, list(seen))
    t, motion, outputs = found
    return Run(t, motion, [dict(zip(seen, rows.T)) for rows in outputs])


def fmus_of(scenes, folder):
    """Paths of the FMUs: those that are FMUs already, the others built, each scene once."""

    def path(scene):
        shipped = SCENES / f"{scene}.toml"
        return shipped if shipped.is_file() and not Path(scene).exists() else Path(scene)

    paths = [path(scene) for scene in scenes]
    to_build = list(dict.fromkeys(p for p in paths if p.suffix != ".fmu"))
    built = dict(zip(to_build, build(to_build, folder))) if to_build else {}
    return [built.get(p, p) for p in paths]


def with_bearings(rotor, nodes, coefficients, housings=()):
    """The rotor with linear bearings at `nodes`: stiffness and damping, to ground or to housings on springs.

    A housing is a dict of its mass, damping and stiffness to ground.
    """
    # ROSS writes into the elements that it is given.
    elements, disks, bearings, masses = (
        copy.deepcopy(list(of))
        for of in (rotor.shaft_elements, rotor.disk_elements, rotor.bearing_elements, rotor.point_mass_elements)
    )
    for i, (node, (k, c)) in enumerate(zip(nodes, coefficients)):
        names = {"kxx": k[0, 0], "kxy": k[0, 1], "kyx": k[1, 0], "kyy": k[1, 1]}
        names.update({"cxx": c[0, 0], "cxy": c[0, 1], "cyx": c[1, 0], "cyy": c[1, 1]})
        if housings:
            link, housing = len(rotor.nodes) + i, housings[i]
            bearings.append(ross.BearingElement(n=node, n_link=link, **names))
            bearings.append(ross.BearingElement(n=link, kxx=housing["stiffness"], cxx=housing["damping"]))
            masses.append(ross.PointMass(n=link, m=housing["mass"]))
        else:
            bearings.append(ross.BearingElement(n=node, **names))
    return ross.Rotor(elements, disks, bearings, masses)


class Lateral:
    """ROSS's matrices of a rotor for x, y and the two tilts of each node."""

    def __init__(self, rotor, speed):
        per_node, nodes = rotor.number_dof, len(rotor.nodes)
        keep = [0, 1, 3, 4] if per_node == 6 else [0, 1, 2, 3]
        rows = [n * per_node + k for n in range(nodes) for k in keep]
        rows += list(range(nodes * per_node, rotor.ndof))  # housings: x, y (and z, which nothing moves)
        at = np.ix_(rows, rows)
        self.rows = rows
        self.M, self.K = rotor.M(speed)[at], rotor.K(speed)[at]
        self.C = rotor.C(speed)[at] + speed * rotor.G()[at]
        self.size = len(rows)

    def nodes(self, nodes):
        """Indices of x and y of nodes, one after the other."""
        return np.array([4 * n + axis for n in nodes for axis in (0, 1)], dtype=int)


def unbalance(eccentric):
    """Force of a disk's mass times the eccentricity of its centre [kg m].

    It grows from zero over the first turn, so that nothing is struck.
    """

    def force(t, speed):
        turn = np.clip(np.asarray(t) * speed / (2 * np.pi), 0.0, 1.0)
        size = eccentric * speed**2 * turn * turn * (3 - 2 * turn)
        return np.array([size * np.cos(speed * t), size * np.sin(speed * t)])

    return force


class Coupled:
    """The bearings' FMUs at rest below the rotor, and their linear stand-ins. Vectors have x and y of each in turn."""

    def __init__(self, machine, fmus, speed, tolerance=1e-5, initial_angle=None):
        start = {"shaft.speed": speed, "housing.load.x": 0.0, "housing.load.y": 0.0, "solver.tolerance": tolerance}
        if initial_angle is not None:
            start["cage.initial_angle"] = initial_angle
        self.fmus = []
        for fmu, node in zip(fmus, machine.nodes):
            # A housing that nothing moves has no loads.
            known = {variable.name for variable in fmpy.read_model_description(fmu).modelVariables}
            told = {name: value for name, value in start.items() if name in known}
            self.fmus.append(Bearing(fmu, f"bearing at node {node}", told))
        self.load = self.carried(machine, speed)
        loads = self.load.reshape(-1, 2)
        positions = [fmu.rest(load) for fmu, load in zip(self.fmus, loads)]
        self.rest_position = np.concatenate(positions)
        self.rest_force = np.concatenate([fmu.force_at(position) for fmu, position in zip(self.fmus, positions)])
        self.coefficients = [fmu.linear() for fmu in self.fmus]
        self.stand_in(True)
        for fmu in self.fmus:
            fmu.run()

    def carried(self, machine, speed):
        """What the rotor's weight and the loads ask of bearings that hardly yield [N]."""
        hold = 1e9
        system = Lateral(machine.rotor, speed)
        at = system.nodes(machine.nodes)
        system.K[at, at] += hold
        up = np.zeros(system.size)
        up[1 : 4 * len(machine.rotor.nodes) : 4] = 1.0
        weight = -GRAVITY * system.M @ up
        for node, load in machine.loads.items():
            weight[system.nodes([node])] += load
        return hold * np.linalg.solve(system.K, weight)[at]

    def stand_in(self, there):
        """Stiffness and damping of all bearings at rest, or none."""
        self.stiffness, self.damping = np.zeros((2, 2 * len(self.fmus), 2 * len(self.fmus)))
        for i, (k, c) in enumerate(self.coefficients if there else []):
            self.stiffness[2 * i : 2 * i + 2, 2 * i : 2 * i + 2] = k
            self.damping[2 * i : 2 * i + 2, 2 * i : 2 * i + 2] = c

    def tell(self, displacement, velocity, acceleration, h):
        """Steps the FMUs; their forces beyond the stand-ins': mean over the step, and at the end."""
        there, mean, end = self.rest_position + displacement, np.empty_like(displacement), np.empty_like(displacement)
        for i, fmu in enumerate(self.fmus):
            own = slice(2 * i, 2 * i + 2)
            mean[own], end[own] = fmu.advance(there[own], velocity[own], acceleration[own], h)
        mean_displacement = displacement + h * (velocity / 2 + h * acceleration / 6)
        mean_velocity = velocity + h * acceleration / 2
        end_displacement = displacement + h * (velocity + h * acceleration / 2)
        end_velocity = velocity + h * acceleration
        mean += self.stiffness @ mean_displacement + self.damping @ mean_velocity - self.rest_force
        end += self.stiffness @ end_displacement + self.damping @ end_velocity - self.rest_force
        return mean, end

    def see(self, names):
        """Values of these outputs, a row for each bearing."""
        return [fmu.read(names) if names else () for fmu in self.fmus]

    def close(self):
        for fmu in self.fmus:
            fmu.close()


def with_ross(machine, fmus, speed, h, stop, seen=(), tolerance=1e-5, stand_in=True):
    """ROSS integrates; gives time, motion of all nodes, and of each bearing the outputs named in `seen`."""
    coupled = Coupled(machine, fmus, speed, tolerance)
    coupled.stand_in(stand_in)
    rotor = with_bearings(machine.rotor, machine.nodes, coupled.coefficients if stand_in else ())
    t = h * np.arange(round(stop / h) + 1)
    force = np.zeros((len(t), rotor.ndof))
    indices = lambda n: [rotor.number_dof * n, rotor.number_dof * n + 1]  # noqa: E731
    for n, drive in machine.forces.items():
        force[:, indices(n)] += drive(t, speed).T
    node = np.concatenate([indices(n) for n in machine.nodes])
    rows, given = [coupled.see(seen)], []

    # ROSS 3 tells `args` besides, and gives a third value at the end.
    def beyond(step, time_step, disp_resp, velc_resp, **_):
        if step != len(rows):
            raise RuntimeError(f"ROSS asked for step {step} after {len(rows) - 1}: not once per step")
        given.append(disp_resp[node].copy())
        out = np.zeros(rotor.ndof)
        # ROSS's acceleration of a light node rings from step to step: straight on is safer.
        out[node] = coupled.tell(disp_resp[node], velc_resp[node], np.zeros(len(node)), time_step)[1]
        if not np.all(np.abs(out[node]) < 1e6):
            raise RuntimeError(f"unstable at {step * time_step:.4g} s")
        rows.append(coupled.see(seen))
        return out

    with contextlib.redirect_stdout(io.StringIO()):
        motion = rotor.integrate_system(speed, force, t, add_to_RHS=beyond)[1]
    coupled.close()
    if len(given) != len(t) - 1 or not np.array_equal(given, motion[:-1, node]):
        raise RuntimeError("ROSS asked with another state than the last accepted one")
    return t, motion[:, Lateral(rotor, speed).rows], np.array(rows).transpose(1, 0, 2)


class Propagator:
    """M z'' + C z' + K z = f over steps of h, exact for f that changes with time as a parabola on some coordinates.

    The parabola is given by its value at the start, its mean and its value at the end.
    """

    def __init__(self, system, h, columns):
        n, m = system.size, len(columns)
        inverse = np.linalg.inv(system.M)
        big = np.zeros((2 * n + 3 * m, 2 * n + 3 * m))
        big[:n, n : 2 * n] = np.eye(n)
        big[n : 2 * n, :n], big[n : 2 * n, n : 2 * n] = -inverse @ system.K, -inverse @ system.C
        big[n : 2 * n, 2 * n : 2 * n + m] = inverse[:, columns]
        # Value, slope and curvature times h and h² of the force, τ counted in steps.
        big[2 * n : 2 * n + m, 2 * n + m : 2 * n + 2 * m] = np.eye(m) / h
        big[2 * n + m : 2 * n + 2 * m, 2 * n + 2 * m :] = 2 * np.eye(m) / h
        out = expm(big * h)[: 2 * n]
        self.free = out[:, : 2 * n]
        value, slope, curve = (out[:, 2 * n + i * m : 2 * n + (i + 1) * m] for i in range(3))
        # f = f₀ + b τ + c τ²,  c = 3 (f₀ + f₁) − 6 f̄,  b = f₁ − f₀ − c
        self.by_start = value - 4 * slope + 3 * curve
        self.by_mean = 6 * slope - 6 * curve
        self.by_end = -2 * slope + 3 * curve


def exact(machine, fmus, speed, h, stop, passes=1, seen=(), tolerance=1e-5):
    """Our host; gives time, motion of all nodes, and of each bearing the outputs named in `seen`."""
    coupled = Coupled(machine, fmus, speed, tolerance)
    system = Lateral(machine.rotor, speed)
    node, driven, n = system.nodes(machine.nodes), system.nodes(machine.forces), system.size
    system.K[np.ix_(node, node)] += coupled.stiffness
    system.C[np.ix_(node, node)] += coupled.damping
    over = Propagator(system, h, np.concatenate([node, driven]))
    own = len(node)  # columns of the bearings; those of other forces follow
    count = round(stop / h)
    z = np.zeros(2 * n)
    motion, rows = np.zeros((count + 1, n)), [coupled.see(seen)]
    half_steps = 0.5 * h * np.arange(2 * count + 1)
    given = [force(half_steps, speed) for force in machine.forces.values()]
    drive = np.concatenate([np.zeros((0, len(half_steps))), *given]).T
    beyond, change = np.zeros(own), np.zeros(own)
    for step in range(count):
        start, _, later = drive[2 * step : 2 * step + 3]
        carried = over.free @ z + over.by_start @ np.concatenate([beyond, start])
        carried += over.by_mean[:, own:] @ (SIMPSON @ drive[2 * step : 2 * step + 3]) + over.by_end[:, own:] @ later
        # What the FMUs will say is guessed from how that changed over the last step.
        mean, end = beyond + 0.5 * change, beyond + change
        for repeat in range(passes):
            for fmu in coupled.fmus if passes > 1 else ():
                fmu.restore() if repeat else fmu.save()
            told = carried + over.by_mean[:, :own] @ mean + over.by_end[:, :own] @ end
            # The parabola that starts as the shaft does and ends where it is told to.
            a = 2 * (told[node] - z[node] - h * z[n + node]) / h**2
            mean, end = coupled.tell(z[node], z[n + node], a, h)
        z = carried + over.by_mean[:, :own] @ mean + over.by_end[:, :own] @ end
        change, beyond = end - beyond, end
        motion[step + 1] = z[:n]
        if not abs(z[node]).max() < 1e-2:
            raise RuntimeError(f"unstable at {step * h:.4g} s")
        rows.append(coupled.see(seen))
    coupled.close()
    return h * np.arange(count + 1), motion, np.array(rows).transpose(1, 0, 2)
