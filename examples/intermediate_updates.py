#!/usr/bin/env python3
"""A rotor that is advanced inside the bearing's communication steps, in FMI 3.0's intermediate updates.

    python examples/intermediate_updates.py [--step 1e-4] [--stop 0.02] [-o target/examples]

The bearing calls back after each step of its own solver, some microseconds. There the host reads the force, moves its
rotor on to that instant, and sets position, velocity and acceleration, which act from there on. So the communication
step may be as long as anything else allows. Bearing and rotor are those of `system_of_fmus.py`, as is the error: rms of
the rotor's position over rms of its way, against one FMU that holds mass and spring.
"""

import argparse
import json
import time
from pathlib import Path

import fmpy
import numpy as np
from bearing import build, unzipped
from fmpy.fmi3 import FMU3Slave
from system_of_fmus import GRID, LOAD, MASS, STIFFNESS, fmus_in, whole_run

MOTION = [f"shaft.{q}" for q in ("x", "y", "vx", "vy", "ax", "ay")]
FORCE = ["shaft.force.x", "shaft.force.y"]


class Host:
    """The rotor, and the bearing's FMU that moves it on."""

    def __init__(self, fmu, start):
        description = fmpy.read_model_description(fmu)
        references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.motion, self.read = ([references[name] for name in names] for names in (MOTION, FORCE))
        self.fmu = FMU3Slave(
            guid=description.guid,
            unzipDirectory=unzipped(fmu),
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="bearing",
        )
        self.fmu.instantiate(
            intermediateUpdate=self.update, requiredIntermediateVariables=[*self.motion, *self.read]
        )
        self.t, self.x, self.v, self.updates = 0.0, np.array(start), np.zeros(2), 0
        self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.setFloat64(self.motion[:2], list(start))
        self.force = np.array(self.fmu.getFloat64(self.read))
        self.fmu.exitInitializationMode()
        self.tell()

    def acceleration(self, force, x):
        return (force + [0.0, -LOAD] - STIFFNESS * x) / MASS

    def tell(self):
        self.fmu.setFloat64(self.motion, [*self.x, *self.v, *self.acceleration(self.force, self.x)])

    def update(self, _, t, may_set, may_get, step_finished, can_return, early, early_time):
        """To `t`, under a force that goes straight from what it was to what it is: exact to the third order."""
        if not (may_set and may_get and t > self.t):
            return
        force, h = np.array(self.fmu.getFloat64(self.read)), t - self.t
        a0 = self.acceleration(self.force, self.x)
        a1 = self.acceleration(force, self.x + h * self.v + h * h / 2 * a0)
        self.x, self.v = self.x + h * self.v + h * h / 6 * (2 * a0 + a1), self.v + h / 2 * (a0 + a1)
        self.t, self.force, self.updates = t, force, self.updates + 1
        self.tell()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--step", type=float, default=GRID, help="communication step [s]")
    parser.add_argument("--stop", type=float, default=0.02, help="end [s]")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    options = parser.parse_args()
    for (name, _), (bearing, inside) in fmus_in(options.output, ["free"]).items():
        exact = whole_run(inside, options.stop)
        fmu = build([bearing.with_suffix(".toml")], options.output / "fmi3", "--fmi", "3")[0]
        host = Host(fmu, exact[0])
        positions, begin, count = [host.x], time.perf_counter(), round(options.stop / options.step)
        for step in range(count):
            host.fmu.doStep(step * options.step, options.step)
            # A communication point is an update as well.
            positions.append(host.x)
        took = time.perf_counter() - begin
        host.fmu.freeInstance()
        there = exact[:: round(options.step / GRID)] if options.step >= GRID else exact
        found = np.array(positions)[:: max(1, round(GRID / options.step))]
        apart = np.sqrt(np.mean(np.sum((found - there) ** 2, axis=1)))
        way = np.sqrt(np.mean(np.sum((there - there[0]) ** 2, axis=1)))
        said = {"bearing": name, "step_s": options.step, "error": apart / way, "updates": host.updates, "run_s": took}
        print(json.dumps(said), flush=True)


if __name__ == "__main__":
    main()
