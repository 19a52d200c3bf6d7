"""Integrates one scene to near rounding and writes its motion at equal times.

    python tests/oracle/reference.py SCENE.toml --stop 0.02 --step 1e-5 -o out.csv
        [--shaft-motion=X0,Y0,AX,AY,HZ] [--housing-motion=X0,Y0,AX,AY,HZ]   x0 + A sin(2πft), for rings of motion `host`
        [--rtol 1e-12] [--method DOP853|Radau] [--check]

DOP853 with steps that end on output times, on corners of the paths, and on every gain or loss of a contact, because the
right-hand side is smooth only in between. An outer path's corners come at known times. An inner path's are located as
changes of contact are, because the rings' motion turns the inner contacts too.
"""

import argparse
import csv
import sys

import numpy as np
from bearing import MICRO, Bearing
from equilibrium import Equilibrium
from scipy.integrate import DOP853, Radau
from scipy.optimize import brentq

METHODS = {"DOP853": DOP853, "Radau": Radau}
SAME_EVENT = 1e-12  # s; an event nearer than this to the last one is that one


class Reference:
    """Runs forward from static equilibrium; `changes` collects (time, contact, element, gained)."""

    def __init__(self, bearing, rtol=1e-12, method="DOP853", state=None, t=0.0):
        self.bearing, self.rtol, self.method = bearing, rtol, METHODS[method]
        self.t = t
        self.y = Equilibrium(bearing, t).state() if state is None else np.array(state, float)
        b = bearing  # position errors count against 1 µm, velocities against 1 mm/s
        ring = [MICRO, MICRO, 1e-3, 1e-3] * (b.n_rings // 4) + [MICRO, 1e-3] * bool(b.sensor)
        self.atol = rtol * np.array(ring + [MICRO] * b.z + [1e-3] * b.z)
        self.changes, self.steps, self.step_size = [], 0, None

    def switches(self, t, y):
        c = self.bearing.contacts_at(t, y)
        return np.concatenate([c.switch_i, c.switch_o, c.corners])

    def advance(self, stop):
        """To time `stop` exactly."""
        for knot in [*self.bearing.knots(self.t, stop), stop]:
            while self.t < knot:
                self.segment(knot)

    def solver(self, bound, first_step):
        first = min(first_step, bound - self.t) if first_step else None
        return self.method(self.bearing.rhs, self.t, self.y, bound, rtol=self.rtol, atol=self.atol, first_step=first)

    def segment(self, bound):
        """To `bound`, or to the first contact change or corner of an inner path before it."""
        solver = self.solver(bound, self.step_size)
        before = self.switches(self.t, self.y) > 0
        while solver.status == "running":
            message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"t = {solver.t}: {message}")
            self.steps += 1
            if solver.t < bound:
                self.step_size = solver.step_size
            after = self.switches(solver.t, solver.y) > 0
            if np.array_equal(after, before):
                self.t, self.y = solver.t, solver.y
                continue
            dense, changed = solver.dense_output(), np.flatnonzero(after != before)
            times = [
                brentq(
                    lambda t: self.switches(t, dense(t))[k] if t > solver.t_old else (1.0 if before[k] else -1.0),
                    solver.t_old,
                    solver.t,
                    xtol=1e-17,
                    rtol=1e-15,
                )
                for k in changed
            ]
            at, k = min(zip(times, changed))
            if k < 2 * self.bearing.z:
                side = "outer" if k >= self.bearing.z else "inner"
                self.changes.append((at, side, int(k % self.bearing.z), bool(after[k])))
            if at - self.t > SAME_EVENT and solver.t - at > SAME_EVENT:
                self.land(at)
                self.step_size = None
                # The sign may not have changed yet at the landing; past the event it has. One short step settles it.
                self.land(min(self.t + SAME_EVENT, bound))
            else:
                self.t, self.y = solver.t, solver.y
            return

    def land(self, at):
        """Steps to `at` without looking for events: the state there is a step's end, not an interpolation."""
        solver = self.solver(at, None if at - self.t > SAME_EVENT else at - self.t)
        while solver.status == "running":
            solver.step()
        assert solver.status == "finished", f"t = {solver.t}"
        self.t, self.y = solver.t, solver.y


