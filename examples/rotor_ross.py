#!/usr/bin/env python3
"""A ROSS rotor with one bearing computed by an FMU, healthy and spalled.

    python examples/rotor_ross.py [--stop 0.5] [-o target/examples]      response and order spectra
    python examples/rotor_ross.py linear                                 against ROSS with a linear bearing
    python examples/rotor_ross.py table                                  error over communication step
    python examples/rotor_ross.py share                                  where the run time goes

The rotor: a steel shaft of 25 mm, 0.6 m long, a disk of 4.4 kg near the middle with unbalance, a light damper beside
it, a linear bearing on the left, and the ER16K under study on the right, pressed down with 300 N. The FMU moves the
bearing's elements and its housing; ROSS moves the shaft.

Everything is counted from static rest: z = y − y₀. A linear bearing with the FMU's stiffness K and damping C at rest
stands in for it in ROSS's matrices, and what the FMU says beyond it goes to the right-hand side:
    d = F − F₀ + K z + C ż        at the motion that the FMU was told
so that a difference between the motion told and the motion found is answered by the stand-in, at once. Without it a
shaft node of 0.1 kg against 9e7 N/m is stable with tiny steps only.

Two hosts:
  `newmark`  ROSS's own integrate_system(add_to_RHS=…). It asks once per step, with the last accepted state, and starts
             from zeros; the force at the end of the step belongs to its equation.
  `exact`    ours: ROSS's matrices propagated exactly over a step for forces that change linearly with time; the FMU is
             told the motion the rotor would make without news from it, and gives its mean force. A second pass goes
             back and tells it the motion found.
"""

import argparse
import contextlib
import io
import json
import time
from pathlib import Path

import numpy as np
import ross
from bearing import SCENES, Bearing, build, changed_scene
from scipy.linalg import expm
from scipy.optimize import least_squares

NODES, LEFT, DAMPER, DISK, RIGHT = 13, 0, 5, 6, 12  # 12 elements of 50 mm
GRAVITY = 9.81
PRESSED = np.array([0.0, -300.0])  # N on the shaft at the bearing under study
ECCENTRIC = 5e-4  # kg m: a disk that should be balanced; grade G 28 at 40 Hz
STEEL = 5e-6  # s, assumed: damping over stiffness of the shaft; 8 % of critical at 5 kHz, 0.1 % at the first critical
SIMPSON = np.array([1.0, 4.0, 1.0]) / 6  # weights of start, middle and end in a mean
HOUSING = {"mass": 6.638, "damping": 2210.7, "stiffness": 1.51056e7}  # as in the scene


def shaft(extra):
    steel = ross.Material("steel", rho=7810, E=211e9, G_s=81.2e9)
    elements = [ross.ShaftElement(L=0.05, idl=0.0, odl=0.025, material=steel, beta=STEEL) for _ in range(NODES - 1)]
    disk = ross.DiskElement.from_geometry(n=DISK, material=steel, width=0.04, i_d=0.025, o_d=0.135)
    left = ross.BearingElement(n=LEFT, kxx=5e7, cxx=100.0, kzz=1e6)
    damper = ross.BearingElement(n=DAMPER, kxx=0.0, cxx=60.0)
    return elements, [disk], [left, damper, *extra]


def rotor_with(bearing_coefficients=None, housing=False):
    """The rotor; with stiffness and damping of a bearing on the right, to ground or to a housing on springs."""
    extra, masses = [], []
    if bearing_coefficients is not None:
        k, c = bearing_coefficients
        names = {"kxx": k[0, 0], "kxy": k[0, 1], "kyx": k[1, 0], "kyy": k[1, 1]}
        names.update({"cxx": c[0, 0], "cxy": c[0, 1], "cyx": c[1, 0], "cyy": c[1, 1]})
        extra.append(ross.BearingElement(n=RIGHT, **names, **({"n_link": NODES} if housing else {})))
    if housing:
        extra.append(ross.BearingElement(n=NODES, kxx=HOUSING["stiffness"], cxx=HOUSING["damping"]))
        masses.append(ross.PointMass(n=NODES, m=HOUSING["mass"]))
    elements, disks, bearings = shaft(extra)
    return ross.Rotor(elements, disks, bearings, masses)


