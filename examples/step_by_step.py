#!/usr/bin/env python3
"""A rigid rotor on two bearings, stepped by hand: NumPy and fmpy only.

    python examples/step_by_step.py [--step 5e-5] [--passes 1] [--stop 0.4] [-o target/examples]

A rotor of 6 kg turns at 20 Hz with a small unbalance in two ER16K bearings: the left one healthy, the right one with a
spall of 15.8 degrees. It carries 1000 N, and from 0.2 s on 600 N more. Each bearing is one instance of an FMU that
takes the shaft's motion and gives the force on the shaft; its housing stands on springs and carries a sensor.

One communication step of length h, bearings first:
  1. each FMU goes on with the shaft's position, velocity and acceleration a₀, and gives the force's mean over the step
     and its value at the end, and the tangent stiffness K;
  2. the mean acceleration A: the shaft goes elsewhere than it told the FMU, by (A − a₀)h²/12 on average if the
     acceleration changes linearly, and K says what force that makes: (M + h²/12 K) A = mean forces + h²/12 K a₀;
  3. the force at the end is corrected likewise, and from a₀, A and the acceleration at the end a₁ follow
     v += h A,  q += h v + h²/2 A + h²/12 (a₀ − a₁).
With --passes 2 the FMUs go back to the step's start and repeat it on the way just found.
For constant K this conserves energy, its error is of fourth order, and it is stable to ωh = 2 with one pass.

Coordinates: the shaft's positions q = (x, y) of the left and (x, y) of the right bearing.
"""

import json
import time

import numpy as np
from bearing import Bearing, build, healthy_and_spalled, parser, whole

MASS, LENGTH, CENTRE = 6.0, 0.40, 0.22  # kg, m between the bearings, m from left bearing to the centre of mass
INERTIA, POLAR = 0.09, 0.008  # kg m², across the axis and about it
SPEED = 2 * np.pi * 20.0  # rad/s
UNBALANCE = MASS * 4e-6  # kg m at the centre of mass: balance grade G 0.5 at this speed
LOAD, MORE, LATER = 1000.0, 600.0, 0.2  # N, N, s; down, at the centre of mass
DAMPING = 1376.8  # N s/m on the shaft at each bearing: what published models of such rigs assume
GRAVITY = 9.81

# Weights of left and right bearing in the position of the centre of mass; the rotor's tilt is (right − left)/LENGTH.
AT_CENTRE = np.array([1 - CENTRE / LENGTH, CENTRE / LENGTH])
TILT = np.array([-1.0, 1.0]) / LENGTH
PLANE = MASS * np.outer(AT_CENTRE, AT_CENTRE) + INERTIA * np.outer(TILT, TILT)
MASSES = np.kron(PLANE, np.eye(2))
# Gyroscopic: a tilt rate in x gives a moment in y and the other way round.
GYRO = SPEED * POLAR * np.kron(np.outer(TILT, TILT), np.array([[0.0, 1.0], [-1.0, 0.0]]))
RESIST = GYRO + DAMPING * np.eye(4)


def outer_load(t):
    """Load, weight and unbalance at time t on the coordinates [N]."""
    rise = np.clip((t - LATER) / 0.02, 0.0, 1.0)
    down = LOAD + MORE * rise * rise * (3 - 2 * rise) + MASS * GRAVITY
    turning = UNBALANCE * SPEED**2 * np.array([np.cos(SPEED * t), np.sin(SPEED * t)])
    return np.outer(AT_CENTRE, turning + [0.0, -down]).ravel()


def one_step(bearings, masses, resist, loads, state, h, passes):
    """The steps 1 to 3 above. `loads` are those at the start, the middle and the end; `state` is (q, v, force)."""
    q, v, force = state
    begin, middle, later = loads
    start_a = told = np.linalg.solve(masses, force + begin - resist @ v)
    others = (begin + 4 * middle + later) / 6 - resist @ (v + 0.5 * h * start_a)
    stiffness = np.zeros_like(masses)
    for repeat in range(passes):
        if passes > 1:
            for bearing in bearings:
                bearing.restore() if repeat else bearing.save()
        mean, end = np.empty_like(q), np.empty_like(q)
        for i, bearing in enumerate(bearings):
            part = slice(2 * i, 2 * i + 2)
            mean[part], end[part] = bearing.advance(q[part], v[part], told[part], h)
            stiffness[part, part] = bearing.stiffness()
        aside = h * h * ((start_a - told) / 6 - start_a / 12)
        a = np.linalg.solve(masses + h * h / 12 * stiffness, mean + others - stiffness @ aside)
        force = end - stiffness @ (h * h * ((start_a - told) / 2 + (a - start_a) / 3))
        end_a = np.linalg.solve(masses, force + later - resist @ (v + h * a))
        told = a + (start_a - end_a) / 6
    return q + h * v + 0.5 * h * h * told, v + h * a, force


