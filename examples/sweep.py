#!/usr/bin/env python3
"""Thousands of runs over length, depth, load and speed of a defect, on all cores or a cluster, into Parquet.

    python examples/sweep.py --runs 500 --seed 1 [--workers 2] [-o target/sweep]
        --grid defect.length_deg=2,5,10,15.8 --grid defect.depth_um=20,50,100
        --random shaft.load_n=300:1500 --random shaft.speed_hz=8:40
    python examples/sweep.py --kinds healthy,outer,inner,element --law hertz --signals …       labelled classes
    python examples/sweep.py --scheduler tcp://127.0.0.1:8786 …     on a dask cluster that runs already

Run i takes the grid's point i modulo its size and random values that depend on seed and i alone: the same design to the
bit on any machine, and a longer one begins with the shorter. What an FMU can be told costs a run 0.1 ms (load, speed,
slip, first angle), the clearance 2.6 s of a core where the law is `map`: the FMU computes its contact map anew. Other
keys of the scene make one FMU per grid point, so let them be on the grid.

With `--kinds` runs take the kinds of fault in turn, each at every point of the grid. Each row says in its label_…
columns what it is a run of: kind, length, depth and position of the defect, load and speed. Under law `map` each size of a
defect inside needs a map of some minutes; `--law hertz` needs none.

FMUs are built once and shipped to each worker once, also to one that starts later; a worker keeps one instance per FMU
and resets it between runs. Results go to part-*.parquet in the output folder as they come; started again, the
sweep does what is missing. A run that fails has its error in the column `error`, and the others go on.
"""

import argparse
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
from bearing import tomllib
from dask.distributed import Client, LocalCluster, WorkerPlugin, as_completed, get_worker

# What an instance is told: scene key → variable, factor.
TOLD = {
    "shaft.load_n": ("shaft.load.y", -1.0),  # downwards
    "shaft.speed_hz": ("shaft.speed", 2 * np.pi),
    "bearing.radial_clearance_um": ("bearing.radial_clearance", 1e-6),
    "cage.slip": ("cage.slip", 1.0),
    "cage.initial_angle_deg": ("cage.initial_angle", np.pi / 180),
    "defect.angle_deg": ("defect.angle", np.pi / 180),
}
# What a kind of fault is in the scene.
KINDS = {
    "healthy": {"defect": None},
    "outer": {"defect.on": "outer"},
    "inner": {"defect.on": "inner"},
    "element": {"defect.on": "element", "defect.element": 1},
}
LABELS = ["label_kind", "label_length_mm", "label_depth_um", "label_angle_deg", "label_load_n", "label_speed_hz"]
# Maps for many defects are coarser than that of one studied closely: 0.4 % of the largest force, for a third of the
# time.
MAP_ACCURACY = 4e-3
HARMONICS = 5
FEATURES = ["bpfo_hz", "rms_m_s2", "kurtosis", *(f"envelope_{k}_bpfo_m_s2" for k in range(1, HARMONICS + 1))]
FEATURES += ["unloaded_s", "loaded_again_s", "unloaded_deg"]
SIZED = ["sized_verdict", "sized_length_mm", "sized_uncertainty_mm", "sized_kind"]


def design(count, grid, random, seed, kinds=()):
    """The runs: a list of {key: value}."""
    points = [dict(zip(grid, values)) for values in itertools.product(*grid.values())]
    if kinds:
        points = [{"kind": kind, **point} for point in points for kind in kinds]
    runs = []
    for index in range(count):
        # One draw per key, from a stream of this run's own.
        draws = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, index]))).random(len(random))
        values = {key: low + (high - low) * float(draw) for (key, (low, high)), draw in zip(random.items(), draws)}
        runs.append({**points[index % len(points)], **values})
    return runs


def is_told(key, run):
    """Whether an instance is told a key of this run, and not the scene that its FMU is made of."""
    return key in TOLD or key == "kind" or (run.get("kind") == "healthy" and key.startswith("defect."))


