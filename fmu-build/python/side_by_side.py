"""Steps a second of one core over the number of elements, of bearings alone and side by side in registers."""

import csv
import sys
from pathlib import Path

import numpy as np
import plotting
from plotting import BLUE, GREEN, ORANGE, PURPLE, plt

data, stem = Path(sys.argv[1]), Path(sys.argv[2])
with open(data / "side-by-side.csv", encoding="utf-8") as file:
    rows = list(csv.DictReader(file))
count = np.array([float(row["elements"]) for row in rows])
figure, axis = plt.subplots(figsize=(plotting.WIDTH, 4.2))
measured = 1e-6 / np.array([float(row["alone_measured_s"]) for row in rows])
axis.loglog(count, measured, "o", color=BLUE, markersize=5, label="alone, measured")
CURVES = (
    ("of_1_s", BLUE, "-", "alone, fitted"),
    ("of_2_s", PURPLE, "-.", "two side by side, at best"),
    ("of_4_s", GREEN, "--", "four"),
    ("of_8_s", ORANGE, ":", "eight"),
)
for column, colour, line, label in CURVES:
    steps = 1e-6 / np.array([float(row[column]) for row in rows])
    axis.loglog(count, steps, line, color=colour, linewidth=1.6, label=label)
axis.set_xlabel("elements of a bearing")
axis.set_ylabel("steps of all bearings per µs of one core")
axis.set_xticks([3, 5, 9, 16, 25, 50, 100], ["3", "5", "9", "16", "25", "50", "100"])
axis.set_yticks([0.2, 0.5, 1, 2, 5], ["0.2", "0.5", "1", "2", "5"])
axis.minorticks_off()
axis.legend()
plotting.save(figure, stem)
