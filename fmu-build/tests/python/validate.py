"""Validates FMUs: with fmpy model description, names, units, model structure; against the official schema of FMI 3.0,
which FMI 2.0.4 refers to, terminals and icons. Fails with everything that was found."""

import sys
from pathlib import Path
from zipfile import ZipFile

import fmpy
from fmpy.validation import validate_fmu
from lxml import etree

schema = etree.XMLSchema(etree.parse(Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"))


def terminals(fmu):
    with ZipFile(fmu) as archive:
        if "terminalsAndIcons/terminalsAndIcons.xml" not in archive.namelist():
            return []
        file = archive.open("terminalsAndIcons/terminalsAndIcons.xml")
        schema.validate(etree.parse(file))
    return [f"{fmu}: {error.message}" for error in schema.error_log]


problems = [problem for fmu in sys.argv[1:] for problem in validate_fmu(fmu) + terminals(fmu)]
if problems:
    sys.exit("fmpy validate_fmu: " + "; ".join(problems))
