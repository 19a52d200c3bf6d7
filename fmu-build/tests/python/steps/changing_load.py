"""A load that changes with each step, set by hand: at every communication point Newton's law holds on the shaft.

m a = F_load + F_bearing − c v − k x (a ring's weight is part of its load). All terms are outputs, inputs or parameters
of the FMU, so the balance is exact up to rounding: 1e-12 of the largest term, with three digits to spare for five
terms.
"""

import math
import sys

from host import started

STEP = 5e-5
host = started(sys.argv[1])
mass, damping, stiffness = host.read(["shaft.mass", "shaft.damping", "shaft.stiffness"])
loads = ["shaft.load.x", "shaft.load.y"]
lowest = highest = -host.read(["shaft.force.y"])[0]
for count in range(600):
    load = [80.0 * math.sin(0.05 * count), -500.0 - 300.0 * math.sin(0.11 * count)]
    host.write(loads, load)
    host.step(STEP)
    for axis, applied in zip("xy", load):
        names = [f"shaft.{name}" for name in (axis, f"v{axis}", f"a{axis}", f"force.{axis}")]
        x, v, a, force = host.read(names)
        terms = [applied, force, -damping * v, -stiffness * x, -mass * a]
        rest, largest = abs(sum(terms)), max(map(abs, terms))
        assert rest <= 1e-12 * largest, f"{axis} at {host.time} s: {rest} N of {largest} N are left over: {terms}"
    lowest, highest = min(lowest, -force), max(highest, -force)
# The load goes through 300 N both ways; a bearing that did not notice would stay near 500 N.
assert lowest < -700.0 and highest < 0.0, f"the bearing carried {lowest} … {highest} N"
host.close()
