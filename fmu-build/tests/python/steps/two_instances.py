"""Two instances of two scenes, stepped in turn in one process, give the bits that each gives alone."""

import sys

from host import started

STEP, COUNT = 2e-5, 500


def stepped(host):
    """All outputs after one more step."""
    host.step(STEP)
    outputs = [v.name for v in host.description.modelVariables if v.causality == "output" and v.type == "Real"]
    return host.read(outputs).tolist()


expected = []
for fmu in sys.argv[1:3]:
    host = started(fmu)
    expected.append([stepped(host) for _ in range(COUNT)])
    host.close()
hosts = [started(fmu) for fmu in sys.argv[1:3]]
for count in range(COUNT):
    for host, rows in zip(hosts, expected):
        assert stepped(host) == rows[count], f"{host.description.modelName} differs at {host.time} s"
# One goes, the other goes on.
hosts[0].close()
hosts[1].step(STEP)
hosts[1].close()
