"""CPU seconds per simulated second of a nine-ball bearing in Exudyn, a general multibody program: for orientation only.

    python benches/peers/exudyn_bearing.py [--steps 1e-4 1e-5] [--stop 0.1]

Needs `exudyn` (1.13.6) and `numpy`, in an environment of their own.

The bearing has the size, load and speed of scenes/6205-healthy.toml and Exudyn's own parts: balls and cage as rigid
bodies with six degrees of freedom each, friction, grooves as tori, the outer ring fixed. Contacts are linear with the
stiffness that Hertz's have under this load, and the bearing is preloaded by 5 µm: with Hertz's exponent, or where
contacts open, its Newton iteration does not converge at these steps. Ours has a kinematic cage, balls that move
radially, Hertz's contacts, clearance and a moving outer ring. The two do not compute the same, and there is no error to
compare at; what stands here is what a user of a general program waits. The step of Exudyn's own bearing example is 1e-4
s.
"""

import argparse
import math
import time

import exudyn as exu
import numpy as np
from exudyn.machines import CreateBallBearing, GetBallBearingData
from exudyn.utilities import InertiaCylinder, MarkerBodyRigid, RigidBodyInertia, SensorBody

BALLS, DIAMETER, PITCH, CLEARANCE, CONFORMITY = 9, 7.94e-3, 39.04e-3, -5e-6, 0.52
MASS, LOAD, SPEED, DENSITY = 3.2638, 1500.0, 2 * math.pi * 25.0, 7800.0
STIFFNESS = 5e7  # N/m: Hertz's tangent at 10 µm
DAMPING = 50.0  # N s/m: the example's


def bearing():
    system = exu.SystemContainer()
    mbs = system.AddSystem()
    ground = mbs.CreateGround()
    gravity = [0.0, -9.81, 0.0]
    inertia = RigidBodyInertia(mass=MASS, inertiaTensor=np.diag([2e-3, 2e-3, 1e-3]))
    shaft = mbs.CreateRigidBody(referencePosition=[0, 0, 0], nodeType=exu.NodeType.RotationRxyz, inertia=inertia,
                                initialAngularVelocity=[0, 0, SPEED], gravity=gravity)
    # The shaft turns evenly about an axis that does not tilt, and does not move along it.
    for coordinate, offset in ((2, 0.0), (3, 0.0), (4, 0.0), (5, SPEED)):
        mbs.CreateCoordinateConstraint(itemNumbers=[shaft, None], coordinates=[coordinate, None],
                                       velocityLevel=coordinate == 5, offset=offset, show=False)
    mbs.CreateForce(itemNumber=shaft, loadVector=[0, -LOAD, 0])
    data = GetBallBearingData([0, 0, 1], 52e-3, 25e-3, 15e-3, BALLS, radiusBalls=DIAMETER / 2, radiusCage=PITCH / 2,
                              innerGrooveRadius=CONFORMITY * DIAMETER, outerGrooveRadius=CONFORMITY * DIAMETER,
                              innerRingShoulderRadius=PITCH / 2 - 1.2e-3, outerRingShoulderRadius=PITCH / 2 + 1.2e-3)
    # Half the clearance on either side of the balls' centres.
    data["innerGrooveTorusRadius"] = PITCH / 2 - CLEARANCE / 4 + (CONFORMITY - 0.5) * DIAMETER
    data["outerGrooveTorusRadius"] = PITCH / 2 + CLEARANCE / 4 - (CONFORMITY - 0.5) * DIAMETER
    cage = 0.5 * SPEED * (1 - DIAMETER / PITCH)
    contact = {"contactStiffness": STIFFNESS, "contactDamping": DAMPING, "dynamicFriction": 0.1,
               "contactStiffnessExponent": 1, "frictionProportionalZone": 1e-2}
    inner = mbs.AddMarker(MarkerBodyRigid(bodyNumber=shaft))
    outer = mbs.AddMarker(MarkerBodyRigid(bodyNumber=ground))
    spin = -cage * (PITCH / DIAMETER)
    CreateBallBearing(mbs, data, inner, outer, DENSITY, DENSITY, cageInitialAngularVelocity=[0, 0, cage],
                      ballsInitialAngularVelocity=[0, 0, spin], gravity=gravity, springStiffnessCage=1e5,
                      springDampingCage=1e2, contactParametersRingBalls=contact)
    position = mbs.AddSensor(SensorBody(bodyNumber=shaft, storeInternal=True,
                                        outputVariableType=exu.OutputVariableType.Position))
    mbs.Assemble()
    return mbs, position


def run(step, stop):
    mbs, position = bearing()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = step
    settings.timeIntegration.numberOfSteps = round(stop / step)
    settings.timeIntegration.endTime = stop
    settings.timeIntegration.verboseMode = 0
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    settings.parallel.numberOfThreads = 1
    start = time.process_time()
    mbs.SolveDynamic(settings)
    seconds = time.process_time() - start
    rows = mbs.GetSensorStoredData(position)
    late = rows[len(rows) // 2:, 2]
    return seconds / stop, late.mean(), late.std()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=float, nargs="+", default=[1e-4, 1e-5])
    parser.add_argument("--stop", type=float, default=0.1)
    args = parser.parse_args()
    print(f"exudyn {exu.config.Version()}")
    for step in args.steps:
        cost, mean, spread = run(step, args.stop)
        print(
            f"step {step:.0e} s: {cost:.2f} CPU s/s; shaft at {1e6 * mean:.2f} µm, {1e6 * spread:.2f} µm rms about it"
        )


if __name__ == "__main__":
    main()
