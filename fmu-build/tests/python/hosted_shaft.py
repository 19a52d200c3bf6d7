"""The motion of a shaft that moves itself, prescribed to a bearing whose shaft is the host's, gives the same forces.

The first FMU has both rings internal. The second is the same bearing with the shaft moved by the host, who sets
position, velocity and acceleration before each step; inside the step the FMU goes on with them. What it goes on with
is wrong by a'·h³/6 in position at most; with a' from the recorded acceleration's differences and the stiffness of the
bearing that bounds the error of the force. A solver tolerance of 1e-9 keeps the solver out of the comparison.
"""

import sys

import numpy as np

from host import Host

STEP, COUNT = 5e-7, 24000
MOTION = ["shaft.x", "shaft.y", "shaft.vx", "shaft.vy", "shaft.ax", "shaft.ay"]
SEEN = ["shaft.force.x", "shaft.force.y", "housing.y", "element[1].path", "element[1].force.outer"]

own = Host(sys.argv[1], start={"solver.tolerance": 1e-9})
motion, expected = [own.read(MOTION)], [own.read(SEEN)]
for _ in range(COUNT):
    own.step(STEP)
    motion.append(own.read(MOTION))
    expected.append(own.read(SEEN))
own.close()

start = dict(zip(MOTION, motion[0]))
start.update({"housing.load.x": 0.0, "housing.load.y": 0.0, "solver.tolerance": 1e-9})
hosted = Host(sys.argv[2], start=start)
seen = [hosted.read(SEEN)]
for count in range(COUNT):
    hosted.write(MOTION, motion[count])
    hosted.step(STEP)
    # The force now follows from the place now, which the host knows after its own step.
    hosted.write(MOTION, motion[count + 1])
    seen.append(hosted.read(SEEN))
hosted.close()

difference = np.abs(np.array(seen) - np.array(expected))
acceleration = np.array(motion)[:, 4:]
jerk = np.abs(np.diff(acceleration, axis=0)).max() / STEP
position = jerk * STEP**3 / 6
print("largest differences", dict(zip(SEEN, difference.max(axis=0))), "position within a step", position)
