"""The look of every figure: README width, legible at half size, colour-blind safe, equal bytes from equal data."""

import contextlib
import os
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

# Okabe and Ito's palette; black is left for axes and event lines.
BLUE, ORANGE, GREEN, VERMILION, SKY, PURPLE = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7"
WIDTH = 9.0  # inches: 900 px at 100 dpi, the width of a README

plt.rcParams.update(
    {
        "svg.hashsalt": "brinell",
        "font.family": "DejaVu Sans",
        "font.size": 10,
        "axes.labelsize": 10,
        "axes.titlesize": 11,
        "axes.titlelocation": "left",
        "axes.grid": True,
        "grid.color": "#dddddd",
        "grid.linewidth": 0.6,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.axisbelow": True,
        "legend.frameon": False,
        "legend.fontsize": 9,
        "lines.linewidth": 1.2,
        "figure.constrained_layout.use": True,
    }
)


def read_csv(path):
    """Columns of a CSV file by their names without units."""
    with open(path, encoding="utf-8") as file:
        names = [cell.rsplit(" [", 1)[0] for cell in file.readline().strip().split(",")]
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    return {name: values[:, index] for index, name in enumerate(names)}


@contextlib.contextmanager
def whole(path):
    """A file to write that takes the name `path` when all is written: a full disk leaves what was there before."""
    path = Path(path)
    part = path.with_name(f"new-{os.getpid()}-{path.name}")
    try:
        yield part
        os.replace(part, path)
    except OSError as error:
        why = f"{path} was not written, what was there before is unchanged: {error.strerror}; choose another folder"
        raise OSError(error.errno, why) from error
    finally:
        part.unlink(missing_ok=True)


def write_csv(path, header, columns):
    """Columns of equal length; `repr` of a float reads back to the same bits."""
    with whole(path) as part, open(part, "w", encoding="utf-8", newline="\n") as file:
        file.write(",".join(header) + "\n")
        for row in zip(*(np.asarray(column, dtype=float).tolist() for column in columns)):
            file.write(",".join(map(repr, row)) + "\n")


def save(figure, stem):
    """Writes `stem`.svg and .png without dates or program versions, and names them on standard output."""
    stem = Path(stem)
    for suffix, metadata in ((".svg", {"Date": None, "Creator": None}), (".png", {"Software": None})):
        path = stem.with_name(stem.name + suffix)
        with whole(path) as part:
            figure.savefig(part, metadata=metadata, dpi=150)
        print(path)
    plt.close(figure)
