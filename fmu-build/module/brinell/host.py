"""FMUs of bearings in a host of one's own: variables by name, over fmpy, and a bearing whose shaft the host moves.

    from brinell.host import Bearing
    bearing = Bearing(fmu)
    position = bearing.rest([0.0, -500.0])
    bearing.run()
    mean_force, force = bearing.advance(position, (0.0, 0.0), (0.0, 0.0), 1e-4)

SI units; y up; angles counter-clockwise from +x; ``force`` is the bearing's force on the ring it is named after.
"""

import atexit
import collections
import functools
import os
import shutil
from ctypes import POINTER, byref, c_double, c_uint

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE, fmi2FMUstate
from fmpy.logging import addLoggerProxy


def unzipped(fmu):
    """The FMU's files, unpacked once for this process and removed at its end."""
    return unzipped_of(str(fmu), os.stat(fmu).st_mtime_ns)


@functools.cache
def unzipped_of(fmu, _changed):
    folder = fmpy.extract(fmu)
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


# The last things that the FMUs said. One list for all instances: fmpy has one logger for the whole process.
SAID = collections.deque(maxlen=2)
HEAR = fmi2CallbackLoggerTYPE(lambda _, __, ___, ____, message: SAID.append(message.decode()))


def what_was_said(error):
    said = "; ".join(SAID) or str(error)
    SAID.clear()
    return said


class Instance:
    """One instance of an FMU, its variables by name. An error carries what the FMU said about it."""

    def __init__(self, fmu, name="bearing"):
        fmu = str(fmu)
        self.description = fmpy.read_model_description(fmu)
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}
        self.inputs = {v.name for v in self.description.modelVariables if v.causality == "input"}
        self.units = {v.name: v.unit for v in self.description.modelVariables}
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = HEAR
        callbacks.allocateMemory, callbacks.freeMemory = defaultCallbacks.allocateMemory, defaultCallbacks.freeMemory
        # Fills in the variable arguments of the FMU's messages, which Python cannot.
        addLoggerProxy(byref(callbacks))
        self.unit = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=unzipped(fmu),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=name,
        )
        self.kept, self.name = callbacks, name
        self.unit.instantiate(callbacks=callbacks)
        # Without this an error would say no more than its status.
        self.unit.setDebugLogging(True, ["logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal"])
        self.time = 0.0
        self.state = fmi2FMUstate()

    def enter(self, start=None):
        """Sets parameters and start values and goes into initialization mode."""
        for name, value in (start or {}).items():
            if isinstance(value, str):
                self.call(self.unit.setString, [self.reference[name]], [value])
            else:
                self.write([name], [value])
        self.call(self.unit.setupExperiment, startTime=0.0)
        self.call(self.unit.enterInitializationMode)

    def run(self):
        """Ends initialization; steps may follow."""
        self.call(self.unit.exitInitializationMode)
        self.time = 0.0

    def call(self, function, *arguments, **named):
        try:
            return function(*arguments, **named)
        except FMICallException as error:
            raise RuntimeError(f"{function.__name__} at {self.time:.9g} s: {what_was_said(error)}") from None

    def read(self, names):
        return np.array(self.call(self.unit.getReal, [self.reference[name] for name in names]))

    def write(self, names, values):
        self.call(self.unit.setReal, [self.reference[name] for name in names], [float(value) for value in values])

    def step(self, length):
        self.call(self.unit.doStep, self.time, length)
        self.time += length

    def save(self):
        """Takes the FMU's state, over the one taken before."""
        self.call(self.unit.fmi2GetFMUstate, self.unit.component, byref(self.state))
        self.saved_time = self.time

    def restore(self):
        """Goes back to the state taken last."""
        self.call(self.unit.fmi2SetFMUstate, self.unit.component, self.state)
        self.time = self.saved_time

    def close(self):
        self.unit.freeInstance()


def started(fmu, start=None, name="bearing"):
    """An instance that has gone through its initialization with these start values; steps may follow."""
    instance = Instance(fmu, name)
    instance.enter(start)
    instance.run()
    return instance


class Numbers:
    """Some variables, with an array that the C interface reads or fills in place: no conversion in each step."""

    def __init__(self, instance, names):
        self.array = np.zeros(len(names))
        references = (c_uint * len(names))(*(instance.reference[name] for name in names))
        self.arguments = instance.unit.component, references, len(names), self.array.ctypes.data_as(POINTER(c_double))


def named(kind, axis):
    """Name of the shaft's variable along x, y, z, about x or about y: `force` and `tilt.x` make `shaft.moment.x`."""
    if kind.endswith("force"):
        return f"shaft.{kind.replace('force', 'moment') if '.' in axis else kind}.{axis[-1]}"
    return f"shaft.{axis[:-1]}{kind}{axis[-1]}"


