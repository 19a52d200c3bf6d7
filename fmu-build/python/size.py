"""Averaged passages of recordings: signal, high-frequency envelope, and the path of an element over the spall that was
found."""

import json
import sys
from pathlib import Path

import numpy as np
import plotting
from figures import marked
from plotting import BLUE, GREEN, ORANGE, plt


def beside(stem, ending):
    return stem.with_name(stem.name + ending)


def title(found):
    name = found["name"]
    if found["length_deg"] is None:
        looks = {"inner": ", looks like the inner raceway", "element": ", looks like a rolling element"}
        return f"{name}: unresolved{looks.get(found['fault'], '')}"
    length = f"{found['length_deg']:.2f} ± {found['uncertainty_deg']:.2f} degrees"
    return f"{name}: {length} ({found['kind']}), {found['passages']} passages"


def draw(stem):
    data = plotting.read_csv(beside(stem, ".csv"))
    found = json.loads(beside(stem, ".json").read_text(encoding="utf-8"))
    angle = data["angle"]
    rows = 3 if "path" in data else 2
    figure, axes = plt.subplots(rows, 1, figsize=(plotting.WIDTH, 0.8 + 2.1 * rows), sharex=True)

    top = axes[0]
    top.plot(angle, data["signal"], color=BLUE, linewidth=0.7, label="averaged signal")
    top.plot(angle, data["low"], color=ORANGE, linewidth=1.6, label="below 2.5 kHz")
    if "model" in data:
        top.plot(angle, data["model"], color="black", linewidth=0.9, linestyle=":", label="simulated passage")
    top.set_ylabel("signal\n(recording's unit)")
    top.set_title(title(found))

    middle = axes[1]
    middle.plot(angle, data["level"] - np.max(data["level"]), color=GREEN, label="high-frequency envelope")
    middle.set_ylabel("level (dB)")

    edges = found["edges_deg"]
    for axis in axes:
        marked(axis, found, axis is top)
        if edges:
            axis.axvspan(*edges, color="#eeeeee", zorder=0)
    if rows == 3:
        axes[2].plot(angle, -1e6 * data["path"], color=BLUE, label="element's centre, until free or on the floor")
        axes[2].set_ylabel("path (µm)")
    for axis in axes:
        low, high = axis.get_ylim()
        axis.set_ylim(low, high + 0.3 * (high - low))
        axis.legend(loc="upper right", ncols=6, columnspacing=1)
    raceway = "the inner raceway" if found["fault"] == "inner" else "the outer raceway"
    axes[-1].set_xlabel(
        f"element travel from the leading edge (degrees of {raceway})"
        if found["length_deg"]
        else f"element travel (degrees of {raceway}; 0: first impact, if there is one)"
    )
    if edges:
        room = max(4.0, 0.8 * (edges[1] - edges[0]))
        axes[-1].set_xlim(max(angle[0], edges[0] - room), min(angle[-1], edges[1] + 1.6 * room))
    else:
        axes[-1].set_xlim(angle[0], angle[-1])
    figure.align_ylabels()
    plotting.save(figure, stem)


for argument in sys.argv[1:]:
    draw(Path(argument))
