"""A sweep keeps every run once: when a worker dies, when the sweep is interrupted, when a run fails.

Arguments: the folder of the examples, a folder for the results.
"""

import os
import signal
import sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import bearing  # noqa: E402
import numpy as np  # noqa: E402
import pyarrow.parquet as parquet  # noqa: E402
import sweep  # noqa: E402
import sweep_signals  # noqa: E402
from dask.distributed import Client, LocalCluster  # noqa: E402

RUNS, BAD = 24, 5
OPTIONS = {"stop": 0.08, "settle": 0.02, "rate": 51200.0, "signals": True, "size": False}


def rows(folder):
    """All rows by run; a run that is there twice is an error."""
    found = [row for part in folder.glob("part-*.parquet") for row in parquet.read_table(part).to_pylist()]
    by_run = {row["run"]: row for row in found}
    assert len(by_run) == len(found), f"{len(found) - len(by_run)} runs are there twice"
    return by_run


def same(one, other):
    assert one.keys() == other.keys()
    unlike = [key for key in one if key != "cpu_s" and not np.array_equal(np.array(one[key]), np.array(other[key]))]
    assert not unlike, f"run {one['run']} came out different in {', '.join(unlike)}"


def main():
    folder = Path(sys.argv[2])
    grid = {"housing.mass_kg": [6.638, 8.0]}  # two FMUs with one contact map
    random = {"shaft.load_n": (300.0, 1500.0), "shaft.speed_hz": (20.0, 40.0)}
    runs = sweep.design(RUNS, grid, random, 7)
    assert runs == sweep.design(2 * RUNS, grid, random, 7)[:RUNS], "a longer design begins with the shorter"
    assert runs != sweep.design(RUNS, grid, random, 8)
    # Rings and elements overlap: the FMU refuses.
    runs[BAD]["bearing.radial_clearance_um"] = -1e6
    paths, names = sweep.prepare(bearing.SCENES / "er16k-tb1.toml", runs, folder / "fmu")
    assert len(paths) == 2

    broken, whole = folder / "broken", folder / "whole"
    for made in (broken, whole):
        made.mkdir()
    with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
        with Client(cluster) as client:
            client.register_plugin(sweep.Bearings(paths, bearing.__file__))
            ended = []

            def end_a_worker_then_interrupt(count):
                if count == 4:
                    ended.append(sorted(client.run(os.getpid).values())[0])
                    os.kill(ended[0], signal.SIGKILL)
                if count == 14:
                    raise KeyboardInterrupt

            try:
                sweep.collect(client, runs, names, OPTIONS, broken, 3, end_a_worker_then_interrupt)
                raise AssertionError("the interruption was swallowed")
            except KeyboardInterrupt:
                pass
            kept = len(rows(broken))
            assert kept == 14, f"14 runs had come back, {kept} were kept"
            count, failed, _ = sweep.collect(client, runs, names, OPTIONS, broken)
            assert ended and ended[0] not in client.run(os.getpid).values()
            assert count == RUNS - kept, f"resumed: {count} runs"
            assert sweep.collect(client, runs, names, OPTIONS, broken)[0] == 0, "nothing is left to do"
            sweep.collect(client, runs, names, OPTIONS, whole)

    found, expected = rows(broken), rows(whole)
    assert sorted(found) == sorted(expected) == list(range(RUNS))
    for index in range(RUNS):
        same(found[index], expected[index])
        assert (found[index]["error"] is not None) == (index == BAD), found[index]["error"]
    assert "clearance" in found[BAD]["error"], found[BAD]["error"]

    # An instance that had many runs gives what a fresh one gives.
    last = RUNS - 1
    fresh = sweep_signals.run_one(bearing.Instance(str(paths[names[last]])), runs[last], OPTIONS)
    same({**found[last], **fresh}, found[last])
    print("kept", kept, "failed", failed)


if __name__ == "__main__":
    main()
