"""Rotors of ROSS in bearings of Brinell: in the time domain with all of a bearing, or linear in ROSS's own analyses.

    import brinell.ross
    run = brinell.ross.simulate(rotor, {0: "6205-hosted", 12: "mine.toml"}, speed=314.16, stop=0.5)
    run.plot_1d([ross.Probe(6, 0)])       # run is a ross.TimeResponseResults
    run.outputs[12]["housing.ay"]         # what the bearing at node 12 gives

    bearing = brinell.ross.element("6205-hosted", n=12, speeds=[10, 300, 600], load=(0, -500))
    ross.Rotor(shaft, disks, [left, bearing]).run_campbell(speeds)

`rotor` is a `ross.Rotor` with all but these bearings, each from a scene (a file, a shipped one's name, or an FMU) whose
shaft the host moves. There may be one or many, and other bearings of ROSS's beside them or none. `brinell new NAME
--hosted` writes such a scene.

Everything is counted from static rest: z = y − y₀. Bearings are aligned: their housings have one axis, and each is set
so that it carries at rest what it would if none yielded. The shaft bends under its weight and tilts their inner rings,
against their moments. A linear bearing with the FMU's stiffness K and damping C at rest stands in for it in the rotor's
matrices, and what the FMU says beyond it goes to the right-hand side:
    d = F − F₀ + K z + C ż        at the motion that the FMU was told
so that a difference between the motion told and the motion found is answered by the stand-in, at once. Without it a
shaft node of 0.1 kg against 9e7 N/m is stable with tiny steps only.

ROSS's matrices M, C + Ω G, K + Ω' K_sdt are propagated exactly over a step. FMUs are told the motion that the rotor
makes if d goes on changing as it did, and give their mean force and that at the end. Then they go back and are told the
motion found, unless there is one pass: that is faster, and a coarse step leaves noise in the spectra.
"""

import contextlib
import ctypes
import functools
import io
import math
import os
import sys
import tempfile
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path

if sys.version_info < (3, 10):
    raise ImportError("ROSS 2 needs Python 3.10 or newer")
import numpy as np
from scipy.linalg import expm



@contextlib.contextmanager
def silence():
    """Nothing that libraries print is seen; under POSIX nor what compiled ones do, which do not ask Python where to."""
    with contextlib.redirect_stdout(io.StringIO()):
        if os.name != "posix":
            yield
            return
        c = ctypes.CDLL(None)
        c.fflush(None)
        kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, 1)
        try:
            yield
        finally:
            c.fflush(None)
            os.dup2(kept, 1)
            os.close(kept)
            os.close(nowhere)


# Libraries that ROSS brings along speak at length of another one that they lack.
with silence(), warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import ross

from . import build
from .host import Bearing

__all__ = ["Response", "element", "housing", "simulate", "unbalance"]

GRAVITY = 9.81
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6  # weights of start, middle and end in a mean
# Between matrices propagated at speeds so far apart (rad/s) those of a run-up are interpolated. Gyroscopic terms are
# at most twice the speed: over a step of 50 µs the interpolation is off by (2·10·5e-5)²/8 = 1.3e-7 of the state.
APART = 10.0
# Of the search for rest: most steps, and how far slopes at bearings may be off (rad): 0.02 nm at a bearing's radius.
REST_STEPS, SLOPE = 50, 1e-9

# Of times [s], the shaft's angle [rad], speed [rad/s] and acceleration [rad/s²] then; gives x and y [N], one column per
# time.
Force = Callable[..., np.ndarray]


class Response(ross.TimeResponseResults):
    """ROSS's results of a run, one row per communication point, and what the bearings gave."""

    outputs: dict  # by node and name
    speed: np.ndarray  # of the shaft [rad/s]

    @property
    def time(self):
        """Times of the rows [s]."""
        return self.t

    def at(self, node):
        """x and y of a node from rest [m]."""
        first = self.rotor.number_dof * node
        return self.yout[:, first : first + 2]


