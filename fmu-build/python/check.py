"""Tries an FMU of FMI 2.0 or 3.0 as an importer would; ends with a line that says what is wrong.

Arguments: the FMU; the platform's folder under `binaries` after FMI 2.0, and after FMI 3.0.
"""

import shutil
import stat
import sys
import tempfile
import zipfile
from ctypes import byref
from pathlib import Path, PurePosixPath

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, defaultCallbacks, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Slave
from fmpy.logging import addLoggerProxy
from fmpy.validation import validate_fmu

STEPS = 100  # communication steps that are tried


def need(holds, otherwise):
    if not holds:
        raise RuntimeError(otherwise)


def unzip(path, folder):
    with zipfile.ZipFile(path) as archive:
        for entry in archive.infolist():
            name = entry.orig_filename
            need(entry.flag_bits & 0x800 or name.isascii(), f"entry {name}: its name is not UTF-8")
            need("\\" not in name, f"entry {name}: back-slash in the name")
            inside = not name.startswith("/") and ":" not in name and ".." not in PurePosixPath(name).parts
            need(inside, f"entry {name}: leaves the folder")
            need(not stat.S_ISLNK(entry.external_attr >> 16), f"entry {name}: is a link")
            plain = entry.compress_type in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
            need(plain, f"entry {name}: compressed by method {entry.compress_type}, only store and deflate are allowed")
        archive.extractall(folder)
        return len(archive.infolist())


class Unit:
    """One instance. An error carries the last line that the FMU logged."""

    def __init__(self, description, folder, own):
        what = description.coSimulation
        self.two = description.fmiVersion == "2.0"
        experiment = description.defaultExperiment
        given = experiment and experiment.stepSize or getattr(what, "fixedInternalStepSize", None)
        self.step_size = float(given or 1e-3)
        self.tolerance = float(experiment and experiment.tolerance or 1e-5)
        real = "Real" if self.two else "Float64"
        self.outputs = [v for v in description.modelVariables if (v.type, v.causality) == (real, "output")]
        counts = [int(np.prod([int(d.start) for d in v.dimensions or ()])) for v in self.outputs]
        self.references = [v.valueReference for v in self.outputs]
        self.names = [v.name for v, count in zip(self.outputs, counts) for _ in range(count)]
        file = f"binaries/{own}/{what.modelIdentifier}{fmpy.sharedLibraryExtension}"
        need((Path(folder) / file).is_file(), f"{file} is missing: nothing for this platform")
        kind = FMU2Slave if self.two else FMU3Slave
        self.log = []
        self.unit = kind(
            guid=description.guid, unzipDirectory=folder, modelIdentifier=what.modelIdentifier, instanceName="check",
            libraryPath=str(Path(folder).resolve() / file), requireFunctions=False,
        )  # fmt: skip
        functions = [name for name in dir(self.unit) if name[:4] in ("fmi2", "fmi3") and name[4].isupper()]
        missing = [name for name in functions if not hasattr(self.unit.dll, name)]
        need(not missing, f"{file} lacks {', '.join(missing)}")
        try:
            self.instantiate()
        except Exception:
            raise RuntimeError(f"no instance was made; log: {self.last()}") from None
        print(f"library: {file} loads, has all functions, makes an instance")

    def instantiate(self):
        if not self.two:
            heard = lambda _, __, category, message: self.hear(category, message)  # noqa: E731
            return self.unit.instantiate(loggingOn=True, logMessage=heard)
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(lambda _, __, ___, category, message: self.hear(category, message))
        callbacks.allocateMemory, callbacks.freeMemory = defaultCallbacks.allocateMemory, defaultCallbacks.freeMemory
        # Fills in the variable arguments of the FMU's messages, which Python cannot.
        addLoggerProxy(byref(callbacks))
        self.callbacks = callbacks
        return self.unit.instantiate(callbacks=callbacks, loggingOn=True)

    def hear(self, category, message):
        text = [(part or b"").decode("utf-8", "replace") for part in (category, message)]
        self.log.append(": ".join(text))

    def last(self):
        return self.log[-1] if self.log else "empty"

    def call(self, function, *arguments, **named):
        try:
            return function(*arguments, **named)
        except FMICallException as error:
            raise RuntimeError(f"{str(error).rstrip('.')}; log: {self.last()}") from None

    def initialize(self):
        if self.two:
            self.call(self.unit.setupExperiment, tolerance=self.tolerance)
            self.call(self.unit.enterInitializationMode)
        else:
            self.call(self.unit.enterInitializationMode, tolerance=self.tolerance)
        self.call(self.unit.exitInitializationMode)
        self.read("after initialization")

    def read(self, when):
        """Values of all real outputs, which must be finite."""
        if self.two:
            values = self.call(self.unit.getReal, self.references)
        else:
            values = self.call(self.unit.getFloat64, self.references, nValues=len(self.names))
        for name, value in zip(self.names, values):
            need(np.isfinite(value), f"{when}: output {name} is {value}")
        return values

    def steps(self, first):
        """Outputs after each of the steps from the one of this number on."""
        rows, h = [], self.step_size
        for start in h * np.arange(first, first + STEPS):
            done = self.call(self.unit.doStep, start, h, False)
            if not self.two:
                _, terminate, _, time = done
                need(not terminate, f"fmi3DoStep at {start:g} s: the FMU wants the run to end at {time:g} s")
                # A solver of fixed steps may miss the end by some of them; an early return was not allowed.
                need(abs(time - start - h) <= 0.5 * h, f"fmi3DoStep at {start:g} s by {h:g} s reached {time:g} s")
            rows.append(self.read(f"at {start + h:g} s"))
        return np.array(rows)

    def rewind(self, state, how):
        """Steps on from the state twice and compares every bit."""
        runs = []
        for _ in range(2):
            self.call(self.unit.setFMUState, state)
            runs.append(self.steps(STEPS))
        differs = np.argwhere(runs[0].view(np.uint64) != runs[1].view(np.uint64))
        if len(differs):
            step, output = differs[0]
            raise RuntimeError(f"{how}: {self.names[output]} differs in step {step} after the state")


