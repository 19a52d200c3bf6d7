"""`Bearing.rest` finds where a bearing of `brinell new --hosted` carries its load.

Arguments: the folder of the examples, and one for the FMUs.
"""

import subprocess
import sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import numpy as np
from bearing import Bearing, build, changed_scene, program

FOLDER = Path(sys.argv[2])
# A bearing, its spall, degrees of freedom, and the largest load [N].
CASES = [
    ("608", None, 2, 700.0),
    ("6205", None, 2, 6000.0),
    ("NU205", None, 2, 6000.0),
    ("6205", None, 3, 6000.0),
    ("6205", None, 5, 6000.0),
    ("7208B", None, 5, 6000.0),
    ("608", "outer:1mm", 2, 500.0),
    ("6205", "outer:1mm", 2, 1200.0),
    ("6205", "outer:2mm", 2, 1200.0),
    ("6205", "outer:1mm", 5, 1200.0),
]


def built(bearing, spall, freedom):
    name = "-".join([bearing, spall.replace(":", "") if spall else "healthy", str(freedom)])
    defect = ["--defect", spall] if spall else []
    words = ["new", name, "--bearing", bearing, "--hosted", *defect, "-o", str(FOLDER), "-q"]
    subprocess.run([*program(), *words], check=True)
    changes = {"bearing.degrees_of_freedom": freedom}
    if spall:
        # Few cells: the map is built in a second. It reaches what the largest load asks for, with impacts.
        changes |= {"contact.law": "map", "contact.cells": [16, 8], "contact.largest_force_n": 6000.0}
    return changed_scene(FOLDER / f"{name}.toml", f"{name}-here", changes, FOLDER)


scenes = [built(*case[:3]) for case in CASES]
for (bearing, spall, freedom, largest), fmu in zip(CASES, build(scenes, FOLDER)):
    count = 0
    for load in np.geomspace(5.0, largest, 10):
        unit = Bearing(fmu)
        # Along the axis as well, without which balls that lean lift the ring; no moments.
        asked = np.array([0.0, -load, 0.6 * load, 0.0, 0.0][: len(unit.axes)])
        force = unit.force_at(unit.rest(asked))
        assert np.linalg.norm(force + asked) < 1e-6 * load, (bearing, spall, freedom, load, force)
        unit.close()
        count += 1
    print(f"{bearing} {spall} {freedom}: {count} of 10")
