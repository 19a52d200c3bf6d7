"""Pressure of a ball on a raceway beside Hertz's, and von Mises stress over depth and in two planes below it."""

import json
import sys
from pathlib import Path

import numpy as np
import plotting
from figures import UNBOUNDED, cells
from matplotlib.ticker import MaxNLocator
from plotting import BLUE, GREEN, VERMILION, plt

# Most cells each way of the map that are drawn: more than pixels make no difference.
MOST = 256
stem = Path(sys.argv[1])
report = json.loads(stem.with_name(stem.name + ".json").read_text(encoding="utf-8"))
found, hertz, stress = report["found"], report["hertz"], report["stress"]
(x_from, x_to), (y_from, y_to) = report["window_mm"]


def table(end):
    return plotting.read_csv(stem.with_name(stem.name + end))


(x, y), pressure = cells(report, table("-pressure.csv"))
surface = table("-surface.csv")
lines = np.unique(surface["y"])
depth_x = 1e3 * surface["x"][: len(surface["x"]) // len(lines)]
depth = 1e6 * surface["depth"].reshape(len(lines), -1)
# The line below which stresses were worked out.
below_x, below_y, _ = stress["below_middle"]["at_mm"]
middle_row = int(np.argmin(np.abs(y - below_y)))
middle_column = int(np.argmin(np.abs(x - below_x)))


# At an edge pressure and stress grow without bound as cells get smaller: what is far beyond these is cut off.
HIGHEST_PRESSURE = max(hertz["max_pressure_mpa"], np.quantile(pressure[pressure > 0], 0.97))
HIGHEST_STRESS = max(stress["below_middle"]["von_mises_mpa"], stress["hertz"]["von_mises_mpa"])


def scale(most, bound):
    """Up to where values of at most `most` are drawn, and whether some are beyond."""
    return (UNBOUNDED * bound, True) if most > UNBOUNDED * bound else (most, False)


def legend_below(axis):
    """A legend that covers no curve, and few enough numbers along the axis."""
    axis.xaxis.set_major_locator(MaxNLocator(5))
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.2), ncols=3, fontsize=8, handlelength=1.4, columnspacing=1)


def edges(axis, label=None):
    for edge in report["edges_mm"]:
        if x_from < edge < x_to:
            axis.axvline(edge, color="black", linewidth=0.9, linestyle="--", label=label)
            label = None


def levels_of_depth():
    """Some depths (µm) between the surface's least and greatest, none where it is flat."""
    least, greatest = depth.min(), depth.max()
    return np.linspace(least, greatest, 5)[1:-1] if greatest - least > 1e-3 else []


