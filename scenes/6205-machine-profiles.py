"""Writes the profiles of 6205-spall-5deg-machine, the spall of its outer raceway and the lobes of its inner one, and of
6205-inner-5deg-machine, the spall of its inner raceway.

None was measured. Their figures were fitted to what recordings of one machine with spalls of nominally 5 degrees show
at 10 and 20 Hz, see docs/explanation/signals.md and docs/evidence/signals-inside.md. The spalls' edges are rounded: depth
grows with a power of the way, so that an element sinks without a jerk and strikes where it meets the flat floor. The
outer one is 6.4 degrees long at the surface, 4.5 at half its depth, the inner one 6.2 and 4.0. The inner raceway has
three lobes, as rings held in a chuck of three jaws get them: depth A (1 - cos 3 phi) over 89 % of its circumference (a
profile must leave a tenth free), which is where phi goes once round.

    python3 scenes/6205-machine-profiles.py spall > scenes/6205-machine-spall.csv
    python3 scenes/6205-machine-profiles.py inner > scenes/6205-machine-spall-inner.csv
    python3 scenes/6205-machine-profiles.py lobes > scenes/6205-machine-lobes.csv
"""

import math
import sys

OUTER_RADIUS_MM = 23.4925  # 6205 with 5 um of clearance: (39.04 + 7.94 + 0.005)/2
INNER_RADIUS_MM = 15.5475
SPALL_STEP_MM = 0.008  # a tenth of a contact's length
LOBES = 3  # of the scatter that repeats with the shaft, recordings show most three times a turn
LOBE_AMPLITUDE_UM = 1.2  # fitted: scatter of passages
LOBE_SHARE = 0.89  # of the circumference
LOBE_POINTS = 30  # a chord is off the cosine by 6 % of the amplitude


def spall(radius, depth, power, leading, floor, trailing):
    """Points (arc in mm, depth in um) in the sense in which elements pass, 0 in the middle of the floor.

    Radius in mm, depth in um; ways over the leading edge, the floor and the trailing edge in degrees.
    """
    leading, floor, trailing = (way * math.pi / 180 * radius for way in (leading, floor, trailing))
    ways = lambda length: [SPALL_STEP_MM * k for k in range(math.ceil(length / SPALL_STEP_MM))]  # noqa: E731
    sinking = [(-floor / 2 - leading + way, depth * (way / leading) ** power) for way in ways(leading)]
    rising = [(floor / 2 + trailing - way, depth * (way / trailing) ** power) for way in reversed(ways(trailing))]
    return [*sinking, (-floor / 2, depth), (floor / 2, depth), *rising]


def outer():
    """The floor reaches from first to last impact in recordings; the rest is fitted."""
    return spall(OUTER_RADIUS_MM, depth=7.5, power=2.6, leading=1.42, floor=3.9, trailing=1.1)


def inner():
    """Likewise. Elements cross it backwards: the shaft turns faster than the cage."""
    passed = spall(INNER_RADIUS_MM, depth=16.5, power=3.5, leading=2.2, floor=3.56, trailing=0.42)
    return [(-arc, depth) for arc, depth in reversed(passed)]


def lobes():
    """Points over most of the inner raceway."""
    length = 2 * math.pi * INNER_RADIUS_MM * LOBE_SHARE
    shares = [k / LOBE_POINTS for k in range(LOBE_POINTS + 1)]
    depth = lambda share: LOBE_AMPLITUDE_UM * (1 - math.cos(2 * math.pi * LOBES * share))  # noqa: E731
    return [(length * (share - 0.5), depth(share)) for share in shares]


print("# Fitted, not measured: written by 6205-machine-profiles.py, which says how.")
print("arc_mm,depth_um")
for arc, depth in {"spall": outer, "inner": inner, "lobes": lobes}[sys.argv[1]]():
    print(f"{arc:.4f},{abs(depth):.4f}")
