"""Numbers to hold a bearing against: events of a passage, ringing, natural frequencies, static stiffness, critical
load.

    python tests/oracle/measure.py passage SCENE.toml [--stop 0.08] [--rtol 1e-9]
    python tests/oracle/measure.py modes SCENE.toml [--remove N …]      elements N (from 1) taken out
    python tests/oracle/measure.py stiffness SCENE.toml [--points 161]
    python tests/oracle/measure.py critical SCENE.toml

Time 0 of a passage is when the element's centre crosses the radius of the spall's leading edge. Stiffness is the load
direction's entry of the condensed tangent of the static equilibrium at fixed housing: dF/dx with the transverse ring
position held (`held`) or free (`free`). Modes are eigenvalues of the undamped-contact equations around the equilibrium.
"""

import argparse

import numpy as np
from bearing import Bearing
from equilibrium import Equilibrium
from reference import simulate
from scipy.optimize import brentq, least_squares


def fit_ringing(t, signal):
    """Frequency [Hz] and decay [1/s] of the one damped sinusoid, on a straight line, that fits best."""
    t = t - t[0]
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(t)), 16 * len(t)))
    frequency = np.fft.rfftfreq(16 * len(t), t[1])
    band = (frequency > 300) & (frequency < 2000)
    peak = frequency[band][np.argmax(spectrum[band])]

    def basis(p):
        decay = np.exp(-p[1] * 100 * t)
        phase = 2 * np.pi * p[0] * 1000 * t
        return np.array([decay * np.cos(phase), decay * np.sin(phase), np.ones_like(t), t / t[-1]]).T

    def misfit(p):
        a = basis(p)
        return a @ np.linalg.lstsq(a, signal, rcond=None)[0] - signal

    best = least_squares(misfit, [peak / 1000, 3.0])
    return best.x[0] * 1000, best.x[1] * 100, np.sqrt(np.mean(best.fun**2)) / np.std(signal)


def outer_spall(bearing):
    assert bearing.spall and bearing.spall.on == "outer" and not bearing.omega_o, (
        "a spall of an outer ring at rest only"
    )
    return bearing.spall


def passage(bearing, stop, rtol):
    rows, run = simulate(bearing, stop, 1e-5, rtol=rtol)
    a = {k: np.array([r[k] for r in rows]) for k in rows[0]}
    spall = outer_spall(bearing)
    length = 2 * spall.half_length / bearing.omega_c
    for j in range(bearing.z):
        to_edge = -spall.half_length - spall.angle("outer", bearing.angles(0.0), 0.0)[j]
        start = np.remainder(to_edge, 2 * np.pi) / bearing.omega_c
        if start + length + 5e-3 > stop:
            continue
        changes = [((at - start) * 1e3, side, gained) for at, side, k, gained in run.changes
                   if k == j and -1e-3 < at - start < length + 2e-3]
        print(f"element {j + 1}: leading edge at t = {start * 1e3:.4f} ms, trailing edge {length * 1e3:.4f} ms later")
        print(
            "  contact changes, ms: "
            + " ".join(f"{at:.3f}{side[0]}{'+' if gained else '-'}" for at, side, gained in changes)
        )
        t, q = a["time"] - start, a[f"element[{j + 1}].force.outer"]
        for name, low, high in (
            ("before the edge", -1e-3, 0.0),
            ("on the floor", 1e-3, length - 1.05e-3),
            ("at the trailing edge", length - 1.05e-3, length),
            ("after it", length, length + 3e-3),
        ):
            window = np.flatnonzero((t > low) & (t < high))
            k = window[np.argmax(q[window])]
            print(f"  outer force {name}: at most {q[k]:.1f} N, at {t[k] * 1e3:.2f} ms")
        for name, low, high in (("entry", 0.8e-3, 9e-3), ("exit", length + 1e-3, length + 9e-3)):
            window = (t > low) & (t < high)
            for signal in ("housing.ay", "shaft.ay"):
                if signal in a:
                    print("  ringing after {}, {}: {:.1f} Hz, decay {:.0f} /s, misfit {:.3f} of its rms".format(
                        name, signal, *fit_ringing(t[window], a[signal][window])))