class Lateral:
    """ROSS's matrices of a rotor for x, y and the two tilts of each node."""

    def __init__(self, rotor, speed):
        per_node = rotor.number_dof
        keep = [0, 1, 3, 4] if per_node == 6 else [0, 1, 2, 3]
        rows = [n * per_node + k for n in range(NODES) for k in keep]
        rows += list(range(NODES * per_node, rotor.ndof))  # a housing: x, y (and z, which nothing moves)
        at = np.ix_(rows, rows)
        self.rows = rows
        self.M, self.K = rotor.M(speed)[at], rotor.K(speed)[at]
        self.C = rotor.C(speed)[at] + speed * rotor.G()[at]
        self.size = len(rows)

    def node(self, n):
        return slice(4 * n, 4 * n + 2)


def unbalance(t, speed, eccentric=ECCENTRIC):
    """Force at the disk; it grows from zero over the first turn, so that nothing is struck."""
    turn = np.clip(np.asarray(t) * speed / (2 * np.pi), 0.0, 1.0)
    size = eccentric * speed**2 * turn * turn * (3 - 2 * turn)
    return np.array([size * np.cos(speed * t), size * np.sin(speed * t)])


class Coupled:
    """The bearing's FMU at rest below the rotor, and its linear stand-in."""

    def __init__(self, fmu, speed, tolerance=1e-5, initial_angle=None):
        start = {"shaft.speed": speed, "housing.load.x": 0.0, "housing.load.y": 0.0, "solver.tolerance": tolerance}
        if initial_angle is not None:
            start["cage.initial_angle"] = initial_angle
        self.fmu = Bearing(fmu, start=start)
        # What the rotor's weight and the load ask of a bearing that hardly yields.
        hold = 1e9
        system = Lateral(rotor_with((hold * np.eye(2), np.zeros((2, 2)))), speed)
        up = np.zeros(system.size)
        up[1::4] = 1.0
        weight = -GRAVITY * system.M @ up
        weight[system.node(RIGHT)] += PRESSED
        self.load = hold * np.linalg.solve(system.K, weight)[system.node(RIGHT)]
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


def newmark(fmu, speed, h, stop, stand_in=True, seen=(), tolerance=1e-5):
    """ROSS integrates; gives time, motion of all nodes, and the FMU's outputs named in `seen`."""
    coupled = Coupled(fmu, speed, tolerance)
    if not stand_in:
        coupled.stiffness, coupled.damping = np.zeros((2, 2)), np.zeros((2, 2))
    rotor = rotor_with((coupled.stiffness, coupled.damping) if stand_in else None)
    t = h * np.arange(round(stop / h) + 1)
    force = np.zeros((len(t), rotor.ndof))
    first = rotor.number_dof * DISK
    force[:, first : first + 2] = unbalance(t, speed).T
    node = slice(rotor.number_dof * RIGHT, rotor.number_dof * RIGHT + 2)
    rows = [coupled.fmu.read(seen)]

    def beyond(step, time_step, disp_resp, velc_resp, accl_resp):
        if step != len(rows):
            raise RuntimeError(f"ROSS asked for step {step} after {len(rows) - 1}: not once per step")
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
    keep = Lateral(rotor, speed).rows
    return t, motion[:, keep], np.array(rows)


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


