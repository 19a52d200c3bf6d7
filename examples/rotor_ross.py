#!/usr/bin/env python3
"""A ROSS rotor with one bearing computed by an FMU, healthy and spalled: motion and order spectra.

    python examples/rotor_ross.py [--host exact|ross] [--passes 2] [--step 5e-5] [--stop 4] [-o target/examples]

The rotor: a steel shaft of 25 mm, 0.6 m long, a disk of 4.4 kg in the middle with unbalance, a light damper beside
it, a linear bearing on the left, and the ER16K under study on the right, pressed down with 300 N. The FMU moves the
bearing's elements and its housing; ROSS, or we with ROSS's matrices, move the shaft.

Everything is counted from static rest: z = y − y₀. A linear bearing with the FMU's stiffness K and damping C at rest
stands in for it in the rotor's matrices, and what the FMU says beyond it goes to the right-hand side:
    d = F − F₀ + K z + C ż        at the motion that the FMU was told
so that a difference between the motion told and the motion found is answered by the stand-in, at once. Without it a
shaft node of 0.1 kg against 9e7 N/m is stable with tiny steps only.

Two hosts:
  `ross`   ROSS's own integrate_system(add_to_RHS=…). It asks once per step, with the last accepted state, and starts
           from zeros; the force at the end of the step belongs to its equation.
  `exact`  ours: ROSS's matrices propagated exactly over a step. The FMU is told the motion that the rotor makes if d goes
           on changing as it did, and gives its mean force and that at the end. Then it goes back and is told the motion
           found, unless --passes is 1: that is faster, and a coarse step leaves a floor of noise in the spectra.

For a rotor of your own write another `Machine`, as `shown` is one; `exact` and `with_ross` take any.
"""

import argparse
import contextlib
import io
import json
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable

import numpy as np
from bearing import SCENES, Bearing, build, changed_scene
from scipy.linalg import expm

if sys.version_info < (3, 10):
    sys.exit("ROSS 2.3 needs Python 3.10 or newer")
with contextlib.redirect_stdout(sys.stderr):  # it greets on standard output
    import ross

GRAVITY = 9.81
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6  # weights of start, middle and end in a mean


@dataclass(frozen=True)
class Machine:
    """A rotor of ROSS without the bearing that the FMU computes: all that another rotor changes."""

    parts: Callable  # gives new lists of shaft elements, disks, and all other bearings
    nodes: int  # of the shaft
    disk: int  # node that is driven and watched
    bearing: int  # node in the bearing under study
    pressed: tuple  # N on the shaft at that bearing, x and y
    eccentric: float  # kg m: the disk's mass times the eccentricity of its centre
    housing: dict  # mass, damping and stiffness to ground, as in the bearing's scene

    def rotor(self, coefficients=None, housing=False):
        """The rotor; with stiffness and damping of the bearing under study, to ground or to its housing on springs."""
        elements, disks, bearings = self.parts()
        masses = []
        if coefficients is not None:
            k, c = coefficients
            names = {"kxx": k[0, 0], "kxy": k[0, 1], "kyx": k[1, 0], "kyy": k[1, 1]}
            names.update({"cxx": c[0, 0], "cxy": c[0, 1], "cyx": c[1, 0], "cyy": c[1, 1]})
            to = {"n_link": self.nodes} if housing else {}
            bearings.append(ross.BearingElement(n=self.bearing, **names, **to))
        if housing:
            support = {"kxx": self.housing["stiffness"], "cxx": self.housing["damping"]}
            bearings.append(ross.BearingElement(n=self.nodes, **support))
            masses.append(ross.PointMass(n=self.nodes, m=self.housing["mass"]))
        return ross.Rotor(elements, disks, bearings, masses)


def shown():
    """The rotor described above, in 12 elements of 50 mm."""
    left, damper, disk, right = 0, 5, 6, 12

    def parts():
        # beta: damping over stiffness of the shaft, assumed; 8 % of critical at 5 kHz, 0.1 % at the first critical speed
        steel = ross.Material("steel", rho=7810, E=211e9, G_s=81.2e9)
        elements = [ross.ShaftElement(L=0.05, idl=0.0, odl=0.025, material=steel, beta=5e-6) for _ in range(right)]
        disks = [ross.DiskElement.from_geometry(n=disk, material=steel, width=0.04, i_d=0.025, o_d=0.135)]
        return elements, disks, [
            ross.BearingElement(n=left, kxx=5e7, cxx=100.0, kzz=1e6),
            ross.BearingElement(n=damper, kxx=0.0, cxx=60.0),
        ]

    return Machine(
        parts,
        nodes=right + 1,
        disk=disk,
        bearing=right,
        pressed=(0.0, -300.0),
        eccentric=5e-4,  # a disk that should be balanced; grade G 36 at 50 Hz
        housing={"mass": 6.638, "damping": 2210.7, "stiffness": 1.51056e7},
    )


