"""A host that steps one FMU of FMI 3.0 through the C interface, with variables by name."""

import shutil
from ctypes import byref, c_int, c_size_t, c_uint32

import fmpy
from fmpy.fmi3 import FMU3Slave


class Host3:
    """One instance of the FMU, and the names of its variables. Arrays are read and counted as a whole."""

    def __init__(self, fmu, update=None, required=(), early_return=False):
        self.description = fmpy.read_model_description(fmu)
        self.folder = fmpy.extract(fmu)
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.unit = FMU3Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="host",
        )
        self.unit.instantiate(
            loggingOn=True,
            earlyReturnAllowed=early_return,
            logMessage=lambda *_: None,
            intermediateUpdate=update,
            requiredIntermediateVariables=[self.variables[name].valueReference for name in required],
        )
        self.unit.enterInitializationMode(startTime=0.0)
        self.unit.exitInitializationMode()
        self.time = 0.0

    def size(self, name):
        return self.variables[name].shape[0] if self.variables[name].shape else 1

    def names(self, causality, type="Float64"):
        return [v.name for v in self.description.modelVariables if v.causality == causality and v.type == type]

    def step(self, length):
        event, end, early, time = self.unit.doStep(self.time, length)
        assert not event and not end
        self.time = time
        return early

    def read(self, names):
        references = [self.variables[name].valueReference for name in names]
        return self.unit.getFloat64(references, nValues=sum(map(self.size, names)))

    def write(self, names, values):
        self.unit.setFloat64([self.variables[name].valueReference for name in names], values)

    def dependencies(self, name):
        """Pairs of element and reference; fmpy 0.3.32's own function fails on a number that it does not make."""
        reference, count = self.variables[name].valueReference, c_size_t()
        self.unit.fmi3GetNumberOfVariableDependencies(self.unit.component, reference, byref(count))
        elements, known = (c_size_t * count.value)(), (c_uint32 * count.value)()
        others, kinds = (c_size_t * count.value)(), (c_int * count.value)()
        self.unit.fmi3GetVariableDependencies(
            self.unit.component, reference, elements, known, others, kinds, count.value
        )
        return set(zip(elements, known))

    def close(self):
        self.unit.terminate()
        self.unit.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)
