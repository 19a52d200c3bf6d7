"""General-purpose integrators on the same equations: CPU seconds per simulated second against error.

    python laboratory/peers/integration.py SCENE.toml … [--stop 0.04] [--step 1e-5] [--repeat 3] [--csv peers.csv]

SciPy's LSODA (`odeint`), Radau, BDF and DOP853, and SUNDIALS' CVODE BDF (scikit-sundae). Right-hand side and Jacobian
(one-sided differences) are compiled by numba; SciPy's Radau, BDF and DOP853 themselves are Python, the others are not.
Nobody is told where contacts change: the methods meet that by their error control, as for a user of theirs.

Errors are against DOP853 at rtol 1e-12 stopping at each contact change (tests/oracle), whose own error is measured by a
second run at 1e-11 and printed, because bouncing unloaded elements let any error grow exponentially with time:
  acceleration  rms of the housing's vertical acceleration error / rms of that acceleration
  path          greatest error of any element's path, m
Time is process CPU time of the fastest repeat, compilation excluded.
"""

import argparse
import csv
import math
import pathlib
import sys
import time

import numba
import numpy as np
from scipy.integrate import odeint, solve_ivp
from sksundae.cvode import CVODE

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "oracle"))
from bearing import Bearing, Point
from reference import Reference

TOLERANCES = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8]


def compile_inner(b):
    """Contact of an element and the inner ring as machine code: inner(c, s, u, u_dot, x, y, vx, vy), the last four of
    the outer ring's centre against the inner ring's. Force, direction times length (x and y), length."""
    rho0, clearance, k_i, chi, omega = b.rho0, b.clearance, b.growth_i.constant, b.chi, b.omega_c

    @numba.njit
    def inner(c, s, u, u_dot, x, y, vx, vy):
        sx, sy = x + u * c, y + u * s
        qx, qy = rho0 * c + sx, rho0 * s + sy
        length = math.sqrt(qx * qx + qy * qy)
        depth = -clearance - (2 * rho0 * (c * sx + s * sy) + sx * sx + sy * sy) / (rho0 + length)
        if depth > 0:
            approach = qx * (vx + u_dot * c) + qy * (vy + u_dot * s)
            rate = -(approach + (rho0 + u) * omega * (c * sy - s * sx)) / length
            return k_i * depth * math.sqrt(depth) * max(0.0, 1 + chi * rate), qx, qy, length
        return 0.0, qx, qy, length

    return inner


def compile_path(b):
    """The rigid path over the spall as machine code: path(theta), P and dP/dψ."""
    if b.spall is None:
        return numba.njit(lambda theta: (0.0, 0.0))
    shape, middle, r, r_o, tau = b.spall.paths["outer"], b.spall.middle, b.r, b.r_o, 2 * math.pi
    half, depth, roll_in = shape.half_length, shape.depth, shape.roll_in

    @numba.njit
    def path(theta):
        psi = -((middle - theta + math.pi) % tau) + math.pi
        d = half - abs(psi)
        if d >= roll_in:
            return depth, 0.0
        if d > 0:
            cd, sd = math.cos(d), math.sin(d)
            root = math.sqrt(r * r - (r_o * sd) ** 2)
            p = -2 * r_o * math.sin(d / 2) ** 2 + (r_o * sd) ** 2 / (r + root)
            return p, -math.copysign(1.0, psi) * (-r_o * sd + r_o**2 * sd * cd / root)
        return 0.0, 0.0

    return path


def compile_outer(b):
    """Contact of an element and the outer ring as machine code: outer(theta, u, u_dot), the force's radial and
    tangential part."""
    rho0, k_o, chi, omega, path = b.rho0, b.growth_o.constant, b.chi, b.omega_c, compile_path(b)

    @numba.njit
    def outer(theta, u, u_dot):
        p, slope = path(theta)
        depth = u - p
        if depth > 0:
            tan = slope / (rho0 + u)
            damping = max(0.0, 1 + chi * (u_dot - slope * omega))
            radial = k_o * depth * math.sqrt(depth) * damping / math.sqrt(1 + tan * tan)
            return radial, radial * tan
        return 0.0, 0.0

    return outer