def simulate(fmus, step, passes, stop, seen=(), tolerance=1e-5):
    """Runs the rotor. Gives time, positions, forces of both bearings, and the outputs in `seen` of the right one."""
    start = {"shaft.speed": SPEED, "solver.tolerance": tolerance}
    bearings = [Bearing(fmu, name, start) for fmu, name in zip(fmus, ("left", "right"))]
    load = outer_load(0.0)
    # The unbalance starts with the rotor at rest: a jolt of less than a newton against 1000 N.
    q = np.concatenate([bearing.rest([0.0, load[2 * i + 1]]) for i, bearing in enumerate(bearings)])
    force = np.concatenate([bearing.force_at(q[2 * i : 2 * i + 2]) for i, bearing in enumerate(bearings)])
    state = q, np.zeros(4), force
    rows = [[0.0, *q, *force, *bearings[1].read(seen)]]
    for bearing in bearings:
        bearing.run()
    for count in range(round(stop / step)):
        t = count * step
        loads = outer_load(t), outer_load(t + 0.5 * step), outer_load(t + step)
        state = one_step(bearings, MASSES, RESIST, loads, state, step, passes)
        if not np.all(np.abs(state[0]) < 1e-2):
            raise RuntimeError(f"the shaft is {np.abs(state[0]).max():.2g} m off at {t:.4g} s: take a shorter step")
        rows.append([t + step, *state[0], *state[2], *(bearings[1].read(seen) if seen else ())])
    for bearing in bearings:
        bearing.close()
    return np.array(rows)


def draw(rows, seen, step, passes, stem):
    from figures import BLACK, BLUE, GREEN, ORANGE, legend, plots, save

    t, positions, forces = rows[:, 0], rows[:, 1:5], rows[:, 5:9]
    spalled = dict(zip(seen, rows[:, 9:].T))
    figure, axes = plots(4, 9, sharex=True)
    axes[0].plot(t, [-outer_load(when)[1::2].sum() for when in t], color=BLACK)
    axes[0].set_ylabel("load on the\nrotor, down (N)")
    axes[0].set_title(
        f"Rigid rotor on two bearings, {passes} pass{'es' * (passes > 1)}, step {step * 1e6:g} µs", loc="left"
    )
    for column, colour, label in ((1, BLUE, "left, healthy"), (3, ORANGE, "right, spalled")):
        axes[1].plot(t, forces[:, column], color=colour, label=label, linewidth=0.8)
        axes[2].plot(t, positions[:, column] * 1e6, color=colour, label=label)
    axes[1].set_ylabel("bearing's force on\nthe shaft, y (N)")
    axes[2].set_ylabel("position of the\nshaft, y (µm)")
    axes[3].plot(t, spalled["sensor.acceleration"], color=GREEN, linewidth=0.7)
    axes[3].set_ylabel("sensor on the\nright, y (m/s²)")
    axes[3].set_xlabel("time (s)")
    axes[3].set_xlim(0, t[-1])
    for axis in axes[1:3]:
        legend(axis)
    save(figure, stem)


def main():
    words = parser(__doc__)
    words.add_argument("--step", type=float, default=5e-5, help="communication step [s]")
    words.add_argument("--passes", type=int, default=1, choices=(1, 2, 3))
    words.add_argument("--stop", type=float, default=0.4, help="end [s]")
    options = words.parse_args()
    fmus = build(healthy_and_spalled(options.output), options.output)
    seen = ["sensor.acceleration", "housing.ay"]
    begin = time.perf_counter()
    rows = simulate(fmus, options.step, options.passes, options.stop, seen)
    took = time.perf_counter() - begin
    stem = options.output / "step_by_step"
    positions = [f"{side}.{axis} [m]" for side in ("left", "right") for axis in "xy"]
    forces = [f"{side}.force.{axis} [N]" for side in ("left", "right") for axis in "xy"]
    header = ",".join(["time [s]", *positions, *forces, *(f"right.{name} [m/s2]" for name in seen)])
    with whole(stem.with_suffix(".csv")) as part:
        np.savetxt(part, rows, delimiter=",", header=header, comments="", fmt="%.9g")
    draw(rows, seen, options.step, options.passes, stem)
    last = rows[:, 0] > options.stop - 0.05
    print(json.dumps({
        "run_s": round(took, 3), "steps": len(rows) - 1,
        "mean_force_left_n": rows[last, 6].mean(), "mean_force_right_n": rows[last, 8].mean(),
        "largest_sensor_m_s2": np.abs(rows[:, 9]).max(), "files": f"{stem}.csv .svg .png",
    }))


if __name__ == "__main__":
    main()
