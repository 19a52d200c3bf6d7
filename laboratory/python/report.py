"""Error against CPU time of the time integration, one panel for each scene."""

import csv
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
import plotting
from matplotlib.ticker import LogLocator, NullFormatter
from plotting import BLUE, GREEN, ORANGE, PURPLE, SKY, plt

data, stem = Path(sys.argv[1]), Path(sys.argv[2])
LOOK = {
    "automatic": (BLUE, "o", "-"),
    "phase-fitted only": (SKY, "P", "--"),
    "DP5 only": (GREEN, "s", "--"),
    "Rodas5P only": (PURPLE, "^", "--"),
}
scenes = defaultdict(lambda: defaultdict(list))
with open(data / "integration.csv", encoding="utf-8") as file:
    for row in csv.DictReader(file):
        point = float(row["cpu_s_per_s"]), float(row["acceleration_rms"])
        scenes[row["scene"]][row["method"]].append(point)

columns = 2
rows = -(-len(scenes) // columns)
figure, axes = plt.subplots(
    rows, columns, figsize=(plotting.WIDTH, 0.6 + 2.7 * rows), sharex=True, sharey=True, squeeze=False
)
for axis, (scene, methods) in zip(axes.flat, scenes.items()):
    for method, points in methods.items():
        colour, marker, line = LOOK[method]
        time, error = np.array(points).T
        # An error of 1 or more is no result: it is drawn at the upper edge.
        error = np.where(np.isfinite(error), np.minimum(error, 2.0), 2.0)
        axis.loglog(time, error, line, color=colour, marker=marker, markersize=4, label=method)
    axis.set_title(scene)
    axis.xaxis.set_major_locator(LogLocator())
    axis.xaxis.set_minor_formatter(NullFormatter())
    axis.set_xlim(0.01, 100)
    axis.set_ylim(1e-10, 3.0)
    axis.axhline(1.0, color="black", linewidth=0.7)
handles, labels = axes[0, 0].get_legend_handles_labels()
for axis in axes.flat[len(scenes):]:
    axis.set_axis_off()
# Beside the panels where there is room, or it would cover points.
(axes[-1, -1] if len(scenes) < rows * columns else axes[0, -1]).legend(
    handles, labels, loc="center", title="errors above 1 are at the upper edge", title_fontsize=8
)
for axis in axes[:, 0]:
    axis.set_ylabel("acceleration error (rms / rms)")
# The lowest panel of each column, which need not be in the last row.
for axis in axes.flat[max(len(scenes) - columns, 0) : len(scenes)]:
    axis.tick_params(labelbottom=True)
    axis.set_xlabel("CPU seconds per simulated second")
plotting.save(figure, stem)

# One contact: grids and maps.
with open(data / "contact.csv", encoding="utf-8") as file:
    contacts = list(csv.DictReader(file))
figure, axis = plt.subplots(figsize=(plotting.WIDTH, 4.2))
for law, colour, marker, name in (
    ("love", BLUE, "o", "grid against a finer grid"),
    ("map", ORANGE, "s", "map against its grid"),
):
    own = [row for row in contacts if row["law"] == law]
    time = [float(row["seconds_per_contact"]) for row in own]
    for column, face, kind in (("max_normal", colour, "largest"), ("rms_normal", "white", "root mean square")):
        error = [float(row[column]) for row in own]
        axis.loglog(time, error, marker, color=colour, markerfacecolor=face, label=f"{name}, {kind}")
    for row, x in zip(own, time):
        label = f"{row['columns']}×{row['rows']}" if law == "love" else f"{row['nodes']} nodes"
        axis.annotate(label, (x, float(row["max_normal"])), textcoords="offset points", xytext=(7, 3), fontsize=8)
axis.set_xlabel("CPU time of one contact (s)")
axis.set_ylabel("error of the normal force / full scale")
axis.legend(loc="lower center")
plotting.save(figure, stem.with_name(stem.name + "-contact"))