def compile_rings(b):
    """Motion of both rings and of the sensor as machine code: rings(y, shx, shy, hox, hoy, dy) under the contacts'
    forces on shaft and housing."""
    m_s, c_s, k_s = b.shaft.mass, b.shaft.damping, b.shaft.stiffness
    m_h, c_h, k_h = b.housing.mass, b.housing.damping, b.housing.stiffness
    fsx, fsy, fhx, fhy = *b.shaft.load, *b.housing.load
    n_r, sensor, (m_r, k_r, c_r) = b.n_rings, bool(b.sensor), b.sensor or (1.0, 0.0, 0.0)

    @numba.njit
    def rings(y, shx, shy, hox, hoy, dy):
        dy[0], dy[1], dy[4], dy[5] = y[2], y[3], y[6], y[7]
        dy[2] = (shx + fsx - c_s * y[2] - k_s * y[0]) / m_s
        dy[3] = (shy + fsy - c_s * y[3] - k_s * y[1]) / m_s
        resonator = 0.0
        if sensor:
            resonator = k_r * (y[n_r] - y[5]) + c_r * (y[n_r + 1] - y[7])
            dy[n_r], dy[n_r + 1] = y[n_r + 1], -resonator / m_r
        dy[6] = (hox + fhx - c_h * y[6] - k_h * y[4]) / m_h
        dy[7] = (hoy + fhy - c_h * y[7] - k_h * y[5] + resonator) / m_h

    return rings


def compile_rhs(b):
    """The right-hand side of one scene as machine code: rhs(t, y, dy). Rings internal, Hunt-Crossley."""
    assert b.n_rings == 8 and b.law == "hunt-crossley", "both rings internal, Hunt-Crossley damping"
    assert isinstance(b.growth_i, Point), "balls"
    assert b.spall is None or (b.spall.on == "outer" and b.spall.omega == 0), "a spall of a standing outer ring"
    z, n_f, m, rho0, omega, theta0, gx, gy = b.z, b.n_front, b.mass, b.rho0, b.omega_c, b.theta0, *b.gravity
    inner, outer, rings, tau = compile_inner(b), compile_outer(b), compile_rings(b), 2 * math.pi

    @numba.njit
    def rhs(t, y, dy):
        shx = shy = hox = hoy = 0.0
        v_ox, v_oy = y[6], y[7]
        for j in range(z):
            theta = theta0 + omega * t + tau * j / z
            c, s = math.cos(theta), math.sin(theta)
            u, w = y[n_f + j], y[n_f + z + j]
            u_dot = w - c * v_ox - s * v_oy
            q_i, qx, qy, length = inner(c, s, u, u_dot, y[4] - y[0], y[5] - y[1], v_ox - y[2], v_oy - y[3])
            radial, tangential = outer(theta, u, u_dot)
            shx -= q_i * qx / length
            shy -= q_i * qy / length
            hox += c * radial + s * tangential
            hoy += s * radial - c * tangential
            push = (q_i * (qx * c + qy * s) / length - radial) / m + gx * c + gy * s
            dy[n_f + j] = u_dot
            dy[n_f + z + j] = push + omega * (c * v_oy - s * v_ox + (rho0 + u) * omega)
        rings(y, shx, shy, hox, hoy, dy)

    return rhs


def compile_jacobian(b, rhs):
    """The Jacobian of a compiled right-hand side by one-sided differences, as machine code: jac(t, y, J)."""
    z, n_r, n_f, n, sensor = b.z, b.n_rings, b.n_front, b.n_front + 2 * b.z, bool(b.sensor)

    @numba.njit
    def jac(t, y, j):
        base, moved, x = np.empty(n), np.empty(n), y.copy()
        rhs(t, y, base)
        for k in range(n):
            velocity = k in (2, 3, 6, 7) or (sensor and k == n_r + 1) or k >= n_f + z
            step = 1e-7 if velocity else 1e-11
            x[k] = y[k] + step
            rhs(t, x, moved)
            x[k] = y[k]
            j[:, k] = (moved - base) / step

    return jac