def changes(run):
    """What a run changes in the scene."""
    built_in = {key: value for key, value in run.items() if not is_told(key, run)}
    # The base scene's length may be in the other unit.
    given = {"defect.length_mm", "defect.length_deg"} & set(built_in)
    if given:
        built_in = {"defect.length_mm": None, "defect.length_deg": None, **built_in}
    return {**KINDS.get(run.get("kind"), {}), **built_in}


def prepare(base, runs, folder, law=None):
    """Builds one FMU for each set of values that an instance cannot be told. Gives {name: path}, name of each run."""
    names, scenes = [], {}
    contact = tomllib.loads(Path(base).read_text(encoding="utf-8")).get("contact", {})
    law = law or contact.get("law", "map")
    all_runs = {"contact.law": law, **({"contact.map_accuracy": MAP_ACCURACY} if law == "map" else {})}
    for run in runs:
        values = [f"{value:g}".replace(".", "p") for key, value in run.items() if not is_told(key, run)]
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
    row["label_kind"] = "healthy" if defect is None else "several" if isinstance(defect, list) else defect.get("on", "outer")
    if isinstance(defect, dict):
        length = defect.get("length_mm")
        if length is None and "length_deg" in defect:
            length = float(np.radians(defect["length_deg"]) * radius_mm(scene["bearing"], row["label_kind"]))
        row["label_length_mm"], row["label_depth_um"] = length, defect.get("depth_um")
        row["label_angle_deg"] = run.get("defect.angle_deg", defect["angle_deg"])
    return row


def radius_mm(dimensions, kind):
    """Radius of the body that bears a defect, at the groove's bottom or on the element's track."""
    pitch, element = dimensions["pitch_diameter_mm"], dimensions["element_diameter_mm"]
    clearance = dimensions.get("radial_clearance_um", 0.5 * dimensions.get("internal_clearance_um", 10.0)) * 1e-3
    return 0.5 * {"outer": pitch + element + clearance, "inner": pitch - element - clearance, "element": element}[kind]


class Bearings(WorkerPlugin):
    """Lives on a worker: the FMUs' files, one instance of each, and the module that drives them.

    The module comes with the plugin and is imported only after `setup`: a worker that joins later unpacks all its plugins
    at once, before a file that was uploaded for it is there.
    """

    name = "bearings"

    def __init__(self, paths, module, program=None):
        self.program = program
        self.module = Path(module).read_bytes()
        self.files = {name: Path(path).read_bytes() for name, path in paths.items()}
        self.scenes = {name: Path(path).with_suffix(".toml").read_text(encoding="utf-8") for name, path in paths.items()}

    def setup(self, worker):
        self.folder = Path(worker.local_directory) / "bearings"
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / "bearing.py").write_bytes(self.module)
        sys.path.insert(0, str(self.folder))
        sys.modules.pop("bearing", None)  # an earlier sweep's
        self.instances = {}

    def teardown(self, worker):
        sys.path.remove(str(self.folder))
        shutil.rmtree(self.folder, ignore_errors=True)

    def instance(self, name):
        from bearing import Instance

        if name not in self.instances:
            path = self.folder / f"{name}.fmu"
            path.write_bytes(self.files[name])
            self.instances[name] = Instance(str(path))
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
        bearings = get_worker().plugins[Bearings.name]
        row.update(label(bearings.scene(name), values))
        row.update(run_one(bearings.instance(name), values, options))
        if options["size"]:
            row.update(bearings.sized(index, name, values, row["signal"], options))
    except Exception as error:  # whatever it is, the other runs go on
        row["error"] = f"{type(error).__name__}: {error}"
    if not options["signals"]:
        row.pop("signal", None)
    row["cpu_s"] = time.process_time() - begin
    return row