class Speed:
    """Shaft speed over time: straight between points, level before the first and after the last."""

    def __init__(self, given):
        if isinstance(given, (int, float)):
            given = [0.0], [given]
        elif isinstance(given, (str, Path)):
            table = np.genfromtxt(given, delimiter=",", names=True)
            given = np.atleast_1d(table["time_s"]), 2 * np.pi * np.atleast_1d(table["speed_hz"])
        self.times, self.speeds = (np.array(of, dtype=float) for of in given)
        if self.times.shape != self.speeds.shape or self.times.ndim != 1 or not len(self.times):
            raise ValueError("speed: a number [rad/s], times [s] and as many speeds [rad/s], or a CSV file")
        if not (np.all(np.isfinite(self.speeds)) and np.all(np.diff(self.times) > 0)):
            raise ValueError("speed: times must rise, and speeds be finite")
        self.rates = np.append(np.diff(self.speeds) / np.diff(self.times), 0.0)
        mean = 0.5 * (self.speeds[1:] + self.speeds[:-1])
        self.angles = np.append(0.0, np.cumsum(mean * np.diff(self.times)))
        self.angles += self.speeds[0] * self.times[0]

    def at(self, t):
        """Angle [rad] from time 0, speed [rad/s] and acceleration [rad/s²]."""
        t = np.asarray(t, dtype=float)
        i = np.maximum(np.searchsorted(self.times, t, side="right") - 1, 0)
        since = t - self.times[i]
        rate = np.where(since < 0.0, 0.0, self.rates[i])
        angle = self.angles[i] + since * (self.speeds[i] + 0.5 * rate * since)
        return angle, self.speeds[i] + rate * since, rate


def simulate(
    rotor, bearings, speed, stop, step=5e-5, *, loads=None, forces=None, seen=("housing.ay",), passes=2,
    tolerance=1e-5, preloads=None,
):  # fmt: skip
    """Runs a rotor in bearings until `stop` [s], from static rest, and gives a `Response`.

    `bearings` are scenes or FMUs by their nodes of the shaft. `speed` is a number [rad/s], or changes: times [s] and
    speeds [rad/s] with straight lines between, or a CSV file with time_s and speed_hz. `loads` are N, x and y, that
    stand on nodes beside the weight; `forces` functions of times, angles, speeds and accelerations at nodes, as
    `unbalance` makes them, 0 at the start. `seen` are the outputs kept of each bearing that has them. Errors over the
    communication step are in docs/how-to/step.md; `passes`: at the top of this file.

    With bearings of three or five degrees of freedom the rotor, one of six a node, moves along its axis too, and tilts
    their inner rings; loads and forces may have a z. Housings are mounted aligned, so that a bearing of five holds the
    shaft's slope at rest by its moment, and `preloads` [N] by their nodes are what the shaft pushes each with along z
    beside its share of the loads: of a pair
    back to back 150 and -150. The shaft's torsion is left out.
    """
    loads, forces, speed = dict(loads or {}), dict(forces or {}), Speed(speed)
    check(rotor, bearings, loads, forces)
    if passes < 1 or not (step > 0.0 and stop > 0.0):
        raise ValueError(f"{passes} passes, step {step} s, stop {stop} s: at least one pass, and positive times")
    with Coupled(rotor, bearings, loads, speed.at(0.0)[1], tolerance, dict(preloads or {})) as coupled:
        return propagated(coupled, forces, speed, step, stop, passes, seen)


def check(rotor, bearings, loads, forces):
    """Whether all is at nodes of the shaft."""
    if not isinstance(bearings, Mapping) or not bearings:
        raise ValueError("bearings: scenes by their nodes, as {0: 'left.toml', 12: 'right.toml'}")
    there = range(len(rotor.nodes))
    for what, nodes in (("bearing", bearings), ("load", loads), ("force", forces)):
        for node in nodes:
            if node not in there:
                raise ValueError(f"a {what} at node {node}: the shaft has nodes 0 to {there[-1]}")


