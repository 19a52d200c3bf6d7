"""Reference results in FMUs: the manifest after FMI-LS-REF, the files it names, the experiment, the results found."""

import re
import sys
import tempfile
from pathlib import Path
from zipfile import ZipFile

from fmpy.validation import validate_fmu
from lxml import etree
from reference import found_again

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
        options, told = found_again(path, Path(folder) / PREFIX / results.removesuffix("_ref.csv"))
        said = [float(described.get(key)) for key in ("startTime", "stopTime", "stepSize", "tolerance")]
        assert said == [options[key] for key in ("StartTime", "StopTime", "StepSize", "RelTol")], said
        print(f"{path.name}: {len(named)} related files, results found again: {told}")