def modes(bearing, t=0.0):
    """(frequency Hz, damping ratio, mode shape) of every oscillation below 20 kHz."""
    chi, bearing.chi = bearing.chi, 0.0
    at_rest = Equilibrium(bearing, t)
    y, step = at_rest.state(), np.ones(bearing.n_front + 2 * bearing.z) * 1e-9
    step[bearing.n_front:bearing.n_front + bearing.z] = np.maximum(at_rest.u * 1e-3, 1e-12)
    jacobian = np.array([(bearing.rhs(t, y + d) - bearing.rhs(t, y - d)) / (2 * d.max()) for d in np.diag(step)]).T
    bearing.chi = chi
    values, vectors = np.linalg.eig(jacobian)
    found = [
        (v.imag / (2 * np.pi), -v.real / abs(v), vectors[: bearing.n_rings, i])
        for i, v in enumerate(values)
        if v.imag > 60
    ]
    return sorted((m for m in found if m[0] < 20e3), key=lambda m: m[0])


def tangent(bearing, t, start=None, step=1e-10):
    """Equilibrium and dF/dx of the shaft, housing held."""
    at_rest = Equilibrium(bearing, t, start)
    return at_rest, -at_rest.jacobian(at_rest.x, step)


def hold_housing(bearing):
    bearing.housing.motion, bearing.sensor = "fixed", None
    bearing.n_rings = bearing.n_front = 4
    return bearing


def stiffness_over_cage_angle(bearing, points):
    """Cage angles over one spacing, stiffness in load direction with transverse position held and free, N/m."""
    turn = 2 * np.pi / bearing.z / abs(bearing.omega_c)
    way = bearing.shaft.load / np.linalg.norm(bearing.shaft.load)
    angles, held, free, start = [], [], [], None
    for t in np.arange(points) * turn / points:
        at_rest, k = tangent(bearing, t, start)
        assert at_rest.error < 1e-9, f"no equilibrium at t = {t}"
        angles.append(np.degrees(bearing.omega_c * t))
        held.append(way @ k @ way)
        free.append(1 / (way @ np.linalg.inv(k) @ way))
        start = at_rest.x
    return np.array(angles), np.array(held), np.array(free)


def critical_loads(bearing, t):
    """(angle from the spall's middle, load that squeezes it against the floor) of each element on the floor at time
    t."""
    way = bearing.shaft.load / np.linalg.norm(bearing.shaft.load)
    spall = outer_spall(bearing)
    psi = spall.angle("outer", bearing.angles(t), t)
    found = []
    for j in np.flatnonzero(np.abs(psi) < spall.half_length - spall.paths["outer"].roll_in):
        def approach(load):
            bearing.shaft.load = way * load
            return Equilibrium(bearing, t).contacts.inner[j] + 1e-13
        if approach(10.0) < 0 < approach(3e4):
            found.append((np.degrees(psi[j]), brentq(approach, 10.0, 3e4, rtol=1e-7)))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["passage", "modes", "stiffness", "critical"])
    parser.add_argument("scene")
    parser.add_argument("--stop", type=float, default=0.08)
    parser.add_argument("--rtol", type=float, default=1e-9)
    parser.add_argument("--remove", type=int, nargs="*", default=[])
    parser.add_argument("--points", type=int, default=161)
    args = parser.parse_args()
    bearing = Bearing.load(args.scene)
    bearing.removed = [n - 1 for n in args.remove]

    if args.what == "passage":
        passage(bearing, args.stop, args.rtol)
    elif args.what == "modes":
        for frequency, ratio, shape in modes(bearing):
            print(f"{frequency:9.1f} Hz, damping ratio {ratio:.4f}, shaft/housing x y x y " + " ".join(
                f"{abs(s):.3g}" for s in np.delete(shape, [2, 3, 6, 7][:len(shape) // 2]) / np.abs(shape).max()))
    elif args.what == "stiffness":
        _, held, free = stiffness_over_cage_angle(hold_housing(bearing), args.points)
        for name, k in (("held", held), ("free", free)):
            print(
                f"transverse {name}: min {k.min() / 1e6:.2f}, mean {k.mean() / 1e6:.2f}, max {k.max() / 1e6:.2f} N/µm"
            )
    else:
        hold_housing(bearing)
        turn = 2 * np.pi / bearing.z / abs(bearing.omega_c)
        for t in np.arange(40) * turn / 40:
            print(
                f"cage {np.degrees(bearing.omega_c * t):5.1f}° past its start: "
                + (
                    ", ".join(f"element at {psi:+.1f}° from {load:.1f} N" for psi, load in critical_loads(bearing, t))
                    or "none on the floor"
                )
            )


if __name__ == "__main__":
    main()
