"""A host that steps by 1 ms gets the signals at 51.2 kHz in a file that NumPy reads, also of steps that it took back.

The last sample before a communication point lies less than a period from it, so the two cannot be equal; what is
compared is the sample right at the communication points that both rates share: every 5 ms is 256 periods.
"""

import sys
from pathlib import Path

import numpy as np

from host import started

SEEN = ["sensor.acceleration", "shaft.force.y", "element[1].path", "cage.angle"]
folder = Path(sys.argv[1]).parent / "recorded here"
host = started(sys.argv[1], {"recorder.folder": str(folder)})
reference = host.reference["recorder.folder"]
assert host.unit.getString([reference])[0].decode() == str(folder)
seen = [host.read(SEEN)]
for index in range(100):
    if index % 10 == 3:
        host.save()
        host.step(1e-3)
        host.restore()
    host.step(1e-3)
    seen.append(host.read(SEEN))
host.close()

files = list(folder.iterdir())
assert len(files) == 1 and files[0].suffix == ".npy", files
recording = np.load(files[0])
assert recording.shape == (5120,), recording.shape
assert np.allclose(recording["time"], np.arange(5120) / 51200, rtol=0, atol=1e-12)
for name in recording.dtype.names:
    assert np.isfinite(recording[name]).all(), name
at_points = recording[::256]
for column, name in enumerate(SEEN):
    expected = np.array(seen)[0:100:5, column]
    # The same numbers by the same code, except for the cage's angle, whose turns are added up in another order.
    assert np.allclose(at_points[name], expected, rtol=1e-12, atol=1e-12), name
