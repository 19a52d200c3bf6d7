"""Overview of a run: what moves, the forces on both rings, the outer forces of the elements, and the sensor."""

import sys
from pathlib import Path

import plotting
from plotting import BLUE, GREEN, ORANGE, VERMILION, plt

path = Path(sys.argv[1])
data = plotting.read_csv(path)
time = data["time"] * 1e3


def curves(axis, names, colours, scale=1.0, labels=None):
    for name, colour, label in zip(names, colours, labels or names):
        axis.plot(time, data[name] * scale, color=colour, label=label, linewidth=0.9)


def panels():
    """Each panel: its axis label and what draws it, as far as this run has the signals."""
    if "sensor.acceleration" in data:
        yield "sensor, y\n(m/s²)", lambda axis: curves(axis, ["sensor.acceleration"], [BLUE])
    for ring, colour in (("housing", VERMILION), ("shaft", GREEN)):
        if f"{ring}.ay" in data and data[f"{ring}.ay"].any():
            name = f"{ring}.ay"
            yield f"{ring}, y\n(m/s²)", lambda axis, name=name, colour=colour: curves(axis, [name], [colour])
    for ring in ("shaft", "housing"):
        if f"{ring}.y" in data and data[f"{ring}.y"].any():
            names = [f"{ring}.x", f"{ring}.y"]
            yield (
                f"{ring}\nposition (µm)",
                lambda axis, names=names: curves(axis, names, [ORANGE, BLUE], 1e6, ["x", "y"]),
            )
    yield (
        "bearing force\non shaft (N)",
        lambda axis: curves(axis, ["shaft.force.x", "shaft.force.y"], [ORANGE, BLUE], 1.0, ["x", "y"]),
    )

    def outer(axis):
        count = sum(name.startswith("element[") and name.endswith("].force.outer") for name in data)
        for j in range(1, count + 1):
            colour = plt.cm.viridis((j - 1) / max(count, 2))
            axis.plot(time, data[f"element[{j}].force.outer"], color=colour, linewidth=0.9, label=str(j))

    yield "outer force on\nelements (N)", outer


drawn = list(panels())
figure, axes = plt.subplots(len(drawn), 1, figsize=(plotting.WIDTH, 0.6 + 1.5 * len(drawn)), sharex=True, squeeze=False)
for axis, (label, draw) in zip(axes[:, 0], drawn):
    draw(axis)
    axis.set_ylabel(label)
    if len(axis.get_legend_handles_labels()[1]) > 1:
        axis.legend(loc="lower right", bbox_to_anchor=(1, 0.93), ncols=24, handlelength=1, columnspacing=1)
axes[0, 0].set_title(path.stem)
axes[-1, 0].set_xlabel("time (ms)")
axes[-1, 0].set_xlim(time[0], time[-1])
figure.align_ylabels()
plotting.save(figure, path.with_suffix(""))
