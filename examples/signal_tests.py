#!/usr/bin/env python3
"""What makes a scene's signals grow, scatter and ring as a machine's do: one change at a time, at 10, 15 and 20 Hz.

    python examples/signal_tests.py [--seconds 2.5] [--workers 2] [-o target/signals] [GROUP …]

Groups: `added`, single changes of 6205-spall-5deg; `surface`, oil and soft edges in that scene, and edges and floor
that vary across the track (rough_spall.py); `taken`, 6205-spall-5deg-machine with one of its parts put back;
`irregular`, that scene without lobes and with an even cage, and one irregularity at a time. Facts are those of
signal_facts.py; the first 0.3 s of a run are left out. Markdown.
"""

import argparse
import concurrent.futures
import os
import subprocess

import numpy as np
import rough_spall
import signal_facts
from bearing import ROOT, SCENES, changed_scene, program

OLD, NEW = SCENES / "6205-spall-5deg.toml", SCENES / "6205-spall-5deg-machine.toml"
SPEEDS = (10.0, 15.0, 20.0)
RATE = 51200.0
SETTLING = 0.3
HERTZ = {"contact.law": "hertz"}
FLANKS = {"defect.length_deg": 5.8, "defect.depth_um": 12.0, "defect.edge_slope_deg": 4.18}
LOAD = {"shaft.load_n": [0.0, -150.0]}
LIGHT = {"shaft.mass_kg": 0.2, "housing.mass_kg": 1.36}
SUPPORT = {"housing.stiffness_n_m": 6.5e6, "housing.damping_n_s_m": 287.0}
SPALL = {"on": "outer", "angle_deg": -90.0, "profile": "6205-machine-spall.csv"}
LOBES = {"on": "inner", "angle_deg": 0.0, "profile": "6205-machine-lobes.csv"}
SHARP = {"on": "outer", "angle_deg": -90.0, "length_deg": 5.0, "depth_um": 15.0, "edge_slope_deg": 90.0}
MODES = [
    {"frequency_hz": 1200.0, "damping_ratio": 0.04, "gain": 0.35},
    {"frequency_hz": 1750.0, "damping_ratio": 0.04, "gain": -0.35},
    {"frequency_hz": 9800.0, "damping_ratio": 0.035, "gain": 1.3},
]
EVEN = {"cage.irregularity": None, "defect": [SPALL]}

# Oil and elements that bounce without it: 40 mPa s and 2e-8 1/Pa are assumed, a mineral oil of about 46 mm2/s at 40
# degrees.
OIL = {"film.viscosity_pa_s": 0.04, "film.pressure_viscosity_1_pa": 2e-8}
DRY = {"contact.damping_chi_s_m": 0.5}

# Group: base scene, and what is changed in it, one line of the table each. A surface is what rough_spall.profile takes:
# edges [mm], floor [um], seed; a swing is a share of the speed and how often a turn it swings.
GROUPS = {
    "added": (
        OLD,
        {
            "6205-spall-5deg": {},
            "law hertz; the same below": HERTZ,
            "flanks of 4.2°, floor 12 µm down": {**HERTZ, **FLANKS},
            "rounded spall of the new scene": {**HERTZ, "defect": SPALL},
            "floor 5 µm down": {**HERTZ, "defect.depth_um": 5.0},
            "floor 100 µm down": {**HERTZ, "defect.depth_um": 100.0},
            "load 150 N": {**HERTZ, **LOAD},
            "load 400 N": {**HERTZ, "shaft.load_n": [0.0, -400.0]},
            "load 1000 N": {**HERTZ, "shaft.load_n": [0.0, -1000.0]},
            "preload, clearance −2 µm": {**HERTZ, "bearing.radial_clearance_um": -2.0},
            "clearance 15 µm": {**HERTZ, "bearing.radial_clearance_um": 15.0},
            "contact damping χ 0.5 s/m": {**HERTZ, "contact.damping_chi_s_m": 0.5},
            "contact damping χ 100 s/m": {**HERTZ, "contact.damping_chi_s_m": 100.0},
            "rings of 0.2 and 1.36 kg": {**HERTZ, **LIGHT},
            "shaft of 6.5 kg": {**HERTZ, "shaft.mass_kg": 6.5},
            "support of the new scene": {**HERTZ, **SUPPORT},
            "modes of the structure": {**HERTZ, "sensor.mode": MODES},
            "cage as recorded": {**HERTZ, "cage.irregularity": "recorded", "cage.seed": 1},
            "rounded spall, load 150 N": {**HERTZ, **LOAD, "defect": SPALL},
            "the same, light rings": {**HERTZ, **LOAD, **LIGHT, "defect": SPALL},
        },
    ),
    "surface": (
        OLD,
        {
            "oil": OIL,
            "oil, χ 0.5 s/m": {**OIL, **DRY},
            "edges of a step": {"contact.edge": "step"},
            "straight edges, even floor, as a topography": {"surface": (0.0, 0.0, 1)},
            "edges ± 0.1 mm across the track": {"surface": (0.1, 0.0, 1)},
            "edges ± 0.3 mm, seed 1": {"surface": (0.3, 0.0, 1)},
            "edges ± 0.3 mm, seed 2": {"surface": (0.3, 0.0, 2)},
            "edges ± 0.3 mm, seed 3": {"surface": (0.3, 0.0, 3)},
            "floor ± 1 µm": {"surface": (0.0, 1.0, 1)},
            "floor ± 5 µm": {"surface": (0.0, 5.0, 1)},
            "edges ± 0.1 mm, floor ± 1 µm, another seed": {"surface": (0.1, 1.0, 2)},
        },
    ),
    "taken": (
        NEW,
        {
            "6205-spall-5deg-machine": {},
            "sharp edges, floor 15 µm down": {"defect": [SHARP, LOBES]},
            "load 49 N": {"shaft.load_n": [0.0, -49.0]},
            "rings of 0.6 and 2 kg": {"shaft.mass_kg": 0.6, "housing.mass_kg": 2.0},
            "old support": {"housing.stiffness_n_m": 1.51056e7, "housing.damping_n_s_m": 2210.7},
            "no modes of the structure": {"sensor.mode": None},
            "without 1200 Hz": {"sensor.mode": MODES[1:]},
            "without 1750 Hz": {"sensor.mode": MODES[::2]},
            "without 9800 Hz": {"sensor.mode": MODES[:2]},
            "contact damping χ 20 s/m": {"contact.damping_chi_s_m": 20.0},
            "no lobes": {"defect": [SPALL]},
            "even cage": {"cage.irregularity": None},
        },
    ),
    "irregular": (
        NEW,
        {
            "even cage, no lobes": EVEN,
            "spacing 0.6 %": {**EVEN, "cage.spacing_rms_deg": 0.24, "cage.seed": 1},
            "spacing 3 %": {**EVEN, "cage.spacing_rms_deg": 1.2, "cage.seed": 1},
            "jitter 0.4 %": {**EVEN, "cage.jitter_rms_deg": 0.16, "cage.seed": 1},
            "wander 0.3 %": {**EVEN, "cage.wander": 0.003, "cage.seed": 1},
            "bouncing elements, χ 0.5 s/m": {**EVEN, "contact.damping_chi_s_m": 0.5},
            "lobes alone": {"cage.irregularity": None},
            "speed ± 1 % once a turn": {**EVEN, "swing": (0.01, 1)},
            "speed ± 1 % three times a turn": {**EVEN, "swing": (0.01, 3)},
        },
    ),
}


