#!/usr/bin/env python3
"""Which communication step? Error of the coupled motion over the step, for three hosts, as Markdown.

    python examples/coupling_error.py [--short]

Hosts: a mass of 3 kg on one bearing, the rigid rotor of step_by_step.py, the ROSS rotor as brinell.ross steps it, and
as ROSS itself does. The error is that of the shaft's position in the bearing, rms over rms of its motion, against the
same host with two passes and a fine step. A spall magnifies small differences: the FMU's tolerance is 1e-8 here, so
that the coupling's error is seen alone.
"""

import argparse
import contextlib
import copy
import io
from pathlib import Path

import numpy as np
import step_by_step
from bearing import Bearing, percent
from brinell.ross import Coupled, ross, simulate
from rotor_ross import BEARING, fmus_in, shown

SPEED = 2 * np.pi * 30.0
TOLERANCE = 1e-8
MASS, DAMPING, LOAD = 3.0, 1376.8, 500.0  # the plain host: kg, N s/m, N


def plain(fmu, h, stop, passes=1, hold=False):
    """A mass on the bearing, below its load and unbalance; with `hold`, inputs and force stand still over a step."""
    bearing = Bearing(fmu, start={"shaft.speed": SPEED, "solver.tolerance": TOLERANCE})
    q = bearing.rest([0.0, -LOAD])
    v, force = np.zeros(2), bearing.force_at(q)
    bearing.run()
    masses, resist = MASS * np.eye(2), DAMPING * np.eye(2)

    def load(t):
        rise = np.clip(t * SPEED / (2 * np.pi), 0.0, 1.0)
        return 50.0 * rise**2 * (3 - 2 * rise) * np.array([np.cos(SPEED * t), np.sin(SPEED * t)]) - [0.0, LOAD]

    positions = [q[1]]
    for count in range(round(stop / h)):
        t = count * h
        if hold:
            v = v + h / MASS * (force + load(t) - DAMPING * v)
            q = q + h * v
            force = bearing.advance(q, (0, 0), (0, 0), h)[1]
        else:
            loads = load(t), load(t + 0.5 * h), load(t + h)
            q, v, force = step_by_step.one_step([bearing], masses, resist, loads, (q, v, force), h, passes)
        check(q, t)
        positions.append(q[1])
    bearing.close()
    return np.array(positions)


def rigid(fmus, h, stop, passes):
    return step_by_step.simulate(fmus, h, passes, stop, tolerance=TOLERANCE)[:, 4]


def by_matrices(fmu, h, stop, passes):
    rotor, loads, forces = shown()
    how = {"loads": loads, "forces": forces, "passes": passes, "tolerance": TOLERANCE}
    return simulate(rotor, {BEARING: fmu}, SPEED, stop, h, **how).at(BEARING)[:, 1]


def by_ross(fmu, h, stop, stand_in=True):
    """ROSS's own integrate_system(add_to_RHS=…). It asks once per step, with the last accepted state, and starts from
    zeros; the force at the end of the step belongs to its equation."""
    rotor, loads, forces = shown()
    with Coupled(rotor, {BEARING: fmu}, loads, SPEED, TOLERANCE) as coupled:
        coupled.stiffness *= stand_in
        coupled.damping *= stand_in
        parts = rotor.shaft_elements, rotor.disk_elements, rotor.bearing_elements
        named = {f"{kind}{a}{b}": of[i, j] for kind, of in (("k", coupled.stiffness), ("c", coupled.damping))
                 for i, a in enumerate("xy") for j, b in enumerate("xy")}  # fmt: skip
        shaft, disks, bearings = (copy.deepcopy(list(part)) for part in parts)  # ROSS writes into its elements
        rotor = ross.Rotor(shaft, disks, [*bearings, ross.BearingElement(n=BEARING, **named)])
        t = h * np.arange(round(stop / h) + 1)
        force, at = np.zeros((len(t), rotor.ndof)), lambda n: slice(rotor.number_dof * n, rotor.number_dof * n + 2)
        for n, drive in forces.items():
            force[:, at(n)] += drive(t, SPEED * t, SPEED, 0.0).T
        given = []

        # ROSS 3 tells `args` besides, and gives a third value at the end.
        def beyond(step, time_step, disp_resp, velc_resp, **_):
            given.append(disp_resp[at(BEARING)].copy())
            out = np.zeros(rotor.ndof)
            # ROSS's acceleration of a light node rings from step to step: straight on is safer.
            told = disp_resp[at(BEARING)], velc_resp[at(BEARING)], np.zeros(2)
            out[at(BEARING)] = coupled.tell(*told, None, time_step)[1]
            if not np.all(np.abs(out) < 1e6):
                raise RuntimeError(f"unstable at {step * time_step:.4g} s")
            return out

        with contextlib.redirect_stdout(io.StringIO()):
            motion = rotor.integrate_system(SPEED, force, t, add_to_RHS=beyond)[1][:, at(BEARING)]
    if len(given) != len(t) - 1 or not np.array_equal(given, motion[:-1]):
        raise ValueError("ROSS asked not once per step, or with another state than the last accepted one")
    return motion[:, 1]


