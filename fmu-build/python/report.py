"""Error against CPU time of the time integration, one panel for each scene."""

import csv
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
import plotting
from matplotlib.ticker import LogLocator, NullFormatter
from plotting import BLUE, GREEN, ORANGE, PURPLE, VERMILION, plt

data, stem = Path(sys.argv[1]), Path(sys.argv[2])
LOOK = {
    "automatic": (BLUE, "o", "-"),
    "DP5 only": (GREEN, "s", "--"),
    "Rodas5P only": (PURPLE, "^", "--"),
    "RK4": (ORANGE, "v", ":"),
    "Verlet": (VERMILION, "D", ":"),
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
for axis in axes.flat[len(scenes):]:
    axis.set_visible(False)
for axis in axes[:, 0]:
    axis.set_ylabel("acceleration error (rms / rms)")
for axis in axes[-1]:
    axis.set_xlabel("CPU seconds per simulated second")
axes[0, 0].legend(loc="lower left", ncols=1)
plotting.save(figure, stem)