def run_one(instance, values, options):
    """Steps an instance that is reset, and gives the features of what the sensor shows."""
    from bearing import Numbers  # not above: the scheduler unpacks this function too, and has no such module

    told = {TOLD[key][0]: TOLD[key][1] * value for key, value in values.items() if key in TOLD}
    instance.enter({name: value for name, value in told.items() if name in instance.reference})
    instance.run()
    count = sum(name.endswith(".path") for name in instance.reference)
    elements = [f"element[{j}].{what}" for what in ("angle", "force.outer") for j in range(1, count + 1)]
    seen = Numbers(instance, ["sensor.acceleration", "cage.speed", *elements])
    slave, h = instance.slave, 1.0 / options["rate"]
    table = np.empty((round(options["stop"] * options["rate"]), len(seen.array)))
    for index in range(len(table)):
        instance.step(h)
        slave.fmi2GetReal(*seen.arguments)
        table[index] = seen.array
    t = h * np.arange(1, len(table) + 1)
    late = t > options["settle"]
    signal = table[late, 0]
    row = features(signal, options["rate"], count * table[-1, 1] / (2 * np.pi))
    # Where elements pass a defect of the outer raceway is known from their angles alone.
    outer = "defect.angle" in instance.reference and not {"shaft.angle", "housing.angle"} & set(instance.reference)
    outer = outer and not any(name.endswith(".spin_angle") for name in instance.reference)
    defect = instance.read(["defect.angle"])[0] if outer else None
    if defect is not None:
        row.update(passage(t, table[:, 2 : 2 + count], table[:, 2 + count :], defect, options["settle"]))
    row["signal"] = signal.astype(np.float32)
    return row