class Lateral:
    """ROSS's matrices of a rotor for x, y and the two tilts of each node."""

    def __init__(self, machine, rotor, speed):
        per_node = rotor.number_dof
        keep = [0, 1, 3, 4] if per_node == 6 else [0, 1, 2, 3]
        rows = [n * per_node + k for n in range(machine.nodes) for k in keep]
        rows += list(range(machine.nodes * per_node, rotor.ndof))  # a housing: x, y (and z, which nothing moves)
        at = np.ix_(rows, rows)
        self.rows = rows
        self.M, self.K = rotor.M(speed)[at], rotor.K(speed)[at]
        self.C = rotor.C(speed)[at] + speed * rotor.G()[at]
        self.size = len(rows)

    def node(self, n):
        return slice(4 * n, 4 * n + 2)


def unbalance(t, speed, eccentric):
    """Force at the disk; it grows from zero over the first turn, so that nothing is struck."""
    turn = np.clip(np.asarray(t) * speed / (2 * np.pi), 0.0, 1.0)
    size = eccentric * speed**2 * turn * turn * (3 - 2 * turn)
    return np.array([size * np.cos(speed * t), size * np.sin(speed * t)])


class Coupled:
    """The bearing's FMU at rest below the rotor, and its linear stand-in."""

    def __init__(self, machine, fmu, speed, tolerance=1e-5, initial_angle=None):
        start = {"shaft.speed": speed, "housing.load.x": 0.0, "housing.load.y": 0.0, "solver.tolerance": tolerance}
        if initial_angle is not None:
            start["cage.initial_angle"] = initial_angle
        self.fmu = Bearing(fmu, start=start)
        # What the rotor's weight and the load ask of a bearing that hardly yields.
        hold = 1e9
        system = Lateral(machine, machine.rotor((hold * np.eye(2), np.zeros((2, 2)))), speed)
        up = np.zeros(system.size)
        up[1::4] = 1.0
        weight = -GRAVITY * system.M @ up
        node = system.node(machine.bearing)
        weight[node] += machine.pressed
        self.load = hold * np.linalg.solve(system.K, weight)[node]
        self.place = self.fmu.rest(self.load)
        self.rest_force = self.fmu.force_at(self.place)
        self.stiffness, self.damping = self.fmu.linear()
        self.fmu.run()

    def tell(self, place, velocity, acceleration, h):
        """Steps the FMU; its force beyond the stand-in's: mean over the step, and at the end."""
        mean, end = self.fmu.advance(self.place + place, velocity, acceleration, h)
        mean_place = place + h * (velocity / 2 + h * acceleration / 6)
        mean_velocity = velocity + h * acceleration / 2
        end_place, end_velocity = place + h * (velocity + h * acceleration / 2), velocity + h * acceleration
        stand_in = self.stiffness @ mean_place + self.damping @ mean_velocity
        mean = mean - self.rest_force + stand_in
        end = end - self.rest_force + self.stiffness @ end_place + self.damping @ end_velocity
        return mean, end


def with_ross(machine, fmu, speed, h, stop, seen=(), tolerance=1e-5, stand_in=True):
    """ROSS integrates; gives time, motion of all nodes, and the FMU's outputs named in `seen`."""
    coupled = Coupled(machine, fmu, speed, tolerance)
    if not stand_in:
        coupled.stiffness, coupled.damping = np.zeros((2, 2)), np.zeros((2, 2))
    rotor = machine.rotor((coupled.stiffness, coupled.damping) if stand_in else None)
    t = h * np.arange(round(stop / h) + 1)
    force = np.zeros((len(t), rotor.ndof))
    disk, node = (slice(rotor.number_dof * n, rotor.number_dof * n + 2) for n in (machine.disk, machine.bearing))
    force[:, disk] = unbalance(t, speed, machine.eccentric).T
    rows, given = [coupled.fmu.read(seen)], []

    def beyond(step, time_step, disp_resp, velc_resp, accl_resp):
        if step != len(rows):
            raise RuntimeError(f"ROSS asked for step {step} after {len(rows) - 1}: not once per step")
        given.append(disp_resp[node].copy())
        out = np.zeros(rotor.ndof)
        # ROSS's acceleration of a light node rings from step to step: straight on is safer.
        out[node] = coupled.tell(disp_resp[node], velc_resp[node], np.zeros(2), time_step)[1]
        if not np.all(np.abs(out[node]) < 1e6):
            raise RuntimeError(f"unstable at {step * time_step:.4g} s")
        rows.append(coupled.fmu.read(seen) if seen else ())
        return out

    with contextlib.redirect_stdout(io.StringIO()):
        _, motion = rotor.integrate_system(speed, force, t, add_to_RHS=beyond)
    coupled.fmu.close()
    if len(given) != len(t) - 1 or not np.array_equal(given, motion[:-1, node]):
        raise RuntimeError("ROSS asked with another state than the last accepted one")
    return t, motion[:, Lateral(machine, rotor, speed).rows], np.array(rows)


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