def element(scene, n, speeds, load, *, n_link=None, cage_angles=8, **more):
    """A bearing that is linear about its rest under `load` (N): `ross.BearingElement` at node `n`, with tables of
    stiffness and damping over the speeds [rad/s].

    `load` is along x and y; of a scene with three degrees of freedom along z too. Stiffness and damping are between the
    rings, elements in balance, means over `cage_angles` positions of the cage within the pitch of an element. ROSS's
    element has k_zz and no other coupling of z. `n_link` is the node of a housing that may move, of which `housing` makes
    mass and support; without it the housing stands still, and a warning says so where the scene's moves. `more` goes to
    ROSS's element.
    """
    speeds = np.atleast_1d(np.asarray(speeds, dtype=float))
    with fmus_of({n: scene}) as fmus:
        if n_link is None and (support := support_of(fmus[n], speeds[0])):
            warnings.warn(
                f"element: the housing of {scene} is left out, {support['mass']:.3g} kg on "
                f"{support['stiffness']:.3g} N/m; give n_link, and brinell.ross.housing to the rotor", stacklevel=2,
            )  # fmt: skip
        found = np.array([linear(fmus[n], f"bearing at node {n}", speed, load, cage_angles) for speed in speeds])
    axes = list(enumerate("xyz"[: len(load)]))
    table = {f"{kind}{a}{b}": found[:, k, i, j] for k, kind in enumerate("kc") for i, a in axes for j, b in axes
             if a == b or "z" not in a + b}  # fmt: skip
    if len(speeds) == 1:
        return ross.BearingElement(n=n, n_link=n_link, **{name: row[0] for name, row in table.items()}, **more)
    return ross.BearingElement(n=n, n_link=n_link, frequency=speeds, **table, **more)


def housing(scene, n):
    """The housing of a scene at node `n`, to which `element` is linked by `n_link`: its mass, and its support to the
    ground, for a rotor's `point_mass_elements` and `bearing_elements`."""
    with fmus_of({n: scene}) as fmus:
        support = support_of(fmus[n], 0.0)
    if not support:
        raise ValueError(f'{scene}: its housing does not move; it needs motion = "internal" in [housing]')
    k, c = support["stiffness"], support["damping"]
    return ross.PointMass(n=n, m=support["mass"]), ross.BearingElement(n=n, kxx=k, kyy=k, cxx=c, cyy=c)


def support_of(fmu, speed):
    """Mass [kg], stiffness [N/m] and damping [N s/m] of the housing, where it moves inside the FMU."""
    bearing = Bearing(fmu, "housing", {"shaft.speed": speed})
    names = [name for name in ("mass", "stiffness", "damping") if f"housing.{name}" in bearing.reference]
    found = dict(zip(names, bearing.read([f"housing.{name}" for name in names]))) if names else {}
    bearing.close()
    return found


def linear(fmu, name, speed, load, cage_angles):
    """Stiffness and damping between the rings at rest, means over the cage's angle."""
    found = np.zeros((2, len(load), len(load)))
    for k in range(cage_angles):
        bearing = Bearing(fmu, name, {"shaft.speed": speed})
        if len(bearing.axes) != len(load):
            bearing.close()
            raise ValueError(
                f"{name}: a load of {len(load)} numbers, {len(bearing.axes)} degrees of freedom: as many loads, along "
                "x, y and z; a scene of five needs bearing.degrees_of_freedom = 3, as ROSS's element holds no tilt"
            )
        count = sum(variable.endswith(".path") for variable in bearing.reference)
        (first,) = bearing.read(["cage.initial_angle"])
        bearing.write(["cage.initial_angle"], [first + 2 * np.pi / count * k / cage_angles])
        bearing.rest(load)
        found += np.array(bearing.linear()) / cage_angles
        bearing.close()
    return found


def unbalance(eccentric):
    """Force of a disk's mass times the eccentricity of its centre [kg m].

    It grows from zero over the first turn, so that nothing is struck.
    """

    def force(_, angle, speed, acceleration):
        turn = np.clip(np.abs(angle) / (2 * np.pi), 0.0, 1.0)
        size = eccentric * turn * turn * (3 - 2 * turn)
        along, across = size * speed**2, size * acceleration
        cos, sin = np.cos(angle), np.sin(angle)
        return np.array([along * cos + across * sin, along * sin - across * cos])

    return force


