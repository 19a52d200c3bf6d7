"""Another rotor than the examples' own, in one bearing and in two: it rests where statics say, and stays there.

Arguments: the folder of the examples, a folder for the FMUs.
"""

import sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import numpy as np  # noqa: E402
import rotor_ross  # noqa: E402
from ross_bearings import GRAVITY, Coupled, Machine, ross, simulate, unbalance  # noqa: E402

LENGTH, COUNT, BEARING, DISK = 0.1, 4, 1, 2  # four elements of 0.1 m; the other bearing is at the far end


def rotor(*bearings):
    steel = ross.Material("steel", rho=7810, E=211e9, G_s=81.2e9)
    elements = [ross.ShaftElement(L=LENGTH, idl=0.0, odl=0.05, material=steel, beta=5e-6) for _ in range(COUNT)]
    disks = [ross.DiskElement.from_geometry(n=DISK, material=steel, width=0.02, i_d=0.05, o_d=0.2)]
    return ross.Rotor(elements, disks, list(bearings))


healthy, spalled = rotor_ross.fmus_in(Path(sys.argv[2]))
speed = 2 * np.pi * 20.0
pressed = {BEARING: (0.0, -200.0)}
# Moments about the far bearing: the shaft's weight in its middle, the disk, and what presses the shaft down.
shaft = 7810 * np.pi / 4 * 0.05**2 * LENGTH * COUNT
disk = 7810 * np.pi / 4 * (0.2**2 - 0.05**2) * 0.02
arm = LENGTH * (COUNT - BEARING)
near = (GRAVITY * (shaft * LENGTH * COUNT / 2 + disk * LENGTH * (COUNT - DISK)) + 200.0 * arm) / arm
far = GRAVITY * (shaft + disk) + 200.0 - near

held = rotor(ross.BearingElement(n=COUNT, kxx=1e8, cxx=200.0, kzz=1e6))
coupled = Coupled(Machine(held, (BEARING,), pressed), [healthy], speed)
load = coupled.load
coupled.close()
# Two springs under a rotor: statics alone say what each carries. 1e-5: the one that stands in is 1e9 N/m.
assert abs(load[1] + near) < 1e-5 * near and abs(load[0]) < 1e-6, (load, near)
run = simulate(held, [BEARING], [healthy], speed, 2e-3, loads=pressed, seen=["shaft.force.y"])
assert run.motion.shape == (len(run.time), 4 * (COUNT + 1)) and len(run.time) == 41
# Without unbalance nothing moves it but the varying compliance: well below the approach of some 10 µm.
assert np.abs(run.at(BEARING)).max() < 2e-6, np.abs(run.at(BEARING)).max()
assert abs(run.outputs[0]["shaft.force.y"][0] - near) < 1e-6 * near

# In two FMUs, no other bearing: the far one rests on the rest of the weight.
free = rotor()
coupled = Coupled(Machine(free, (BEARING, COUNT), pressed), [healthy, healthy], speed)
both = coupled.load
coupled.close()
assert np.abs(both - [0.0, -near, 0.0, -far]).max() < 1e-5 * near, (both, near, far)
two = simulate(free, [BEARING, COUNT], [healthy, healthy], speed, 2e-3, loads=pressed, seen=["shaft.force.y"])
for node, output, weight in ((BEARING, two.outputs[0], near), (COUNT, two.outputs[1], far)):
    assert abs(output["shaft.force.y"][0] - weight) < 1e-6 * near, (node, output["shaft.force.y"][0], weight)
    assert np.abs(two.at(node)).max() < 2e-6, (node, np.abs(two.at(node)).max())

# Bearings are told apart: in the other order all is the same, in that order; the spalled one is felt where it is.
forces = {DISK: unbalance(1e-4)}
there, back = (
    simulate(free, nodes, fmus, speed, 4e-3, loads=pressed, forces=forces)
    for nodes, fmus in (((BEARING, COUNT), (spalled, healthy)), ((COUNT, BEARING), (healthy, spalled)))
)
size = np.abs(there.motion).max()
assert np.abs(there.motion - back.motion).max() < 1e-6 * size
assert np.abs(there.outputs[0]["housing.ay"] - back.outputs[1]["housing.ay"]).max() < 1e-6 * np.abs(
    there.outputs[0]["housing.ay"]
).max()
# ROSS itself integrates it to the same motion: by steps of 10 µs 7e-5 apart.
by_ross, ours = (
    simulate(free, [BEARING, COUNT], [healthy, healthy], speed, 4e-3, 1e-5, loads=pressed, forces=forces, host=host)
    for host in ("ross", "exact")
)
apart = np.abs(by_ross.at(COUNT) - ours.at(COUNT)).max() / np.abs(ours.at(COUNT)).max()
assert apart < 1e-3, apart

for nodes, fmus, host, words in (
    ([BEARING, 9], [healthy, healthy], "exact", "a bearing at node 9: the shaft has nodes 0 to 4"),
    ([BEARING, BEARING], [healthy, healthy], "exact", "each at a node of its own"),
    ([BEARING], [healthy, healthy], "exact", "2 scenes for 1 nodes"),
    ([BEARING], [healthy], "newmark", "exact or ross"),
):
    try:
        simulate(free, nodes, fmus, speed, 1e-3, host=host)
    except ValueError as error:
        assert words in str(error), error
    else:
        raise AssertionError(words)
print(f"rests on {near:.3f} N and {far:.3f} N; ROSS's own integration within {100 * apart:.2g} %")
