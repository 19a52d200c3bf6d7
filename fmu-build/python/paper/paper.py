"""A figure of the paper, or of the validation. Arguments: its name, the folder of its data, the figure's path without
suffix."""

import sys
from pathlib import Path

import numpy as np
import plotting
from events import NUMBERED, find_events, listed
from plotting import BLUE, GREEN, ORANGE, SKY, VERMILION, plt
from scipy import signal

name, data_folder, stem = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])


def read(name):
    return plotting.read_csv(data_folder / f"{name}.csv")


def event(axis, at, text, height=0.97, ha="left"):
    """A dotted line with its name at the top of the axis."""
    axis.axvline(at, color="black", linewidth=0.8, linestyle=":")
    beside = {"xytext": (3 if ha == "left" else -3, 0), "textcoords": "offset points", "ha": ha, "va": "top"}
    axis.annotate(text, (at, height), xycoords=axis.get_xaxis_transform(), fontsize=9, **beside)


def legend_above(axis, *what, **options):
    """Above the axis on the right, where no curve is."""
    axis.legend(*what, loc="lower right", bbox_to_anchor=(1, 0.97), borderaxespad=0, **options)


def four_events():
    data = read("four-events")
    time = data["time"] * 1e3
    free = time[(time > 0) & (data["map element[1].force.outer"] == 0)][0]
    struck = time[(time > free) & (data["map element[1].force.outer"] > 0)][0]
    again = time[(time > free + 1) & (data["map element[1].force.inner"] > 0)][0]
    figure, axes = plt.subplots(3, 1, figsize=(plotting.WIDTH, 7.2), sharex=True)
    panels = (
        ("housing.ay", 1.0, "housing, y\n(m/s²)"),
        ("element[1].force.outer", 1.0, "outer force on\nthe element (N)"),
        ("element[1].path", 1e6, "path of the\nelement (µm)"),
    )
    for axis, (name, scale, label) in zip(axes, panels):
        for law, colour, style in (("hertz", ORANGE, "-"), ("map", BLUE, "-")):
            axis.plot(time, scale * data[f"{law} {name}"], style, color=colour, linewidth=0.8, label=f"law {law}")
        axis.set_ylabel(label)
    axes[2].invert_yaxis()
    spread = np.quantile(np.abs(data["map housing.ay"]), 0.999)
    axes[0].set_ylim(-1.2 * spread, 1.6 * spread)
    low, high = axes[1].get_ylim()
    axes[1].set_ylim(low, high + 0.55 * (high - low))
    for at, text in ((0.0, "1 enters"), (free, "2 free"), (struck, "3 floor"), (again, "4 re-load"), (10.997, "leaves")):
        # Names that would meet stand on two heights.
        event(axes[1], at, text, 0.8 if text[0] in "2l" else 0.98, "right" if text[0] in "14" else "left")
        for axis in (axes[0], axes[2]):
            axis.axvline(at, color="black", linewidth=0.8, linestyle=":")
    axes[0].set_title("Line spall of 15.8°, 500 N, 10 Hz: one element passes")
    axes[0].legend(loc="upper right", ncols=2)
    axes[-1].set_xlabel("time from the leading edge (ms)")
    axes[-1].set_xlim(-2, 20)
    figure.align_ylabels()
    plotting.save(figure, stem)


def draw_profile(axis):
    profile = read("profile")
    axis.plot(profile["arc"] * 1e3, profile["depth"] * 1e6, color=SKY, label="depth of the stand-in trace")
    axis.plot(profile["arc"] * 1e3, profile["path"] * 1e6, color="black", label="path of a rigid element")
    axis.invert_yaxis()
    axis.set_xlabel("arc from the middle of the spall (mm)")
    axis.set_ylabel("depth (µm)")
    legend_above(axis, ncols=2)


def profile():
    figure, axis = plt.subplots(figsize=(plotting.WIDTH, 3.4))
    figure.suptitle("Etched spall of 0.8 mm: a stand-in for the unpublished trace", x=0.01, ha="left")
    draw_profile(axis)
    plotting.save(figure, stem)


