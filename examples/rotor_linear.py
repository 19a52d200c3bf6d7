#!/usr/bin/env python3
"""Is the coupling right? Small motion of the ROSS rotor with the FMU against ROSS with a linear bearing.

    python examples/rotor_linear.py [--short] [-o target/examples]

Healthy bearing. The linear one has `shaft.stiffness` and the contacts' damping at rest, mean over cage angles
within one element spacing, and the housing's mass on its springs behind it.

Response to a small unbalance around the first critical speed: ROSS's own run_unbalance_response against the component
at shaft speed of the motion with the FMU. Free decay: after a strike on the disk at 10 Hz; the passing elements excite
the rotor, too, so a run without the strike is taken off.
"""

import argparse
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
from figures import BLACK, ORANGE, legend, plots, save
from matplotlib.ticker import LogLocator
from ross_bearings import SIMPSON, Coupled, Lateral, Propagator, exact, unbalance, with_bearings
from rotor_ross import fmus_in, shown
from scipy.optimize import least_squares

ECCENTRIC = 1e-6  # kg m: a few newtons at the bearing in resonance, 1 % of its load
HOUSING = {"mass": 6.638, "damping": 2210.7, "stiffness": 1.51056e7}  # as in the bearing's scene
drive = unbalance(ECCENTRIC)


def strike(t, speed):
    """20 N for 5 ms, down."""
    return np.array([np.zeros_like(t), -20.0 * np.sin(np.pi * np.clip(t / 5e-3, 0.0, 1.0)) ** 2])


def nothing(t, speed):
    return np.zeros((2, len(t)))


def mean_coefficients(machine, fmu, speed):
    """Stiffness and damping at rest, mean over cage angles within one element spacing."""
    found = []
    for angle in -np.pi / 2 + 2 * np.pi / 9 * np.arange(16) / 16:
        coupled = Coupled(machine, [fmu], speed, initial_angle=angle)
        found.append((coupled.stiffness, coupled.damping))
        coupled.close()
    return [np.mean([pair[i] for pair in found], axis=0) for i in (0, 1)]


def alone(disk, system, speed, h, stop, at_disk):
    """A linear rotor without FMU, the same way."""
    over = Propagator(system, h, system.nodes([disk]))
    t = h * np.arange(round(stop / h) + 1)
    force = at_disk(0.5 * h * np.arange(2 * len(t) - 1), speed).T
    states = np.zeros((len(t), 2 * system.size))
    for step in range(len(t) - 1):
        start, _, end = force[2 * step : 2 * step + 3]
        mean = SIMPSON @ force[2 * step : 2 * step + 3]
        states[step + 1] = over.free @ states[step] + over.by_start @ start + over.by_mean @ mean + over.by_end @ end
    return t, states[:, : system.size]


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


def driven(machine, at_disk):
    """The machine with another force at its disk."""
    return replace(machine, forces={node: at_disk for node in machine.forces})


def responses(machine, fmu, linear, speeds, settle, h):
    """Amplitudes at shaft speed [m]: rows of speed [Hz], node, axis (0 x, 1 y), with the FMU, linear."""
    rows = []
    (bearing,), (disk,) = machine.nodes, machine.forces
    for turns in speeds:
        speed = 2 * np.pi * turns
        expected = linear.run_unbalance_response(disk, ECCENTRIC, 0.0, [speed]).forced_resp[:, 0]
        t, motion, _ = exact(driven(machine, drive), [fmu], speed, h, settle + 0.5, 2)
        late = t >= settle
        window = np.hanning(late.sum())
        found = (window * np.exp(-1j * speed * t[late]) * 2 / window.sum()) @ motion[late]
        for node in (disk, bearing):
            for axis in (0, 1):
                at = linear.number_dof * node + axis
                rows.append([turns, node, axis, abs(found[4 * node + axis]), abs(expected[at])])
    return np.array(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--short", action="store_true", help="three speeds")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    options = parser.parse_args()
    machine = shown()
    (bearing,), (disk,) = machine.nodes, machine.forces
    fmu = fmus_in(options.output)[0]
    if options.short:
        speeds, settle, h = (62.0, 64.0, 66.0), 1.0, 2e-4
    else:
        speeds, settle, h = (45, 50, 55, 58, 60, 62, 63, 63.5, 64, 64.5, 65, 66, 68, 72, 80), 1.5, 1e-4
    mean = mean_coefficients(machine, fmu, 2 * np.pi * 60.0)
    linear = with_bearings(machine.rotor, machine.nodes, [mean], [HOUSING])
    rows = responses(machine, fmu, linear, speeds, settle, h)

    speed = 2 * np.pi * 10.0
    t, expected = alone(disk, Lateral(linear, speed), speed, h, 0.5, strike)
    struck, still = (exact(driven(machine, force), [fmu], speed, h, 0.5, 2)[1] for force in (strike, nothing))
    found, expected = (motion[:, 4 * disk + 1] for motion in (struck - still, expected))
    free, free_linear = (decay(t[t > 0.01], signal[t > 0.01]) for signal in (found, expected))

    figure, axes = plots(3, 9)
    between = np.linspace(min(speeds), max(speeds), 200)
    curve = linear.run_unbalance_response(disk, ECCENTRIC, 0.0, 2 * np.pi * between).forced_resp
    for axis, node, name in ((axes[0], disk, "disk"), (axes[1], bearing, "shaft in the bearing")):
        at = rows[(rows[:, 1] == node) & (rows[:, 2] == 1)]
        axis.plot(between, np.abs(curve[linear.number_dof * node + 1]) * 1e6, color=BLACK, label="ROSS, linear bearing")
        axis.plot(at[:, 0], at[:, 3] * 1e6, "o", color=ORANGE, label="ROSS, FMU")
        axis.set(xlabel="shaft speed (Hz)", ylabel=f"{name}, y,\nat shaft speed (µm)", yscale="log")
        axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.yaxis.set_major_formatter("{x:g}")
        axis.yaxis.set_minor_formatter("")
    axes[2].plot(t * 1e3, expected * 1e6, color=BLACK, label="ROSS, linear bearing")
    axes[2].plot(t * 1e3, found * 1e6, "--", color=ORANGE, label="ROSS, FMU")
    axes[2].set(xlabel="time after an impact on the disk (ms)", ylabel="disk, y (µm)")
    axes[0].set_title("Small motion about rest, healthy bearing", loc="left")
    legend(axes[0])
    save(figure, options.output / "rotor_linear")

    errors = np.abs(rows[:, 3] / rows[:, 4] - 1)
    print(json.dumps({
        "speeds_hz": speeds,
        "largest_error_disk": errors[rows[:, 1] == disk].max(),
        "largest_error_bearing": errors[rows[:, 1] == bearing].max(),
        "decay_hz": free[0], "decay_hz_linear": free_linear[0], "decay_hz_error": free[0] / free_linear[0] - 1,
        "decay_rate_1_s": free[1], "decay_rate_linear_1_s": free_linear[1],
        "files": f"{options.output / 'rotor_linear'}.svg .png",
    }))


if __name__ == "__main__":
    main()
