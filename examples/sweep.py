#!/usr/bin/env python3
"""Thousands of runs over length, depth, load and speed of a defect, on all cores or a cluster, into Parquet.

On one machine `brinell sweep` does it quicker and without Python (docs/sweeps.md). This is for clusters, for FMUs as
their hosts run them, and for spalls that are to be sized from each signal.

    python examples/sweep.py --runs 500 --seed 1 [--workers 2] [-o target/sweep]
        --grid defect.length_deg=2,5,10,15.8 --grid defect.depth_um=20,50,100
        --random shaft.load_n=300:1500 --random shaft.speed_hz=8:40
    python examples/sweep.py --kinds healthy,outer,inner,element --law hertz --signals …       labelled classes
    python examples/sweep.py --speed-profile up.csv --noise-db 10:30 --rate 25600 --filter --write wav,npy …
    python examples/sweep.py --scheduler tcp://127.0.0.1:8786 …     on a dask cluster that runs already

Run i takes the grid's point i modulo its size and random values that depend on seed and i alone: the same design to the
bit on any machine, and a longer one begins with the shorter. What an FMU can be told costs a run 0.1 ms (load, speed,
slip, first angle), a clearance more than 2.5 µm off the scene's seconds where the law is `map`: a new contact map.
Other keys of the scene make one FMU per grid point, so let them be on the grid.

With `--kinds` runs take the kinds of fault in turn, each at every point of the grid. Each row says in its label_…
columns what it is a run of: kind, length, depth and position of the defect, load and speed. Under law `map` each size
of a defect needs a map of some CPU seconds; `--law hertz` needs none.

A `--speed-profile` (CSV: time_s, speed_hz; several are taken in turn) moves the shaft's speed in straight lines, noise
is white and so many decibels below the signal, `--filter` takes the sensor's samples through the FMU's recorder, which
lets nothing be folded, and `--write` puts each run's signal beside the rows, as run-0000000.wav and .npy.

FMUs are built once and shipped to each worker once, also to one that starts later; a worker keeps one instance per FMU
and resets it between runs. Results go to part-*.parquet in the output folder as they come; started again, the
sweep does what is missing. A run that fails has its error in the column `error`, and the others go on.
"""

import itertools
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import bearing
import numpy as np
import pyarrow
import pyarrow.parquet as parquet
import sweep_options
import sweep_signals
from bearing import tomllib
from dask.distributed import Client, LocalCluster, WorkerPlugin, as_completed, get_worker
from sweep_options import KINDS, OF_RUNS
from sweep_signals import TOLD

LABELS = ["label_kind", "label_length_mm", "label_depth_um", "label_angle_deg", "label_load_n", "label_speed_hz"]
LABELS += ["label_speed_profile", "label_noise_db"]
# Maps for many defects are coarser than that of one studied closely: 0.4 % of the largest force, for a third of the
# time.
MAP_ACCURACY = 4e-3
SIZED = ["sized_verdict", "sized_length_mm", "sized_uncertainty_mm", "sized_kind"]


def design(count, grid, random, seed, kinds=(), profiles=()):
    """The runs: a list of {key: value}."""
    points = [dict(zip(grid, values)) for values in itertools.product(*grid.values())]
    if kinds:
        points = [{"kind": kind, **point} for point in points for kind in kinds]
    if profiles:
        points = [{"speed_profile": profile, **point} for profile in profiles for point in points]
    runs = []
    for index in range(count):
        # One draw per key, from a stream of this run's own.
        draws = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, index]))).random(len(random))
        values = {key: drawn(*limits, float(draw)) for (key, limits), draw in zip(random.items(), draws)}
        runs.append({**points[index % len(points)], **values})
    return runs


def drawn(low, high, draw):
    """A value between two limits for a draw from [0, 1); a whole number between whole ones of a key that counts."""
    if isinstance(low, int) and isinstance(high, int):
        return low + int((high - low + 1) * draw)
    return low + (high - low) * draw


def is_told(key, run):
    """Whether an instance is told a key of this run, and not the scene that its FMU is made of."""
    return key in TOLD or key in OF_RUNS or (run.get("kind") == "healthy" and key.startswith("defect."))


def changes(run):
    """What a run changes in the scene."""
    built_in = {key: value for key, value in run.items() if not is_told(key, run)}
    # The base scene's length may be in the other unit.
    given = {"defect.length_mm", "defect.length_deg"} & set(built_in)
    if given:
        built_in = {"defect.length_mm": None, "defect.length_deg": None, "defect.profile": None, **built_in}
    return {**KINDS.get(run.get("kind"), {}), **built_in}


