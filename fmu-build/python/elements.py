"""Cost of a step over the number of elements."""

import csv
import sys
from pathlib import Path

import numpy as np
import plotting
from plotting import BLUE, ORANGE, PURPLE, plt

data, stem = Path(sys.argv[1]), Path(sys.argv[2])
with open(data / "elements.csv", encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
count = np.array([float(row["elements"]) for row in rows])
figure, axis = plt.subplots(figsize=(plotting.WIDTH, 4.2))
CURVES = (
    ("explicit_s_per_step", BLUE, "o", "explicit, healthy"),
    ("explicit_with_spall_s_per_step", ORANGE, "s", "explicit, spall"),
    ("implicit_s_per_step", PURPLE, "^", "implicit, healthy"),
)
for column, colour, marker, label in CURVES:
    cost = 1e6 * np.array([float(row[column]) for row in rows])
    axis.loglog(count, cost, marker + "-", color=colour, markersize=5, label=label)
    # In proportion to the number, through the last point.
    axis.loglog(count, cost[-1] * count / count[-1], ":", color=colour, linewidth=0.9)
axis.set_xlabel("elements (dotted: in proportion to their number)")
axis.set_ylabel("CPU time of one step (µs)")
axis.set_xticks([3, 5, 9, 16, 25, 50, 100], ["3", "5", "9", "16", "25", "50", "100"])
axis.minorticks_off()
axis.legend()
plotting.save(figure, stem)
