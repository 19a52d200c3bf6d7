"""Drives an FMU with fmpy through the C interface while one rolling element crosses the defect, and draws it.

Arguments: the FMU, and the raceway's profile and rigid path (CSV: arc [m], depth [m], path [m]; arc from the defect's
centre along the raceway). Writes overview.csv, passage.csv, events.csv and demo.svg/.png beside the FMU.

The host does what a fixed grid cannot: it takes long communication steps while nothing happens and short ones
while an element is on the defect.
"""

import sys
from pathlib import Path

import plotting
from events import NUMBERED, find_events, listed
from host import started
from plotting import BLUE, GREEN, SKY, VERMILION, np, plt

LONG_STEP, SHORT_STEP = 1e-5, 1e-6  # s; the sensor rings at 15 kHz, contacts at up to 50 kHz
SETTLE = 15e-3  # s; the first passage after this is looked at closely
BEFORE, AFTER = 0.5e-3, 2.2e-3  # s around the passage
OVERVIEW = 60e-3  # s


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


class Raceway:
    """The profile around the defect, and the path of an element that rolls over it without load."""

    def __init__(self, path):
        table = plotting.read_csv(path)
        self.arc, self.depth, self.path = table["arc"], table["depth"], table["path"]
        # A measured trace has no sharp edge: it begins where a tenth of the depth is reached.
        deep = self.arc[self.depth >= 0.1 * self.depth.max()]
        self.edges = deep[0], deep[-1]


def drive(host, raceway, radius):
    """Steps the FMU. Gives the signals of all communication points and the element that was looked at closely."""
    count = sum(name.endswith(".path") for name in host.reference)
    angles = [f"element[{j}].angle" for j in range(1, count + 1)]
    common = ["housing.ay", "sensor.acceleration", "cage.speed"]
    local = ["angle", "force.inner", "force.outer", "path"]
    names = common + [f"element[{j}].{what}" for j in range(1, count + 1) for what in local]
    (centre,) = host.read(["defect.angle"])
    rows, chosen, leaves = [], None, None
    while host.time < OVERVIEW:
        rows.append([host.time, *host.read(names)])
        speed = radius * host.read(["cage.speed"])[0]  # of the contact along the raceway
        arcs = radius * wrapped(np.array(host.read(angles)) - centre)
        if chosen is None and host.time >= SETTLE:
            ahead = (raceway.edges[0] - arcs) / speed
            near = np.flatnonzero((ahead > 0) & (ahead <= BEFORE + LONG_STEP))
            if near.size:
                chosen = int(near[0]) + 1
                leaves = host.time + ahead[near[0]] + (raceway.edges[1] - raceway.edges[0]) / speed + AFTER
        close = chosen is not None and host.time < leaves
        host.step(SHORT_STEP if close else LONG_STEP)
    if chosen is None:
        sys.exit(f"no element reached the defect between {SETTLE} s and {OVERVIEW} s")
    table = dict(zip(["time", *names], np.array(rows).T))
    return table, chosen, centre


def passage(table, element, raceway, radius, centre):
    """The signals around the one passage, time counted from the leading edge."""
    arc = radius * wrapped(table[f"element[{element}].angle"] - centre)
    window = np.flatnonzero(np.diff(table["time"]) < 0.5 * (LONG_STEP + SHORT_STEP))
    window = slice(window[0], window[-1] + 1)
    signals = {
        "time": table["time"][window],
        "arc": arc[window],
        "housing.ay": table["housing.ay"][window],
        "sensor.acceleration": table["sensor.acceleration"][window],
    }
    for what in ("force.inner", "force.outer", "path"):
        signals[what] = table[f"element[{element}].{what}"][window]
    entry, leave = (float(np.interp(edge, signals["arc"], signals["time"])) for edge in raceway.edges)
    return signals, entry, leave