def prepare(base, runs, folder, law=None, recorder=None):
    """Builds one FMU for each set of values that an instance cannot be told. Gives {name: path}, name of each run."""
    names, scenes = [], {}
    contact = tomllib.loads(Path(base).read_text(encoding="utf-8")).get("contact", {})
    law = law or contact.get("law", "map")
    all_runs = {"contact.law": law, **({"contact.map_accuracy": MAP_ACCURACY} if law == "map" else {})}
    if recorder:
        all_runs.update({"recorder.rate_hz": recorder, "recorder.filter": "linear-phase"})
    for run in runs:
        values = [
            (value if isinstance(value, str) else f"{value:g}").replace(".", "p")
            for key, value in run.items()
            if not is_told(key, run)
        ]
        name = "-".join([Path(base).stem, *([run["kind"]] if "kind" in run else []), *values])
        if name not in scenes:
            scenes[name] = bearing.changed_scene(base, name, {**all_runs, **changes(run)}, folder)
        names.append(name)
    paths = bearing.build(scenes.values(), folder)
    return dict(zip(scenes, paths)), names


def label(scene, run):
    """What a run of an FMU of this scene is a run of."""
    defect, shaft = scene.get("defect"), scene["shaft"]
    load = float(np.hypot(*shaft.get("load_n", [0.0, 0.0])))
    row = dict.fromkeys(LABELS)
    row["label_load_n"] = run.get("shaft.load_n", load)
    row["label_speed_hz"] = run.get("shaft.speed_hz", shaft["speed_hz"])
    row["label_speed_profile"], row["label_noise_db"] = run.get("speed_profile"), run.get("noise_db")
    row["label_kind"] = (
        "healthy" if defect is None else "several" if isinstance(defect, list) else defect.get("on", "outer")
    )
    if isinstance(defect, dict):
        length = defect.get("length_mm")
        if length is None and "length_deg" in defect:
            length = float(np.radians(defect["length_deg"]) * radius_mm(scene["bearing"], row["label_kind"]))
        row["label_length_mm"], row["label_depth_um"] = length, defect.get("depth_um")
        row["label_angle_deg"] = run.get("defect.angle_deg", defect["angle_deg"])
    return row


def radius_mm(dimensions, kind):
    """Radius of the body that bears a defect, at the groove's bottom or on the element's track; NaN where a catalogue
    has the dimensions."""
    if not {"pitch_diameter_mm", "element_diameter_mm"} <= set(dimensions):
        return float("nan")
    pitch, element = dimensions["pitch_diameter_mm"], dimensions["element_diameter_mm"]
    clearance = dimensions.get("radial_clearance_um", 0.5 * dimensions.get("internal_clearance_um", 10.0)) * 1e-3
    return 0.5 * {"outer": pitch + element + clearance, "inner": pitch - element - clearance, "element": element}[kind]


class Bearings(WorkerPlugin):
    """Lives on a worker: the FMUs' files, one instance of each, and the module that drives them.

    The module comes with the plugin and is imported only after `setup`: a worker that joins later unpacks all its
    plugins at once, before a file that was uploaded for it is there.
    """

    name = "bearings"

    def __init__(self, paths, module, program=None):
        self.program = program
        modules = [Path(module), Path(module).with_name("sweep_signals.py")]
        self.modules = {path.name: path.read_bytes() for path in modules}
        self.files = {name: Path(path).read_bytes() for name, path in paths.items()}
        self.scenes = {
            name: Path(path).with_suffix(".toml").read_text(encoding="utf-8") for name, path in paths.items()
        }

    def setup(self, worker):
        self.folder = Path(worker.local_directory) / "bearings"
        self.folder.mkdir(parents=True, exist_ok=True)
        sys.path.insert(0, str(self.folder))
        for name, text in self.modules.items():
            (self.folder / name).write_bytes(text)
            sys.modules.pop(name.removesuffix(".py"), None)  # an earlier sweep's
        self.instances = {}

    def teardown(self, worker):
        sys.path.remove(str(self.folder))
        shutil.rmtree(self.folder, ignore_errors=True)

    def instance(self, name):
        from bearing import Instance

        if name not in self.instances:
            path = self.folder / f"{name}.fmu"
            path.write_bytes(self.files[name])
            self.instances[name] = Instance(str(path), name)
        self.instances[name].reset()
        return self.instances[name]

    def scene(self, name):
        from bearing import tomllib

        return tomllib.loads(self.scenes[name])

    def sized(self, index, name, values, signal, options):
        """The spall's length from the sensor's signal alone, by `fmu size`."""
        from bearing import changed_scene, tomllib

        recording, base = self.folder / f"run-{index}.npy", self.folder / f"{name}.toml"
        np.save(recording, signal)
        base.write_text(self.scenes[name], encoding="utf-8")
        # Of the scene it takes the bearing, the rig and the load; it does not look at the defect.
        load = {"shaft.load_n": [0.0, -values["shaft.load_n"]]} if "shaft.load_n" in values else {}
        scene = changed_scene(base, f"run-{index}", load, self.folder)
        speed = values.get("shaft.speed_hz", tomllib.loads(self.scenes[name])["shaft"]["speed_hz"])
        command = [*self.program, "size", recording, "--scene", scene, "--rate", options["rate"], "--speed", speed]
        command += ["--no-figure", "-o", self.folder / "sized"]
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        for path in (recording, scene):
            path.unlink()
        if done.returncode:
            raise RuntimeError(f"fmu size: {done.stderr.strip()[-300:]}")
        found = json.loads(done.stdout)
        return {f"sized_{key}": found[key] for key in ("verdict", "length_mm", "uncertainty_mm", "kind")}


