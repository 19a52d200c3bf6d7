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


# Of the search for rest [m, N/m]: how far the first step goes, over what differences are taken, where it gives up; what
# stands for the stiffness of a shaft that touches nothing, a thousandth of any bearing's; and the radius at which tilts
# count, of a bearing of middling size.
FIRST, DIFFERENCE, SHORTEST, LOOSE, RADIUS, STEPS = 5e-6, 1e-9, 1e-13, 1e4, 0.02, 200


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

    def rest(self, load, tilt=()):
        """During initialization: moves the shaft to where the bearing carries `load` and gives that position. With a `tilt`
        about x and y the shaft keeps that, whatever moment it takes, and `load` is along x, y and z.

        Newton's method by differences, from a shaft that touches nothing yet. A step is at most twice as long as the one
        before and is halved until what the load leaves has not grown: on the way lies a place of which the FMU knows no
        force, beyond its contact map or without a balance of its elements, and a spall's edge bends the force.
        """
        load = np.asarray(load, dtype=float)
        free, tilt = self.axes[: len(self.axes) - len(tilt)], np.asarray(tilt, dtype=float)
        if len(load) != len(free) or not np.linalg.norm(load) > 0.0:
            raise ValueError(f"{self.name}: a load of {load}: as many numbers as it has axes, {', '.join(free)}")
        # Tilts count by what they move at a bearing's radius, so that all are lengths and forces.
        reach = np.where([axis.startswith("tilt") for axis in free], RADIUS, 1.0)
        whole = lambda place: np.append(place / reach, tilt)  # noqa: E731
        why = ""

        def left(place):
            nonlocal why
            try:
                return (self.force_at(whole(place))[: len(load)] + load) / reach
            except RuntimeError as error:
                why = f": {error}"
                self.restore()
                return None

        self.save()
        place, longest, wanted = np.zeros(len(load)), FIRST, 1e-10 * np.linalg.norm(load / reach)
        force = left(place)
        for _ in range(STEPS if force is not None else 0):
            if np.linalg.norm(force) <= wanted:
                self.force_at(whole(place))
                return whole(place)
            beside = [left(place + moved) for moved in DIFFERENCE * np.eye(len(load))]
            if any(one is None for one in beside):
                break
            slope = np.column_stack([(one - force) / DIFFERENCE for one in beside])
            # What nothing holds yet goes along its load.
            step = np.linalg.solve(slope - LOOSE * np.eye(len(load)), -force)
            step *= min(1.0, longest / np.linalg.norm(step))
            there = left(place + step)
            while there is None or np.linalg.norm(there) > np.linalg.norm(force) + wanted:
                step *= 0.5
                if np.linalg.norm(step) < SHORTEST:
                    break
                there = left(place + step)
            else:
                place, force, longest = place + step, there, 2.0 * np.linalg.norm(step)
                longest = max(longest, FIRST)
                continue
            break
        # Rounding: the FMU's own balance is as good.
        if force is not None and np.linalg.norm(force) <= 1e3 * wanted:
            self.force_at(whole(place))
            return whole(place)
        over = [] if force is None else [f"{x:.3g}" for x in force * reach]
        raise RuntimeError(f"{self.name}: no position carries {load}; at {place / reach} {over} is left{why}")

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