def exact(fmu, speed, h, stop, passes=1, seen=(), tolerance=1e-5, at_disk=unbalance):
    """Our host; `at_disk` is the force there. Gives time, motion of all nodes, and the FMU's outputs named in `seen`."""
    coupled = Coupled(fmu, speed, tolerance)
    system = Lateral(rotor_with((coupled.stiffness, coupled.damping)), speed)
    node, disk, n = system.node(RIGHT), system.node(DISK), system.size
    columns = [node.start, node.start + 1, disk.start, disk.start + 1]
    over = Propagator(system, h, columns)
    speeds = slice(n + node.start, n + node.stop)
    count = round(stop / h)
    z = np.zeros(2 * n)
    motion, rows = np.zeros((count + 1, n)), [coupled.fmu.read(seen)]
    drive = at_disk(0.5 * h * np.arange(2 * count + 1), speed).T
    beyond = np.zeros(2)
    for step in range(count):
        carried = over.free @ z + over.by_start @ np.concatenate([beyond, drive[2 * step]])
        carried += over.by_mean[:, 2:] @ (SIMPSON @ drive[2 * step : 2 * step + 3])
        carried += over.by_end[:, 2:] @ drive[2 * step + 2]
        told = carried + (over.by_mean[:, :2] + over.by_end[:, :2]) @ beyond
        for repeat in range(passes):
            if passes > 1:
                coupled.fmu.restore() if repeat else coupled.fmu.save()
            # The parabola that starts as the shaft does and ends where it is told to.
            a = 2 * (told[node] - z[node] - h * z[speeds]) / h**2
            mean, end = coupled.tell(z[node], z[speeds], a, h)
            told = carried + over.by_mean[:, :2] @ mean + over.by_end[:, :2] @ end
        z, beyond = told, end
        motion[step + 1] = z[:n]
        if not abs(z[node]).max() < 1e-2:
            raise RuntimeError(f"unstable at {step * h:.4g} s")
        rows.append(coupled.fmu.read(seen) if seen else ())
    coupled.fmu.close()
    return h * np.arange(count + 1), motion, np.array(rows)


def alone(system, speed, h, stop, at_disk):
    """A linear rotor without FMU, the same way."""
    disk = system.node(DISK)
    over = Propagator(system, h, [disk.start, disk.start + 1])
    t = h * np.arange(round(stop / h) + 1)
    drive = at_disk(0.5 * h * np.arange(2 * len(t) - 1), speed).T
    states = np.zeros((len(t), 2 * system.size))
    for step in range(len(t) - 1):
        start, _, end = drive[2 * step : 2 * step + 3]
        mean = SIMPSON @ drive[2 * step : 2 * step + 3]
        states[step + 1] = over.free @ states[step] + over.by_start @ start + over.by_mean @ mean + over.by_end @ end
    return t, states[:, : system.size]


def fmus_in(folder):
    base = SCENES / "er16k-tb1-hosted-shaft.toml"
    healthy = changed_scene(base, "er16k-hosted-shaft", {"defect": None, "contact": None}, folder)
    spalled = changed_scene(base, "er16k-tb1-hosted-shaft", {}, folder)
    return build([healthy, spalled], folder)


def mean_coefficients(fmu, speed):
    """Stiffness and damping at rest, mean over the cage's places within one element spacing."""
    found = []
    for angle in -np.pi / 2 + 2 * np.pi / 9 * np.arange(16) / 16:
        coupled = Coupled(fmu, speed, initial_angle=angle)
        found.append((coupled.stiffness, coupled.damping))
        coupled.fmu.close()
    return [np.mean([pair[i] for pair in found], axis=0) for i in (0, 1)]


