"""The same contacts through slippy, Tamaas, ContactMechanics and Brinell, from one run on one core.

    cargo build --release -p brinell-analysis --example contact_case && python3 laboratory/peers/contact.py
    python3 laboratory/peers/contact.py --hertz 512

The second prints, for a sphere on so many cells each way, errors of largest pressure and force against
Hertz and the CPU time of one solution, which other work on the machine hardly lengthens.

Makes two environments of its own under target/peers (slippy needs an old NumPy) and prints, for each case, force error
against a Brinell solution at residual 1e-12, best time, and the ratio to Brinell's time at residual 1e-8. Tamaas
prescribes the force, the others the approach. Everybody gets the same number of tries, and the best counts. slippy's
kernel is wrong on cells that are not square, hence square cells only; ContactMechanics' default minimiser stagnates at
a sharp edge, `dual_minimize_proxy` does not.
"""

import json
import math
import os
import pathlib
import resource
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


def cases(sizes=(32, 64, 128), kinds=(("sphere", 1.2), ("edge", 1.3))):
    """Sphere of radius 1, E* = 1: smooth over 1.2 Hertz radii, broken by an edge over 1.3."""
    for n in sizes:
        for kind, margin in kinds:
            half = margin * APPROACH**0.5
            cell = 2 * half / n
            x = [(i + 0.5) * cell - half for i in range(n)]
            step = [0.1 if kind == "edge" and v > 0 else 0.0 for v in x]
            yield (
                f"{kind}-{n}",
                dict(
                    nx=n,
                    ny=n,
                    cell_x=cell,
                    cell_y=cell,
                    x_first_centre=x[0],
                    y_first_centre=x[0],
                    delta=APPROACH,
                    Estar=1.0,
                    hx=[v * v / 2 + s for v, s in zip(x, step)],
                    hy=[v * v / 2 for v in x],
                ),
            )


def brinell(path, *options):
    binary = ROOT / "target" / "release" / "examples" / "contact_case"
    return json.loads(subprocess.run([binary, path, *options], check=True, capture_output=True, text=True).stdout)


def cpu_seconds_of(path, repeat):
    """CPU time of one of Brinell's solutions, its setup taken off."""

    def spent(count):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        found = brinell(path, "--solver", "cg", "--repeat", str(count))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, found

    (once, _), (many, found) = spent(1), spent(repeat + 1)
    return (many - once) / repeat, found


def best(solve, repeat):
    """Least wall-clock and CPU time of `solve`, which gives force and largest pressure."""
    seconds = cpu = float("inf")
    for _ in range(repeat):
        start, cpu_start = time.perf_counter(), time.process_time()
        force, largest = solve()
        seconds, cpu = min(seconds, time.perf_counter() - start), min(cpu, time.process_time() - cpu_start)
    return dict(force=float(force), max_pressure=float(largest), seconds=seconds, cpu_seconds=cpu)


def tamaas(case, gap, force, repeat):
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
        return 0.0, model.traction.max()

    found = best(solve, repeat)
    # The force is prescribed: what can be wrong is the approach, the mean of u + h under pressure.
    sunk = np.zeros_like(model.traction)
    model.operators["free"](model.traction, sunk)
    found["force"] = float((sunk + gap)[model.traction > 0].mean())
    return found


def contact_mechanics(case, gap, method, repeat):
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
        return system.compute_normal_force(), np.abs(substrate.force).max() / (case["cell_x"] * case["cell_y"])

    return best(solve, repeat)


def slippy(case, gap, repeat):
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
        return np.sum(pressure) * case["cell_x"] * case["cell_y"], np.max(pressure)

    return best(solve, repeat)


def worker(name, path, force, repeat):
    repeat = int(repeat)
    import numpy as np
    case = json.loads(pathlib.Path(path).read_text())
    gap = np.add.outer(np.array(case["hx"]), np.array(case["hy"]))
    solve = {
        "Tamaas": lambda: tamaas(case, gap, float(force), repeat),
        "ContactMechanics": lambda: contact_mechanics(case, gap, "dual", repeat),
        "ContactMechanics, default": lambda: contact_mechanics(case, gap, "default", repeat),
        "slippy": lambda: slippy(case, gap, repeat),
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


# No BLAS or OpenMP threads: one core each.
ONE_CORE = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}


def of_peer(name, python, path, force, repeat):
    """What a peer found, or None after its error has been printed."""
    job = subprocess.run([python, __file__, "--worker", name, path, repr(force), str(repeat)], env=ONE_CORE, text=True,
                         capture_output=True, timeout=1200)
    if job.returncode:
        print(f"{path.stem:12} {name:28} failed: {job.stderr.strip().splitlines()[-1]}", flush=True)
        return None
    return json.loads(job.stdout.strip().splitlines()[-1])


def force_error(name, found, case, exact):
    # Tamaas reports the approach it found for the force: F grows as its power 3/2.
    return 1.5 * (found["force"] / case["delta"] - 1) if name == "Tamaas" else found["force"] / exact - 1


def peers():
    WORK.mkdir(parents=True, exist_ok=True)
    modern, old = environment("modern"), environment("slippy")
    return [("Tamaas", modern), ("ContactMechanics", modern), ("ContactMechanics, default", modern), ("slippy", old)]


def against_hertz(cells, repeat=3):
    """Errors against Hertz and CPU time of one solution; ContactMechanics' default minimiser is left out."""
    print(f"{'case':12} {'solver':28} {'largest pressure':>16} {'force':>9} {'CPU time / s':>13} {'ratio':>6}")
    for label, case in cases((cells,), (("sphere", 1.2),)):
        path = WORK / f"{label}.json"
        path.write_text(json.dumps(case))
        # Radius and E* are 1.
        force, largest = 4 / 3 * case["delta"] ** 1.5, 2 / math.pi * case["delta"] ** 0.5
        own, found = cpu_seconds_of(path, repeat)
        row = lambda name, pressure, error, seconds: print(
            f"{label:12} {name:28} {pressure / largest - 1:16.1e} {error:9.1e} {seconds:13.3f} {seconds / own:6.1f}",
            flush=True)
        row("Brinell", found["max_pressure_pa"], found["force_n"] / force - 1, own)
        for name, python in peers():
            if name == "ContactMechanics, default":
                continue
            if found := of_peer(name, python, path, force, repeat):
                row(name, found["max_pressure"], force_error(name, found, case, force), found["cpu_seconds"])


def main():
    print(f"{'case':12} {'solver':28} {'force error':>12} {'time / ms':>10} {'ratio':>8}")
    for label, case in cases():
        path = WORK / f"{label}.json"
        path.write_text(json.dumps(case))
        exact = brinell(path, "--solver", "cg", "--residual", "1e-12")["force_n"]
        own = brinell(path, "--repeat", str(REPEAT))
        row = lambda name, error, seconds: print(
            f"{label:12} {name:28} {error:12.1e} {seconds * 1e3:10.3f} {seconds / own['seconds']:8.1f}", flush=True)
        row(f"Brinell, {own['solver']}", own["force_n"] / exact - 1, own["seconds"])
        for name, python in peers():
            if found := of_peer(name, python, path, exact, REPEAT):
                row(name, force_error(name, found, case, exact), found["seconds"])


if __name__ == "__main__":
    if sys.argv[1:2] == ["--worker"]:
        worker(*sys.argv[2:])
    elif sys.argv[1:2] == ["--hertz"]:
        WORK.mkdir(parents=True, exist_ok=True)
        against_hertz(int(sys.argv[2]))
    else:
        WORK.mkdir(parents=True, exist_ok=True)
        main()
