"""Figures by matplotlib of what the package's functions give. Those of the commands show more."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Signal = npt.NDArray[np.float64]
Table = Mapping[str, Signal]
WIDTH = 9.0  # inches
# A line belongs to the elements if more than this share of its energy is theirs.
MOST = 0.5
# At an edge pressure grows without bound as cells get smaller: what is beyond this multiple of all others is cut off.
UNBOUNDED = 1.5
BLUE, ORANGE, VERMILION, GREY = "#0072B2", "#E69F00", "#D55E00", "#777777"


@contextlib.contextmanager
def whole(name: str | Path) -> Iterator[Path]:
    """A file to write that takes this name when all is written: a full disk leaves what was there before."""
    path = Path(name)
    part = path.with_name(f"new-{os.getpid()}-{path.name}")
    try:
        yield part
        os.replace(part, path)
    except OSError as error:
        why = f"{path} was not written, what was there before is unchanged: {error.strerror}; choose another folder"
        raise OSError(error.errno, why) from error
    finally:
        part.unlink(missing_ok=True)


def written(figure: Any, stem: str | Path) -> Iterator[Path]:
    """Writes `stem`.svg and .png without dates or program versions: the same bytes from the same numbers."""
    from matplotlib import pyplot

    for suffix, metadata in ((".svg", {"Date": None, "Creator": None}), (".png", {"Software": None})):
        path = Path(f"{stem}{suffix}")
        with whole(path) as part:
            figure.savefig(part, metadata=metadata, dpi=150)
        # What is laid out once is for both.
        figure.set_layout_engine("none")
        yield path
    pyplot.close(figure)


def panels(along: str, where: Signal, columns: list[tuple[str, str, Signal]]) -> Any:
    """A figure of named columns with their units over one, a panel for each unit."""
    from matplotlib import pyplot

    units = list(dict.fromkeys(unit for _, unit, _ in columns))
    figure, axes = pyplot.subplots(len(units), 1, sharex=True, squeeze=False, layout="constrained")
    for unit, axis in zip(units, axes[:, 0]):
        for name, _, values in (column for column in columns if column[1] == unit):
            axis.plot(where, values, label=name, linewidth=0.9)
        axis.set_ylabel(unit)
        axis.legend(loc="upper right")
    axes[-1, 0].set_xlabel(along)
    return figure


def runs(table: Any, over: str | None, names: list[str]) -> Any:
    """Columns of a sweep's table over another, a panel for each; a colour for each kind of damage."""
    from matplotlib import pyplot

    inputs = list(table.select_dtypes("number").columns)[1:]
    along = over or next((name for name in inputs if table[name].nunique() > 1), "run")
    figure, axes = pyplot.subplots(len(names), 1, sharex=True, squeeze=False, layout="constrained")
    for name, axis in zip(names, axes[:, 0]):
        for kind, part in table.groupby("label_kind"):
            axis.plot(part[along], part[name], "o", label=kind, markersize=4, alpha=0.7)
        axis.set_ylabel(name)
        axis.legend(loc="upper right")
    axes[-1, 0].set_xlabel(along)
    return figure


def from_middle(angle: Signal) -> Signal:
    """An angle of the cage (rad) in degrees from the middle of all, where the defect or the load is."""
    return np.degrees(angle - 0.5 * (angle[0] + angle[-1]))


def stiffness(axis: Any, columns: Table) -> None:
    """The stiffness along the load over the cage angle on an axis, from columns by their names without units; with the
    rings' other coordinate held only where that differs."""
    cage, load = from_middle(columns["cage.angle"]), np.hypot(columns["load.x"][0], columns["load.y"][0])
    free, held, healthy = (1e-6 * columns[f"stiffness.{name}"] for name in ("free", "held", "healthy"))
    axis.plot(cage, healthy, color=GREY, label="without defect", linewidth=0.9)
    if np.abs(held / free - 1).max() > 1e-3:
        axis.plot(cage, held, color=ORANGE, label="transverse position held", linestyle="--")
    axis.plot(cage, free, color=BLUE, label="no transverse force")
    axis.set_ylim(0, 1.1 * max(healthy.max(), held.max()))
    axis.set_xlim(cage[0], cage[-1])
    axis.set_title(f"stiffness along the load, {load:g} N")
    axis.set_ylabel("stiffness (N/µm)")
    defect = np.isfinite(columns["critical_load"]).any()
    axis.set_xlabel(f"cage angle from the {'defect' if defect else 'load'} (degrees)")
    axis.legend(loc="lower left" if free[0] > 0.5 * healthy[0] else "lower center")


