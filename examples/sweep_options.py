"""What a sweep can be told, and what it refuses before anything is built."""

import argparse
import os
import sys
from pathlib import Path

import bearing
import numpy as np
import sweep_signals
from sweep_signals import TOLD

# What a kind of fault is in the scene.
KINDS = {
    "healthy": {"defect": None},
    "outer": {"defect.on": "outer"},
    "inner": {"defect.on": "inner"},
    "element": {"defect.on": "element", "defect.element": 1},
}
# What a run is told that is no key of a scene.
OF_RUNS = ("kind", "speed_profile", "noise_db")


def number(text):
    """A whole number, another one, or None."""
    for kind in (int, float):
        try:
            value = kind(text)
            return value if np.isfinite(value) else None
        except ValueError:
            pass
    return None


def grid_of(text):
    """Key and values of `KEY=V,V,…`: numbers, or words where the key takes words."""
    key, equals, values = text.partition("=")
    if not (key and equals and values):
        raise argparse.ArgumentTypeError(f"{text!r}: it must be KEY=V,V,…")
    found = [value if (numeric := number(value)) is None else numeric for value in values.split(",")]
    words = [value for value in found if isinstance(value, str)]
    if words and (key in TOLD or "" in words):
        raise argparse.ArgumentTypeError(f"{key}: {words[0]!r} is no number")
    return key, found


def range_of(text):
    """Key and limits of `KEY=LOW:HIGH`."""
    key, _, values = text.partition("=")
    return key, limits_of(values, text)


def limits_of(values, text):
    limits = [number(value) for value in values.split(":")]
    if len(limits) != 2 or None in limits or limits[0] > limits[1]:
        raise argparse.ArgumentTypeError(f"{text!r}: it must be two numbers LOW:HIGH, the lower one first")
    return tuple(limits)


def noise_of(text):
    """A ratio, or the limits of one [dB]."""
    limits = limits_of(text if ":" in text else f"{text}:{text}", text)
    if not -60 <= limits[0] <= limits[1] <= 200:
        raise argparse.ArgumentTypeError(f"{text!r}: a signal-to-noise ratio must be from -60 to 200 dB")
    return tuple(map(float, limits))


def parser():
    parser = argparse.ArgumentParser(
        description="Thousands of runs over a design, on all cores or a cluster, into Parquet."
    )
    add = parser.add_argument
    add("--base", type=Path, default=bearing.SCENES / "er16k-tb1.toml", help="scene that the runs change")
    add("--grid", action="append", default=[], type=grid_of, metavar="KEY=V,V,…", help="values of a scene key")
    add("--random", action="append", default=[], type=range_of, metavar="KEY=LOW:HIGH", help="range of a scene key")
    add("--kinds", help="kinds of fault to take in turn, of " + ",".join(KINDS))
    add("--law", choices=["hertz", "map", "love"], help="contact law near defects; default: the scene's")
    add("--speed-profile", action="append", default=[], type=Path, metavar="FILE",
        help="the shaft's speed over time: CSV with time_s, speed_hz; several are taken in turn")
    add("--noise-db", type=noise_of, metavar="DB", help="signal-to-noise ratio, or a range LOW:HIGH of it")
    add("--runs", type=int, default=20)
    add("--seed", type=int, default=1)
    add("--stop", type=float, default=0.3, help="end of each run [s]")
    add("--settle", type=float, default=0.05, help="left out of signals and features [s]")
    add("--rate", type=float, default=51200.0, help="samples per second")
    add("--filter", action="store_true", help="take the sensor's samples through the recorder's filter against aliases")
    add("--signals", action="store_true", help="keep the sensor's signal of each run in its row")
    add("--write", type=lambda text: text.split(","), default=[], metavar="wav,npy", help="and write it as such files")
    add("--size", action="store_true", help="size the spall from each signal: some 15 s of a core per run; "
        "`cargo fmu` as built here must be at the same path on each worker")
    add("--workers", type=int, default=os.cpu_count())
    add("--scheduler", help="address of a dask scheduler; default: workers of our own")
    add("-o", "--output", type=Path, default=Path("target/sweep"))
    return parser


def check(parser, chosen):
    """Refuses what cannot be run, before anything is built."""
    for name, least in (("runs", 1), ("workers", 1), ("seed", 0)):
        if getattr(chosen, name) < least:
            parser.error(f"--{name} is {getattr(chosen, name)}: it must be at least {least}")
    if not 0 <= chosen.settle < chosen.stop:
        parser.error(f"--settle is {chosen.settle} s: it must be from 0 to below --stop, {chosen.stop} s")
    if not 100 <= chosen.rate <= 1e6:
        parser.error(f"--rate is {chosen.rate} Hz: it must be from 100 to 1000000")
    if unknown := [kind for kind in chosen.write if kind not in ("wav", "npy")]:
        parser.error(f"--write: {unknown[0]!r} is none of wav, npy")
    if "wav" in chosen.write and chosen.rate != round(chosen.rate):
        parser.error(f"--rate is {chosen.rate} Hz: a WAV file holds a whole number of samples per second")
    if not chosen.base.is_file():
        parser.error(f"--base {chosen.base}: there is no such scene file")
    keys = [key for key, _ in [*chosen.grid, *chosen.random]]
    if twice := [key for key in keys if keys.count(key) > 1]:
        parser.error(f"{twice[0]} is given twice")
    if {"defect.length_mm", "defect.length_deg"} <= set(keys):
        parser.error("defect.length_mm and defect.length_deg exclude each other: give only one")
    if chosen.speed_profile and "shaft.speed_hz" in keys:
        parser.error("shaft.speed_hz and --speed-profile exclude each other: give only one")
    if chosen.speed_profile and chosen.size:
        parser.error("--size takes one speed for each run: leave out --speed-profile")
    if chosen.rate < sweep_signals.ENOUGH_WITHOUT_FILTER and not chosen.filter:
        print(
            f"note: {chosen.rate:g} Hz without --filter: what is above {chosen.rate / 2:g} Hz is folded",
            file=sys.stderr,
        )
