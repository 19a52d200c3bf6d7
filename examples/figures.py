"""How the examples' figures look, and how they are written: the same bytes from the same numbers."""

import matplotlib
from bearing import whole

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, BLACK = "#0072B2", "#D55E00", "#009E73", "black"  # told apart by colour-blind eyes, too
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


def save(figure, stem):
    for suffix in ("svg", "png"):
        metadata = {"Date": None} if suffix == "svg" else {"Software": None}
        with whole(f"{stem}.{suffix}") as part:
            figure.savefig(part, dpi=150, metadata=metadata)
    plt.close(figure)
