"""The same contacts through slippy, Tamaas, ContactMechanics and Brinell, from one run on one core.

    cargo build --release --example contact_case && python3 benches/peers/contact.py

Makes two environments of its own under target/peers (slippy needs an old NumPy) and prints, for each case, force error against a
Brinell solution at residual 1e-12, best time, and the ratio to Brinell's time at residual 1e-8. Tamaas prescribes the force, the others the
approach. Everybody gets the same number of tries, and the best counts. slippy's kernel is wrong on cells that are not square, hence square cells only; ContactMechanics' default minimiser
stagnates at a sharp edge, `dual_minimize_proxy` does not.
"""

import json
import os
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / "target" / "peers"
PINS = {
    "modern": ["numpy==2.4.6", "scipy==1.17.1", "tamaas==2.9.0", "ContactMechanics==1.8.3"],
    "slippy": ["numpy==1.24.4", "scipy==1.10.1", "numba==0.57.1", "matplotlib==3.7.5", "sympy==1.12", "tinydb==4.8.0",
               "scikit-image==0.21.0", "pyfftw==0.13.1"],
}
REPEAT = 10
APPROACH = 0.01


def cases():
    """Sphere of radius 1, E* = 1: smooth over 1.2 Hertz radii, broken by an edge over 1.3."""
    for n in (32, 64, 128):
        for kind, margin in (("sphere", 1.2), ("edge", 1.3)):
            half = margin * APPROACH**0.5
            cell = 2 * half / n
            x = [(i + 0.5) * cell - half for i in range(n)]
            step = [0.1 if kind == "edge" and v > 0 else 0.0 for v in x]
            yield f"{kind}-{n}", dict(
                nx=n, ny=n, cell_x=cell, cell_y=cell, x_first_centre=x[0], y_first_centre=x[0], delta=APPROACH, Estar=1.0,
                hx=[v * v / 2 + s for v, s in zip(x, step)], hy=[v * v / 2 for v in x])


def brinell(path, *options):
    binary = ROOT / "target" / "release" / "examples" / "contact_case"
    return json.loads(subprocess.run([binary, path, *options], check=True, capture_output=True, text=True).stdout)


def best(solve):
    seconds, force = float("inf"), None
    for _ in range(REPEAT):
        start = time.perf_counter()
        force = solve()
        seconds = min(seconds, time.perf_counter() - start)
    return dict(force=float(force), seconds=seconds)


def tamaas(case, gap, force):
    import numpy as np
    import tamaas as tm
    tm.set_log_level(tm.LogLevel.error)
    size = [case["nx"] * case["cell_x"], case["ny"] * case["cell_y"]]
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, size, [case["nx"], case["ny"]])
    model.E, model.nu = 1.0, 0.0
    tm.ModelFactory.registerNonPeriodic(model, "free")

    def solve():
        model.traction[:] = 0
        solver = tm.PolonskyKeerRey(model, -gap, 1e-9)
        solver.setIntegralOperator("free")
        solver.max_iter = 5000
        solver.solve(force / (size[0] * size[1]))
        return 0.0

    found = best(solve)
    # The force is prescribed: what can be wrong is the approach, the mean of u + h under pressure.
    sunk = np.zeros_like(model.traction)
    model.operators["free"](model.traction, sunk)
    found["force"] = float((sunk + gap)[model.traction > 0].mean())
    return found


def contact_mechanics(case, gap, method):
    import numpy as np
    from ContactMechanics import FreeFFTElasticHalfSpace
    from ContactMechanics.Systems import NonSmoothContactSystem
    from SurfaceTopography import Topography
    size = (case["nx"] * case["cell_x"], case["ny"] * case["cell_y"])
    substrate = FreeFFTElasticHalfSpace((case["nx"], case["ny"]), 1.0, size)
    system = NonSmoothContactSystem(substrate, Topography(-gap, size))

    def solve():
        if method == "dual":
            start = np.zeros(substrate.nb_grid_pts)
            system.dual_minimize_proxy(offset=case["delta"], init_force=start, gtol=1e-12)
        else:
            system.minimize_proxy(offset=case["delta"], pentol=1e-8 * case["delta"], maxiter=2000)
        return system.compute_normal_force()

    return best(solve)


