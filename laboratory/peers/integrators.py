"""General-purpose integrators on equations that numba has compiled: CPU seconds per simulated second against error.

SciPy's LSODA (`odeint`), Radau, BDF and DOP853, and SUNDIALS' CVODE BDF (scikit-sundae). SciPy's Radau, BDF and DOP853
themselves are Python, the others are not. Nobody is told where contacts change: the methods meet that by their error
control, as for a user of theirs.

Errors are the rms of the housing's vertical acceleration against DOP853 at rtol 1e-12, over that of the acceleration,
and the greatest error of any element's path (m). The reference's own error, by a run at 1e-11, is printed, because
bouncing unloaded elements let any error grow exponentially with time. Time is process CPU time of the fastest repeat,
compilation excluded.
"""

import argparse
import csv
import math
import pathlib
import time
import tomllib

import numba
import numpy as np
from scipy.integrate import odeint, solve_ivp
from scipy.optimize import brentq
from scipy.special import ellipe, ellipkm1
from sksundae.cvode import CVODE


def hertz_constant(curvature_rolling, curvature_axial, e_star):
    """K of Q = K δ^1.5 of an elliptical contact, exact; Johnson (1985) eqs. 4.25-4.28 with 1 - e² = (b/a)²."""
    small, large = sorted((curvature_rolling / 2, curvature_axial / 2))  # A and B of z = A x² + B y²

    def ratio_error(log_k):
        m1 = np.exp(2 * log_k)
        k_int, e_int = ellipkm1(m1), ellipe(1 - m1)
        return np.log((e_int / m1 - k_int) / (k_int - e_int)) - np.log(large / small)

    m1 = np.exp(2 * brentq(ratio_error, np.log(1e-6), np.log(0.9999), xtol=1e-15, rtol=1e-15))
    e2, k_int, e_int = 1 - m1, ellipkm1(m1), ellipe(1 - m1)
    return 2 * np.pi * e_star / (3 * k_int) * np.sqrt((k_int - e_int) / (small * e2 * k_int))


def compile_jacobian(rhs, scale):
    """The Jacobian by one-sided differences as machine code: jac(t, y, J)."""
    steps = 1e-5 * scale

    @numba.njit
    def jac(t, y, j):
        base, moved, x = np.empty(len(y)), np.empty(len(y)), y.copy()
        rhs(t, y, base)
        for i in range(len(y)):
            x[i] = y[i] + steps[i]
            rhs(t, x, moved)
            x[i] = y[i]
            j[:, i] = (moved - base) / steps[i]

    return jac


class Problem:
    """A compiled right-hand side `fill(t, y, dy)`, its start, what errors of a state count against, the place of the
    housing's vertical velocity in a state, and those of the elements' paths."""

    def __init__(self, fill, y0, scale, velocity, paths):
        self.fill, self.y0, self.scale, self.velocity, self.paths = fill, y0, scale, velocity, paths
        self.fill_jacobian = compile_jacobian(fill, scale)
        self.jacobian(0.0, y0)

    def compare(self, stop, step):
        self.times = np.arange(round(stop / step) + 1) * step
        self.reference = self.scipy("DOP853", 1e-12)
        return self.errors(self.scipy("DOP853", 1e-11))

    def rhs(self, t, y):
        dy = np.empty(len(y))
        self.fill(t, y, dy)
        return dy

    def jacobian(self, t, y):
        j = np.empty((len(y), len(y)))
        self.fill_jacobian(t, y, j)
        return j

    def errors(self, rows):
        """Of the acceleration and of the paths; of a run that did not reach the end, NaN."""
        if rows.shape != self.reference.shape or not np.all(np.isfinite(rows)):
            return math.nan, math.nan
        a, exact = (np.array([self.rhs(t, y)[self.velocity] for t, y in zip(self.times, of)])
                    for of in (rows, self.reference))
        path = np.abs(rows - self.reference)[:, self.paths].max()
        return np.sqrt(np.mean((a - exact) ** 2) / np.mean(exact**2)), path

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


def fastest(problem, peer, rtol, repeat):
    """CPU seconds and rows."""
    best = math.inf
    for _ in range(repeat):
        start = time.process_time()
        rows = PEERS[peer](problem, rtol)
        best = min(best, time.process_time() - start)
    return best, rows


def main(description, problem_of, tolerances):
    """The command line of both kinds of equations; `problem_of` a scene."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", type=pathlib.Path)
    parser.add_argument("--stop", type=float, default=0.02)
    parser.add_argument("--step", type=float, default=1e-5)
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--peers", nargs="*", choices=PEERS, default=["LSODA", "CVODE BDF"])
    parser.add_argument("--csv")
    args = parser.parse_args()

    table = []
    for path in args.scenes:
        problem = problem_of(tomllib.loads(path.read_text(encoding="utf-8")))
        own = problem.compare(args.stop, args.step)
        print("{}, {} s: reference's own error {:.1e}, path {:.1e} m".format(path.stem, args.stop, *own), flush=True)
        print("at the start", *problem.y0[problem.paths], "m")
        for peer in args.peers:
            PEERS[peer](problem, tolerances[0])  # the compiler's time, once per kind of array
            for rtol in tolerances:
                seconds, rows = fastest(problem, peer, rtol, args.repeat)
                acceleration, path_error = problem.errors(rows)
                table.append({"scene": path.stem, "peer": peer, "rtol": rtol, "cpu_s_per_s": seconds / args.stop,
                              "acceleration_error": acceleration, "path_error_m": path_error})
                print(f"  {peer:10} rtol {rtol:.0e}: {seconds / args.stop:8.2f} s/s, "
                      f"error {acceleration:.1e}, path {path_error:.1e} m", flush=True)
    if args.csv:
        with open(args.csv, "w", newline="") as f:
            writer = csv.DictWriter(f, table[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(table)