def number_events(axes, data, case):
    """The paper's events of a case on all axes, its numbers at the top, and below the last what they are."""
    signals = {"time": data["time"], "force.outer": data[f"{case} element[1].force.outer"]}
    # At the cage's speed, without slip: 0.8 mm.
    _, events = find_events(signals, 0.0, 0.5447e-3)
    for name, (number, _) in NUMBERED.items():
        for axis in axes if name in events else ():
            event(axis, events[name][0] * 1e3, str(number), ha="right" if name == "entry" else "left")
    lines = "\n".join(listed(events, 0.0, "trace, law map"))
    axes[-1].set_xlabel(f"time from the leading edge (ms)\n\n{lines}", loc="left")


def epps():
    data = read("epps")
    whole = (data_folder / "profile.csv").exists()
    figure, axes = plt.subplots(3 + whole, 1, figsize=(plotting.WIDTH, 7.6 + 2.2 * whole))
    figure.suptitle("Etched spall of 0.8 mm on a 6205, 1500 N, 25 Hz", x=0.01, ha="left")
    if whole:
        draw_profile(axes[0])
        axes = axes[1:]
    time = data["time"] * 1e3
    panels = (
        ("housing.ay", 1.0, "housing, y\n(m/s²)"),
        ("element[1].path", 1e6, "path of the\nelement (µm)"),
        ("element[1].force.outer", 1.0, "outer force on\nthe element (N)"),
    )
    curves = (
        ("trace hertz", GREEN, "-", "trace, law hertz"),
        ("sharp hertz", ORANGE, ":", "90° edges, law hertz"),
        ("trace map", BLUE, "-", "trace, law map"),
        ("sharp map", SKY, ":", "90° edges, law map"),
    )
    for axis, (name, scale, label) in zip(axes, panels):
        for case, colour, style, text in curves:
            if f"{case} {name}" in data:
                width = 1.8 if style == ":" else 0.9
                axis.plot(time, scale * data[f"{case} {name}"], style, color=colour, linewidth=width, label=text)
        axis.set_ylabel(label)
        axis.set_xlim(-0.5, 2.5)
    number_events(axes, data, "trace map")
    axes[1].invert_yaxis()
    legend_above(axes[0], ncols=2)
    figure.align_ylabels()
    plotting.save(figure, stem)


def spectrograms(rows, title):
    """Entry and exit of averaged passages: one row a case, one column an event."""
    data = read("averages")
    time = data["time"] * 1e3
    rate = 1e3 / (time[1] - time[0])
    # 15.8 degrees after the entry an element leaves, of the extended spall too: 55.8 is one spacing more.
    exit_at = 10.997
    figure, axes = plt.subplots(
        len(rows), 2, figsize=(plotting.WIDTH, 0.9 + 2.0 * len(rows)), sharex="col", sharey=True
    )
    mesh = None
    for line, (key, label) in zip(axes, rows):
        passage = data[f"{key} sensor.acceleration"]
        # The passage repeats: three in a row leave the middle one without ends.
        long = np.tile(passage - passage.mean(), 3)
        window = int(round(5e-3 * rate))
        frequency, at, power = signal.spectrogram(
            long, rate, window="hann", nperseg=window, noverlap=window - 8, nfft=4096, mode="psd"
        )
        at = at * 1e3 - time.size / rate * 1e3 + time[0]
        shown = frequency <= 2000
        level = 10 * np.log10(power[shown] / power[shown][:, (at > time[0]) & (at < time[-1])].max() + 1e-9)
        for axis, centre, event_name in zip(line, (0.0, exit_at), ("entry", "exit")):
            near = (at > centre - 3) & (at < centre + 9)
            look = {"vmin": -30, "vmax": 0, "cmap": "viridis", "rasterized": True, "shading": "nearest"}
            mesh = axis.pcolormesh(at[near] - centre, frequency[shown], level[:, near], **look)
            axis.axvline(0, color="white", linewidth=0.9, linestyle=":")
            axis.set_title(f"{label}: {event_name}")
            axis.grid(False)
        line[0].set_ylabel("frequency (Hz)")
    for axis in axes[-1]:
        axis.set_xlabel("time from the edge (ms)")
    figure.colorbar(mesh, ax=axes, label="level (dB re maximum of the passage)", shrink=0.6, pad=0.01)
    figure.suptitle(title, x=0.01, ha="left")
    plotting.save(figure, stem)