def slippy(case, gap):
    import numpy as np
    import slippy as package
    package.CUDA = False
    from slippy.core import bccg, elastic_influence_matrix_spatial, plan_convolve
    n, m = case["nx"], case["ny"]
    # E* = E/(1 − ν²) = 1 with ν = 0, E = 1, G = 1/2
    influence = elastic_influence_matrix_spatial("zz", (2 * n, 2 * m), (case["cell_x"], case["cell_y"]), 0.5, 0.0)
    g = case["delta"] - gap
    domain = g > 0
    convolve = plan_convolve(g, influence, domain=domain, fft_im=False)

    def solve():
        pressure, _ = bccg(convolve, g[domain], 1e-8 * case["delta"], 2000, np.zeros(domain.sum()))
        return np.sum(pressure) * case["cell_x"] * case["cell_y"]

    return best(solve)


def worker(name, path, force):
    import numpy as np
    case = json.loads(pathlib.Path(path).read_text())
    gap = np.add.outer(np.array(case["hx"]), np.array(case["hy"]))
    solve = {
        "Tamaas": lambda: tamaas(case, gap, float(force)),
        "ContactMechanics": lambda: contact_mechanics(case, gap, "dual"),
        "ContactMechanics, default": lambda: contact_mechanics(case, gap, "default"),
        "slippy": lambda: slippy(case, gap),
    }
    print(json.dumps(solve[name]()))


def environment(name):
    python = WORK / name / "bin" / "python"
    ready = WORK / name / "ready"
    if not ready.exists():
        subprocess.run([sys.executable, "-m", "venv", WORK / name], check=True)
        pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        subprocess.run([*pip, *PINS[name]], check=True)
        if name == "slippy":
            # Its own pins exclude every NumPy that has a wheel for a current Python.
            subprocess.run([*pip, "--no-deps", "slippy==0.5.2"], check=True)
        ready.touch()
    return python


def main():
    WORK.mkdir(parents=True, exist_ok=True)
    modern, old = environment("modern"), environment("slippy")
    peers = [("Tamaas", modern), ("ContactMechanics", modern), ("ContactMechanics, default", modern), ("slippy", old)]
    # No BLAS or OpenMP threads: one core each.
    one_core = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    print(f"{'case':12} {'solver':28} {'force error':>12} {'time / ms':>10} {'ratio':>8}")
    for label, case in cases():
        path = WORK / f"{label}.json"
        path.write_text(json.dumps(case))
        exact = brinell(path, "--solver", "cg", "--residual", "1e-12")["force_n"]
        own = brinell(path, "--repeat", str(REPEAT))
        row = lambda name, error, seconds: print(
            f"{label:12} {name:28} {error:12.1e} {seconds * 1e3:10.3f} {seconds / own['seconds']:8.1f}", flush=True)
        row(f"Brinell, {own['solver']}", own["force_n"] / exact - 1, own["seconds"])
        for name, python in peers:
            job = subprocess.run([python, __file__, "--worker", name, path, repr(exact)], env=one_core, text=True,
                                 capture_output=True, timeout=600)
            if job.returncode:
                print(f"{label:12} {name:28} failed: {job.stderr.strip().splitlines()[-1]}", flush=True)
                continue
            found = json.loads(job.stdout.strip().splitlines()[-1])
            # Tamaas reports the approach it found for the force: F grows as its power 3/2.
            error = 1.5 * (found["force"] / case["delta"] - 1) if name == "Tamaas" else found["force"] / exact - 1
            row(name, error, found["seconds"])


if __name__ == "__main__":
    if sys.argv[1:2] == ["--worker"]:
        worker(*sys.argv[2:])
    else:
        main()
