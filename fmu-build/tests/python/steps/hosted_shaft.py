"""The motion of a shaft that moves itself, prescribed to a bearing whose shaft is the host's, gives the same forces.

The first FMU has both rings internal. The second is the same bearing with the shaft moved by the host, who sets
position, velocity and acceleration before each step; inside the step the FMU goes on with them. What it goes on with
is wrong by a'·h³/6 at most, here some 7e-15 m, and the solver at tolerance 1e-9 is wrong by 1e-14 m of a path of 10 µm.
At the bearing's 1e8 N/m either is about 1e-6 N; a hundred times that is left for what builds up in 24000 steps.
Element 1 enters the defect at 5 ms and flies freely from 5.6 ms on; the run ends before it strikes the trailing edge.
"""

import sys

import numpy as np

from host import started

STEP, COUNT = 5e-7, 24000
MOTION = ["shaft.x", "shaft.y", "shaft.vx", "shaft.vy", "shaft.ax", "shaft.ay"]
SEEN = ["shaft.force.x", "shaft.force.y", "housing.y", "element[1].path", "element[1].force.outer"]

own = started(sys.argv[1], {"solver.tolerance": 1e-9})
motion, expected = [own.read(MOTION)], [own.read(SEEN)]
for _ in range(COUNT):
    own.step(STEP)
    motion.append(own.read(MOTION))
    expected.append(own.read(SEEN))
own.close()

start = dict(zip(MOTION, motion[0]))
start.update({"housing.load.x": 0.0, "housing.load.y": 0.0, "solver.tolerance": 1e-9})
hosted = started(sys.argv[2], start)
seen = [hosted.read(SEEN)]
for count in range(COUNT):
    hosted.write(MOTION, motion[count])
    hosted.step(STEP)
    # The force now follows from the position now, which the host knows after its own step.
    hosted.write(MOTION, motion[count + 1])
    seen.append(hosted.read(SEEN))
hosted.close()

passed = abs(np.array(expected)[:, SEEN.index("element[1].force.outer")]).min()
assert passed == 0.0, f"element 1 was never unloaded: least outer force {passed} N"
difference = np.abs(np.array(seen) - np.array(expected)).max(axis=0)
for name, found in zip(SEEN, difference):
    limit = 1e-4 if "force" in name else 1e-12  # N; m, the force's limit over 1e8 N/m
    assert found <= limit, f"{name}: {found} off, more than {limit}"