def exact(machine, fmu, speed, h, stop, passes=1, seen=(), tolerance=1e-5, at_disk=None):
    """Our host; `at_disk` is the force there, by default the unbalance's.

    Gives time, motion of all nodes, and the FMU's outputs named in `seen`.
    """
    coupled = Coupled(machine, fmu, speed, tolerance)
    system = Lateral(machine, machine.rotor((coupled.stiffness, coupled.damping)), speed)
    node, disk, n = system.node(machine.bearing), system.node(machine.disk), system.size
    over = Propagator(system, h, [node.start, node.start + 1, disk.start, disk.start + 1])
    speeds = slice(n + node.start, n + node.stop)
    count = round(stop / h)
    z = np.zeros(2 * n)
    motion, rows = np.zeros((count + 1, n)), [coupled.fmu.read(seen)]
    half_steps = 0.5 * h * np.arange(2 * count + 1)
    drive = (at_disk(half_steps, speed) if at_disk else unbalance(half_steps, speed, machine.eccentric)).T
    beyond, change = np.zeros(2), np.zeros(2)
    for step in range(count):
        start, _, later = drive[2 * step : 2 * step + 3]
        carried = over.free @ z + over.by_start @ np.concatenate([beyond, start])
        carried += over.by_mean[:, 2:] @ (SIMPSON @ drive[2 * step : 2 * step + 3]) + over.by_end[:, 2:] @ later
        # What the FMU will say is guessed from how that changed over the last step.
        mean, end = beyond + 0.5 * change, beyond + change
        for repeat in range(passes):
            if passes > 1:
                coupled.fmu.restore() if repeat else coupled.fmu.save()
            told = carried + over.by_mean[:, :2] @ mean + over.by_end[:, :2] @ end
            # The parabola that starts as the shaft does and ends where it is told to.
            a = 2 * (told[node] - z[node] - h * z[speeds]) / h**2
            mean, end = coupled.tell(z[node], z[speeds], a, h)
        z = carried + over.by_mean[:, :2] @ mean + over.by_end[:, :2] @ end
        change, beyond = end - beyond, end
        motion[step + 1] = z[:n]
        if not abs(z[node]).max() < 1e-2:
            raise RuntimeError(f"unstable at {step * h:.4g} s")
        rows.append(coupled.fmu.read(seen) if seen else ())
    coupled.fmu.close()
    return h * np.arange(count + 1), motion, np.array(rows)


def fmus_in(folder):
    """The FMUs: healthy, spalled."""
    base = SCENES / "er16k-tb1-hosted-shaft.toml"
    healthy = changed_scene(base, "er16k-hosted-shaft", {"defect": None, "contact": None}, folder)
    spalled = changed_scene(base, "er16k-tb1-hosted-shaft", {}, folder)
    return build([healthy, spalled], folder)


def spectrum(signal, h, turns):
    """Orders of shaft speed, and amplitudes."""
    window = np.hanning(len(signal))
    amplitudes = np.abs(np.fft.rfft((signal - signal.mean()) * window)) * 2 / window.sum()
    return np.fft.rfftfreq(len(signal), h) / turns, amplitudes


