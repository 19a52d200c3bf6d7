"""A light shaft, 0.1 kg, is the host's, and the bearing an FMU that is stepped again until both agree.

The reference is the same bearing with the shaft inside one FMU. The host's shaft has mass m, damper c, load L and moves
with a constant acceleration a through each step of length H; the FMU, started from the saved state, is given that
motion and answers with its mean force F(a). Wanted is the a of

    m a + c (v + a H/2) = F(a) + L

once by fixed point, a <- (F + L - c v)/(m + c H/2), once by Newton's method, whose derivative comes from the FMU's
directional derivatives of the force by position and velocity: dF/da = F_x H^2/6 + F_v H/2, the mean of the motion that
a adds. Elements do not stand still through a step, so this derivative is not exact, and the iteration is a damped one.
Without iteration, one pass a step, the scheme is the plain one of the guide.

Arguments: FMU of er16k-tb1, FMU of er16k-tb1-hosted-shaft.
"""

import sys

import numpy as np

from host import started

MASS, DAMPING, LOAD = 0.1, 200.0, np.array([0.0, -500.0])
STOP = 0.012  # the element enters the spall at 5 ms and leaves it at 11 ms
POSITION, VELOCITY, ACCELERATION = ["shaft.x", "shaft.y"], ["shaft.vx", "shaft.vy"], ["shaft.ax", "shaft.ay"]
MEAN = ["shaft.mean_force.x", "shaft.mean_force.y"]
FORCE = ["shaft.force.x", "shaft.force.y"]
AGREED = 1e-6  # N, a few millionths of a per cent of the load
MOST = 50


def monolithic(fmu, step):
    """Position and force of the shaft at the communication points, and the largest force on an element."""
    own = started(fmu, {"shaft.mass": MASS, "shaft.damping": DAMPING, "solver.tolerance": 1e-9})
    rows = [own.read(POSITION + VELOCITY + FORCE)]
    for _ in range(round(STOP / step)):
        own.step(step)
        rows.append(own.read(POSITION + VELOCITY + FORCE))
    own.close()
    return np.array(rows)


def slope(hosted, known):
    """How the force changes with two inputs: one column each."""
    unknowns = [hosted.reference[name] for name in FORCE]
    columns = [hosted.unit.getDirectionalDerivative(unknowns, [hosted.reference[name]], [1.0]) for name in known]
    return np.array(columns).T


def coupled(fmu, step, begin, scheme):
    """Rows as above, and how often each step was taken."""
    x, v = np.array(begin[:2]), np.zeros(2)
    start = dict(zip(POSITION, x))
    start.update({"housing.load.x": 0.0, "housing.load.y": 0.0, "solver.tolerance": 1e-9})
    hosted = started(fmu, start)
    rows, passes = [np.concatenate([x, v, hosted.read(FORCE)])], []
    a = np.zeros(2)
    inertia = MASS + 0.5 * DAMPING * step
    for _ in range(round(STOP / step)):
        hosted.save()
        for count in range(1, MOST + 1):
            if count > 1:
                hosted.restore()
            hosted.write(POSITION + VELOCITY + ACCELERATION, np.concatenate([x, v, a]))
            hosted.step(step)
            push = hosted.read(MEAN) + LOAD - DAMPING * v
            left = inertia * a - push
            if scheme == "newton":
                by_a = slope(hosted, POSITION) * step**2 / 6 + slope(hosted, VELOCITY) * step / 2
                better = a - np.linalg.solve(inertia * np.eye(2) - by_a, left)
            else:
                better = push / inertia
            if scheme == "one pass" or not np.isfinite(better).all():
                a = better
                break
            if np.abs(left).max() < AGREED:
                break
            a = better
        passes.append(count)
        x, v = x + step * v + 0.5 * step**2 * a, v + step * a
        if not np.abs(x).max() < 1e-3:
            break
        hosted.write(POSITION + VELOCITY + ACCELERATION, np.concatenate([x, v, a]))
        rows.append(np.concatenate([x, v, hosted.read(FORCE)]))
    hosted.close()
    return np.array(rows), np.array(passes)


def main():
    own, hosted = sys.argv[1:3]
    schemes = ["one pass", "fixed point", "newton"]
    steps = [5e-5, 2.5e-5, 1.25e-5]
    found = {}
    for step in steps:
        expected = monolithic(own, step)
        sag = np.abs(expected[:, :2] - expected[0, :2]).max()
        for scheme in schemes:
            rows, passes = coupled(hosted, step, expected[0], scheme)
            whole = len(rows) == len(expected)
            error = np.sqrt(np.mean((rows[:, :2] - expected[: len(rows), :2]) ** 2)) / sag if whole else np.inf
            found[scheme, step] = (rows, expected, error, passes)
            print(
                f"{scheme:12} H = {step:.2e} s: error {error:.2e} of the largest excursion, {passes.mean():.2f} passes"
            )

    for step in steps:
        for scheme in ["fixed point", "newton"]:
            _, _, error, passes = found[scheme, step]
            assert np.isfinite(error), f"{scheme} at {step} s is not stable"
            assert passes.max() < MOST, f"{scheme} at {step} s did not agree"
        # One equation, two ways to its solution: what is left of it, a millionth of a newton on 0.1 kg, times what a
        # run through impacts makes of it.
        difference = np.abs(found["fixed point", step][0] - found["newton", step][0])[:, :2].max()
        assert difference < 1e-9, f"the two iterations differ by {difference} m at {step} s"
        assert found["newton", step][3].mean() <= found["fixed point", step][3].mean(), "Newton takes more passes"
    errors = [found["newton", step][2] for step in steps]
    assert errors[0] < 0.1 and errors[2] < 0.5 * errors[0], f"the error does not fall with the step: {errors}"


main()