def check(path, folder, own):
    entries = unzip(path, folder)
    print(f"archive: {entries} files, deflate or store, plain names")
    problems = validate_fmu(path)
    description = fmpy.read_model_description(path, validate=False)
    version = description.fmiVersion
    need(version == "2.0" or version.startswith("3.0"), f"fmiVersion is {version!r}: only 2.0 and 3.0 are tried here")
    exchange = description.modelExchange is not None
    lacks = "for Model Exchange alone; what is checked is co-simulation: build it with --kind both" if exchange else \
        "no CoSimulation element with a modelIdentifier"
    need(description.coSimulation is not None, f"modelDescription.xml: {lacks}")
    real = "Real" if version == "2.0" else "Float64"
    count = {c: sum((v.type, v.causality) == (real, c) for v in description.modelVariables) for c in ("output", "input")}
    what = description.coSimulation
    print(
        f"model description: FMI {version}, {what.modelIdentifier}, {count['output']} real outputs, "
        f"{count['input']} real inputs"
    )
    need(not problems, "fmpy validate_fmu: " + "; ".join(problems))
    print("fmpy validate_fmu: nothing found")
    unit = Unit(description, folder, own[version != "2.0"])
    unit.initialize()
    unit.steps(0)
    print(f"doStep: {STEPS} steps of {np.format_float_positional(unit.step_size, trim='-')} s, every output finite")
    if what.canGetAndSetFMUstate:
        state = unit.call(unit.unit.getFMUState)
        unit.rewind(state, "save and restore")
        print(f"state: restored, {STEPS} steps again, equal bits")
        if what.canSerializeFMUstate:
            serialized = unit.call(unit.unit.serializeFMUState, state)
            copy = unit.call(unit.unit.deserializeFMUState, serialized)
            unit.rewind(copy, "serialize and deserialize")
            unit.call(unit.unit.freeFMUState, copy)
            print(f"serialized state: {len(serialized)} bytes, {STEPS} steps again, equal bits")
        unit.call(unit.unit.freeFMUState, state)
    else:
        print("state: not declared, not tried")
    unit.call(unit.unit.terminate)
    unit.unit.freeInstance()


folder = tempfile.mkdtemp()
try:
    check(sys.argv[1], folder, sys.argv[2:4])
except Exception as error:  # one line for the user, whatever it is
    sys.exit(f"{sys.argv[1]}: {error}")
finally:
    shutil.rmtree(folder, ignore_errors=True)