def stiffness_alone(columns: Table) -> Any:
    """The same as a figure."""
    from matplotlib import pyplot

    figure, axis = pyplot.subplots(figsize=(WIDTH, 3.4), layout="constrained")
    stiffness(axis, columns)
    return figure


def modes(answer: Mapping[str, Any], _: Mapping[str, Table]) -> Any:
    """Natural frequencies and damping ratios over the cage angle: a curve for each mode of rings and sensor, those of
    the elements grey."""
    from matplotlib import pyplot

    cage = np.array([one["cage_angle_deg"] for one in answer["angles"]]) - answer["middle_deg"]
    figure, axes = pyplot.subplots(1, 2, sharex=True, figsize=(WIDTH, 4.4), layout="constrained")
    quantities = (
        ("undamped_frequency_hz", 1.0, "undamped natural frequency (Hz)"),
        ("damping_ratio", 100.0, "damping ratio (%)"),
    )
    for axis, (key, scale, label) in zip(axes, quantities):
        elements: str | None = "elements"
        # Elements first, so that they hide nothing.
        for line in sorted(answer["lines"], key=lambda line: (line["elements"] <= MOST, line["line"])):
            values = np.full(cage.size, np.nan)
            for i, angle in enumerate(answer["angles"]):
                values[i] = next((scale * mode[key] for mode in angle["modes"] if mode["line"] == line["line"]), np.nan)
            if line["elements"] > MOST:
                axis.plot(cage, values, color="0.75", linewidth=0.7, label=elements)
                elements = None
            else:
                most = answer["freedoms"][int(np.argmax(line["energy"]))]
                axis.plot(cage, values, label=f"{line['line']}: most of all {most}")
        axis.set(yscale="log", ylabel=label)
        axis.set_xlabel(f"cage angle from the {'defect' if answer['defect_length_deg'] else 'load'} (degrees)")
    handles = axes[0].get_legend_handles_labels()
    loads = ((ring, np.hypot(*answer[f"{ring}_load_n"])) for ring in ("shaft", "housing"))
    figure.suptitle(", ".join([answer["scene"], *(f"{load:g} N on the {ring}" for ring, load in loads if load)]))
    figure.legend(*handles, loc="outside lower center", ncols=min(4, len(handles[0])))
    return figure


def passages(answer: Mapping[str, Any], tables: Mapping[str, Table]) -> Any:
    """The averaged passage of each recording and the level of its high-frequency envelope, with the edges of the spall
    and the impacts that were found."""
    from matplotlib import pyplot

    found = answer["recordings"]
    size = (WIDTH, 0.7 + 2.6 * len(found))
    figure, axes = pyplot.subplots(len(found), 2, squeeze=False, figsize=size, layout="constrained")
    for (left, right), one, table in zip(axes, found, tables.values()):
        travel, level = table["angle [deg]"], table["level [dB]"]
        left.plot(travel, table["signal [1]"], linewidth=0.7, label="averaged")
        left.plot(travel, table["low [1]"], linewidth=1.6, label="below 2.5 kHz")
        right.plot(travel, level - level.max(), color="tab:green", linewidth=0.9)
        left.set_ylabel("signal (recording's unit)")
        right.set_ylabel("envelope (dB)")
        zero = " from the leading edge" if one["length_deg"] else ""
        for axis in (left, right):
            marked(axis, one)
            axis.set_xlabel(f"travel of the element{zero} (degrees)")
            axis.set_xlim(travel[0], travel[-1])
        left.set_title(titled(one), loc="left")
    named = {label: line for axis in axes[:, 0] for line, label in zip(*axis.get_legend_handles_labels())}
    figure.legend(named.values(), named.keys(), loc="outside lower center", ncols=len(named))
    return figure


