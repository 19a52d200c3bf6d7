#!/usr/bin/env python3
"""Where the run time goes: processor time of one communication step in the FMU, in fmpy and ctypes, in the rest of
Python.

    python examples/step_cost.py [--steps 2000]

The three calls of a step (set inputs, step, get outputs) are timed at the C interface, with the processor time of this
thread. fmpy's and ctypes' share is that of calls that do nothing; the cost of the clock is taken off. Markdown.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import step_by_step
from bearing import Bearing
from ross_bearings import exact, with_ross
from rotor_ross import fmus_in, shown

SPEED = 2 * np.pi * 30.0


class Watch:
    """Looks on while bearings are stepped: one row [ns] per doStep of when it began, the time in FMUs and the calls so
    far."""

    def __init__(self):
        self.rows, self.inside, self.calls, self.original = [], 0, 0, Bearing.__init__

    def __enter__(self):
        def watched(bearing, *arguments, **named):
            self.original(bearing, *arguments, **named)
            functions = bearing.slave._functions
            for name in ("fmi2SetReal", "fmi2DoStep", "fmi2GetReal", "fmi2GetFMUstate", "fmi2SetFMUstate"):
                functions[name] = self.timed(functions[name], name == "fmi2DoStep")

        Bearing.__init__ = watched
        return self

    def __exit__(self, *_):
        Bearing.__init__ = self.original

    def timed(self, function, is_step):
        def call(*arguments):
            begin = time.thread_time_ns()
            if is_step:
                self.rows.append((begin, self.inside, self.calls))
            status = function(*arguments)
            self.inside += time.thread_time_ns() - begin
            self.calls += 1
            return status

        # fmpy looks at these.
        call.restype, call.argtypes, call.argnames = function.restype, function.argtypes, function.argnames
        return call


def mean_time(function, *arguments):
    """Of one call [µs]."""
    begin = time.thread_time_ns()
    for _ in range(20000):
        function(*arguments)
    return (time.thread_time_ns() - begin) / 20000 / 1e3


def cost(run, count, idle):
    """Per step [µs]: whole, FMU, fmpy and ctypes, Python. `run` makes a number of steps."""
    ctypes_call, fmpy_call, clock = idle
    with Watch() as watch:
        run(count)
    # The first tenth is left out: there things are made and compiled.
    rows = np.array(watch.rows[len(watch.rows) // 10 :])
    per_step = len(watch.rows) // count  # calls of doStep: of several instances or passes
    whole, inside, calls = np.diff(rows[::per_step], axis=0).T * [[1e-3], [1e-3], [1.0]]
    calls = np.median(calls)
    # The clock is read twice around each call: half of its cost is inside. Outside all steps are alike, so that their
    # median leaves out what the machine did in between; inside they are not.
    outside = np.median(whole - inside) + (ctypes_call - clock) * calls
    inside = np.mean(inside) - (ctypes_call + clock) * calls
    return inside + outside, inside, fmpy_call * calls, outside - fmpy_call * calls


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=2000)
    parser.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    options = parser.parse_args()
    machine = shown()
    healthy, spalled = fmus_in(options.output)
    bearing = Bearing(spalled)
    nothing = bearing.slave.component, None, 0, None
    idle = (
        mean_time(bearing.slave._functions["fmi2GetReal"], *nothing),
        mean_time(bearing.slave.fmi2GetReal, *nothing),
        mean_time(time.thread_time_ns),
    )
    bearing.close()
    print("| host | step | whole | FMU | fmpy and ctypes | rest of Python |")
    print("|---|---|---|---|---|---|")
    for h in (2e-5, 1e-4):
        for host, run in {
            "rigid rotor, 2 FMUs, 1 pass": lambda n: step_by_step.simulate((healthy, spalled), h, 1, n * h),
            "ROSS matrices, 1 pass": lambda n: exact(machine, [spalled], SPEED, h, n * h),
            "ROSS matrices, 2 passes": lambda n: exact(machine, [spalled], SPEED, h, n * h, 2),
            "ROSS": lambda n: with_ross(machine, [spalled], SPEED, h, n * h),
        }.items():
            whole, *parts = cost(run, options.steps, idle)
            shares = " | ".join(f"{part:.1f} µs ({100 * part / whole:.0f} %)" for part in parts)
            print(f"| {host} | {h * 1e6:g} µs | {whole:.0f} µs | {shares} |", flush=True)


if __name__ == "__main__":
    main()
