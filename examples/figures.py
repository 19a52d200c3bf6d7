"""How the examples' figures look, and how they are written: the same bytes from the same numbers."""

import bearing  # noqa: F401, where the package is not installed
import matplotlib
import numpy as np
from brinell.figures import written

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, BLACK = "#0072B2", "#D55E00", "#009E73", "black"  # told apart by colour-blind eyes, too
# Samples of a curve beyond which it is drawn as a band, and most parts of that.
MOST_SAMPLES, PARTS = 12_000, 120
matplotlib.rcParams["svg.hashsalt"] = "brinell"


def plots(count, height, **options):
    """A figure with `count` plots below one another."""
    figure, axes = plt.subplots(count, 1, figsize=(9, height), constrained_layout=True, **options)
    for axis in axes:
        axis.grid(color="#dddddd", linewidth=0.6)
        axis.spines[["top", "right"]].set_visible(False)
    return figure, axes


def legend(axis):
    """Above the plot on the right: it covers nothing."""
    axis.legend(frameon=False, ncols=2, loc="lower right", bbox_to_anchor=(1, 0.97), borderaxespad=0)


def curve(axis, time, values, colour, label, turns):
    """A line through the samples, or of more than 12 000, a solid block otherwise, a band: in parts of so many whole
    turns that there are 120 at most, all that there is and, darker, the middle two thirds."""
    if len(time) <= MOST_SAMPLES:
        axis.plot(time, values, color=colour, label=label, linewidth=0.8)
        return
    each = int(np.ceil((time[-1] - time[0]) * turns / PARTS))
    edges = np.arange(time[0], time[-1] - 0.5 * each / turns, each / turns)
    parts = np.split(np.arange(len(time)), np.searchsorted(time, edges[1:]))
    middle = np.array([time[part].mean() for part in parts])
    # What the first and the last part stand for reaches to the ends.
    middle[0], middle[-1] = time[0], time[-1]
    low, lower, upper, high = np.transpose([np.quantile(values[part], [0.0, 1 / 6, 5 / 6, 1.0]) for part in parts])
    axis.fill_between(middle, low, high, facecolor=colour, alpha=0.25, linewidth=0)
    axis.fill_between(middle, lower, upper, facecolor=colour, alpha=0.6, linewidth=0, label=label)


def save(figure, stem):
    list(written(figure, stem))
