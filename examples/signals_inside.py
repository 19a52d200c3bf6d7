#!/usr/bin/env python3
"""Facts of signals of a spalled inner raceway, of recordings and of scenes with one part changed at a time.

    python examples/signals_inside.py recorded FILE.npy@HZ …
    python examples/signals_inside.py added|taken [--program target/debug/brinell]

Definitions, the mean taken off: growth is the slope of ln RMS over ln speed; bands are shares of the spectrum;
a passage is a window of one BPFI period that begins 35 % of it before the loudest part of the mean envelope (1 to
20 kHz); strong over weak is the 90 % over the 10 % quantile of the passages' RMS; crest and excess kurtosis are those of
the whole signal; by shaft and by element are the shares of the variance of the passages' RMS that nine harmonics of the
shaft's angle explain, and that the element's number explains. Runs are 2 s long after 0.3 s. Needs numpy and scipy.
"""

import argparse
import concurrent.futures
import subprocess

import numpy as np
from bearing import ROOT, SCENES, changed_scene
from scipy.signal import butter, hilbert, sosfiltfilt

RATE, ORDER, ELEMENTS, SPEEDS, SETTLING = 51200.0, 5.4152, 9, (10.0, 15.0, 20.0), 0.3
BANDS = (20, 500), (500, 2500), (2500, 5000), (5000, 10000)
PLAIN, MACHINE = SCENES / "6205-inner-5deg.toml", SCENES / "6205-inner-5deg-machine.toml"
HERTZ = {"contact.law": "hertz"}
SPALL = {"on": "inner", "angle_deg": -104.8, "profile": "6205-machine-spall-inner.csv"}
SHARP = {"on": "inner", "angle_deg": -103.3, "length_deg": 5.0, "depth_um": 15.0, "edge_slope_deg": 90.0}
MODES = [
    {"frequency_hz": f, "damping_ratio": z, "gain": g}
    for f, z, g in ((1750.0, 0.04, -0.75), (4700.0, 0.03, 0.75), (9800.0, 0.035, 2.0))
]


def clearance(um):
    return {"bearing.radial_clearance_um": um}


def unequal(um):
    return {"bearing.element_diameter_rms_um": um, "bearing.element_diameter_seed": 1}


def wave(order, um=1.0):
    return {"waviness": [{"on": "outer", "order": order, "amplitude_um": um, "angle_deg": -90.0}]}


ADDED = {
    "6205-inner-5deg": {},
    "law hertz; the same below": {},
    "balls unequal by 0.25 µm": unequal(0.25),
    "by 0.7 µm": unequal(0.7),
    "outer raceway 2 waves of 1 µm": wave(2),
    "3 waves": wave(3),
    "5 waves": wave(5),
    "8 waves": wave(8),
    "9 waves": wave(9),
    "clearance 0": clearance(0.0),
    "−2 µm": clearance(-2.0),
    "−5 µm": clearance(-5.0),
    "−12 µm": clearance(-12.0),
    "load 150 N": {"shaft.load_n": [0.0, -150.0]},
    "rounded spall of the new scene": {"defect": [SPALL]},
    "rings of 0.2 and 1.36 kg": {"shaft.mass_kg": 0.2, "housing.mass_kg": 1.36},
    "modes of the structure": {"sensor.mode": MODES},
}
TAKEN = {
    "6205-inner-5deg-machine": {},
    "clearance 5 µm": clearance(5.0),
    "clearance 0": clearance(0.0),
    "−5 µm": clearance(-5.0),
    "−8 µm": clearance(-8.0),
    "−16 µm": clearance(-16.0),
    "balls unequal by 0.25 µm": unequal(0.25),
    "by 0.7 µm": unequal(0.7),
    "outer raceway 2 waves of 1 µm": wave(2),
    "3 waves": wave(3),
    "sharp edges, floor 15 µm down": {"defect": [SHARP]},
    "load 49 N": {"shaft.load_n": [0.0, -49.0]},
    "no modes of the structure": {"sensor.mode": None},
}


def envelope(x):
    return np.abs(hilbert(sosfiltfilt(butter(4, [1000, 20000], "bandpass", fs=RATE, output="sos"), x)))


def passage_frequency(e, speed):
    """BPFI (Hz): the strongest comb of ten lines of the logarithmic envelope within 2 % of the kinematic one."""
    e = np.log(e + 1e-3 * e.mean())
    n = 8 * e.size
    lines = np.abs(np.fft.rfft((e - e.mean()) * np.hanning(e.size), n))
    tried = np.arange(0.98, 1.02, 2e-5) * ORDER * speed
    return max(tried, key=lambda f: lines[np.rint(np.arange(1, 11) * f * n / RATE).astype(int)].sum())