def marked(axis: Any, one: Mapping[str, Any], named: bool = True) -> None:
    """Edges and impacts, if they are named, once."""
    for at, name, style in zip(one["edges_deg"] or (), ("leading edge", "trailing edge"), ("--", "-.")):
        axis.axvline(at, color="black", linewidth=0.9, linestyle=style, label=name if named else None)
    for k, at in enumerate(one["impacts_deg"]):
        axis.axvline(at, color=VERMILION, linewidth=0.9, label="impact" if named and k == 0 else None)


def titled(one: Mapping[str, Any]) -> str:
    """What a recording says of the length."""
    if one["length_deg"] is None:
        return f"{one['name']}: no length, {one['passages']} passages"
    length = f"{one['length_deg']:.2f} ± {one['uncertainty_deg']:.2f}° of the {one['fault']} raceway"
    return f"{one['name']}: {length}, {one['passages']} passages"


def pressure(answer: Mapping[str, Any], tables: Mapping[str, Table]) -> Any:
    """Pressure along and across the raceway, through where the force acts, and von Mises stress below it, each beside
    Hertz's of a smooth raceway."""
    from matplotlib import pyplot

    hertz, edges = answer["hertz"], answer["edges_mm"]
    at, grid = cells(answer, tables["pressure"])
    middle = answer["stress"]["below_middle"]["at_mm"][:2]
    row, column = (int(np.argmin(np.abs(at[k] - middle[k]))) for k in (1, 0))
    figure, axes = pyplot.subplots(1, 3, figsize=(WIDTH, 3.6), layout="constrained")
    highest = UNBOUNDED * max(hertz["max_pressure_mpa"], float(np.quantile(grid[grid > 0], 0.97)))
    sections = (
        ("x, along the raceway (mm)", f"at y = {middle[1]:.3f} mm", grid[row]),
        ("y, across the raceway (mm)", f"at x = {middle[0]:.3f} mm", grid[:, column]),
    )
    for k, (axis, (label, where_cut, values)) in enumerate(zip(axes, sections)):
        half = hertz["half_axes_mm"]
        where = np.union1d(at[k], np.linspace(-half[k], half[k], 400))
        left = 1 - (where / half[k]) ** 2 - (middle[1] / half[1] if k == 0 else 0.0) ** 2
        axis.plot(at[k], values, label="found")
        axis.plot(where, hertz["max_pressure_mpa"] * np.sqrt(np.maximum(0, left)), "--", label="Hertz, smooth raceway")
        axis.set(xlabel=label, ylabel="pressure (MPa)")
        axis.set_ylim(0, 1.05 * min(highest, max(values.max(), hertz["max_pressure_mpa"])))
        axis.set_title(where_cut + "; peak cut off" * bool(values.max() > highest), fontsize="medium")
    for i, edge in enumerate(edge for edge in edges if at[0][0] < edge < at[0][-1]):
        axes[0].axvline(edge, color="black", linewidth=0.9, linestyle=":", label=None if i else "edge of the defect")
    below = tables["depth"]
    for name, style in (("stress.von_mises [Pa]", "-"), ("hertz.von_mises [Pa]", "--")):
        axes[2].plot(1e-6 * below[name], 1e3 * below["depth [m]"], style)
    axes[2].set(xlabel="von Mises stress (MPa)", ylabel="depth (mm)", ylim=(1e3 * below["depth [m]"][-1], 0))
    axes[2].set_xlim(left=0)
    axes[2].set_title("below that point", fontsize="medium")
    place = f", {answer['angle_deg']:g}° from the defect's middle" if edges else ""
    figure.suptitle(f"{answer['scene']}: {answer['force_n']:g} N on the {answer['on']} raceway{place}")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def cells(answer: Mapping[str, Any], under: Table) -> tuple[list[Signal], Signal]:
    """Middles of the grid's columns and rows (mm), and the pressure of each cell (MPa), from columns by their names with
    units or without."""
    named = {head.partition(" [")[0]: column for head, column in under.items()}
    counts, window = answer["cells"], answer["window_mm"]
    width = [(end - begin) / count for (begin, end), count in zip(window, counts)]
    at = [begin + (np.arange(count) + 0.5) * of for (begin, _), count, of in zip(window, counts, width)]
    i, j = (((1e3 * named[axis] - window[k][0]) / width[k]).astype(int) for k, axis in enumerate("xy"))
    grid = np.zeros(counts[::-1])
    grid[j, i] = 1e-6 * named["pressure"]
    return at, grid
