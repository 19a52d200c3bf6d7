"""A host that steps one FMU through the C interface, with variables by name."""

import shutil

import fmpy
from fmpy.fmi2 import FMU2Slave


class Host:
    """One instance of the FMU, and the names of its variables."""

    def __init__(self, fmu, start=None, folder=None):
        self.description = fmpy.read_model_description(fmu)
        self.folder = fmpy.extract(fmu, folder)
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}
        self.start = {v.name: float(v.start) for v in self.description.modelVariables if v.start and v.type == "Real"}
        self.unit = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="demo",
        )
        self.unit.instantiate()
        # Without a word from the FMU a failed call would say no more than its status.
        self.unit.setDebugLogging(True, ["logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal"])
        for name, value in (start or {}).items():
            if isinstance(value, str):
                self.unit.setString([self.reference[name]], [value])
            else:
                self.write([name], [value])
        self.unit.setupExperiment(startTime=0.0)
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()
        self.time = 0.0

    def step(self, length):
        self.unit.doStep(currentCommunicationPoint=self.time, communicationStepSize=length)
        self.time += length

    def read(self, names):
        return self.unit.getReal([self.reference[name] for name in names])

    def write(self, names, values):
        self.unit.setReal([self.reference[name] for name in names], values)

    def close(self):
        self.unit.terminate()
        self.unit.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)
