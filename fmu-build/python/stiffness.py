"""Static stiffness over the cage angle, load distribution, and what the critical load depends on."""

import sys
from pathlib import Path

import numpy as np
import plotting
from figures import GREY, from_middle, stiffness
from plotting import BLUE, GREEN, VERMILION, plt

stem = Path(sys.argv[1])
data = plotting.read_csv(stem.with_name(stem.name + "-stiffness.csv"))
critical_file = stem.with_name(stem.name + "-critical-load.csv")
variations = (
    plotting.read_csv(critical_file) if critical_file.exists() and np.isfinite(data["critical_load"]).any() else None
)

cage = from_middle(data["cage.angle"])
load = np.hypot(data["load.x"][0], data["load.y"][0])
direction = np.arctan2(data["load.y"][0], data["load.x"][0])
count = sum(name.endswith("].angle") for name in data)


def unturned(angle):
    return np.remainder(angle + 180.0, 360.0) - 180.0


def logarithmic(axis, values, headroom=1.4):
    """Newtons on a logarithmic axis, from a little below the least to a little above the greatest, marked 1 2 5."""
    values = values[np.isfinite(values) & (values > 0)]
    if not len(values):
        # An element rests on the bottom without any load: the axis is linear, and the curve lies on it.
        axis.set_ylim(-0.05 * load, headroom * load)
        return
    plotting.logarithmic(axis)
    axis.set_ylim(0.7 * min(values.min(), load), headroom * max(values.max(), load))


def critical_over_angle(axis):
    axis.plot(cage, data["critical_load"], color=VERMILION, label="the deepest element carries")
    axis.axhline(load, color="black", linewidth=0.9, linestyle=":", label="the load")
    # On its way in and out an element carries at once: only the upper two decades tell anything.
    values = data["critical_load"]
    logarithmic(axis, values[values > 0.01 * np.nanmax(values)], headroom=3)
    axis.set_xlim(cage[0], cage[-1])
    axis.set_title("critical load")
    axis.set_ylabel("load (N)")
    axis.set_xlabel("cage angle from the defect (degrees)")
    axis.legend(loc="upper center", ncols=2)


def distribution(axis):
    """Every element's force on its way, and all elements at three cage angles."""
    angles = np.array([unturned(np.degrees(data[f"element[{j}].angle"] - direction)) for j in range(1, count + 1)])
    forces = np.array([data[f"element[{j}].force.inner"] for j in range(1, count + 1)])
    inside = np.array([data[f"element[{j}].in_defect"] for j in range(1, count + 1)]) > 0
    order = np.argsort(angles, axis=None)
    if inside.any():
        # Around the turn the defect may reach over ±180 degrees: shade what is inside, piece by piece.
        lower, upper = angles.ravel()[order], inside.ravel()[order]
        axis.fill_between(
            lower, 0, 1, where=upper, transform=axis.get_xaxis_transform(), color="#eeeeee", zorder=0, label="defect"
        )
    axis.plot(angles.ravel()[order], forces.ravel()[order], color=GREY, linewidth=0.9, label="one element on its way")
    for share, colour, marker in ((0.5, BLUE, "o"), (0.75, GREEN, "s"), (1.0, VERMILION, "^")):
        k = int(np.argmin(np.abs(cage - (cage[0] + share * (cage[-1] - cage[0])))))
        drawn = {"color": colour, "markersize": 6, "clip_on": False, "zorder": 3}
        axis.plot(angles[:, k], forces[:, k], marker, label=f"cage angle {cage[k]:.0f}°", **drawn)
    axis.set_xlim(-180, 180)
    axis.set_xticks(range(-180, 181, 45))
    axis.set_ylim(0, 1.05 * forces.max())
    axis.set_title(f"load distribution, {load:g} N")
    axis.set_ylabel("element force (N)")
    axis.set_xlabel("angle of the element from the load (degrees)")
    axis.legend(loc="upper left", ncols=1)


def variation(axis, number, name, scale, label):
    rows = variations["varied"] == number
    axis.plot(variations[name][rows] * scale, variations["critical_load"][rows], ".-", color=VERMILION)
    # The other two blocks hold this quantity at the scene's value.
    axis.axvline(variations[name][~rows][0] * scale, color=GREY, linewidth=0.9, label="the scene")
    axis.axhline(load, color="black", linewidth=0.9, linestyle=":", label="the load")
    logarithmic(axis, variations["critical_load"])
    axis.set_xlabel(label)


if variations is None:
    figure, axes = plt.subplots(2, 1, figsize=(plotting.WIDTH, 6.4))
    stiffness(axes[0], data)
    distribution(axes[1])
else:
    figure = plt.figure(figsize=(plotting.WIDTH, 9.2))
    grid = figure.add_gridspec(3, 6)
    stiffness(figure.add_subplot(grid[0, :3]), data)
    critical_over_angle(figure.add_subplot(grid[0, 3:]))
    distribution(figure.add_subplot(grid[1, :]))
    panels = (
        (0, "path", 1e6, "depth of the path (µm)"),
        (1, "clearance", 1e6, "radial clearance (µm)"),
        (2, "compliance", 1e9, "outer compliance (nm/N)"),
    )
    first = None
    for column, (number, name, scale, label) in enumerate(panels):
        axis = figure.add_subplot(grid[2, 2 * column : 2 * column + 2], sharey=first)
        variation(axis, number, name, scale, label)
        if first is None:
            first = axis
            axis.set_ylabel("critical load (N)")
            axis.set_title("what the critical load depends on")
            axis.legend(loc="lower right")
        else:
            axis.tick_params(labelleft=False)
figure.suptitle(stem.name, x=0.01, ha="left")
plotting.save(figure, stem.with_name(stem.name + "-stiffness"))

over_shaft = stem.with_name(stem.name + "-shaft-stiffness.csv")
if over_shaft.exists():
    turn = plotting.read_csv(over_shaft)
    figure, axis = plt.subplots(figsize=(plotting.WIDTH, 3.4))
    angle = np.degrees(turn["shaft.angle"])
    least, mean, greatest = (turn[f"stiffness.free.{which}"] * 1e-6 for which in ("least", "mean", "greatest"))
    axis.fill_between(
        angle, least, greatest, color=BLUE, alpha=0.2, linewidth=0, label="least to greatest over the cage angle"
    )
    axis.plot(angle, mean, color=BLUE, label="mean over the cage angle")
    axis.set_xlim(-180, 180)
    axis.set_xticks(range(-180, 181, 45))
    axis.set_ylim(0, 1.1 * greatest.max())
    axis.set_title(f"stiffness along the load, {load:g} N, no transverse force")
    axis.set_ylabel("stiffness (N/µm)")
    axis.set_xlabel("angle of the inner ring, 0 with its defect under the load (degrees)")
    axis.legend(loc="lower left")
    figure.suptitle(stem.name, x=0.01, ha="left")
    plotting.save(figure, stem.with_name(stem.name + "-shaft-stiffness"))