@contextlib.contextmanager
def fmus_of(bearings):
    """FMUs by node: those that are FMUs already, the others built, each scene once."""
    with tempfile.TemporaryDirectory(prefix="brinell-") as folder:
        built = {str(scene): scene for scene in bearings.values()}
        for number, scene in enumerate(built):
            if Path(scene).suffix != ".fmu":
                built[scene] = build(scene, Path(folder) / str(number))
        yield {node: str(built[str(scene)]) for node, scene in bearings.items()}


class Lateral:
    """ROSS's matrices of a rotor for x, y and the two tilts of each node, and if `in_space` z."""

    def __init__(self, rotor, speed, acceleration=0.0, in_space=False):
        per_node, nodes = rotor.number_dof, len(rotor.nodes)
        if in_space and per_node != 6:
            raise ValueError("bearings of three or five degrees of freedom: they need a rotor of six a node")
        self.axes = ["x", "y", "z", "tilt.x", "tilt.y"] if in_space else ["x", "y", "tilt.x", "tilt.y"]
        keep = [("x", "y", "z", "tilt.x", "tilt.y").index(axis) for axis in self.axes] if per_node == 6 else range(4)
        rows = [n * per_node + k for n in range(nodes) for k in keep]
        rows += list(range(nodes * per_node, rotor.ndof))  # housings: x, y (and z, which nothing moves)
        at = np.ix_(rows, rows)
        self.rows = rows
        self.M, self.K = rotor.M(speed)[at], (rotor.K(speed) + acceleration * rotor.Ksdt())[at]
        self.C = rotor.C(speed)[at] + speed * rotor.G()[at]
        self.size = len(rows)

    def at(self, node, axes=("x", "y")):
        """Indices of a node's coordinates along these axes."""
        return [len(self.axes) * node + self.axes.index(axis) for axis in axes]

    def nodes(self, nodes, axes=None):
        """Indices of x and y of nodes, or of the axes of each, one after the other."""
        axes = axes or [("x", "y")] * len(nodes)
        return np.array([i for node, along in zip(nodes, axes) for i in self.at(node, along)], dtype=int)