class Bearing(Instance):
    """A bearing whose shaft the host moves. Vectors are arrays of x and y; of x, y and z with three degrees of freedom;
    of these and the tilts about x and y with five, along which what acts is a moment.

    No load stands on its housing unless `start` names one: the host's shaft says what the bearing carries.
    """

    def __init__(self, fmu, name="bearing", start=None):
        super().__init__(fmu, name)
        if "shaft.x" not in self.inputs:
            self.close()
            raise ValueError(f'{name}: a host moves no shaft of this scene; it needs motion = "host" in [shaft]')
        self.axes = [axis for axis in ("x", "y", "z", "tilt.x", "tilt.y") if f"shaft.{axis}" in self.inputs]
        self.motion = Numbers(self, [named(order, axis) for order in ("", "v", "a") for axis in self.axes])
        short = [axis.replace(".", "_") for axis in self.axes]
        pairs = [f"{a}{b}" if len(a + b) == 2 else f"{a}_{b}" for a in short for b in short]
        self.tangent = Numbers(self, [f"shaft.stiffness.{pair}" for pair in pairs])
        self.forces = Numbers(self, [named(kind, axis) for kind in ("mean_force", "force") for axis in self.axes])
        self.enter({**dict.fromkeys(self.inputs & {"housing.load.x", "housing.load.y"}, 0.0), **(start or {})})

    def force_at(self, position):
        """During initialization: the static force on the shaft, elements and housing in balance."""
        self.write([named("", axis) for axis in self.axes], position)
        return self.read([named("force", axis) for axis in self.axes])

    def rest(self, load):
        """During initialization: moves the shaft to where the bearing carries `load` and gives that position.

        Newton with differences of 1 nm: the force is convex in the approach, so that from deep in contact the
        way goes downhill. A housing on springs may yield a lot: 0.1 mm of approach are enough for some 1000 N. In space,
        where rings move along and about each other as well, it begins at 20 µm.
        """
        size = len(self.axes)
        position = (1e-4 if size == 2 else 2e-5) * np.asarray(load) / np.linalg.norm(load)
        for _ in range(100):
            force = self.force_at(position)
            slope = np.column_stack([(self.force_at(position + d) - force) / 1e-9 for d in 1e-9 * np.eye(size)])
            change = np.linalg.solve(slope, -(force + load))
            position = position + change
            if np.linalg.norm(change) < 1e-12:
                self.force_at(position)
                return position
        raise RuntimeError(f"no position found where the bearing carries {load} N")

    def linear(self):
        """Stiffness [N/m] and damping [N s/m] for small motion about the present state, elements in balance.

        Two contacts of an element are in series, each with its normal stiffness and, for damping Q(1 + χ δ'), with χ Q;
        at frequencies far below the element's own they yield c (k_i² + k_o²)/(k_i + k_o)², which is c/2 within 0.1 %.
        Damping τ k δ' of both makes τ times the stiffness. In space other damping is left out.
        """
        stiffness = self.stiffness()
        (constant,) = self.read(["contact.damping"])
        if self.units["contact.damping"] == "s":
            return stiffness, constant * stiffness
        damping = np.zeros_like(stiffness)
        if len(self.axes) > 2:
            return stiffness, damping
        count = sum(name.endswith(".path") for name in self.reference)
        for j in range(1, count + 1):
            angle, force = self.read([f"element[{j}].angle", f"element[{j}].force.inner"])
            normal = np.array([np.cos(angle), np.sin(angle)])
            damping += 0.5 * constant * force * np.outer(normal, normal)
        return stiffness, damping

    def advance(self, position, velocity, acceleration, length):
        """One step of `length` [s]; within it the shaft goes on from `position` with `velocity` and `acceleration`.

        Gives the force on the shaft: its mean over the step, and at the end, where the shaft is then.
        """
        self.motion.array[:] = *position, *velocity, *acceleration
        unit = self.unit
        try:
            unit.fmi2SetReal(*self.motion.arguments)
            unit.fmi2DoStep(unit.component, self.time, length, 1)
            unit.fmi2GetReal(*self.forces.arguments)
        except FMICallException as error:
            raise RuntimeError(f"step at {self.time:.9g} s: {what_was_said(error)}") from None
        self.time += length
        mean, end = self.forces.array.reshape(2, -1)
        return mean.copy(), end.copy()

    def stiffness(self):
        """The tangent stiffness matrix now [N/m]."""
        self.call(self.unit.fmi2GetReal, *self.tangent.arguments)
        return self.tangent.array.reshape(len(self.axes), -1).copy()
