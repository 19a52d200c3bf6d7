"""Another rotor than the examples' own, with the bearing elsewhere: it rests where statics say, and stays there.

Arguments: the folder of the examples, a folder for the FMUs.
"""

import sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import numpy as np  # noqa: E402
import rotor_ross  # noqa: E402
from rotor_ross import GRAVITY, Coupled, Machine, exact, ross  # noqa: E402

LENGTH, COUNT, BEARING, DISK = 0.1, 4, 1, 2  # four elements of 0.1 m; the other bearing is at the far end


def parts():
    steel = ross.Material("steel", rho=7810, E=211e9, G_s=81.2e9)
    elements = [ross.ShaftElement(L=LENGTH, idl=0.0, odl=0.05, material=steel, beta=5e-6) for _ in range(COUNT)]
    disks = [ross.DiskElement.from_geometry(n=DISK, material=steel, width=0.02, i_d=0.05, o_d=0.2)]
    return elements, disks, [ross.BearingElement(n=COUNT, kxx=1e8, cxx=200.0, kzz=1e6)]


machine = Machine(
    parts, nodes=COUNT + 1, disk=DISK, bearing=BEARING, pressed=(0.0, -200.0), eccentric=0.0,
    housing={"mass": 6.638, "damping": 2210.7, "stiffness": 1.51056e7},
)
healthy, _ = rotor_ross.fmus_in(Path(sys.argv[2]))
speed = 2 * np.pi * 20.0
coupled = Coupled(machine, healthy, speed)
load = coupled.load
coupled.fmu.close()
# Moments about the far bearing: the shaft's weight in its middle, the disk, and what presses the shaft down.
shaft = 7810 * np.pi / 4 * 0.05**2 * LENGTH * COUNT
disk = 7810 * np.pi / 4 * (0.2**2 - 0.05**2) * 0.02
arm = LENGTH * (COUNT - BEARING)
moment = GRAVITY * (shaft * LENGTH * COUNT / 2 + disk * LENGTH * (COUNT - DISK)) + 200.0 * arm
# Two springs under a rotor: statics alone say what each carries. 1e-5: the one that stands in is 1e9 N/m.
assert abs(load[1] + moment / arm) < 1e-5 * moment / arm and abs(load[0]) < 1e-6, (load, moment / arm)
t, motion, outputs = exact(machine, healthy, speed, 5e-5, 2e-3, 2, ["shaft.force.y"])
assert motion.shape == (len(t), 4 * machine.nodes) and len(t) == 41
# Without unbalance nothing moves it but the varying compliance: well below the approach of some 10 µm.
assert np.abs(motion[:, 4 * BEARING : 4 * BEARING + 2]).max() < 2e-6, np.abs(motion).max()
assert abs(outputs[0, 0] + load[1]) < 1e-6 * abs(load[1]), (outputs[0], load)
print(f"rests on {-load[1]:.3f} N")