def explained(values, phase, harmonics):
    columns = [np.ones(values.size)]
    columns += [part(m * phase) for m in range(1, harmonics + 1) for part in (np.cos, np.sin)]
    matrix = np.column_stack(columns)
    return 1 - (values - matrix @ np.linalg.lstsq(matrix, values, rcond=None)[0]).var() / values.var()


def facts(x, speed):
    x = x - x.mean()
    e = envelope(x)
    frequency = passage_frequency(e, speed)
    period = RATE / frequency
    n = int(period)
    cut = lambda signal, begins: np.array([signal[int(b) : int(b) + n] for b in begins])  # noqa: E731
    loudest = cut(e, np.arange(0, x.size - n - 1, period)).mean(0).argmax()
    rms = cut(x, np.arange((loudest - 0.35 * n) % n, x.size - n - 1, period)).std(1)
    power, f = np.abs(np.fft.rfft(x)) ** 2, np.fft.rfftfreq(x.size, 1 / RATE)
    passage = 2 * np.pi * np.arange(rms.size)
    # The speed is nominal: the shaft's phase is sought within 1.5 %.
    turns = speed / frequency * (1 + np.arange(-0.015, 0.015, 5e-5))
    return {
        "rms": x.std(),
        "bands": [power[(f >= low) & (f < high)].sum() / power[1:].sum() for low, high in BANDS],
        "crest": np.abs(x).max() / x.std(),
        "kurtosis": (x**4).mean() / x.var() ** 2 - 3,
        "strong": np.quantile(rms, 0.9) / np.quantile(rms, 0.1),
        "shaft": max(explained(rms, turn * passage, 9) for turn in turns),
        "element": explained(rms, passage / ELEMENTS, 4),
    }


def row(label, signals, speeds):
    found = [facts(x, speed) for x, speed in zip(signals, speeds)]
    growth = lambda level: np.polyfit(np.log(speeds), np.log(level), 1)[0]  # noqa: E731
    rms = np.array([one["rms"] for one in found])
    bands = np.array([one["bands"] for one in found])
    by_band = " ".join(f"{growth(rms * np.sqrt(bands[:, k])):.1f}" for k in range(len(BANDS)))
    three = lambda form, values: " / ".join(format(value, form) for value in values)  # noqa: E731
    of = lambda form, key: three(form, [one[key] for one in found])  # noqa: E731
    shares = " | ".join(three(".0f", 100 * bands[:, k]) for k in range(len(BANDS)))
    print(
        f"| {label} | {growth(rms):.2f} | {of('.1f', 'strong')} | {shares} | {of('.0f', 'kurtosis')} "
        f"| {of('.0f', 'crest')} | {of('.2f', 'shaft')} | {of('.2f', 'element')} | {by_band} |",
        flush=True,
    )


def run(program, base, name, speed, changes, folder):
    told = {"recorder.rate_hz": RATE, "shaft.speed_hz": speed, **changes}
    scene = changed_scene(base, f"{name}-{speed:.0f}", told, folder).resolve()
    command = [program, "run", str(scene), "--stop", "2.3", "--step", "0.01", "--no-figure", "-q"]
    subprocess.run([*command, "-o", str(scene.parent)], check=True, stdout=subprocess.DEVNULL)
    return np.load(scene.with_suffix(".npy"))["sensor.acceleration"][round(SETTLING * RATE) :].astype(float)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["recorded", "added", "taken"])
    parser.add_argument("files", nargs="*", metavar="FILE@HZ")
    parser.add_argument("--program", default=str(ROOT / "target/debug/brinell"))
    parser.add_argument("-o", "--output", default="target/signals-inside")
    options = parser.parse_args()
    head = "| RMS grows | strong / weak | 20–500 Hz (%) | 0.5–2.5 kHz | 2.5–5 | 5–10 | kurtosis | crest | shaft | element "
    print(f"| {options.what} {head}| growth by band |\n|---|---:|" + "---|" * 10)
    if options.what == "recorded":
        files, speeds = zip(*(file.rsplit("@", 1) for file in options.files))
        row("recorded", [np.load(file).astype(float) for file in files], [float(speed) for speed in speeds])
        return
    base, cases = (PLAIN, ADDED) if options.what == "added" else (MACHINE, TAKEN)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        jobs = []
        for k, (label, changes) in enumerate(cases.items()):
            changes = {**(HERTZ if options.what == "added" and k else {}), **changes}
            name = f"{options.what}-{k}"
            start = lambda v: pool.submit(run, options.program, base, name, v, changes, options.output)  # noqa: E731,B023
            jobs.append((label, [start(speed) for speed in SPEEDS]))
        for label, three in jobs:
            row(label, [job.result() for job in three], SPEEDS)


if __name__ == "__main__":
    main()