def simulate(index, name, values, options):
    """One run on a worker: its row."""
    row = {"run": index, "fmu": name, **values, "error": None}
    begin = time.process_time()
    try:
        # Not above: the scheduler unpacks this function too, and has no such module.
        from sweep_signals import run_one

        bearings = get_worker().plugins[Bearings.name]
        row.update(label(bearings.scene(name), values))
        row.update(run_one(bearings.instance(name), values, options, index, bearings.folder))
        if options["size"]:
            row.update(bearings.sized(index, name, values, row["signal"], options))
    except Exception as error:  # whatever it is, the other runs go on
        row["error"] = f"{type(error).__name__}: {error}"
    if not (options["signals"] or options.get("write")):
        row.pop("signal", None)
    row["cpu_s"] = time.process_time() - begin
    return row


def done_already(folder):
    """Numbers of the runs that the folder has."""
    done = set()
    for part in sorted(folder.glob("part-*.parquet")):
        done.update(parquet.read_table(part, columns=["run"])["run"].to_pylist())
    return done


def columns(runs, options):
    """Every part has the same columns, whatever its runs."""
    known = {"run": pyarrow.int64(), "fmu": pyarrow.string(), "error": pyarrow.string()}
    known.update(
        {"signal": pyarrow.list_(pyarrow.float32()), "sized_verdict": pyarrow.string(), "sized_kind": pyarrow.string()}
    )
    known.update({"kind": pyarrow.string(), "label_kind": pyarrow.string()})
    known["label_speed_profile"] = pyarrow.string()
    keys = dict.fromkeys(itertools.chain.from_iterable(runs))
    known.update({key: pyarrow.string() for run in runs for key, value in run.items() if isinstance(value, str)})
    names = ["run", "fmu", *keys, *LABELS, *sweep_signals.FEATURES, *(SIZED if options["size"] else [])]
    names += [*(["signal"] if options["signals"] else []), "error", "cpu_s"]
    return pyarrow.schema([(name, known.get(name, pyarrow.float64())) for name in names])


def write_part(rows, schema, folder):
    with bearing.whole(folder / f"part-{rows[0]['run']:07d}-{time.time_ns()}.parquet") as fresh:
        parquet.write_table(pyarrow.Table.from_pylist(rows, schema=schema), fresh)


def collect(client, runs, names, options, folder, every=50, at_result=lambda count: None):
    """Gives the missing runs to the workers, a few ahead of what they can do, and writes what comes back."""
    done = done_already(folder)
    missing = [index for index in range(len(runs)) if index not in done]
    waiting, schema = iter(missing), columns(runs, options)
    rows, count, failed, begin, written = [], 0, 0, time.perf_counter(), time.perf_counter()

    def give(how_many):
        # The key names the run: a result that a lost worker took with it is computed again under the same key.
        return [
            client.submit(simulate, i, names[i], runs[i], options, key=f"run-{i}", pure=False)
            for i in itertools.islice(waiting, how_many)
        ]

    flowing = as_completed(give(4 * max(2, sum(client.nthreads().values()))))
    try:
        for future in flowing:
            index = int(future.key.removeprefix("run-"))
            try:
                # Waits when the worker was lost after it had said that it was done: the run is made again elsewhere.
                row = future.result()
            except Exception as error:  # the run ended its worker more often than dask allows
                row = {"run": index, "fmu": names[index], **runs[index], "error": repr(error)}
            if options.get("write") and "signal" in row:
                sweep_signals.write(row["signal"], options["rate"], folder / f"run-{index:07d}", options["write"])
            if not options["signals"]:
                row.pop("signal", None)
            rows.append(row)
            future.release()
            for fresh in give(1):
                flowing.add(fresh)
            count += 1
            failed += row["error"] is not None
            if len(rows) >= every or time.perf_counter() - written > 10.0:
                write_part(rows, schema, folder)
                rows, written = [], time.perf_counter()
            bar(count, len(missing), failed, time.perf_counter() - begin)
            at_result(count)
    finally:
        if rows:
            write_part(rows, schema, folder)
    return count, failed, time.perf_counter() - begin