def check_linear(fmu, folder, speeds, settle, h):
    """Small motion: ROSS with the FMU against ROSS with a linear bearing on a housing on springs."""
    eccentric = 1e-6  # kg m: a few newtons at the bearing in resonance, 1 % of its load

    def drive(t, speed):
        return unbalance(t, speed, eccentric)

    def strike(t, speed):
        return np.array([np.zeros_like(t), 20.0 * np.sin(np.pi * np.clip(t / 5e-3, 0.0, 1.0)) ** 2])

    coefficients = mean_coefficients(fmu, 2 * np.pi * 60.0)
    rows = []
    for turns in speeds:
        speed = 2 * np.pi * turns
        linear = rotor_with(coefficients, housing=True)
        response = linear.run_unbalance_response(DISK, eccentric, 0.0, [speed]).forced_resp[:, 0]
        t, motion, _ = exact(fmu, speed, h, settle + 0.5, 2, at_disk=drive)
        late = t >= settle
        window = np.hanning(late.sum())
        turning = window * np.exp(-1j * speed * t[late]) * 2 / window.sum()
        found = turning @ motion[late]
        for node in (DISK, RIGHT):
            for axis in (0, 1):
                expected = response[linear.number_dof * node + axis]
                rows.append([turns, node, axis, abs(found[4 * node + axis]), abs(expected)])
    rows = np.array(rows)
    # A strike on the disk at 10 Hz; the difference to a run without it leaves what the passing elements excite.
    speed = 2 * np.pi * 10.0
    linear = rotor_with(coefficients, housing=True)
    t, expected = alone(Lateral(linear, speed), speed, h, 0.5, strike)
    _, struck, _ = exact(fmu, speed, h, 0.5, 2, at_disk=strike)
    _, calm, _ = exact(fmu, speed, h, 0.5, 2, at_disk=lambda t, speed: np.zeros((2, len(t))))
    found = (struck - calm)[:, 4 * DISK + 1]
    free = [decay(t[t > 0.01], signal[t > 0.01]) for signal in (found, expected[:, 4 * DISK + 1])]
    worst = [np.abs(rows[rows[:, 1] == node][:, 3] / rows[rows[:, 1] == node][:, 4] - 1).max() for node in (DISK, RIGHT)]
    figure, (above, below) = plots(2, 7)
    at_disk = rows[(rows[:, 1] == DISK) & (rows[:, 2] == 1)]
    above.plot(at_disk[:, 0], at_disk[:, 4] * 1e6, color="black", label="ROSS with a linear bearing")
    above.plot(at_disk[:, 0], at_disk[:, 3] * 1e6, "o", color="#D55E00", label="ROSS with the FMU")
    above.set(xlabel="shaft speed (Hz)", ylabel="disk, y, at shaft\nspeed (µm)", yscale="log")
    above.set_title("Small motion about rest, healthy bearing", loc="left")
    below.plot(t * 1e3, expected[:, 4 * DISK + 1] * 1e6, color="black", label="ROSS with a linear bearing")
    below.plot(t * 1e3, found * 1e6, "--", color="#D55E00", label="ROSS with the FMU")
    below.set(xlabel="time after a strike on the disk (ms)", ylabel="disk, y (µm)")
    for axis in (above, below):
        legend(axis)
    save(figure, folder / "rotor_ross_linear")
    return {
        "largest_error_disk": worst[0], "largest_error_bearing": worst[1],
        "decay_hz": free[0][0], "decay_hz_linear": free[1][0], "decay_hz_error": free[0][0] / free[1][0] - 1,
        "decay_rate_1_s": free[0][1], "decay_rate_linear_1_s": free[1][1],
        "response_m": [dict(zip(("hz", "node", "axis", "fmu", "linear"), row)) for row in rows.tolist()],
    }


def decay(t, signal):
    """Frequency [Hz] and decay rate [1/s] of the strongest damped sine."""
    spectrum = np.abs(np.fft.rfft(signal * np.hanning(len(t)), 16 * len(t)))
    guess = np.fft.rfftfreq(16 * len(t), t[1] - t[0])[spectrum.argmax()]

    def rest(what):
        wave = np.exp((2j * np.pi * what[0] - what[1]) * (t - t[0]))
        basis = np.column_stack([wave.real, wave.imag])
        return basis @ np.linalg.lstsq(basis, signal, rcond=None)[0] - signal

    signal = signal / np.abs(signal).max()
    return least_squares(rest, [guess, 5.0], x_scale=[0.1, 1.0]).x


def table(fmus, stop, steps, fine=2.5e-6):
    """Error over communication step: Markdown."""
    speed = 2 * np.pi * 30.0
    hosts = {
        "ROSS, no stand-in": lambda fmu, h: newmark(fmu, speed, h, stop, stand_in=False, tolerance=1e-8),
        "ROSS": lambda fmu, h: newmark(fmu, speed, h, stop, tolerance=1e-8),
        "exact, 1 pass": lambda fmu, h: exact(fmu, speed, h, stop, 1, tolerance=1e-8),
        "exact, 2 passes": lambda fmu, h: exact(fmu, speed, h, stop, 2, tolerance=1e-8),
    }
    print("| bearing | host | " + " | ".join(f"{h:g} s" for h in steps) + " |")
    print("|---|---|" + "---|" * len(steps))
    for name, fmu in zip(("healthy", "spalled"), fmus):
        _, reference, _ = exact(fmu, speed, fine, stop, 2, tolerance=1e-8)
        for host, run in hosts.items():
            cells = []
            for h in steps:
                try:
                    _, motion, _ = run(fmu, h)
                except (RuntimeError, FloatingPointError, Warning):
                    cells.append("unstable")
                    continue
                expected = reference[:: round(h / fine)][: len(motion), 4 * RIGHT + 1]
                error = motion[: len(expected), 4 * RIGHT + 1] - expected
                cells.append(f"{np.sqrt(np.mean(error**2)) / expected.std():.1e}")
            print(f"| {name} | {host} | " + " | ".join(cells) + " |", flush=True)


