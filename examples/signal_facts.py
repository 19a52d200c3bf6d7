#!/usr/bin/env python3
"""Plain facts of a recording of a spalled outer raceway: how it grows with speed, scatters, rings, how its entry rises.

    python examples/signal_facts.py FILE@HZ … [--rate 51200] [--order 3.5848] [--figure target/signals/passages]

FILE is a .npy, of numbers or with named fields as the recorder of an FMU writes them; HZ its shaft speed, order the
passages per turn of the shaft (BPFO over shaft speed; 3.5848 is a 6205). Prints one column a file, as Markdown.

Definitions, the mean taken off beforehand:
  growth    slope of ln RMS over ln speed through all files, and the same in bands; all bands are shares of the spectrum
  passages  windows of one BPFO period, each shifted by up to 3 % of it to where its envelope (1 to 20 kHz) agrees best
            with the mean of all; they begin 30 % of a period before the loudest part of the mean envelope
  scatter   standard deviation over mean of the passages' RMS; what of its variance repeats with the cage's turn (four
            harmonics), with the shaft's (three), and with both
  crest     largest magnitude over RMS of the whole file; kurtosis is the excess entry     first extreme of the mean
  passage below 2.5 kHz (Butterworth of second order, forwards and backwards) that is
            at least 15 % of its largest; rise from 10 to 90 % of it
"""

import argparse
import math
from pathlib import Path

import numpy as np

BANDS = {
    "20 to 500 Hz": (20, 500),
    "0.5 to 2.5 kHz": (500, 2500),
    "2.5 to 5 kHz": (2500, 5000),
    "5 to 10 kHz": (5000, 10000),
}
ELEMENTS = 9


def load(path, field="sensor.acceleration"):
    """The samples of a .npy as 64-bit floats."""
    samples = np.load(path)
    return np.asarray(samples[field] if samples.dtype.names else samples, float)


def filtered(x, rate, low, high, order=4):
    """Butterworth's band or low pass (low = 0), forwards and backwards."""
    f = np.fft.rfftfreq(2 * len(x), 1 / rate)
    gain = 1 / (1 + (f / high) ** (2 * order))
    if low:
        gain *= 1 - 1 / (1 + (f / low) ** (2 * order))
    return np.fft.irfft(np.fft.rfft(x, 2 * len(x)) * gain, 2 * len(x))[: len(x)]