def draw(stem, table, signals, raceway, normal, events, element, radius):
    figure, (all_of_it, housing, sensor, force, path) = plt.subplots(
        5, 1, figsize=(plotting.WIDTH, 11.5), height_ratios=[1, 1, 1, 1.5, 1.5]
    )
    start = events["entry"][0]
    ms = (signals["time"] - start) * 1e3

    all_of_it.plot(table["time"] * 1e3, table["sensor.acceleration"], color=BLUE, linewidth=0.7)
    all_of_it.axvspan(signals["time"][0] * 1e3, signals["time"][-1] * 1e3, color=SKY, alpha=0.3, linewidth=0)
    all_of_it.annotate(
        "below", (signals["time"][-1] * 1e3, 0.97), xycoords=("data", "axes fraction"), va="top", xytext=(3, 0),
        textcoords="offset points", fontsize=9,
    )
    all_of_it.set(ylabel="sensor, y\n(m/s²)", xlabel="time (ms)", xlim=(0, table["time"][-1] * 1e3))
    all_of_it.set_title("A rolling element crosses an etched spall (a stand-in trace): the FMU, stepped by fmpy")

    housing.plot(ms, signals["housing.ay"], color=VERMILION)
    housing.set_ylabel("housing, y\n(m/s²)")
    sensor.plot(ms, signals["sensor.acceleration"], color=BLUE)
    sensor.set_ylabel("sensor, y\n(m/s²)")

    force.plot(ms, signals["force.outer"], color=SKY, linewidth=3, label="outer contact")
    force.plot(ms, signals["force.inner"], color=VERMILION, linewidth=1, label="inner contact")
    # The least on the left, or event 4 would cross it.
    for what, words, side, anchor in (("least", "", -6, "right"), ("peak", "re-load peak, ", 6, "left")):
        if what in events:
            at = ((events[what][0] - start) * 1e3, events[what][1])
            force.plot(*at, "o", color="black", markersize=4)
            beside = {"xytext": (side, 0), "textcoords": "offset points", "ha": anchor, "va": "center"}
            force.annotate(f"{words}{at[1]:.0f} N", at, **beside)
    force.axhline(normal, color="black", linewidth=0.8, linestyle=":", label="before the entry")
    force.set_ylabel(f"force on\nelement {element} (N)")
    force.set_ylim(bottom=min(0.0, force.get_ylim()[0]))
    force.legend(loc="lower right", bbox_to_anchor=(1, 0.96), ncols=3)

    profile, rigid = (np.interp(signals["arc"], raceway.arc, of) * 1e6 for of in (raceway.depth, raceway.path))
    path.fill_between(ms, profile, 1e3, color="#c8c8c8", linewidth=0, label="outer ring, unloaded")
    path.plot(ms, rigid, color="black", linestyle="--", linewidth=1, label="path of a rigid element")
    path.plot(ms, signals["path"] * 1e6, color=GREEN, linewidth=1.6, label=f"path of element {element}")
    path.set_ylabel("depth below the\nraceway (µm)")
    before = float(np.median(signals["path"][ms < 0])) * 1e6
    inside = f"{before:.0f} µm inside:\nso far the load\npresses both flat"
    at, there, line = (0.9 * ms[0], before), (0.94 * ms[0], 3.8 * before), {"arrowstyle": "-", "linewidth": 0.7}
    path.annotate(inside, at, xytext=there, arrowprops=line, fontsize=9)
    lowest = 1.15 * max(raceway.depth.max(), signals["path"].max()) * 1e6
    path.set_ylim(lowest, -0.25 * lowest)
    path.legend(loc="upper right", ncols=3)
    path.set_xlabel("time after the element's centre passes the leading edge (ms)")

    marked = {NUMBERED[what][0]: (events[what][0] - start) * 1e3 for what in NUMBERED if what in events}
    for axis in (housing, sensor, force, path):
        axis.set_xlim(ms[0], ms[-1])
        axis.tick_params(labelbottom=axis is path)
        for when in marked.values():
            axis.axvline(when, color="black", linewidth=0.8)
    for number, when in marked.items():
        housing.annotate(
            str(number), (when, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 2), textcoords="offset points",
            ha="center", va="bottom", fontweight="bold",
        )
    path.text(0.48, 0.05, "\n".join(listed(events, start)), transform=path.transAxes, va="bottom", linespacing=1.5)
    figure.align_ylabels()
    plotting.save(figure, stem)


def main():
    fmu, raceway_csv = Path(sys.argv[1]), Path(sys.argv[2])
    folder = fmu.parent
    raceway = Raceway(raceway_csv)
    host = started(fmu)
    radius = float(sys.argv[3])
    try:
        table, element, centre = drive(host, raceway, radius)
    finally:
        host.close()
    signals, entry, leave = passage(table, element, raceway, radius, centre)
    normal, events = find_events(signals, entry, leave)

    overview = folder / "overview.csv"
    plotting.write_csv(
        overview,
        ["time [s]", "housing.ay [m/s2]", "sensor.acceleration [m/s2]"],
        [table["time"], table["housing.ay"], table["sensor.acceleration"]],
    )
    units = {"time": "s", "arc": "m", "housing.ay": "m/s2", "sensor.acceleration": "m/s2", "path": "m"}
    passage_csv = folder / "passage.csv"
    plotting.write_csv(passage_csv, [f"{name} [{units.get(name, 'N')}]" for name in signals], signals.values())
    events_csv = folder / "events.csv"
    with plotting.whole(events_csv) as part, open(part, "w", encoding="utf-8", newline="\n") as file:
        file.write("event,the paper's number,time [s],after entry [s],outer force [N]\n")
        for name, (when, value) in events.items():
            number, _ = NUMBERED.get(name, ("", ""))
            file.write(f"{name},{number},{when!r},{when - entry!r},{value!r}\n")
            print(f"{number:1} {name:10} {(when - entry) * 1e3:7.3f} ms after entry, outer force {value:7.1f} N")
    for path in (overview, passage_csv, events_csv):
        print(path)
    draw(folder / "demo", table, signals, raceway, normal, events, element, radius)


if __name__ == "__main__":
    main()
