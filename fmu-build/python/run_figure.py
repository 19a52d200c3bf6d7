"""Overview of a run: what moves, the forces on both rings, the outer forces of the elements, and the sensor; with the
spectrum of its envelope, if there is one. Where a run is too long for its samples to be seen, bands show what they do.

Arguments: the signals as a NumPy file; the recorder's, filtered, or "-"; the figure without its ending; the spectrum's
CSV if there is one. What the recorder has is drawn from it: samples at communication points beat with what rings faster.
"""

import json
import sys
from pathlib import Path

import numpy as np
import plotting
from plotting import BLUE, GREEN, ORANGE, PURPLE, VERMILION, plt

path = Path(sys.argv[3])
data = plotting.signals(sys.argv[1])
recording = plotting.signals(sys.argv[2]) if sys.argv[2] != "-" else {"time": []}
in_seconds = data["time"][-1] > 2.0
factor = 1.0 if in_seconds else 1e3
time = data["time"] * factor
# Time of a turn of the shaft, at the mean speed.
speed = abs(float(np.mean(data["shaft.speed"]))) if "shaft.speed" in data else 0.0
turn = factor * 2 * np.pi / speed if speed > 0 else None
# Times of all curves that are drawn: the recorder's may be bands where those of communication points are lines.
spans = [data["time"]]


def filtered(name):
    """Whether the recorder has it through its filter."""
    rings = name.endswith((".ax", ".ay", ".force.x", ".force.y")) and not name.startswith("element")
    return name in recording and len(recording["time"]) > 1 and (rings or name.startswith("sensor"))


def curves(axis, names, colours, scale=1.0, labels=None):
    for name, colour, label in zip(names, colours, labels or names):
        source = recording if filtered(name) else data
        spans.append(source["time"])
        plotting.curve(axis, source["time"] * factor, source[name] * scale, colour, label, turn)


def both(axis, name, scale):
    """Along x and y."""
    curves(axis, [f"{name}.x", f"{name}.y"], [ORANGE, BLUE], scale, ["x", "y"])


def panels():
    """Each panel: its axis label and what draws it, as far as this run has the signals."""
    if "sensor.acceleration" in data:
        yield "sensor\n(m/s²)", lambda axis: curves(axis, ["sensor.acceleration"], [BLUE])
    sensors = [name for name in data if name.startswith("sensor[")]
    if sensors:
        colours = [BLUE, ORANGE, GREEN, PURPLE] * 2
        yield "sensors\n(m/s²)", lambda axis: curves(axis, sensors, colours, 1.0, [name[7:-14] for name in sensors])
    if "probe.y" in data:
        yield "probe\n(µm)", lambda axis: both(axis, "probe", 1e6)
    for ring, colour in (("housing", VERMILION), ("shaft", GREEN)):
        if f"{ring}.ay" in data and data[f"{ring}.ay"].any():
            name = f"{ring}.ay"
            yield f"{ring}, y\n(m/s²)", lambda axis, name=name, colour=colour: curves(axis, [name], [colour])
    for ring in ("shaft", "housing"):
        if f"{ring}.y" in data and data[f"{ring}.y"].any():
            yield f"{ring}\nposition (µm)", lambda axis, ring=ring: both(axis, ring, 1e6)
    yield "bearing force\non shaft (N)", lambda axis: both(axis, "shaft.force", 1.0)

    def outer(axis):
        count = sum(name.startswith("element[") and name.endswith("].force.outer") for name in data)
        if plotting.is_long(time):
            # Each element's way through the load zone cannot be seen; what the one that carries most carries can.
            largest = np.max([data[f"element[{j}].force.outer"] for j in range(1, count + 1)], axis=0)
            plotting.curve(axis, time, largest, GREEN, None, turn)
            return
        for j in range(1, count + 1):
            colour = plt.cm.viridis((j - 1) / max(count, 2))
            axis.plot(time, data[f"element[{j}].force.outer"], color=colour, linewidth=0.9, label=str(j))

    yield ("largest outer\nforce on an\nelement (N)" if plotting.is_long(time) else "outer force on\nelements (N)"), outer


def lines(axis, name, frequency, colour, style, top):
    """Harmonics of a characteristic frequency up to `top`, the first one darkest."""
    look = {"color": colour, "linestyle": style, "linewidth": 1.0}
    for k in range(1, int(top / frequency) + 1):
        axis.axvline(k * frequency, alpha=1.0 if k == 1 else 0.5, zorder=1, **look)
    axis.plot([], [], label=f"{name} {frequency:.1f} Hz", **look)


def envelope(axis, path):
    """The spectrum of the envelope and where lines of each kind of defect would stand."""
    data = plotting.read_csv(path)
    said = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    frequency, amplitude = data["frequency"], data["amplitude"]
    top = frequency[-1]
    marks = said["frequencies_hz"]
    styles = {"BPFO": (BLUE, "-"), "BPFI": (VERMILION, "--"), "2 BSF": (GREEN, "-."), "FTF": (PURPLE, ":")}
    for name, (colour, style) in styles.items():
        # The cage's own line alone: its harmonics would cover everything.
        lines(axis, name, marks[name], colour, style, 1.5 * marks[name] if name == "FTF" else top)
    axis.plot(frequency, amplitude, color="black", linewidth=0.9, zorder=3)
    low, high = (f / 1e3 for f in said["band_hz"])
    at = " (Hz); "
    if "mean_speed_hz" in said:
        # Too long for one line.
        at = f" at the mean speed of {said['mean_speed_hz']:.4g} turns per second (Hz)\n"
    axis.set_xlim(0, top)
    axis.set_ylim(0, 1.08 * amplitude[frequency > 0.5 * said["line_width_hz"]].max())
    axis.set_xlabel(
        f"frequency{at}lines are {said['line_width_hz']:.2g} Hz wide; harmonics of BPFO, BPFI and 2 BSF pale"
    )
    axis.set_ylabel("squared envelope\n(share of its mean)")
    axis.set_title(f"envelope, {low:.2g} to {high:.2g} kHz", fontsize=10)
    axis.legend(loc="lower right", bbox_to_anchor=(1, 0.98), ncols=4, columnspacing=1.2)


drawn = list(panels())
spectra = [Path(argument) for argument in sys.argv[4:]]
heights = [1.5] * len(drawn) + [2.6] * len(spectra)
figure, axes = plt.subplots(
    len(heights), 1, figsize=(plotting.WIDTH, 0.6 + sum(heights)), height_ratios=heights, squeeze=False
)
times = axes[: len(drawn), 0]
for axis, (label, draw) in zip(times, drawn):
    draw(axis)
    axis.set_ylabel(label)
    axis.sharex(times[-1])
    axis.tick_params(labelbottom=axis is times[-1])
    if len(axis.get_legend_handles_labels()[1]) > 1:
        axis.legend(loc="lower right", bbox_to_anchor=(1, 0.93), ncols=24, handlelength=1, columnspacing=1)
times[0].set_title(path.name + plotting.bands_said(max(spans, key=len)))
times[-1].set_xlabel("time (s)" if in_seconds else "time (ms)")
times[-1].set_xlim(time[0], time[-1])
for axis, spectrum in zip(axes[len(drawn) :, 0], spectra):
    envelope(axis, spectrum)
figure.align_ylabels()
plotting.save(figure, path)
