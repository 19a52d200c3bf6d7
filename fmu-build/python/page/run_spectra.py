"""Spectra of a run's page: envelope and orders with the lines that defects have, and of a run whose speed changes its
spectrogram."""

import json
from pathlib import Path

import numpy as np
import plotting
from plotting import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from run_motion import packed
from scipy import signal

MOST_OF_SPECTRUM = 40_000
MARKS = {"BPFO": (BLUE, "solid"), "BPFI": (VERMILION, "dash"), "2 BSF": (GREEN, "dashdot"), "FTF": (PURPLE, "dot")}
HARMONICS = 5
# Times and frequencies of a spectrogram.
TIMES, FREQUENCIES = 400, 240


def marks(frequencies, top, count):
    """Lines of each kind of defect; the shaft's, and the sidebands that it and the cage make, are hidden at first."""
    found = []

    def mark(name, at, words, style, hidden):
        lines = [(f, word) for f, word in zip(at, words) if 0 < f <= top]
        if lines:
            at, words = zip(*lines)
            found.append({"name": name, "colour": style[0], "dash": style[1], "at": at, "words": words, "hidden": hidden})

    for name, style in MARKS.items():
        of = frequencies[name]
        many = range(1, 2 if name == "FTF" else HARMONICS + 1)
        mark(name, [k * of for k in many], [f"{k} × {name}" if k > 1 else name for k in many], style, False)
    turn, cage = (frequencies["BPFO"] + frequencies["BPFI"]) / count, frequencies["FTF"]
    many = range(1, HARMONICS + 1)
    mark("1×", [k * turn for k in many], [f"{k}×" for k in many], (ORANGE, "solid"), True)
    for name, beside, said, style in (("BPFI", turn, "1×", (SKY, "dash")), ("2 BSF", cage, "FTF", ("#882255", "dot"))):
        of = frequencies[name]
        at = [k * of + sign * beside for k in many for sign in (-1, 1)]
        words = [f"{k if k > 1 else ''} {name} {sign} {said}".strip() for k in many for sign in "−+"]
        mark(f"{name} ± {said}", at, words, style, True)
    return found


def spectrum(x, y, wide, frequencies, count, **words):
    """What is drawn of a spectrum: where there are many points, the greatest of several."""
    every = -(-len(y) // MOST_OF_SPECTRUM)
    step = float(x[1] - x[0])
    if every > 1:
        x, y = x[: len(y) // every * every], y[: len(y) // every * every].reshape(-1, every).max(axis=1)
    # Heights are those of what is shown: what is far above it may be many times stronger.
    at = np.arange(len(y)) * step * every
    seen = y[(at > 0.5 * wide) & (at <= words["shown"])]
    top, low = float(seen.max()), float(np.quantile(seen, 0.05))
    return {
        "step": step * every,
        "y": packed(y),
        "top": 1.5 * top if words["log"] else 1.08 * top,
        "floor": max(low, 1e-7 * top) if words["log"] else 0.0,
        "marks": marks(frequencies, float(x[-1]), count),
        **words,
    }


def spectra(about):
    if about["envelope"]:
        data = plotting.read_csv(about["envelope"])
        said = json.loads(Path(about["envelope"]).with_suffix(".json").read_text(encoding="utf-8"))
        low, high = (f / 1e3 for f in said["band_hz"])
        speed = said.get("mean_speed_hz")
        at = f", at the mean speed of {speed:.4g} turns per second" if speed else ""
        # Where the speed changes, the envelope is taken in time and then at equal angles between these times.
        used = about["orders"]["said"] if speed else {}
        turning = {"speed": speed, "from": used["from_s"], "to": used["to_s"]} if speed else None
        wide = f"lines are {said['line_width_hz']:.2g} Hz wide"
        yield f"Envelope spectrum, {low:.3g} to {high:.3g} kHz{at}; {wide}", spectrum(
            data["frequency"], data["amplitude"], said["line_width_hz"], said["frequencies_hz"], about["count"],
            band=said["band_hz"], turning=turning, log=False, unit="Hz", name="squared envelope",
            axis="frequency (Hz)", label="squared envelope<br>(share of its mean)", shown=float(data["frequency"][-1]),
        )  # fmt: skip
    if about["orders"]:
        data, said = plotting.read_csv(about["orders"]["file"]), about["orders"]["said"]
        span = f"{said['from_s']:.4g} to {said['to_s']:.4g} s"
        yield f"Order spectrum of the acceleration, {span}; lines are {said['line_width']:.2g} orders wide", spectrum(
            data["order"], data["amplitude"], said["line_width"], said["orders"], about["count"],
            band=None, log=True, unit="×", name="acceleration", axis="order (times per turn)", label="amplitude (m/s²)",
            shown=min(float(data["order"][-1]), 6 * said["orders"]["BPFI"]),
        )  # fmt: skip


def spectrogram(run, about):
    """Levels over time and frequency (dB below the highest) of the first sensor, or of the housing."""
    source = run.source(about["sensor"])
    if about["sensor"] not in source or len(source["time"]) < 4096:
        return None
    time, values = np.asarray(source["time"]), np.asarray(source[about["sensor"]])
    rate = (len(time) - 1) / (time[-1] - time[0])
    across = 2 * FREQUENCIES
    hop = max(1, (len(values) - across) // TIMES)
    # A window as long as two lines of the figure need, or as two pictures of it, whichever is longer.
    window = max(across, 2 * hop)
    frequency, at, power = signal.spectrogram(values, rate, "hann", window, window - hop, mode="psd")
    shown = frequency <= rate / 2.56
    power = power[shown]
    every = max(1, len(power) // FREQUENCIES)
    rows = len(power) // every * every
    power = power[:rows].reshape(-1, every, power.shape[1]).max(axis=1)
    level = 10 * np.log10(power / power.max() + 1e-8)
    step, name = float(frequency[1] - frequency[0]) * every, about["sensor"]
    return {"time": packed(at + time[0]), "step": step, "rows": len(level), "level": packed(level), "name": name}
