"""The FMU of FMI 3.0 gives, at every point of its default grid, the bits of the FMU of FMI 2.0.

Arguments: number of steps, then pairs of FMUs, FMI 2.0 and FMI 3.0 of one scene.
"""

import sys

from host import started
from host3 import Host3

count = int(sys.argv[1])
for two, three in zip(sys.argv[2::2], sys.argv[3::2]):
    old, new = started(two), Host3(three)
    reals = [v.name for v in old.description.modelVariables if v.causality == "output"]
    # `element[3].path` is the third element of `element.path`.
    outputs = new.names("output")
    columns = {}
    for name in outputs:
        for index in range(new.size(name)):
            head, dot, tail = name.partition(".")
            columns[name if name in old.reference else f"{head}[{index + 1}].{tail}"] = len(columns)
    assert sorted(columns) == sorted(reals), set(columns) ^ set(reals)
    counters = new.names("local", "UInt64")
    step = float(new.description.defaultExperiment.stepSize)
    for n in range(count):
        # A host that changes an input sees the same as well.
        for host in (old, new):
            speed = host.read(["shaft.speed"])[0]
            host.write(["shaft.speed"], [speed * (1 + 1e-6 * n)])
            host.step(step)
        before, after = old.read(reals), new.read(outputs)
        for name, value in zip(reals, before):
            now = after[columns[name]]
            assert now == value, f"{three}, step {n}: {name} is {now!r}, not {value!r}"
        numbers = old.unit.getInteger([old.reference[name] for name in counters])
        assert numbers == new.unit.getUInt64([new.variables[name].valueReference for name in counters])
    old.close()
    new.close()
print(f"{count} steps each, {len(sys.argv) // 2 - 1} scenes")