class Coupled:
    """The bearings' FMUs at rest below the rotor, and their linear stand-ins. Vectors have the coordinates of each in
    turn."""

    def __init__(self, rotor, bearings, loads, speed, tolerance, preloads=None):
        self.rotor, self.nodes, self.fmus = rotor, tuple(bearings), []
        start = {"shaft.speed": speed, "solver.tolerance": tolerance}
        try:
            with fmus_of(bearings) as fmus:
                for node, fmu in fmus.items():
                    self.fmus.append(Bearing(fmu, f"bearing at node {node}", start))
            self.axes = [fmu.axes for fmu in self.fmus]
            ends = np.cumsum([0, *map(len, self.axes)])
            self.own = [slice(begin, end) for begin, end in zip(ends, ends[1:])]
            self.in_space = max(map(len, self.axes)) > 2
            self.rest_position = self.at_rest(self.statics(loads, speed), preloads or {})
            positions = [self.rest_position[own] for own in self.own]
            self.rest_force = np.concatenate([fmu.force_at(position) for fmu, position in zip(self.fmus, positions)])
            self.load = -self.rest_force
            self.stiffness, self.damping = np.zeros((2, ends[-1], ends[-1]))
            for own, fmu in zip(self.own, self.fmus):
                self.stiffness[own, own], self.damping[own, own] = fmu.linear()
                fmu.run()
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def system(self, speed, acceleration=0.0):
        return Lateral(self.rotor, speed, acceleration, self.in_space)

    def statics(self, loads, speed):
        """What the rotor's weight and the loads ask of bearings that hardly yield [N], and its slopes there, by the
        bearings' moments on the shaft [N m], of each in turn."""
        hold = 1e9
        system = self.system(speed)
        held, tilted = [axes[:3] for axes in self.axes], [axes[3:] for axes in self.axes]
        at, slopes = system.nodes(self.nodes, held), system.nodes(self.nodes, tilted)
        system.K[at, at] += hold
        up = np.zeros(system.size)
        up[[system.at(node)[1] for node in range(len(self.rotor.nodes))]] = 1.0
        weight = -GRAVITY * system.M @ up
        for node, load in loads.items():
            weight[system.at(node, ("x", "y", "z")[: len(load)])] += load
        yields = np.linalg.solve(system.K, np.column_stack([weight, np.eye(system.size)[:, slopes]]))

        def found(moments):
            there = yields @ np.append(1.0, moments)
            return hold * there[at], there[slopes]

        return found

    def at_rest(self, statics, preloads):
        """Positions of the inner rings at rest in housings that are aligned.

        The shaft's slopes at the bearings and their moments are found together: by Newton's method, with each bearing's
        tangent stiffness about its tilt while it carries its load.
        """
        tilts = [slice(2 * k, 2 * k + 2) for k in np.cumsum([0] + [len(axes) == 5 for axes in self.axes[:-1]])]
        count = 2 * sum(len(axes) == 5 for axes in self.axes)
        moments, tilt = np.zeros(count), np.zeros(count)
        by_moment = np.column_stack([statics(one)[1] - statics(np.zeros(count))[1] for one in np.eye(count)] or [tilt])
        for _ in range(REST_STEPS):
            load, slope = statics(moments)
            positions, begin, yields = [], 0, np.zeros((count, count))
            for node, axes, fmu, of in zip(self.nodes, self.axes, self.fmus, tilts):
                straight = load[begin : begin + len(axes[:3])]
                begin += len(straight)
                straight = straight + [preloads.get(node, 0.0) if axis == "z" else 0.0 for axis in axes[:3]]
                positions.append(fmu.rest(straight, tilt[of] if len(axes) == 5 else ()))
                if len(axes) == 5:
                    moments[of] = fmu.force_at(positions[-1])[3:]
                    k = fmu.stiffness()
                    yields[of, of] = k[3:, 3:] - k[3:, :3] @ np.linalg.solve(k[:3, :3], k[:3, 3:])
            # Slopes under these moments, less the tilts at which they were taken.
            left = statics(moments)[1] - tilt
            if count == 0 or abs(left).max() < SLOPE:
                return np.concatenate(positions)
            tilt = tilt + np.linalg.solve(np.eye(count) + by_moment @ yields, left)
        raise RuntimeError(f"no rest: the slopes at the bearings are {left} rad off after {REST_STEPS} steps")

    def tell(self, displacement, velocity, acceleration, speed, h):
        """Steps the FMUs; their forces beyond the stand-ins': mean over the step, and at the end."""
        there, mean, end = self.rest_position + displacement, np.empty_like(displacement), np.empty_like(displacement)
        for own, fmu in zip(self.own, self.fmus):
            if speed is not None:
                fmu.write(["shaft.speed"], [speed])
            mean[own], end[own] = fmu.advance(there[own], velocity[own], acceleration[own], h)
        mean_displacement = displacement + h * (velocity / 2 + h * acceleration / 6)
        mean_velocity = velocity + h * acceleration / 2
        end_displacement = displacement + h * (velocity + h * acceleration / 2)
        end_velocity = velocity + h * acceleration
        mean += self.stiffness @ mean_displacement + self.damping @ mean_velocity - self.rest_force
        end += self.stiffness @ end_displacement + self.damping @ end_velocity - self.rest_force
        return mean, end

    def close(self):
        for fmu in self.fmus:
            fmu.close()
        self.fmus = []


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
        # Value, slope and second derivative times h and h² of the force, τ counted in steps.
        big[2 * n : 2 * n + m, 2 * n + m : 2 * n + 2 * m] = np.eye(m) / h
        big[2 * n + m : 2 * n + 2 * m, 2 * n + 2 * m :] = 2 * np.eye(m) / h
        out = expm(big * h)[: 2 * n]
        value, slope, second = (out[:, 2 * n + i * m : 2 * n + (i + 1) * m] for i in range(3))
        # f = f₀ + b τ + c τ²,  c = 3 (f₀ + f₁) − 6 f̄,  b = f₁ − f₀ − c;  by state, start, mean and end
        by_force = value - 4 * slope + 3 * second, 6 * slope - 6 * second, -2 * slope + 3 * second
        self.matrix = np.hstack([out[:, : 2 * n], *by_force])