def pressure_map(axis):
    every_x, every_y = (max(1, -(-len(at) // MOST)) for at in (x, y))
    shown = np.ma.masked_equal(pressure[::every_y, ::every_x], 0)
    mesh = axis.pcolormesh(x[::every_x], y[::every_y], shown, cmap="viridis", rasterized=True)
    top, beyond = scale(shown.max(), HIGHEST_PRESSURE)
    mesh.set_clim(0, top)
    figure.colorbar(mesh, ax=axis, label="pressure (MPa)", extend="max" if beyond else "neither")
    turn = np.linspace(0, 2 * np.pi, 400)
    a, b = hertz["half_axes_mm"]
    axis.plot(a * np.cos(turn), b * np.sin(turn), color=VERMILION, label="Hertz's ellipse, smooth raceway")
    if len(lines) > 1 and len(levels_of_depth()):
        drawn = axis.contour(depth_x, 1e3 * lines, depth, levels_of_depth(), colors="black", linewidths=0.7)
        axis.clabel(drawn, fmt="%.1f µm", fontsize=7)
    edges(axis, label="edge of the defect")
    limits(axis, x, y, a, b)
    axis.set_title("pressure (axes are not to one scale)")
    axis.set_xlabel("x, along the raceway (mm)")
    axis.set_ylabel("y, across the raceway (mm)")
    legend_below(axis)


def limits(axis, x, y, a, b):
    """All of the window and of Hertz's ellipse."""
    axis.set_xlim(min(x[0], -1.05 * a), max(x[-1], 1.05 * a))
    low, high = min(y[0], -1.05 * b), max(y[-1], 1.05 * b)
    axis.set_ylim(low, high)


def hertz_section(at, half, other_at, other_half):
    return hertz["max_pressure_mpa"] * np.sqrt(np.maximum(0, 1 - (at / half) ** 2 - (other_at / other_half) ** 2))


def section(axis, values, title, label):
    top, beyond = scale(max(values.max(), hertz["max_pressure_mpa"]), HIGHEST_PRESSURE)
    axis.set_ylim(0, 1.05 * top)
    # How far beyond depends on the cells.
    axis.set_title(f"{title}; peak cut off" if beyond else title)
    axis.set_xlabel(label)
    axis.set_ylabel("pressure (MPa)")


def along(axis):
    """Pressure along the raceway, and the depth below."""
    a, b = hertz["half_axes_mm"]
    at = np.union1d(x, np.linspace(-a, a, 400))
    axis.plot(at, hertz_section(at, a, below_y, b), color=VERMILION, linestyle="--", label="Hertz, smooth raceway")
    axis.plot(x, pressure[middle_row], color=BLUE, label="found")
    edges(axis, label="edge of the defect")
    section(axis, pressure[middle_row], f"along, at y = {below_y:.3f} mm", "x, along the raceway (mm)")
    if np.ptp(depth) > 1e-3:
        other = axis.twinx()
        line = depth[np.argmin(np.abs(1e3 * lines - below_y))]
        other.plot(depth_x, line, color=GREEN, linewidth=0.9)
        # Downwards, and below the pressure.
        other.set_ylim(max(line.max(), 1e-3) * 1.05, min(0, line.min()) - 3 * np.ptp(line))
        ticks = [tick for tick in other.get_yticks() if min(0, line.min()) <= tick <= line.max()]
        other.set_yticks(ticks)
        other.set_ylabel("depth (µm)", color=GREEN, loc="bottom")
        other.grid(False)
    legend_below(axis)


def across(axis):
    a, b = hertz["half_axes_mm"]
    at = np.union1d(y, np.linspace(-b, b, 400))
    axis.plot(at, hertz_section(at, b, 0.0, a), color=VERMILION, linestyle="--", label="Hertz's, in its middle")
    axis.plot(y, pressure[:, middle_column], color=BLUE, label="found")
    section(axis, pressure[:, middle_column], f"across, at x = {below_x:.3f} mm", "y, across the raceway (mm)")
    legend_below(axis)


def over_depth(axis):
    line = table("-depth.csv")
    axis.plot(1e-6 * line["stress.von_mises"], 1e3 * line["depth"], color=BLUE, label="found")
    axis.plot(1e-6 * line["hertz.von_mises"], 1e3 * line["depth"], color=VERMILION, linestyle="--", label="Hertz")
    for what, colour in (("below_middle", BLUE), ("hertz", VERMILION)):
        most = stress[what]
        axis.plot(most["von_mises_mpa"], most["at_mm"][2], "o", color=colour, markersize=4)
    axis.set_ylim(1e3 * line["depth"][-1], 0)
    axis.set_xlim(left=0)
    axis.set_title(f"below x = {below_x:.3f} mm, where the force acts")
    axis.set_xlabel("von Mises stress (MPa)")
    axis.set_ylabel("depth (mm)")
    axis.legend(loc="lower right", fontsize=8)


def planes():
    """Von Mises stress (MPa) in the planes along and across the raceway: coordinates, depths, values."""
    points = table("-plane.csv")
    half = len(points["x"]) // 2
    for part, name in ((slice(0, half), "x"), (slice(half, None), "y")):
        depths = np.unique(points["depth"][part])
        values = 1e-6 * points["stress.von_mises"][part].reshape(len(depths), -1)
        yield 1e3 * points[name][part][: values.shape[1]], 1e3 * depths, values


def plane(axis, at, depths, values, levels, title, label):
    extend = "max" if values.max() > levels[-1] else "neither"
    drawn = axis.contourf(at, depths, values, levels, cmap="viridis", extend=extend)
    k, i = np.unravel_index(np.argmax(values), values.shape)
    axis.plot(at[i], depths[k], "+", color=VERMILION, markersize=10, markeredgewidth=1.5, clip_on=False)
    axis.set_ylim(depths[-1], depths[0])
    axis.set_title(f"{title}; + {values[k, i]:.0f} MPa")
    axis.set_xlabel(label)
    axis.set_ylabel("depth (mm)")
    axis.grid(False)
    return drawn


figure = plt.figure(figsize=(plotting.WIDTH, 9.6))
grid = figure.add_gridspec(3, 2)
pressure_map(figure.add_subplot(grid[0, 0]))
along(figure.add_subplot(grid[0, 1]))
over_depth(figure.add_subplot(grid[1, 0]))
across(figure.add_subplot(grid[1, 1]))
(in_x, in_y) = planes()
levels = MaxNLocator(12).tick_values(0, scale(max(in_x[2].max(), in_y[2].max()), HIGHEST_STRESS)[0])
drawn = plane(figure.add_subplot(grid[2, 0]), *in_x, levels, "von Mises stress along", "x, along the raceway (mm)")
edges(figure.axes[-1])
axis = figure.add_subplot(grid[2, 1])
plane(axis, *in_y, levels, "von Mises stress across", "y, across the raceway (mm)")
figure.colorbar(drawn, ax=axis, label="von Mises stress (MPa)")
figure.suptitle(
    f"{report['scene']}: {report['force_n']:g} N on the {report['on']} raceway, {report['angle_deg']:g}° from the "
    f"defect's middle\napproach {found['approach_um']:.2f} µm, Hertz's {hertz['approach_um']:.2f} µm; "
    f"Hertz's pressure {hertz['max_pressure_mpa']:.0f} MPa",
    x=0.01,
    ha="left",
)
plotting.save(figure, stem)
