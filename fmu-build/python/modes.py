"""Natural frequencies and damping ratios over the cage angle, and the shapes of the rings' and the sensor's modes."""

import json
import sys
from pathlib import Path

import numpy as np
import plotting
from plotting import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION, plt

GREY = "#999999"
COLOURS = (BLUE, VERMILION, GREEN, ORANGE, PURPLE)
stem = Path(sys.argv[1])
report = json.loads(stem.with_name(stem.name + "-modes.json").read_text(encoding="utf-8"))
names = report["freedoms"]
is_element = np.array([name.startswith("element") for name in names])
angles = report["angles"]
cage = np.array([angle["cage_angle_deg"] for angle in angles]) - report["middle_deg"]
# The two cage angles at which shapes are drawn: this and the first.
MIDDLE = int(np.argmin(np.abs(cage)))
others = [line for line in report["lines"] if line["elements"] <= 0.5]
colour_of = {line["line"]: COLOURS[i % len(COLOURS)] for i, line in enumerate(others)}


def along(number, quantity):
    """A quantity of a line at every cage angle; NaN where the line is not there."""
    values = np.full(len(angles), np.nan)
    for i, angle in enumerate(angles):
        for mode in angle["modes"]:
            if mode["line"] == number:
                values[i] = quantity(angle, mode)
    return values


def frequency(_, mode):
    return mode["undamped_frequency_hz"]


def damping(_, mode):
    return 100 * mode["damping_ratio"]


def is_resting(angle, mode):
    """Whether most of the motion is that of elements that only rest on a raceway."""
    resting = [hold == "resting" for hold in angle["elements"]]
    return sum(part for part, rests in zip(mode["energy"], resting) if rests) > 0.5


def logarithmic(axis):
    axis.set_yscale("log")
    plotting.logarithmic(axis, (1, 2, 5) if np.ptp(np.log10(axis.get_ylim())) < 2.5 else (1,))


def elements(axis, quantity, with_resting):
    """Lines of elements: pressed and resting parts of each."""
    labels = {False: "elements, pressed", True: "elements, resting under their weight"}
    for line in report["lines"]:
        if line["line"] in colour_of:
            continue
        values, resting = along(line["line"], quantity), along(line["line"], is_resting) == 1
        for rests in (False, True) if with_resting else (False,):
            part = np.where(resting == rests, values, np.nan)
            if np.isfinite(part).any():
                colour, style = (GREY, ":") if rests else (SKY, "-")
                axis.plot(cage, part, color=colour, linestyle=style, linewidth=0.9, label=labels.pop(rests, None))


def moving(line):
    """What moves in a line: freedoms with a seventh of the energy or more."""
    parts = [(part, name) for part, name in zip(line["energy"], names) if part > 1 / 7]
    parts = [(part, name) for part, name in parts if not name.startswith("element")]
    return ", ".join(name for _, name in sorted(parts, reverse=True)) or "elements"


def panel(axis, lines, quantity, label):
    for line in lines:
        number = line["line"]
        axis.plot(cage, along(number, quantity), color=colour_of[number], label=f"{number}: {moving(line)}")
    axis.set_ylabel(label)
    axis.set_xlim(cage[0], cage[-1])
    axis.set_xlabel(f"cage angle from the {'defect' if report['defect_length_deg'] else 'load'} (degrees)")


def shape(axis, line, first):
    """Displacements of rings and sensor and the largest of any element, at two cage angles."""
    shown = [i for i, element in enumerate(is_element) if not element]
    ticks = [names[i] for i in shown] + ["largest\nelement.path"]
    for k, colour, offset in ((MIDDLE, colour_of[line["line"]], -0.2), (0, GREY, 0.2)):
        for mode in angles[k]["modes"]:
            if mode["line"] != line["line"]:
                continue
            values = np.array(mode["amplitude"]) * np.cos(np.radians(mode["phase_deg"]))
            largest = values[is_element][np.argmax(np.abs(values[is_element]))]
            bars = np.append(values[shown], largest)
            # The sign is arbitrary: let the largest be positive.
            bars *= np.sign(bars[np.argmax(np.abs(bars))])
            axis.barh(np.arange(len(bars)) + offset, bars, height=0.36, color=colour)
    axis.set_yticks(range(len(ticks)), ticks if first else [])
    axis.invert_yaxis()
    axis.set_xlim(-1.05, 1.05)
    axis.set_title(f"mode {line['line']}", color=colour_of[line["line"]])


def over_the_cage_angle(rows):
    """Frequencies and damping ratios of everything; what the legend is to say."""
    axis = figure.add_subplot(rows[0])
    elements(axis, frequency, True)
    panel(axis, others, frequency, "frequency (Hz)")
    axis.set_title("undamped natural frequencies")
    logarithmic(axis)
    handles = axis.get_legend_handles_labels()
    axis = figure.add_subplot(rows[1])
    elements(axis, damping, False)
    panel(axis, others, damping, "damping ratio (%)")
    axis.set_title("damping")
    logarithmic(axis)
    return handles


def of_the_rings(panels, handles):
    """The slow modes once more with a linear scale, beside the legend; below them the shapes."""
    slow = 5 * max(300, others[0]["undamped_frequency_hz"][1])
    middle = panels[1].subgridspec(1, 2, width_ratios=(1.6, 1))
    axis = figure.add_subplot(middle[0])
    panel(axis, [line for line in others if line["undamped_frequency_hz"][1] < slow], frequency, "frequency (Hz)")
    axis.set_title("the slow modes")
    axis.set_ylim(bottom=0)
    legend = figure.add_subplot(middle[1])
    legend.axis("off")
    legend.legend(*handles, loc="center left", title="what moves, most energy first", alignment="left")
    lower = panels[2].subgridspec(1, len(others))
    for i, line in enumerate(others):
        axis = figure.add_subplot(lower[i])
        shape(axis, line, i == 0)
    at = [f"{cage[k]:.0f}°".replace("-", "−") for k in (MIDDLE, 0)]
    figure.supxlabel(f"displacement (largest = 1); in colour at {at[0]}, grey at {at[1]}", fontsize=10)


figure = plt.figure(figsize=(plotting.WIDTH, 9.2 if others else 4.6))
if others:
    panels = figure.add_gridspec(3, 1, height_ratios=(1.1, 1.0, 0.8))
    of_the_rings(panels, over_the_cage_angle(panels[0].subgridspec(1, 2)))
else:
    handles = over_the_cage_angle(figure.add_gridspec(1, 2))
    figure.legend(*handles, loc="outside lower center", ncols=2)
loads = [
    f"{np.hypot(*report[f'{ring}_load_n']):g} N on the {ring}"
    for ring in ("shaft", "housing")
    if any(report[f"{ring}_load_n"])
]
figure.suptitle(", ".join([stem.name, *loads]), x=0.01, ha="left")
plotting.save(figure, stem.with_name(stem.name + "-modes"))
