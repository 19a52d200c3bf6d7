"""Forces of the extreme cases in tests/extremes/cases.toml, integrated independently: tests/extremes/oracle.csv.

    python tests/oracle/extremes.py [PART OF A CASE'S NAME]

DOP853 at a relative tolerance of 1e-12 on the equations of bearing.py, landing on edges and contact changes. Each case
runs once more at 1e-10; the column `own_error` is the largest difference of any force over the largest force. With a
name, only such cases are computed anew and the others kept.
"""

import csv
import math
import pathlib
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np
from bearing import Bearing, tomllib
from equilibrium import Equilibrium
from reference import Reference, row

HERE = pathlib.Path(__file__).resolve().parent
TABLE = HERE.parent / "extremes" / "oracle.csv"
NAMES = ["shaft.force.x", "shaft.force.y", "housing.force.y", "element[1].force.outer", "element[2].force.inner"]
SAMPLES = 10  # instants of a case


class Ramping(Bearing):
    """A cage whose speed grows evenly from `start`, past no defect."""

    start, slope = 0.0, 0.0

    def angles(self, t):
        return self.theta0 + (self.start + 0.5 * self.slope * t) * t + 2 * np.pi * np.arange(self.z) / self.z

    def contacts_at(self, t, y):
        self.omega_c = self.start + self.slope * t
        return super().contacts_at(t, y)

    def rhs(self, t, y):
        self.omega_c = self.start + self.slope * t
        return super().rhs(t, y)


class Shaken(Bearing):
    """A load on the shaft that goes up and down as a cosine."""

    amplitude, frequency = 0.0, 0.0

    def rhs(self, t, y):
        self.shaft.load = np.array([0.0, self.amplitude * math.cos(2 * math.pi * self.frequency * t)])
        return super().rhs(t, y)


def scene_of(case):
    with open(HERE.parents[1] / "scenes" / f"{case['scene']}.toml", "rb") as file:
        scene = tomllib.load(file)
    for key in case.get("remove", []):
        *table, name = key.split(".")
        del (scene[table[0]] if table else scene)[name]
    for key, value in case.get("set", {}).items():
        table, name = key.split(".")
        scene[table][name] = value
    return scene


def bearing_of(case):
    scene = scene_of(case)
    if "ramp" in case:
        bearing = Ramping(scene)
        speed = 2 * math.pi * scene["shaft"]["speed_hz"]
        bearing.start, bearing.slope = bearing.omega_c, bearing.omega_c / speed * case["ramp"]
    elif "cosine_load" in case:
        bearing = Shaken(scene)
        bearing.amplitude, bearing.frequency = case["cosine_load"]
    else:
        bearing = Bearing(scene)
    if "start" in case:
        bearing.shaft.centre = np.array([0.0, case["start"]["shaft.y"]])
    return bearing


def change(bearing, later, t):
    """What the host does at one instant; the cage goes on from where it is."""
    if "shaft.y" in later:
        bearing.shaft.centre = np.array([0.0, later["shaft.y"]])
    if "shaft.speed" in later:
        ratio = later["shaft.speed"] / (2 * math.pi * 25.0)
        bearing.theta0 += bearing.omega_c * t * (1 - ratio)
        bearing.omega_c *= ratio


def start(bearing):
    """State at rest. Where Newton's method ends at a kink, an element just touching, it begins again beside it."""
    found = Equilibrium(bearing)
    for aside in (1e-5, -1e-5, 3e-5, -3e-5, 6e-5, -6e-5):
        if found.error < 1e-10:
            break
        guess = np.array(found.x)
        guess[0] += aside
        found = Equilibrium(bearing, start=guess)
    assert found.error < 1e-10, f"no equilibrium: {found.error:.1e} of the load is left"
    return found.state()


def forces(case, rtol):
    bearing, later = bearing_of(case), case.get("later")
    run, found = Reference(bearing, rtol=rtol, state=start(bearing)), []
    for k in range(1, SAMPLES + 1):
        step = k * case["steps"] // SAMPLES
        t = step * case["step_s"]
        if later and t > later["time_s"]:
            run.advance(later["time_s"])
            change(bearing, later, run.t)
            run.step_size, later = None, None
        run.advance(t)
        at = row(bearing, run.t, run.y)
        found.append((step, [at[name] for name in NAMES]))
    return found


def rows(case):
    """Lines of the table."""
    exact, looser = forces(case, 1e-12), forces(case, 1e-10)
    largest = max(abs(f) for _, at in exact for f in at)
    own = max(abs(a - b) for (_, at), (_, by) in zip(exact, looser) for a, b in zip(at, by)) / largest
    print(f"{case['what']}: {largest:.4e} N, own error {own:.1e}", flush=True)
    return [{"what": case["what"], "step": step, **{name: f"{value:.9e}" for name, value in zip(NAMES, at)},
             "own_error": f"{own:.1e}"} for step, at in exact]


def main():
    wanted = sys.argv[1] if len(sys.argv) > 1 else ""
    with open(HERE.parent / "extremes" / "cases.toml", "rb") as file:
        cases = [case for case in tomllib.load(file)["case"] if "reference" not in case]  # others have the other method
    kept = {}
    if wanted:
        with open(TABLE, encoding="utf-8") as file:
            for line in csv.DictReader(file):
                kept.setdefault(line["what"], []).append(line)
    with ProcessPoolExecutor() as pool, open(TABLE, "w", newline="", encoding="utf-8") as file:
        anew = {
            case["what"]: pool.submit(rows, case)
            for case in cases
            if wanted in case["what"] or case["what"] not in kept
        }
        writer = csv.DictWriter(file, ["what", "step", *NAMES, "own_error"], lineterminator="\n")
        writer.writeheader()
        for case in cases:
            what = case["what"]
            writer.writerows(anew[what].result() if what in anew else kept[what])
            file.flush()


if __name__ == "__main__":
    main()