def envelope(x, rate):
    """Magnitude of the analytic signal between 1 and 20 kHz."""
    n = len(x)
    spectrum = np.fft.fft(filtered(x, rate, 1000, 20000))
    spectrum[1 : (n + 1) // 2] *= 2
    spectrum[n // 2 + 1 :] = 0
    return np.abs(np.fft.ifft(spectrum))


def passage_frequency(x, rate, speed, order):
    """BPFO [Hz]: the strongest comb of ten lines of the logarithmic envelope within 2 % of the kinematic one."""
    e = envelope(x, rate)
    e = np.log(e + 1e-3 * e.mean())
    e -= e.mean()
    n = 8 * len(e)
    lines = np.abs(np.fft.rfft(e * np.hanning(len(e)), n))
    candidates = np.arange(0.98, 1.02, 2e-5) * order * speed
    sums = [lines[np.rint(np.arange(1, 11) * f * n / rate).astype(int)].sum() for f in candidates]
    return candidates[int(np.argmax(sums))]


def cut(x, starts, n):
    return np.array([x[start : start + n] for start in starts])


def passage_starts(x, rate, frequency):
    """First sample of each passage, and their length in samples."""
    period = rate / frequency
    n, most = round(period), int(0.03 * period)
    e = filtered(envelope(x, rate), rate, 0, 3000, 2)
    even = np.arange(0, len(x) - 2 * n - 2, period)
    mean = cut(e, np.rint(even).astype(int), n).mean(0)
    even = np.rint(even[:-1] + (np.argmax(mean) - 0.3 * n) % n).astype(int)
    even = even[(even >= most) & (even + most + n <= len(x))]
    starts = even
    for _ in range(3):
        mean = cut(e, starts, n).mean(0)
        mean = mean - mean.mean()
        shifts = range(-most, most + 1)
        agreement = [[e[start + s : start + s + n] @ mean for s in shifts] for start in even]
        starts = even + np.argmax(agreement, axis=1) - most
    return starts, n


def explained(values, phases):
    """Share of the variance of `values` that harmonics of phases explain; phases are (angles, harmonics)."""
    columns = [np.ones(len(values))]
    for angle, harmonics in phases:
        columns += [part(m * angle) for m in range(1, harmonics + 1) for part in (np.cos, np.sin)]
    matrix = np.column_stack(columns)
    rest = values - matrix @ np.linalg.lstsq(matrix, values, rcond=None)[0]
    return 1 - rest.var() / values.var()


def scatter(x, starts, n, turn):
    """Scatter of the passages' RMS, its variance's shares by cage, shaft, both. `turn` is shaft turns a passage."""
    rms = cut(x, starts, n).std(1)
    k = np.arange(len(rms))
    cage = 2 * np.pi * k / ELEMENTS, ELEMENTS // 2
    # The speed is nominal: the shaft's phase is searched within 1.5 %.
    slips = np.arange(-0.015, 0.015, 1e-4) if len(rms) > 60 else [0.0]
    shaft = max(((2 * np.pi * turn * (1 + s) * k, 3) for s in slips), key=lambda phase: explained(rms, [phase]))
    return rms.std() / rms.mean(), [explained(rms, phases) for phases in ([cage], [shaft], [cage, shaft])]


def entry(x, starts, n, rate):
    """Rise [s] of the entry from 10 to 90 %, and the mean passage below 2.5 kHz."""
    mean = cut(filtered(x, rate, 0, 2500, 2), starts, n).mean(0)
    fine = np.interp(np.arange(0, n - 1, 0.05), np.arange(n), mean)
    fine -= fine[: len(fine) // 10].mean()
    slope = np.diff(fine)
    turns = np.flatnonzero((slope[:-1] * slope[1:] <= 0) & (np.abs(fine[1:-1]) > 0.15 * np.abs(fine).max())) + 1
    if not len(turns):
        return math.nan, mean
    way = fine[: turns[0] + 1] / fine[turns[0]]
    return (np.flatnonzero(way < 0.9)[-1] - np.flatnonzero(way < 0.1)[-1]) * 0.05 / rate, mean


def facts(x, rate, speed, order=3.5848):
    """All facts of one file by their names; those that begin with _ are arrays for figures."""
    x = x - x.mean()
    frequency = passage_frequency(x, rate, speed, order)
    starts, n = passage_starts(x, rate, frequency)
    power = np.abs(np.fft.rfft(x)) ** 2
    f = np.fft.rfftfreq(len(x), 1 / rate)
    found = {"rms": x.std()}
    for name, (low, high) in BANDS.items():
        found[name] = power[(f >= low) & (f < high)].sum() / power[1:].sum()
    found["crest"] = np.abs(x).max() / x.std()
    found["kurtosis"] = (x**4).mean() / x.var() ** 2 - 3
    found["scatter"], found["_shares"] = scatter(x, starts, n, speed / frequency)
    found["entry_ms"], found["_mean"] = entry(x, starts, n, rate)
    found["entry_ms"] *= 1e3
    found["entry_deg"] = found["entry_ms"] * 1e-3 * frequency * 360 / ELEMENTS
    found["_passages"] = cut(x, starts, n)
    return found


def growth(speeds, all_facts, band=None):
    """Power of the speed with which RMS grows, of a band or of all."""
    levels = [one["rms"] * (math.sqrt(one[band]) if band else 1) for one in all_facts]
    return np.polyfit(np.log(speeds), np.log(levels), 1)[0]


def draw(names, speeds, all_facts, stem):
    """Mean passages over the RMS, one plot a speed, and strong, middle and weak single ones. The entry
    points upwards, as the polarity of an accelerometer is seldom known."""
    import figures

    several = sorted(set(speeds))
    figure, axes = figures.plots(2 * len(several), 3.2 * len(several), sharex=True)
    for i, speed in enumerate(several):
        here = [(name, one) for name, at, one in zip(names, speeds, all_facts) if at == speed]
        for (name, one), colour in zip(here, (figures.BLACK, figures.ORANGE, figures.BLUE, figures.GREEN)):
            low, n = one["_mean"], len(one["_mean"])
            reach = np.flatnonzero(np.abs(low - low[: n // 10].mean()) > 0.15 * np.abs(low).max())[0]
            sign = np.sign(low[reach] - low[: n // 10].mean())
            angle = 360 / ELEMENTS * np.arange(n) / n - 360 / ELEMENTS * reach / n
            axes[2 * i].plot(angle, sign * one["_passages"].mean(0) / one["rms"], colour, lw=0.8, label=name)
            strength = np.argsort(one["_passages"].std(1))
            picked = [strength[round(share * (len(strength) - 1))] for share in (0.9, 0.5, 0.1)]
            for k, passage in enumerate(one["_passages"][picked]):
                shift = -16 * (k + 3 * [one for one, _ in here].index(name))
                axes[2 * i + 1].plot(angle, sign * passage / one["rms"] + shift, colour, lw=0.5)
        axes[2 * i].set(xlim=(-3, 22), ylabel="mean passage\n/ RMS", title=f"{speed:g} Hz")
        axes[2 * i].legend(frameon=False, loc="upper right", ncols=3)
        axes[2 * i + 1].set(ylabel="single passages\n/ RMS, shifted", yticks=[])
    axes[-1].set_xlabel("element travel from the onset of the entry (degrees)")
    Path(stem).parent.mkdir(parents=True, exist_ok=True)
    figures.save(figure, stem)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", metavar="FILE@HZ")
    parser.add_argument("--rate", type=float, default=51200.0, help="sampling rate [Hz]")
    parser.add_argument("--order", type=float, default=3.5848, help="passages per turn of the shaft")
    parser.add_argument("--figure", help="draws mean and single passages into this file, .png and .svg")
    options = parser.parse_args()
    given = [file.rsplit("@", 1) for file in options.files]
    speeds = [float(speed) for _, speed in given]
    found = [facts(load(path), options.rate, speed, options.order) for (path, _), speed in zip(given, speeds)]
    print("| | " + " | ".join(f"{Path(path).stem}, {speed} Hz" for path, speed in given) + " |")
    print("|---|" + "---:|" * len(found))
    row = lambda name, cells: print(f"| {name} | " + " | ".join(cells) + " |")  # noqa: E731
    row("RMS", [f"{one['rms']:.4g}" for one in found])
    for name in BANDS:
        row(f"energy {name} (%)", [f"{100 * one[name]:.1f}" for one in found])
    row("crest factor; kurtosis", [f"{one['crest']:.1f}; {one['kurtosis']:.0f}" for one in found])
    row("scatter of passages' RMS", [f"{one['scatter']:.2f}" for one in found])
    row("of it with cage, shaft, both", [", ".join(f"{share:.2f}" for share in one["_shares"]) for one in found])
    row("rise of the entry (ms; °)", [f"{one['entry_ms']:.2f}; {one['entry_deg']:.2f}" for one in found])
    if len(set(speeds)) > 1:
        print(f"\ngrowth of RMS: power {growth(speeds, found):.2f}", end="")
        print("".join(f"; {name} {growth(speeds, found, name):.2f}" for name in BANDS))

    if options.figure:
        draw([Path(path).stem for path, _ in given], speeds, found, options.figure)


if __name__ == "__main__":
    main()