def beside():
    speeds = sorted(int(path.name.split("-")[1][:-2]) for path in data_folder.glob("beside-*hz-recording.csv"))
    if not speeds:
        return
    figure = plt.figure(figsize=(plotting.WIDTH, 2.3 * len(speeds) + 2.8))
    grid = figure.add_gridspec(len(speeds) + 1, 2)
    shown = {}
    for row, speed in enumerate(speeds):
        for column, (who, colour) in enumerate((("recording", BLUE), ("scene", VERMILION))):
            axis = figure.add_subplot(grid[row, column])
            path = data_folder / f"beside-{speed}hz-{who}.csv"
            data = plotting.read_csv(path)
            near = (data["angle"] > -4) & (data["angle"] < 9)
            low = data["low"][near]
            axis.plot(data["angle"][near], low / np.abs(low).max(), color=colour)
            axis.set_ylim(-1.15, 1.9)
            axis.set_xlim(-4, 9)
            other = axis.twinx()
            level = data["level"][near]
            other.plot(data["angle"][near], level - level.max(), color=GREEN, linewidth=0.9)
            other.set_ylim(-75, 5)
            other.grid(False)
            other.spines["right"].set_visible(True)
            axis.axvline(0, color="black", linewidth=0.8, linestyle=":")
            axis.set_title(f"{who if column == 0 else 'scene with flanks'}, {speed} Hz")
            if column == 0:
                axis.set_ylabel("acceleration / its largest")
                other.set_yticklabels([])
            else:
                other.set_ylabel("envelope (dB)")
            if row == 0:
                shown[f"{who}, below 2.5 kHz"] = axis.get_lines()[0]
                shown["envelope"] = other.get_lines()[0]
            if row == len(speeds) - 1:
                axis.set_xlabel("element travel from the first impact (degrees)")
    figure.legend(shown.values(), shown, loc="outside upper right", ncols=len(shown))
    bottom = figure.add_subplot(grid[len(speeds), :])
    styles = ("-", "--", ":")
    for speed, style in zip(speeds, styles * 3):
        data = read(f"beside-{speed}hz-harmonics")
        for who, colour, label in (("recording", BLUE, "recording"), ("scene", VERMILION, "with flanks")):
            bottom.plot(data["harmonic"], data[who], style, color=colour, marker=".", label=f"{label}, {speed} Hz")
    bottom.set(xlim=(1, 20), ylim=(0, None), xticks=range(1, 21), ylabel="amplitude / that of the first")
    bottom.set_xlabel("harmonic of the ball pass frequency in the averaged envelope")
    bottom.legend(ncols=len(speeds))
    plotting.save(figure, stem)


NOMINAL = (("tb1", "TB1, 500 N"), ("tb2-500", "TB2, 500 N"), ("tb2-600", "TB2, 600 N"))
ASSUMED = (
    ("30um-500", "30 µm, 500 N"),
    ("30um-600", "30 µm, 600 N"),
    ("soft-500", "compliant, 500 N"),
    ("soft-600", "compliant, 600 N"),
)
DRAWN = {
    "four-events": four_events,
    "profile": profile,
    "epps": epps,
    "spectrograms": lambda: spectrograms(NOMINAL, "Nominal depth of 100 µm, rigid rings"),
    "assumptions": lambda: spectrograms(ASSUMED, "TB2 with its floor within reach: two assumptions"),
    "beside": beside,
}
DRAWN[name]()
