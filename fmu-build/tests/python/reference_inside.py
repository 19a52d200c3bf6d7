"""Reference results in FMUs: the manifest after FMI-LS-REF, the files it names, the experiment, the results found."""

import re
import sys
import tempfile
from pathlib import Path
from zipfile import ZipFile

import numpy as np
from fmpy import read_csv, simulate_fmu
from fmpy.cross_check import validate_result
from fmpy.util import read_ref_opt_file
from fmpy.validation import validate_fmu
from lxml import etree

PREFIX = "extra/org.fmi-standard.fmi-ls-ref/"
NAMESPACE = "{http://fmi-standard.org/fmi-ls-manifest}"
ROLES = re.compile("testcase|result|configuration|experiment/smoke-test")

for path in map(Path, sys.argv[1:]):
    assert not validate_fmu(str(path)), validate_fmu(str(path))
    with ZipFile(path) as fmu, tempfile.TemporaryDirectory() as folder:
        root = etree.fromstring(fmu.read(PREFIX + "fmi-ls-manifest.xml"))
        assert root.tag == "fmiReferences" and root.get(NAMESPACE + "fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
        assert re.fullmatch(r"\d+\.\d+\.\d+(-.+)?", root.get(NAMESPACE + "fmi-ls-version"))
        # The schema allows this text alone.
        said = root.get(NAMESPACE + "fmi-ls-description")
        assert said == "Layered Standard providing information on related files included in an FMU.", said
        related = root.findall("Related")
        assert len(related) == len(root) and all(ROLES.fullmatch(file.get("role")) for file in related)
        named = {file.get("source") for file in related}
        held = {name.removeprefix(PREFIX) for name in fmu.namelist() if name.startswith(PREFIX)}
        assert named == held - {"fmi-ls-manifest.xml"}, (named, held)
        (experiment,) = (file for file in related if file.get("role") == "experiment/smoke-test")
        assert experiment.get("type") == "application/x-ma-hs-experiments"
        fmu.extract(PREFIX + experiment.get("source"), folder)
        experiments = etree.parse(str(Path(folder) / PREFIX / experiment.get("source"))).getroot()
        assert experiments.tag == "Experiments" and experiments.get("name") == path.stem
        (described,) = experiments
        sources = {file.get("source") for file in described}
        assert [file.tag for file in described] == ["Stimuli", "References"] and sources < named
        for name in named - {experiment.get("source")}:
            fmu.extract(PREFIX + name, folder)
            beside = path.with_name(name)
            assert fmu.read(PREFIX + name) == beside.read_bytes(), f"{name} differs from the file beside the FMU"
        (results,) = (file.get("source") for file in related if file.get("role") == "result")
        stem = str(Path(folder) / PREFIX / results.removesuffix("_ref.csv"))
        options, reference = read_ref_opt_file(stem + "_ref.opt"), read_csv(stem + "_ref.csv")
        step = options["StepSize"]
        said = [float(described.get(key)) for key in ("startTime", "stopTime", "stepSize", "tolerance")]
        assert said == [options[key] for key in ("StartTime", "StopTime", "StepSize", "RelTol")], said
        result = simulate_fmu(
            str(path), stop_time=options["StopTime"], step_size=step, output_interval=step,
            output=list(reference.dtype.names[1:]), relative_tolerance=options["RelTol"],
            input=read_csv(stem + "_in.csv"),
        )  # fmt: skip
        problem = validate_result(result, reference, options["StartTime"], options["StopTime"])
        assert problem is None, problem
        early = reference["time"] < 0.01
        for name in reference.dtype.names[1:]:
            size = max(np.ptp(reference[name]), 1e-3 * np.abs(reference[name]).max(), 1e-12)
            assert np.abs(result[name][early] - reference[name][early]).max() < 1e-6 * size, name
        print(f"{path.name}: {len(named)} related files, results found again")
