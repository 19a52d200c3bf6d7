"""A sweep on a dask cluster that runs already, and on workers that join it later.

Arguments: the commands that start scheduler and worker and run the sweep, as the guide has them; a folder for the
results.
"""

import json
import subprocess
import sys
import time
from pathlib import Path

from dask.distributed import Client

scheduler, worker, sweep, folder = sys.argv[1:]
said = Path(folder) / "scheduler.json"
started = []


def start(command, *more):
    """Starts a process of the cluster; what it says goes to a file."""
    words = command.split()
    assert words[0] == "dask", command
    with open(Path(folder) / f"{words[1]}-{len(started)}.txt", "w") as log:
        started.append(subprocess.Popen([sys.executable, "-m", "dask", *words[1:], *more], stdout=log, stderr=log))


def run(command):
    """Runs the sweep and gives what it found, as JSON."""
    words = command.split()
    script = Path(__file__).resolve().parents[3] / words[1]
    done = subprocess.run(
        [sys.executable, script, *words[2:], "-o", folder], stdout=subprocess.PIPE, text=True, timeout=240
    )
    assert done.returncode == 0, done.returncode
    return done.stdout.splitlines()[-1]


try:
    # A port that the system chooses: a fixed one may be taken.
    start(scheduler.replace("--port 8786", "--port 0"), "--scheduler-file", said)
    begin = time.monotonic()
    while not said.exists() or not said.read_text().strip():
        assert started[0].poll() is None and time.monotonic() - begin < 120, "the scheduler does not start"
        time.sleep(0.1)
    address = json.loads(said.read_text())["address"]
    worker, sweep = (command.replace("tcp://127.0.0.1:8786", address) for command in (worker, sweep))
    start(worker, "--local-directory", folder)
    first = run(sweep)
    # Late workers are told of all plugins at once, when they join.
    start(worker, "--local-directory", folder)
    with Client(address) as client:
        client.wait_for_workers(4, timeout=120)
        states = [one["status"] for one in client.scheduler_info(n_workers=-1)["workers"].values()]
        assert states == 4 * ["running"], states
    later = json.loads(run(sweep.replace("--runs 8", "--runs 16")))
    assert (later["runs"], later["failed"]) == (8, 0), later
    print(first)
except BaseException:
    for log in sorted(Path(folder).glob("*.txt")):
        print(log.name, log.read_text()[-3000:], sep="\n", file=sys.stderr)
    raise
finally:
    for process in reversed(started):
        process.terminate()
    for process in started:
        try:
            process.wait(60)
        except subprocess.TimeoutExpired:
            process.kill()