def features(signal, rate, bpfo):
    """RMS [m/s²], kurtosis, and the envelope's amplitudes at multiples of the passage frequency [m/s²]."""
    signal = signal - signal.mean()
    rms = float(np.sqrt(np.mean(signal**2)))
    spectrum = np.fft.fft(signal)
    spectrum[1 : (len(signal) + 1) // 2] *= 2
    spectrum[len(signal) // 2 + 1 :] = 0
    envelope = np.abs(np.fft.ifft(spectrum))
    window = np.hanning(len(signal))
    t = np.arange(len(signal)) / rate
    row = {"bpfo_hz": bpfo, "rms_m_s2": rms, "kurtosis": float(np.mean(signal**4) / rms**4)}
    weighed = window * (envelope - envelope.mean()) * 2 / window.sum()
    for k in range(1, HARMONICS + 1):
        row[f"envelope_{k}_bpfo_m_s2"] = float(np.abs(weighed @ np.exp(-2j * np.pi * k * bpfo * t)))
    return row


def passage(t, angles, forces, defect, settle):
    """The first passage after settling: when an element loses and regains half its force over the defect [s].

    `unloaded_deg` is how far it goes in between: a lower bound of a line spall's length.
    """
    for j in range(angles.shape[1]):
        normal = np.median(forces[:, j][forces[:, j] > 0]) if np.any(forces[:, j] > 0) else 0.0
        away = (angles[:, j] - defect + np.pi) % (2 * np.pi) - np.pi
        near = np.abs(away) < 0.75 * np.pi / angles.shape[1] + 0.3
        light = near & (forces[:, j] < 0.5 * normal) & (t > settle)
        begins = np.flatnonzero(light[1:] & ~light[:-1] & near[:-1]) + 1
        for first in begins:
            again = first + np.flatnonzero(~light[first:])
            if again.size and near[again[0]] and t[first] - settle < 0.5 * (t[-1] - settle):
                turned = angles[again[0], j] - angles[first, j]
                return {
                    "unloaded_s": float(t[first]), "loaded_again_s": float(t[again[0]]),
                    "unloaded_deg": float(np.degrees(turned)),
                }
    return {"unloaded_s": None, "loaded_again_s": None, "unloaded_deg": None}


def done_already(folder):
    """Numbers of the runs that the folder has."""
    done = set()
    for part in sorted(folder.glob("part-*.parquet")):
        done.update(parquet.read_table(part, columns=["run"])["run"].to_pylist())
    return done


def columns(runs, options):
    """Every part has the same columns, whatever its runs."""
    known = {"run": pyarrow.int64(), "fmu": pyarrow.string(), "error": pyarrow.string()}
    known.update({"signal": pyarrow.list_(pyarrow.float32()), "sized_verdict": pyarrow.string(), "sized_kind": pyarrow.string()})
    known.update({"kind": pyarrow.string(), "label_kind": pyarrow.string()})
    keys = dict.fromkeys(itertools.chain.from_iterable(runs))
    names = ["run", "fmu", *keys, *LABELS, *FEATURES, *(SIZED if options["size"] else [])]
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


def same_design(folder, **design):
    """Refuses to mix two designs in one folder."""
    text = json.dumps(design, indent=1)
    path = folder / "design.json"
    if path.exists() and path.read_text(encoding="utf-8") != text:
        sys.exit(f"{path} says that the folder holds another design: choose another folder, or take this one away")
    with bearing.whole(path) as part:
        part.write_text(text, encoding="utf-8")


def pair(text):
    key, _, value = text.partition("=")
    return key, value


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--base", type=Path, default=bearing.SCENES / "er16k-tb1.toml", help="scene that the runs change")
    parser.add_argument("--grid", action="append", default=[], metavar="KEY=V,V,…", help="values of a scene key")
    parser.add_argument("--random", action="append", default=[], metavar="KEY=LOW:HIGH", help="range of a scene key")
    parser.add_argument("--kinds", help="kinds of fault to take in turn, of " + ",".join(KINDS))
    parser.add_argument("--law", choices=["hertz", "map", "love"], help="contact law near defects; default: the scene's")
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stop", type=float, default=0.3, help="end of each run [s]")
    parser.add_argument("--settle", type=float, default=0.05, help="left out of the features [s]")
    parser.add_argument("--rate", type=float, default=51200.0, help="samples per second")
    parser.add_argument("--signals", action="store_true", help="keep the sensor's signal of each run")
    parser.add_argument("--size", action="store_true", help="size the spall from each signal: some 15 s of a core per run; "
                        "`cargo fmu` as built here must be at the same place on each worker")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--scheduler", help="address of a dask scheduler; default: workers of our own")
    parser.add_argument("-o", "--output", type=Path, default=Path("target/sweep"))
    chosen = parser.parse_args(arguments)
    grid = {key: [float(v) for v in values.split(",")] for key, values in map(pair, chosen.grid)}
    random = {key: tuple(float(v) for v in values.split(":")) for key, values in map(pair, chosen.random)}
    kinds = chosen.kinds.split(",") if chosen.kinds else []
    if unknown := [kind for kind in kinds if kind not in KINDS]:
        parser.error(f"--kinds: {unknown[0]} is none of {', '.join(KINDS)}")
    if not grid and not random and kinds:
        grid = {"defect.length_mm": [0.4, 0.8, 1.6], "defect.depth_um": [30.0, 100.0]}
        random = {"shaft.load_n": (300.0, 1500.0), "shaft.speed_hz": (8.0, 40.0), "defect.angle_deg": (-120.0, -60.0)}
    elif not grid and not random:
        grid = {"defect.length_deg": [2.0, 5.0, 10.0, 15.8], "defect.depth_um": [20.0, 50.0, 100.0]}
        random = {"shaft.load_n": (300.0, 1500.0), "shaft.speed_hz": (8.0, 40.0)}
    runs = design(chosen.runs, grid, random, chosen.seed, kinds)
    options = {name: getattr(chosen, name) for name in ("stop", "settle", "rate", "signals", "size")}
    chosen.output.mkdir(parents=True, exist_ok=True)
    scene = chosen.base.read_text(encoding="utf-8")
    design_of = {"grid": grid, "random": random, "seed": chosen.seed, "options": options, "kinds": kinds, "law": chosen.law}
    same_design(chosen.output, scene=scene, **design_of)
    paths, names = prepare(chosen.base, runs, chosen.output / "fmu", chosen.law)
    cluster = chosen.scheduler or LocalCluster(
        n_workers=chosen.workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
    )
    with Client(cluster) as client:
        client.register_plugin(Bearings(paths, bearing.__file__, bearing.executable()))
        count, failed, seconds = collect(client, runs, names, options, chosen.output)
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