def share(fmu, h=1e-4, stop=0.2):
    """Processor time of one communication step [µs]: the FMU, fmpy and ctypes around it, the rest of Python."""
    inside, original = {}, Bearing.__init__

    def watched(self, *arguments, **named):
        original(self, *arguments, **named)
        for name in ("fmi2SetReal", "fmi2DoStep", "fmi2GetReal"):
            function = self.slave._functions[name]

            def timed(*arguments, function=function, name=name):
                begin = time.thread_time_ns()
                status = function(*arguments)
                inside[name] = inside.get(name, 0) + time.thread_time_ns() - begin
                return status

            timed.restype, timed.argtypes, timed.argnames = function.restype, function.argtypes, function.argnames
            self.slave._functions[name] = timed

    def timed_calls(function, *arguments):
        begin = time.thread_time_ns()
        for _ in range(20000):
            function(*arguments)
        return (time.thread_time_ns() - begin) / 20000 / 1e3

    idle = Bearing(fmu)
    # Calls that do nothing: what ctypes, fmpy and the clock cost.
    ctypes_call = timed_calls(idle.slave._functions["fmi2GetReal"], idle.slave.component, None, 0, None)
    fmpy_call = timed_calls(idle.slave.fmi2GetReal, idle.slave.component, None, 0, None)
    clock = timed_calls(time.thread_time_ns)
    idle.close()
    speed, count = 2 * np.pi * 30.0, round(stop / h)
    result = {"step_s": h, "steps": count}
    Bearing.__init__ = watched
    for name, run in (("exact", exact), ("newmark", newmark)):
        took = []
        for steps in (10, 10, count + 10):  # the first makes and compiles what is made once
            inside.clear()
            begin = time.thread_time()
            run(fmu, speed, h, steps * h)
            took.append((time.thread_time() - begin) * 1e6)
        whole = (took[2] - took[1]) / count - 6 * clock
        in_fmu = sum(inside.values()) / 1e3 / count - 3 * (ctypes_call + clock)
        result[name] = {
            "whole_us": whole, "fmu_us": in_fmu, "fmpy_and_ctypes_us": 3 * fmpy_call,
            "python_us": whole - in_fmu - 3 * fmpy_call,
        }
    Bearing.__init__ = original
    return result


