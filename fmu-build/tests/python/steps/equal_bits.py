"""FMUs, stepped over the grid of a run without a host, give the same bits at every point.

Arguments: communication step [s], then pairs of an FMU and the run's CSV.
"""

import sys

from host import started

step = float(sys.argv[1])
for fmu, path in zip(sys.argv[2::2], sys.argv[3::2]):
    with open(path, encoding="utf-8") as file:
        names = [cell.rsplit(" [", 1)[0] for cell in file.readline().strip().split(",")]
        rows = [list(map(float, line.split(","))) for line in file]
    host = started(fmu)
    types = {v.name: v.type for v in host.description.modelVariables}
    reals = [name for name in names[1:] if types[name] == "Real"]
    integers = [name for name in names[1:] if types[name] == "Integer"]
    assert ["time", *reals, *integers] == names
    for count, row in enumerate(rows):
        if count > 0:
            host.step(step)
        counts = host.unit.getInteger([host.reference[name] for name in integers]) if integers else []
        for name, expected, got in zip(names, row, [host.time, *host.read(reals), *counts]):
            assert got == expected, f"{fmu}, point {count}: {name} is {got!r}, and {expected!r} without a host"
    host.close()
