"""An FMU unpacked in a folder with spaces, umlauts and signs that a URI must escape loads and steps."""

import sys
import tempfile
from pathlib import Path

from host import started, unzipped

fmu = Path(sys.argv[1])
folder = fmu.parent / "entpackt für später #1 (50 % + ß)"
folder.mkdir()
tempfile.tempdir = str(folder)
assert folder in Path(unzipped(fmu)).parents
host = started(fmu)
for _ in range(10):
    host.step(1e-4)
assert host.read(["element[1].force.outer"])[0] >= 0.0
host.close()