def run(scene, seconds, more=()):
    """The sensor's signal of a scene."""
    command = [*program(), "run", str(scene.resolve()), "--stop", str(seconds), "--step", "0.01", "--no-figure", *more]
    subprocess.run([*command, "-o", str(scene.resolve().parent)], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return signal_facts.load(scene.with_suffix(".npy"))[round(SETTLING * RATE) :]


def swinging(path, speed, share, times, seconds):
    """Writes a speed that swings by a share of it, so many times a turn; gives the file as `run` takes it."""
    time = np.arange(0.0, seconds + 0.05, 1.0 / (24 * times * speed))
    speeds = speed * (1.0 + share * np.sin(2 * np.pi * times * speed * time))
    np.savetxt(path, np.column_stack([time, speeds]), "%.9g", ",", header="time_s,speed_hz", comments="")
    return ["--speed-profile", str(path.resolve())]


def jobs_of(case, name, base, options, pool):
    """One run of a case at each speed."""
    changes = {key: value for key, value in case.items() if key not in ("surface", "swing")}
    if "surface" in case:
        changes.update(rough_spall.profile(options.output, *case["surface"], name))
    jobs = []
    for speed in SPEEDS:
        told = {"recorder.rate_hz": RATE, "shaft.speed_hz": speed, **changes}
        scene = changed_scene(base, f"{name}-{speed:.0f}", told, options.output)
        swing = (
            swinging(scene.with_suffix(".speed.csv"), speed, *case["swing"], options.seconds) if "swing" in case else []
        )
        jobs.append(pool.submit(run, scene, options.seconds, swing))
    return jobs


def line(label, signals):
    """One line of the table."""
    found = [signal_facts.facts(signal, RATE, speed) for signal, speed in zip(signals, SPEEDS)]
    three = lambda form, key, factor=1.0: " / ".join(format(factor * one[key], form) for one in found)  # noqa: E731
    shares = " / ".join(f"{one['_shares'][0]:.1f}+{one['_shares'][1]:.1f}" for one in found)
    growth = signal_facts.growth(SPEEDS, found)
    return (
        f"| {label} | {growth:.2f} | {three('.2f', 'entry_ms')} | {three('.2f', 'scatter')} "
        f"| {shares if min(one['scatter'] for one in found) > 0.03 else '–'} | {three('.1f', '5 to 10 kHz', 100)} "
        f"| {three('.0f', 'crest')} | {three('.0f', 'kurtosis')} |"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("groups", nargs="*", metavar="GROUP", help="added, surface, taken, irregular; all without it")
    parser.add_argument("--seconds", type=float, default=2.5)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("-o", "--output", default="target/signals")
    options = parser.parse_args()
    head = "| RMS grows with the power | rise of the entry (ms) | scatter | of it cage + shaft "
    head += "| 5 to 10 kHz (%) | crest | kurtosis |"
    with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
        for group in options.groups or GROUPS:
            base, cases = GROUPS[group]
            jobs = [jobs_of(case, f"{group}-{i}", base, options, pool) for i, case in enumerate(cases.values())]
            print(f"\n| {base.stem} {head}\n|---|---:|---|---|---|---|---|---|")
            for label, signals in zip(cases, jobs):
                print(line(label, [job.result() for job in signals]), flush=True)


if __name__ == "__main__":
    main()