def response(fmus, folder, turns, h, stop):
    """Rotor and housing over time, and order spectra, healthy and spalled."""
    speed = 2 * np.pi * turns
    seen = ["housing.ay", "shaft.force.y", "cage.speed"]
    runs, took = {}, {}
    for name, fmu in zip(("healthy", "spalled"), fmus):
        begin = time.perf_counter()
        runs[name] = exact(fmu, speed, h, stop, 1, seen)
        took[name] = time.perf_counter() - begin
    passage = 9 * runs["spalled"][2][0, 2] / speed  # of an element over a place on the outer ring, per shaft turn
    figure, axes = plots(4, 11)
    colours = {"healthy": "#0072B2", "spalled": "#D55E00"}
    summary = {"bpfo_order": passage, "seconds": took}
    for name in ("spalled", "healthy"):
        t, motion, outputs = runs[name]
        late = t >= min(0.3, 0.4 * stop)
        part = (t >= t[-1] - 4 / turns) & late
        axes[0].plot((t[part] - t[-1]) * turns, motion[part, 4 * RIGHT + 1] * 1e6, color=colours[name], label=name)
        axes[1].plot((t[part] - t[-1]) * turns, motion[part, 4 * DISK + 1] * 1e6, color=colours[name], label=name)
        for axis, signal, scale in ((axes[2], motion[late, 4 * RIGHT + 1], 1e6), (axes[3], outputs[late, 0], 1.0)):
            window = np.hanning(late.sum())
            spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * window)) * 2 / window.sum() * scale
            order = np.fft.rfftfreq(late.sum(), h) / turns
            axis.semilogy(order[order < 15], spectrum[order < 15], color=colours[name], linewidth=0.9, label=name)
            if axis is axes[2]:
                near = {}
                for line in (1.0, passage - 1, passage, passage + 1, 2 * passage - 1, 2 * passage, 2 * passage + 1):
                    near[f"{line:.3f}"] = float(spectrum[np.abs(order - line) < 0.06].max())
                summary[f"place_um_{name}"] = near
    for axis in axes[2:]:
        top = axis.get_xaxis_transform()
        for multiple in (1, 2, 3, 4):
            axis.plot(multiple * passage, 1.02, "v", color="black", transform=top, clip_on=False, markersize=5)
            for side in (-1, 1) if multiple < 4 else (-1,):
                at = multiple * passage + side
                axis.plot(at, 1.02, "v", color="#999999", transform=top, clip_on=False, markersize=4)
        axis.set_xlim(0, 15)
    axes[2].set_ylim(1e-5, None)
    axes[3].set_ylim(1e-4, None)
    axes[0].set(ylabel="shaft in the bearing,\ny from rest (µm)", xlabel="turns of the shaft")
    axes[1].set(ylabel="disk, y from rest\n(µm)", xlabel="turns of the shaft")
    axes[2].set(ylabel="shaft in the bearing,\ny (µm)", xlabel="order of shaft speed; marks: multiples of BPFO, grey: ±1")
    axes[3].set(ylabel="housing, y (m/s²)", xlabel="order of shaft speed; the same marks")
    axes[0].set_title(f"ROSS rotor at {turns:g} Hz, ER16K with a spall of 15.8 degrees", loc="left")
    legend(axes[0])
    save(figure, folder / "rotor_ross")
    return summary


def plots(count, height):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(count, 1, figsize=(9, height), constrained_layout=True)
    for axis in axes:
        axis.grid(color="#dddddd", linewidth=0.6)
        axis.spines[["top", "right"]].set_visible(False)
    return figure, axes


def legend(axis):
    axis.legend(frameon=False, ncols=2, loc="lower right", bbox_to_anchor=(1, 0.97), borderaxespad=0)


def save(figure, stem):
    for suffix in ("svg", "png"):
        metadata = {"Date": None} if suffix == "svg" else {"Software": None}
        figure.savefig(f"{stem}.{suffix}", dpi=150, metadata=metadata)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", nargs="?", default="response", choices=("response", "linear", "table", "share"))
    parser.add_argument("--speed", type=float, default=40.0, help="shaft speed of the response [Hz]")
    parser.add_argument("--step", type=float, default=5e-5, help="communication step of the response [s]")
    parser.add_argument("--stop", type=float, help="end [s]")
    parser.add_argument("--short", action="store_true", help="fewer speeds, steps and seconds")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    options = parser.parse_args()
    fmus = fmus_in(options.output)
    if options.what == "linear":
        speeds = (64.0,) if options.short else (45.0, 55.0, 60.0, 62.0, 63.0, 63.5, 64.0, 64.5, 65.0, 67.0, 72.0, 80.0)
        result = check_linear(fmus[0], options.output, speeds, *((1.0, 2e-4) if options.short else (1.5, 1e-4)))
    elif options.what == "table":
        steps = (2e-5, 1e-4) if options.short else (1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3)
        fine = 5e-6 if options.short else 2.5e-6
        return table(fmus, options.stop or (0.01 if options.short else 0.05), steps, fine)
    elif options.what == "share":
        result = share(fmus[1])
    else:
        result = response(fmus, options.output, options.speed, options.step, options.stop or (0.5 if options.short else 4.0))
    print(json.dumps(result))


if __name__ == "__main__":
    main()