def summary(machine, runs, passage, h, turns, settle):
    """Amplitudes of the shaft's position in the bearing [µm] at shaft speed, at multiples of BPFO, and their sidebands."""
    found = {"bpfo_order": passage}
    for name, (t, motion, _) in runs.items():
        order, amplitude = spectrum(motion[t >= settle, 4 * machine.bearing + 1] * 1e6, h, turns)
        lines = [1.0, *(k * passage + side for k in (1, 2) for side in (-1, 0, 1))]
        near = max(0.06, order[1])
        found[f"place_um_{name}"] = {f"{x:.3f}": float(amplitude[np.abs(order - x) <= near].max()) for x in lines}
        # What lies between the lines n BPFO + m shaft speed.
        apart = [np.abs((order - n * passage + 0.5) % 1 - 0.5) > 0.1 for n in (0, 1, 2)]
        found[f"floor_um_{name}"] = float(np.median(amplitude[np.all(apart, axis=0) & (order < 2 * passage)]))
    return found


def draw(machine, runs, passage, h, turns, settle, stem):
    from figures import BLACK, BLUE, ORANGE, legend, plots, save

    figure, axes = plots(4, 11)
    for name, colour in (("spalled", ORANGE), ("healthy", BLUE)):
        t, motion, outputs = runs[name]
        part = t >= max(t[-1] - 4 / turns, settle)
        axes[0].plot((t[part] - t[-1]) * turns, motion[part, 4 * machine.bearing + 1] * 1e6, color=colour, label=name)
        axes[1].plot((t[part] - t[-1]) * turns, motion[part, 4 * machine.disk + 1] * 1e6, color=colour)
        late = t >= settle
        for axis, signal in ((axes[2], motion[late, 4 * machine.bearing + 1] * 1e6), (axes[3], outputs[late, 0])):
            order, amplitude = spectrum(signal, h, turns)
            axis.semilogy(order[order < 11], amplitude[order < 11], color=colour, linewidth=0.8)
    for axis in axes[2:]:
        top = axis.get_xaxis_transform()
        for multiple in (1, 2, 3):
            axis.plot(multiple * passage, 1.03, "v", color=BLACK, transform=top, clip_on=False, markersize=6)
            axis.text(multiple * passage, 1.07, f"{multiple} BPFO", transform=top, ha="center", fontsize=8)
            for side in (-1, 1) if multiple < 3 else (-1,):
                at = multiple * passage + side
                axis.plot(at, 1.03, "v", color="#999999", transform=top, clip_on=False, markersize=4)
        axis.set_xlim(0, 11)
    axes[2].set_ylim(1e-4, None)
    axes[3].set_ylim(1e-4, None)
    axes[0].set(ylabel="shaft in the bearing,\ny from rest (µm)", xlabel="turns of the shaft")
    axes[1].set(ylabel="disk, y from rest\n(µm)", xlabel="turns of the shaft")
    axes[2].set(ylabel="shaft in the bearing,\ny (µm)", xlabel="order of shaft speed; grey marks: sidebands, BPFO ± shaft speed")
    axes[3].set(ylabel="housing, y (m/s²)", xlabel="order of shaft speed")
    axes[0].set_title(f"ROSS rotor at {turns:g} Hz, ER16K with a spall of 15.8°", loc="left")
    legend(axes[0])
    save(figure, stem)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--host", choices=("exact", "ross"), default="exact")
    parser.add_argument("--passes", type=int, default=2, help="of the host `exact`")
    parser.add_argument("--speed", type=float, default=50.0, help="shaft speed [Hz]")
    parser.add_argument("--step", type=float, help="communication step [s]; default 5e-5, or 1e-5 with --host ross")
    parser.add_argument("--stop", type=float, default=4.0, help="end [s]")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    options = parser.parse_args()
    machine = shown()
    healthy, spalled = fmus_in(options.output)
    speed, settle = 2 * np.pi * options.speed, min(0.3, 0.4 * options.stop)
    h = options.step or {"exact": 5e-5, "ross": 1e-5}[options.host]
    seen = ["housing.ay", "cage.speed"]
    runs, took = {}, {}
    for name, fmu in (("healthy", healthy), ("spalled", spalled)):
        begin = time.perf_counter()
        if options.host == "ross":
            runs[name] = with_ross(machine, fmu, speed, h, options.stop, seen)
        else:
            runs[name] = exact(machine, fmu, speed, h, options.stop, options.passes, seen)
        took[name] = round(time.perf_counter() - begin, 2)
    passage = 9 * runs["spalled"][2][0, 1] / speed  # of an element over a place on the outer ring, per shaft turn
    stem = options.output / f"rotor_{options.host}"
    draw(machine, runs, passage, h, options.speed, settle, stem)
    found = summary(machine, runs, passage, h, options.speed, settle)
    print(json.dumps({**found, "seconds": took, "files": f"{stem}.svg .png"}))


if __name__ == "__main__":
    main()
