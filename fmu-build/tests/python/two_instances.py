"""Two instances of two scenes, stepped in turn in one process, give the bits that each gives alone."""

import sys

from host import Host

STEP, COUNT = 2e-5, 500


def outputs(host):
    return [v.name for v in host.description.modelVariables if v.causality == "output" and v.type == "Real"]


def alone(fmu):
    host = Host(fmu)
    names, rows = outputs(host), []
    for _ in range(COUNT):
        host.step(STEP)
        rows.append(host.read(names))
    host.close()
    return rows


expected = [alone(fmu) for fmu in sys.argv[1:3]]
hosts = [Host(fmu) for fmu in sys.argv[1:3]]
for count in range(COUNT):
    for host in hosts:
        host.step(STEP)
    for host, rows in zip(hosts, expected):
        assert host.read(outputs(host)) == rows[count], f"{host.description.modelName} differs at {host.time} s"
# One goes, the other goes on.
hosts[0].close()
hosts[1].step(STEP)
hosts[1].close()