class Propagators:
    """The propagator at the speed of a step."""

    def __init__(self, coupled, h, columns):
        self.coupled, self.h, self.columns = coupled, h, columns
        self.made = functools.lru_cache(maxsize=256)(self.make)

    def make(self, speed, acceleration):
        system, coupled = self.coupled.system(speed, acceleration), self.coupled
        at = system.nodes(coupled.nodes, coupled.axes)
        own = np.ix_(at, at)
        system.K[own] += coupled.stiffness
        system.C[own] += coupled.damping
        return Propagator(system, self.h, self.columns).matrix

    def over(self, speed, acceleration):
        """Of a step in whose middle the shaft has this speed and acceleration."""
        if acceleration == 0.0:
            return self.made(speed, 0.0)
        below = math.floor(speed / APART)
        share = speed / APART - below
        there = (self.made(APART * (below + i), acceleration) for i in (0, 1))
        return (1 - share) * next(there) + share * next(there)


def propagated(coupled, forces, speed, h, stop, passes, seen):
    """The run, step by step."""
    system = coupled.system(0.0)
    count = round(stop / h)
    half_steps = 0.5 * h * np.arange(2 * count + 1)
    turning = speed.at(half_steps)
    given = [np.asarray(force(half_steps, *turning)) for force in forces.values()]
    axes = [("x", "y", "z")[: len(force)] for force in given]
    node, driven, n = system.nodes(coupled.nodes, coupled.axes), system.nodes(forces, axes), system.size
    over = Propagators(coupled, h, np.concatenate([node, driven]))
    own, all_columns = len(node), len(node) + len(driven)
    drive = np.concatenate([np.zeros((0, len(half_steps))), *given]).T
    seen = [[name for name in seen if name in fmu.reference] for fmu in coupled.fmus]
    see = lambda: [fmu.read(names) if names else () for fmu, names in zip(coupled.fmus, seen)]  # noqa: E731
    z, motion, rows = np.zeros(2 * n), np.zeros((count + 1, n)), [see()]
    beyond, change = np.zeros(own), np.zeros(own)
    for step in range(count):
        angle, omega, acceleration = (float(of[2 * step + 1]) for of in turning)
        matrix = over.over(omega, acceleration)
        start, _, later = drive[2 * step : 2 * step + 3]
        by_mean, by_end = (matrix[:, 2 * n + i * all_columns :][:, :own] for i in (1, 2))
        known = z, beyond, start, 0 * beyond, SIMPSON @ drive[2 * step : 2 * step + 3], 0 * beyond, later
        carried = matrix @ np.concatenate(known)
        # What the FMUs will say is guessed from how that changed over the last step.
        mean, end = beyond + 0.5 * change, beyond + change
        # Speed held at its mean turns the cage as far as the shaft's angle asks.
        ends = (turning[0][2 * step + 2] - turning[0][2 * step]) / h if len(speed.times) > 1 else None
        for repeat in range(passes):
            for fmu in coupled.fmus if passes > 1 else ():
                fmu.restore() if repeat else fmu.save()
            told = carried + by_mean @ mean + by_end @ end
            # The parabola that starts as the shaft does and ends where it is told to.
            a = 2 * (told[node] - z[node] - h * z[n + node]) / h**2
            mean, end = coupled.tell(z[node], z[n + node], a, ends, h)
        z = carried + by_mean @ mean + by_end @ end
        change, beyond = end - beyond, end
        motion[step + 1] = z[:n]
        if not abs(z[node]).max() < 1e-2:
            raise RuntimeError(f"the shaft is {abs(z[node]).max():.2g} m from rest at {step * h:.4g} s: shorter steps")
        rows.append(see())
    full = np.zeros((count + 1, coupled.rotor.ndof))
    full[:, system.rows] = motion
    found = Response(coupled.rotor, half_steps[::2], full, [])
    found.speed = turning[1][::2]
    found.outputs = {
        node: dict(zip(names, np.array([row[i] for row in rows]).T))
        for i, (node, names) in enumerate(zip(coupled.nodes, seen))
    }
    return found