def row(bearing, t, y):
    """Named outputs at one moment."""
    x_i, v_i, x_o, v_o, u, _ = bearing.split(t, y)
    c, dy = bearing.contacts_at(t, y), bearing.rhs(t, y)
    out = {"time": t}
    at = 0
    for name, ring, x, v, force in (("shaft", bearing.shaft, x_i, v_i, c.on_shaft()),
                                    ("housing", bearing.housing, x_o, v_o, c.on_housing())):
        out.update(zip((f"{name}.x", f"{name}.y", f"{name}.vx", f"{name}.vy"), (*x, *v)))
        if ring.motion == "internal":
            out[f"{name}.ax"], out[f"{name}.ay"] = dy[at + 2:at + 4]
            at += 4
        out[f"{name}.force.x"], out[f"{name}.force.y"] = force
    if bearing.sensor:
        out["sensor.acceleration"] = dy[bearing.n_front - 1]
    spall = bearing.spall
    if spall and spall.on == "inner":
        out["shaft.angle"], out["shaft.torque"] = bearing.alpha_i + bearing.omega_i * t, c.torque_on_shaft()
    if spall and spall.on == "element":
        j = np.flatnonzero(spall.elements)[0]
        out[f"element[{j + 1}].spin_angle"] = spall.angle_0 + (spall.omega - bearing.omega_c) * t
    for j in range(bearing.z):
        out[f"element[{j + 1}].path"] = u[j]
        out[f"element[{j + 1}].force.inner"], out[f"element[{j + 1}].force.outer"] = c.q_i[j], c.q_o[j]
    return out


def simulate(bearing, stop, step, **settings):
    """Rows at 0, step, 2 step … stop."""
    run = Reference(bearing, **settings)
    rows = [row(bearing, run.t, run.y)]
    for i in range(1, round(stop / step) + 1):
        run.advance(i * step)
        rows.append(row(bearing, run.t, run.y))
    return rows, run


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene")
    parser.add_argument("--stop", type=float, required=True)
    parser.add_argument("--step", type=float, required=True)
    parser.add_argument("-o", "--output", required=True)
    for name in ("shaft", "housing"):
        parser.add_argument(f"--{name}-motion", metavar="X0,Y0,AX,AY,HZ",
                            help="m, Hz; write it with =, minus signs confuse argparse")
    parser.add_argument("--rtol", type=float, default=1e-12)
    parser.add_argument("--method", choices=METHODS, default="DOP853")
    parser.add_argument("--check", action="store_true",
                        help="once more at ten times the tolerance; print the greatest differences")
    args = parser.parse_args()

    bearing = Bearing.load(args.scene)
    for ring, motion in ((bearing.shaft, args.shaft_motion), (bearing.housing, args.housing_motion)):
        if motion:
            motion = [float(value) for value in motion.split(",")]
            ring.centre, ring.amplitude, ring.frequency = np.array(motion[:2]), np.array(motion[2:4]), motion[4]
    rows, run = simulate(bearing, args.stop, args.step, rtol=args.rtol, method=args.method)
    with open(args.output, "w", newline="") as f:
        writer = csv.DictWriter(f, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: repr(float(v)) for k, v in r.items()} for r in rows)
    print(f"{run.steps} steps, {len(run.changes)} contact changes", file=sys.stderr)
    if args.check:
        looser, _ = simulate(bearing, args.stop, args.step, rtol=10 * args.rtol, method=args.method)
        for name in rows[0]:
            print(f"{name:28} {max(abs(a[name] - b[name]) for a, b in zip(rows, looser)):.1e}")


if __name__ == "__main__":
    main()
