#!/usr/bin/env python3
"""A sweep in parts on a dask cluster: each part is `brinell sweep --part K/N`, and the table is that of one run, bit for bit.

    python examples/sweep.py examples/sweep.toml -o target/labelled                       workers on this machine
    python examples/sweep.py design.toml -o out --parts 400 --scheduler tcp://HOST:8786   a cluster that runs already

Workers need the program, the file of the sweep and the folder under the same paths: a file system that all share.
Started again it makes what is missing; so it does after a worker is lost, whose parts dask gives to others.
"""

import argparse
import os
import shlex
import subprocess
import sys

from dask.distributed import Client, LocalCluster, as_completed

PROGRAM = shlex.split(os.environ.get("BRINELL_FMU", "brinell"))


def sweep(program, file, folder, more):
    """Runs the program; its own message is that of an error."""
    done = subprocess.run([*program, "sweep", file, "-o", folder, *more], capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(done.stderr.strip())
    return done


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", help="the sweep (TOML)")
    parser.add_argument("-o", "--output", required=True, help="folder for the table")
    parser.add_argument("--parts", type=int, help="default: four for each thread of the cluster")
    parser.add_argument("--scheduler", help="address of a cluster that runs already")
    parser.add_argument("--signals", nargs="?", const="npy", help="write the signals of each run as well")
    options = parser.parse_args()
    file, folder = os.path.abspath(options.file), os.path.abspath(options.output)
    more = ["--signals", options.signals] if options.signals else []
    cluster = options.scheduler or LocalCluster(threads_per_worker=1, host="127.0.0.1", dashboard_address=None)
    with Client(cluster) as client:
        parts = options.parts or 4 * sum(client.nthreads().values())
        words = [["--part", f"{k}/{parts}", "--jobs", "1", *more] for k in range(1, parts + 1)]
        futures = [client.submit(sweep, PROGRAM, file, folder, each, pure=False) for each in words]
        try:
            for count, future in enumerate(as_completed(futures), 1):
                future.result()
                print(f"\r{count} of {parts} parts", end="", file=sys.stderr, flush=True)
        except RuntimeError as error:
            sys.exit(f"\n{error}")
        print(file=sys.stderr)
    joined = sweep(PROGRAM, file, folder, more)
    print(joined.stderr.strip().splitlines()[-1], file=sys.stderr)
    print(joined.stdout, end="")


if __name__ == "__main__":
    main()