def bar(count, total, failed, seconds):
    full = 30 * count // total
    end = "\n" if count == total else ""
    text = f"\r[{'#' * full}{' ' * (30 - full)}] {count}/{total} runs, {failed} failed, {count / seconds:.1f} runs/s"
    print(text, end=end, file=sys.stderr, flush=True)


def refuse_another_design(folder, text):
    """Refuses to mix two designs in one folder."""
    path = folder / "design.json"
    if path.exists() and path.read_text(encoding="utf-8") != text:
        sys.exit(f"{path} says that the folder holds another design: choose another folder, or take this one away")


def main(arguments=None):
    parser = sweep_options.parser()
    chosen = parser.parse_args(arguments)
    sweep_options.check(parser, chosen)
    grid, random = dict(chosen.grid), dict(chosen.random)
    kinds = chosen.kinds.split(",") if chosen.kinds else []
    if unknown := [kind for kind in kinds if kind not in KINDS]:
        parser.error(f"--kinds: {unknown[0]} is none of {', '.join(KINDS)}")
    speeds = {} if chosen.speed_profile else {"shaft.speed_hz": (8.0, 40.0)}
    if not grid and not random and kinds:
        grid = {"defect.length_mm": [0.4, 0.8, 1.6], "defect.depth_um": [30.0, 100.0]}
        random = {"shaft.load_n": (300.0, 1500.0), **speeds, "defect.angle_deg": (-120.0, -60.0)}
    elif not grid and not random:
        grid = {"defect.length_deg": [2.0, 5.0, 10.0, 15.8], "defect.depth_um": [20.0, 50.0, 100.0]}
        random = {"shaft.load_n": (300.0, 1500.0), **speeds}
    if chosen.noise_db:
        random["noise_db"] = chosen.noise_db
    try:
        profiles = {path.stem: sweep_signals.speed_profile(path, chosen.stop) for path in chosen.speed_profile}
    except (OSError, ValueError) as error:
        parser.error(str(error))
    counts = bearing.whole_numbers(chosen.base)
    random = {key: limits if key in counts else tuple(map(float, limits)) for key, limits in random.items()}
    runs = design(chosen.runs, grid, random, chosen.seed, kinds, list(profiles))
    names = ("stop", "settle", "rate", "signals", "size", "filter", "write", "seed")
    told = {**{name: getattr(chosen, name) for name in names}, "profiles": profiles}
    chosen.output.mkdir(parents=True, exist_ok=True)
    scene = chosen.base.read_text(encoding="utf-8")
    design_of = {
        "grid": grid,
        "random": random,
        "seed": chosen.seed,
        "options": told,
        "kinds": kinds,
        "law": chosen.law,
    }
    text = json.dumps({"scene": scene, **design_of}, indent=1)
    refuse_another_design(chosen.output, text)
    try:
        recorder = chosen.rate if chosen.filter else None
        paths, names = prepare(chosen.base, runs, chosen.output / "fmu", chosen.law, recorder)
    except subprocess.CalledProcessError:
        sys.exit("the FMUs were not built: the program says why above")
    # Only now: a design that cannot be built is none that the folder holds.
    with bearing.whole(chosen.output / "design.json") as part:
        part.write_text(text, encoding="utf-8")
    cluster = chosen.scheduler or LocalCluster(
        n_workers=chosen.workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
    )
    with Client(cluster) as client:
        client.register_plugin(Bearings(paths, bearing.__file__, bearing.executable()))
        count, failed, seconds = collect(client, runs, names, told, chosen.output)
    if not chosen.scheduler:
        cluster.close()
    size = sum(part.stat().st_size for part in chosen.output.glob("part-*.parquet"))
    said = {"runs": count, "failed": failed, "seconds": round(seconds, 2), "bytes": size, "folder": str(chosen.output)}
    if chosen.size:
        parts = [parquet.read_table(part, columns=["sized_verdict"]) for part in chosen.output.glob("part-*.parquet")]
        said["sized"] = sum(part.num_rows - part["sized_verdict"].null_count for part in parts)
        said["resolved"] = sum(part["sized_verdict"].to_pylist().count("resolved") for part in parts)
    print(json.dumps(said))


if __name__ == "__main__":
    main()