class Problem:
    """One scene: compiled equations, start, sample times, reference solution."""

    def __init__(self, path, stop, step):
        self.bearing = b = Bearing.load(path)
        self.name, self.stop = pathlib.Path(path).stem, stop
        self.times = np.arange(round(stop / step) + 1) * step
        self.fill = compile_rhs(b)
        self.fill_jacobian = compile_jacobian(b, self.fill)
        self.y0 = Reference(b).y
        self.n = len(self.y0)
        self.scale = Reference(b).atol / Reference(b).rtol
        self.compare_with_numpy()
        b.rhs = self.rhs
        self.reference, loose = self.solve_reference(1e-12), self.solve_reference(1e-11)
        self.own_error = self.errors(loose)

    def rhs(self, t, y):
        dy = np.empty(self.n)
        self.fill(t, y, dy)
        return dy

    def jacobian(self, t, y):
        j = np.empty((self.n, self.n))
        self.fill_jacobian(t, y, j)
        return j

    def compare_with_numpy(self):
        """The compiled equations are those of tests/oracle, element by element, or there is nothing to compare."""
        random = np.random.default_rng(1)
        for t in random.uniform(0, self.stop, 200):
            y = self.y0 + random.normal(0, 10, self.n) * self.scale
            expected, got = self.bearing.rhs(t, y), self.rhs(t, y)
            np.testing.assert_allclose(got, expected, rtol=1e-9, atol=1e-9)  # rounding of forces up to 1e3 N on 2 g
        self.jacobian(0.0, self.y0)

    def solve_reference(self, rtol):
        run, rows = Reference(self.bearing, rtol=rtol), []
        for t in self.times:
            run.advance(t)
            rows.append(run.y)
        return np.array(rows)

    def acceleration(self, rows):
        return np.array([self.rhs(t, y)[7] for t, y in zip(self.times, rows)])

    def errors(self, rows):
        a, exact = self.acceleration(rows), self.acceleration(self.reference)
        paths = slice(self.bearing.n_front, self.bearing.n_front + self.bearing.z)
        return (np.sqrt(np.mean((a - exact) ** 2) / np.mean(exact**2)), np.abs(rows - self.reference)[:, paths].max())

    # --- the peers: rows at self.times ---------------------------------------------------------------------------
    def scipy(self, method, rtol):
        extra = {} if method == "DOP853" else {"jac": self.jacobian}
        span = (0.0, self.times[-1])
        return solve_ivp(self.rhs, span, self.y0, method, self.times, rtol=rtol, atol=rtol * self.scale, **extra).y.T

    def lsoda(self, rtol):
        return odeint(self.rhs, self.y0, self.times, Dfun=self.jacobian, tfirst=True,
                      rtol=rtol, atol=rtol * self.scale, mxstep=10**7)

    def cvode(self, rtol):
        solver = CVODE(lambda t, y, dy: self.fill(t, y, dy), jacfn=lambda t, y, dy, j: self.fill_jacobian(t, y, j),
                       rtol=rtol, atol=rtol * self.scale, max_num_steps=10**7)
        return solver.solve(self.times, self.y0).y


PEERS = {
    "LSODA": Problem.lsoda,
    "CVODE BDF": Problem.cvode,
    "Radau": lambda p, rtol: p.scipy("Radau", rtol),
    "BDF": lambda p, rtol: p.scipy("BDF", rtol),
    "DOP853": lambda p, rtol: p.scipy("DOP853", rtol),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--stop", type=float, default=0.04)
    parser.add_argument("--step", type=float, default=1e-5)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--peers", nargs="*", choices=PEERS, default=list(PEERS))
    parser.add_argument("--csv")
    args = parser.parse_args()

    table = []
    for path in args.scenes:
        problem = Problem(path, args.stop, args.step)
        print(
            "{}, {} s: reference's own error {:.1e}, path {:.1e} m".format(problem.name, args.stop, *problem.own_error)
        )
        for peer in args.peers:
            PEERS[peer](problem, TOLERANCES[0])  # the compiler's time, once per kind of array
            for rtol in TOLERANCES:
                best = math.inf
                for _ in range(args.repeat):
                    start = time.process_time()
                    rows = PEERS[peer](problem, rtol)
                    best = min(best, time.process_time() - start)
                finished = rows.shape == problem.reference.shape and np.all(np.isfinite(rows))
                acceleration, path_error = problem.errors(rows) if finished else (math.nan, math.nan)
                table.append({"scene": problem.name, "peer": peer, "rtol": rtol, "cpu_s_per_s": best / args.stop,
                              "acceleration_error": acceleration, "path_error_m": path_error})
                print(f"  {peer:10} rtol {rtol:.0e}: {best / args.stop:8.2f} s/s, "
                      f"error {acceleration:.1e}, path {path_error:.1e} m", flush=True)
    if args.csv:
        with open(args.csv, "w", newline="") as f:
            writer = csv.DictWriter(f, table[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(table)


if __name__ == "__main__":
    main()