def check(q, t):
    if not np.all(np.abs(q) < 1e-2):
        raise RuntimeError(f"unstable at {t:.4g} s")


def hosts(healthy, fmu):
    """Names, and functions of step and end that give the shaft's position in the bearing `fmu`."""
    return {
        "3 kg, all held": lambda h, stop: plain(fmu, h, stop, hold=True),
        "3 kg, 1 pass": lambda h, stop: plain(fmu, h, stop, 1),
        "3 kg, 2 passes": lambda h, stop: plain(fmu, h, stop, 2),
        "rigid rotor, 1 pass": lambda h, stop: rigid((healthy, fmu), h, stop, 1),
        "rigid rotor, 2 passes": lambda h, stop: rigid((healthy, fmu), h, stop, 2),
        "ROSS, no stand-in": lambda h, stop: by_ross(fmu, h, stop, stand_in=False),
        "ROSS": lambda h, stop: by_ross(fmu, h, stop),
        "ROSS matrices, 1 pass": lambda h, stop: by_matrices(fmu, h, stop, 1),
        "ROSS matrices, 2 passes": lambda h, stop: by_matrices(fmu, h, stop, 2),
    }


REFERENCE = {"3 kg": "3 kg, 2 passes", "rigid": "rigid rotor, 2 passes", "ROSS": "ROSS matrices, 2 passes"}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--short", action="store_true", help="two steps, 10 ms")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    options = parser.parse_args()
    healthy, spalled = fmus_in(options.output)
    steps = (1e-5, 1e-4) if options.short else (1e-5, 2e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3)
    stop, fine = (0.01, 5e-6) if options.short else (0.05, 2.5e-6)
    print("| bearing | host | " + " | ".join(f"{h * 1e6:g} µs" for h in steps) + " | 1 % up to |")
    print("|---|---|" + "---|" * (len(steps) + 1))
    for name, fmu in (("healthy", healthy), ("spalled", spalled)):
        all_hosts = hosts(healthy, fmu)
        references = {first: all_hosts[host](fine, stop) for first, host in REFERENCE.items()}
        for host, run in all_hosts.items():
            expected = next(reference for first, reference in references.items() if host.startswith(first))
            cells, good = [], "–"
            for h in steps:
                try:
                    found = run(h, stop)
                except (RuntimeError, FloatingPointError):
                    cells.append("unstable")
                    continue
                there = expected[:: round(h / fine)]
                error = np.sqrt(np.mean((found[: len(there)] - there) ** 2)) / there.std()
                cells.append(percent(error))
                if error <= 0.01 and len(cells) == steps.index(h) + 1 and "unstable" not in cells:
                    good = f"{h * 1e6:g} µs"
            print(f"| {name} | {host} | " + " | ".join(cells) + f" | {good} |", flush=True)


if __name__ == "__main__":
    main()
