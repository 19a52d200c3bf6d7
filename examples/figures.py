"""How the examples' figures look, and how they are written: the same bytes from the same numbers."""

import matplotlib
import numpy as np
from bearing import whole

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, BLACK = "#0072B2", "#D55E00", "#009E73", "black"  # told apart by colour-blind eyes, too
# Samples of a curve beyond which it is drawn as bands, in so many parts.
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


def curve(axis, time, values, colour, label=None):
    """A line through the samples, or of more than 12 000, a solid block otherwise, bands: in each of 120 parts of the
    time all of them, the middle two thirds and the middle one, as in figures of `brinell run`."""
    if len(time) <= MOST_SAMPLES:
        axis.plot(time, values, color=colour, label=label)
        return
    middle = [times.mean() for times in np.array_split(time, PARTS)]
    middle[0], middle[-1] = time[0], time[-1]
    quantiles = [np.quantile(part, [0.0, 1 / 6, 0.5, 5 / 6, 1.0]) for part in np.array_split(values, PARTS)]
    low, lower, half, upper, high = np.transpose(quantiles)
    axis.fill_between(middle, low, high, color=colour, alpha=0.25, linewidth=0)
    axis.fill_between(middle, lower, upper, color=colour, alpha=0.5, linewidth=0)
    axis.plot(middle, half, color=colour, label=label)


def save(figure, stem):
    for suffix in ("svg", "png"):
        metadata = {"Date": None} if suffix == "svg" else {"Software": None}
        with whole(f"{stem}.{suffix}") as part:
            figure.savefig(part, dpi=150, metadata=metadata)
    plt.close(figure)
