"""The look of every figure: README width, legible at half size, colour-blind safe, equal bytes from equal data."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from figures import whole, written  # noqa: E402
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter  # noqa: E402

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


# Samples of a curve across a figure beyond which they are a solid block; bands then have so many parts.
MOST_SAMPLES, PARTS = 12_000, 480
# Parts that a turn of the shaft needs, or its passages through the load zone beat with them.
PARTS_OF_A_TURN = 8
# Of all samples of a part: the least, the middle two thirds, the middle one, the greatest.
SHARES = np.array([0.0, 1 / 6, 0.5, 5 / 6, 1.0])


def is_long(time):
    """Whether a curve over these times is drawn as bands."""
    return len(time) > MOST_SAMPLES


def bands_said(time):
    """How bands are to be read, for a title."""
    if not is_long(time):
        return ""
    return "; in each part of the time: line the middle value, dark two thirds of all, light all of them"


def windows(time, turn):
    """First and last sample of each part: parts side by side, or as long as a turn where they are too few for one."""
    edges = np.linspace(0, len(time), PARTS + 1)
    part = (time[-1] - time[0]) / PARTS
    if turn and part > turn / PARTS_OF_A_TURN:
        half = 0.5 * max(part, turn) / (time[-1] - time[0]) * len(time)
        middle = 0.5 * (edges[1:] + edges[:-1])
        return np.maximum(middle - half, 0).astype(int), np.minimum(middle + half, len(time)).astype(int)
    return edges[:-1].astype(int), edges[1:].astype(int)


def quantiles(values):
    """What NumPy's function gives at [`SHARES`], without the checks that take most of its time for few values."""
    at = SHARES * (len(values) - 1)
    below = at.astype(int)
    above = np.minimum(below + 1, len(values) - 1)
    ordered = np.partition(values, np.concatenate((below, above)))
    return ordered[below] + (at - below) * (ordered[above] - ordered[below])


def curve(axis, time, values, colour, label, turn=None):
    """A line through the samples, or where they are too many: all of them, the middle two thirds and the middle one in
    each of equal parts of the time. `turn`: time of one turn of the shaft."""
    if not is_long(time):
        drawn = axis.plot(time, values, color=colour, label=label, linewidth=0.9)
    else:
        first, last = windows(time, turn)
        middle = np.linspace(time[0], time[-1], 2 * PARTS + 1)[1::2]
        # What the first and the last part stand for reaches to the ends.
        middle[0], middle[-1] = time[0], time[-1]
        low, lower, half, upper, high = np.array([quantiles(values[a:b]) for a, b in zip(first, last)]).T
        drawn = [
            axis.fill_between(middle, low, high, color=colour, alpha=0.25, linewidth=0),
            axis.fill_between(middle, lower, upper, color=colour, alpha=0.5, linewidth=0),
            *axis.plot(middle, half, color=colour, label=label, linewidth=0.9),
        ]
    # A curve ends within its axes: the layout, which would look for the room of each, need not know of it.
    for artist in drawn:
        artist.set_in_layout(False)


def logarithmic(axis, subs=(1, 2, 5)):
    """A logarithmic axis upwards, marked at these multiples of powers of ten in plain numbers."""
    axis.set_yscale("log")
    axis.yaxis.set_major_locator(LogLocator(subs=subs))
    axis.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.0f}" if value >= 1 else f"{value:g}"))
    axis.yaxis.set_minor_formatter(NullFormatter())


def read_csv(path):
    """Columns of a CSV file by their names without units."""
    with open(path, encoding="utf-8") as file:
        names = [cell.rsplit(" [", 1)[0] for cell in file.readline().strip().split(",")]
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    return {name: values[:, index] for index, name in enumerate(names)}


def signals(path):
    """Signals of a NumPy file of this program by their names, read where they are used."""
    # Of our own file the header may be of any length, which this lets pass.
    data = np.load(path, mmap_mode="r", allow_pickle=True)
    found = {}
    for name in data.dtype.names:
        if data.dtype[name].subdtype is None:
            found[name] = data[name]
            continue
        # An array over the elements.
        first, _, rest = name.partition(".")
        found.update({f"{first}[{j + 1}].{rest}": data[name][:, j] for j in range(data[name].shape[1])})
    return found


def write_csv(path, header, columns):
    """Columns of equal length; `repr` of a float reads back to the same bits."""
    with whole(path) as part, open(part, "w", encoding="utf-8", newline="\n") as file:
        file.write(",".join(header) + "\n")
        for row in zip(*(np.asarray(column, dtype=float).tolist() for column in columns)):
            file.write(",".join(map(repr, row)) + "\n")


def save(figure, stem):
    """Writes the figure and names its files on standard output."""
    for path in written(figure, stem):
        print(path)
