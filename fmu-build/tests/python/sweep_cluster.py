"""A sweep on a dask cluster that runs already.

Arguments: the commands that start scheduler and worker and run the sweep, as the guide has them; a folder for the results.
"""

import socket
import subprocess
import sys
from pathlib import Path

scheduler, worker, sweep, folder = sys.argv[1:]
with socket.socket() as free:
    free.bind(("127.0.0.1", 0))
    port = free.getsockname()[1]
started = []
try:
    for command in (scheduler, worker):
        words = command.replace("8786", str(port)).split()
        assert words[0] == "dask", command
        words = [sys.executable, "-m", "dask", *words[1:]]
        if words[3] == "worker":
            words += ["--local-directory", folder]
        started.append(subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))
    words = sweep.replace("8786", str(port)).split()
    script = Path(__file__).resolve().parents[3] / words[1]
    done = subprocess.run([sys.executable, script, *words[2:], "-o", folder], stdout=subprocess.PIPE, text=True, timeout=300)
    assert done.returncode == 0, done.returncode
    print(done.stdout.splitlines()[-1])
finally:
    for process in reversed(started):
        process.terminate()
    for process in started:
        process.wait(30)
