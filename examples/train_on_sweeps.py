#!/usr/bin/env python3
"""A plain classifier of a bearing's damaged part, trained on a sweep alone and tried on recordings of machines.

    brinell sweep examples/train_on_sweeps.toml -o made --signals
    python examples/train_on_sweeps.py made recordings/list.csv

The list has the lines file,rig,fault,length,speed,rate,elements,diameter,pitch: NumPy files beside it, fault outer,
inner, element or none, speed and rate in Hz, diameters in mm. Needs numpy, scipy, scikit-learn and pyarrow.
"""

import csv
import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
from scipy.signal import butter, hilbert, sosfiltfilt
from sklearn.ensemble import RandomForestClassifier
from sklearn.metrics import balanced_accuracy_score, confusion_matrix

KINDS = ["none", "outer", "inner", "element"]
TURNS = 12  # of every signal: lines then are as wide in all
BANDS = [(1000, 2500), (2500, 5000)]  # Hz: below the Nyquist frequency of all


def features(signal, rate, speed, elements, ratio):
    """Heights of the envelope's lines over their surroundings, in orders of the shaft: no level, no unit, no rate."""
    passes = elements / 2 * (1 - ratio), elements / 2 * (1 + ratio), 1 / ratio - ratio
    found = []
    for band in BANDS:
        envelope = np.abs(hilbert(sosfiltfilt(butter(4, band, "bandpass", fs=rate, output="sos"), signal))) ** 2
        line = np.abs(np.fft.rfft((envelope / envelope.mean() - 1) * np.hanning(signal.size), 4 * signal.size))
        order = np.fft.rfftfreq(4 * signal.size, speed / rate)
        for base, side in zip(passes, (1, 1, (1 - ratio) / 2)):
            tallest = lambda f: line[abs(order - f) < 0.02 * f].max()
            height = lambda f: np.log(tallest(f) / np.median(line[abs(order - f) < 0.15 * f]))
            beside = np.log(tallest(base) / line[abs(order - base) < 1.2 * base].max())
            heights = [height(k * base) for k in (1, 2, 3)]
            found += [np.mean(heights), beside, height(base - side) + height(base + side)]
    return found


def pieces(signal, rate, speed, most):
    count = int(TURNS * rate / speed)
    return [signal[k : k + count] for k in range(0, signal.size - count + 1, count)][:most]


def made(folder):
    for run in parquet.read_table(folder + "/runs.parquet").to_pylist():
        signal = np.load(f"{folder}/signals/run-{run['run']:07}.npy")["sensor.acceleration"]
        kind = "none" if run["label_kind"] == "healthy" else run["label_kind"]
        yield kind, signal, run["fs"], run["speed_rpm"] / 60, 9, 7.94 / 39.04


def recorded(path):
    for run in csv.DictReader(open(path)):
        signal = np.load(Path(path).parent / run["file"]).astype(float)
        rate, speed, elements, ball, pitch = (float(run[k]) for k in ("rate", "speed", "elements", "diameter", "pitch"))
        yield run["fault"], signal, rate, speed, elements, ball / pitch


def rows(runs, most):
    found = []
    for n, (kind, signal, rate, speed, *bearing) in enumerate(runs):
        parts = pieces(signal, rate, speed, most)
        found += [(kind, n, features(part, rate, speed, *bearing)) for part in parts]
    return [np.array(column) for column in zip(*found)]


kinds, _, x = rows(made(sys.argv[1]), 3)
model = RandomForestClassifier(400, min_samples_leaf=2, class_weight="balanced", random_state=0).fit(x, kinds)
truth, which, x = rows(recorded(sys.argv[2]), 8)
votes = np.array([model.predict_proba(x[which == n]).mean(0) for n in np.unique(which)])
truth = np.array([truth[which == n][0] for n in np.unique(which)])
said = model.classes_[votes.argmax(1)]
print("known \\ said", *KINDS)
for kind, row in zip(KINDS, confusion_matrix(truth, said, labels=KINDS)):
    print(f"{kind:12}", *row)
print(f"balanced accuracy: {100 * balanced_accuracy_score(truth, said):.0f} % of {truth.size} recordings")
