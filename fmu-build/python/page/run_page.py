"""The page of a run: one file with signals, paths over the defects and spectra, to hover over and to zoom into.

Arguments: a JSON file that says where the signals are and what there is to mark; the page. Plotly's own script stands
in the page, which asks no network for anything.
"""

import html
import itertools
import json
import sys
from pathlib import Path

import numpy as np
import plotly
import plotting
from plotting import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from run_motion import gaps, motion, packed, wrapped
from run_spectra import spectra, spectrogram
from scipy import signal

# Numbers of all signals together, 5.3 bytes each in the page; samples of the sensor, which sound and envelope are of.
MOST_NUMBERS, MOST_OF_SENSOR = 400_000, 1 << 20
# Points of the paths over one defect; passages of which more are a solid block.
MOST_OF_PATH, MOST_PASSAGES = 20_000, 60
# Wine, indigo, olive and grey beside the palette of all figures: ten that are told apart, then the same with dashes.
COLOURS = [BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, "#882255", "#332288", "#8C8C1A", "#666666"]
STYLES = [(colour, dash) for dash in ("solid", "dash") for colour in COLOURS]


def extremes(values, every):
    """The least and the greatest of each `every` values, in the order in which they come."""
    count = len(values) // every * every
    blocks = values[:count].reshape(-1, every)
    low, high = np.argmin(blocks, axis=1), np.argmax(blocks, axis=1)
    indices = np.sort(np.column_stack([low, high]), axis=1)
    pairs = blocks[np.arange(len(blocks))[:, None], indices].ravel()
    rest = values[count:]
    return np.append(pairs, [rest.min(), rest.max()]) if rest.size else pairs


def even(signals):
    """Without the last sample, if that comes after a shorter step than the others."""
    time = signals["time"]
    if len(time) > 2 and time[-1] - time[-2] < (1 - 1e-6) * (time[1] - time[0]):
        return {name: values[:-1] for name, values in signals.items()}
    return signals


class Run:
    """Signals of a run by name: those of the recorder where it filters them, else those at communication points."""

    def __init__(self, about):
        self.table = even(plotting.signals(about["signals"]))
        self.recording = plotting.signals(about["recording"]) if about["recording"] else {"time": []}

    def source(self, name):
        recorded = name in self.recording and len(self.recording["time"]) > 1
        return self.recording if recorded else self.table

    def has(self, name):
        return name in self.table

    def moves(self, name):
        return self.has(name) and np.ptp(self.table[name]) > 0

    def at(self, name, time):
        """A signal of the table at other times; 0 where there is none."""
        return np.interp(time, self.table["time"], self.table[name]) if self.has(name) else np.zeros(len(time))


def panels(run, count):
    """Panels of signals: unit, and name and factor of each signal."""
    sensors = [name for name in run.table if name.startswith("sensor")]
    yield "m/s²", [(name, 1.0) for name in sensors]
    yield "µm", [(name, 1e6) for name in ("probe.x", "probe.y", "probe.z")]
    yield "m/s²", [(f"{ring}.ay", 1.0) for ring in ("housing", "shaft")]
    yield "µm", [(f"{ring}.{axis}", 1e6) for ring in ("shaft", "housing") for axis in "xyz"]
    yield "mrad", [(f"{ring}.tilt.{axis}", 1e3) for ring in ("shaft", "housing") for axis in "xy"]
    yield "N", [(f"shaft.force.{axis}", 1.0) for axis in "xyz"]
    yield "N", [(f"element[{j}].force.outer", 1.0) for j in range(1, count + 1)]
    yield "Hz", [("shaft.speed", 1 / (2 * np.pi)), ("cage.speed", 1 / (2 * np.pi))]


def filtered(values, step):
    """A signal with no more samples than the page holds, and their step (s): filtered, if it has more."""
    every = -(-len(values) // MOST_OF_SENSOR)
    return (values, step) if every == 1 else (signal.resample_poly(values, 1, every), every * step)


def signals(run, count, sensor):
    """What the page shows over time, and in words how it was made shorter."""
    chosen = [
        (unit, [s for s in of if run.moves(s[0]) or (unit == "Hz" and run.has(s[0]))])
        for unit, of in panels(run, count)
    ]
    chosen = [(unit, of) for unit, of in chosen if of]
    total = sum(len(run.source(name)["time"]) for _, of in chosen for name, _ in of if name != sensor)
    every = 1 if total <= MOST_NUMBERS else int(np.ceil(2 * total / MOST_NUMBERS))
    shown, words, whole = [], {}, ""
    for unit, of in chosen:
        row = []
        # What moves most is drawn first, so that it hides nothing.
        of = sorted(zip(of, itertools.cycle(STYLES)), key=lambda one: -np.ptp(run.source(one[0][0])[one[0][0]]))
        for (name, factor), (colour, dash) in of:
            source = run.source(name)
            values, time = np.ascontiguousarray(source[name]) * factor, source["time"]
            step = float(time[-1] - time[0]) / (len(time) - 1)
            if name == sensor:
                kept, width = filtered(values, step)
                whole = f"; {name} has all {len(values):,}" if len(kept) == len(values) else (
                    f"; {name} is filtered to a sample every {1e6 * width:.4g} µs"
                )
            else:
                kept = extremes(values, every) if every > 1 else values
                # A pair of extremes stands for so many samples.
                width = step if every == 1 else 0.5 * every * step
            label = short(name, len(of)) + (" (dashed)" if dash == "dash" else "")
            about = {"name": name, "label": label, "unit": unit, "colour": colour, "dash": dash}
            row.append({
                **about, "start": float(time[0]), "end": float(time[-1]), "step": width, "values": packed(kept)
            })  # fmt: skip
            words["recorder" if source is run.recording else "communication points"] = step
        title = "force of the outer raceway on element" if of[0][0][0].endswith("].force.outer") else ""
        shown.append({"unit": unit, "signals": row, "title": title})
    said = "; ".join(f"{name}: a sample every {1e6 * step:.4g} µs" for name, step in words.items())
    if every > 1:
        said += f". The run is long: of each {every} samples the page has the least and the greatest{whole}"
    return shown, said


def short(name, count):
    """What a signal is called above its panel, where a dozen must stand side by side."""
    return name.split("[")[1].split("]")[0] if name.endswith("].force.outer") and count > 4 else name


def position_and_height(run, about, defect, element, time):
    """Where an element is along the surface of a defect, from its middle (m, or degrees where the defect is on the
    element), and how far its centre is above the path over the smooth surface (m, upwards in the page)."""
    angle = run.at(f"element[{element}].angle", time)
    path = np.asarray(run.source("element[1].path")[f"element[{element}].path"])
    outside, inside = gaps(run, about, element, time, path)
    if defect["on"] == "inner":
        return defect["radius"] * wrapped(angle - run.at("shaft.angle", time) - defect["angle"]), inside
    if defect["on"] == "outer":
        along = angle - run.at("housing.angle", time) if about["turns"] else angle
        return defect["radius"] * wrapped(along - defect["angle"]), outside
    return np.degrees(wrapped(run.at(f"element[{element}].spin_angle", time))), outside


def passages(run, about, defect, room):
    """Passages of elements with the middle of a defect no further than `room`, the latest first: rows of position [m],
    height [µm], time [s] and element."""
    time = np.asarray(run.source("element[1].path")["time"])
    found = []
    for j in [defect["element"]] if defect["on"] == "element" else range(1, about["count"] + 1):
        along, height = position_and_height(run, about, defect, j, time)
        near = np.flatnonzero(np.abs(along) <= room)
        breaks = np.flatnonzero((np.diff(near) > 1) | (np.abs(np.diff(along[near])) > room)) + 1
        for piece in np.split(near, breaks):
            if piece.size > 1:
                found.append(np.column_stack([along[piece], height[piece] * 1e6, time[piece], np.full(piece.size, j)]))
    return sorted(found, key=lambda rows: -rows[0, 2])


def latest(found):
    """The latest passages, as many as the page has room for."""
    kept, points = [], 0
    for rows in found:
        if kept and (points + len(rows) > MOST_OF_PATH or len(kept) >= MOST_PASSAGES):
            break
        kept.append(rows)
        points += len(rows)
    return kept


def path(run, about, defect, number):
    """The surface of a defect and the ways of elements over it."""
    element = defect["on"] == "element"
    surface = np.array(defect["surface"])
    half = 0.5 * (surface[-1, 0] - surface[0, 0])
    room = 180.0 if element else half + max(0.8 * half, 0.4e-3)
    found = passages(run, about, defect, room)
    kept = latest(found)
    if not kept:
        return None
    gap = np.full((1, 4), np.nan)
    rows = np.concatenate([part for passage in kept for part in (passage, gap)])
    scale = 1.0 if element else 1e3
    ends = [[-room, 0.0], [room, 0.0]]
    outline = np.array(ends) if element else np.vstack([ends[0], surface, ends[1]]) * [scale, -1e6]
    told = str(len(kept)) if len(kept) == len(found) else f"the last {len(kept)} of {len(found)}"
    body = {"outer": "outer raceway", "inner": "inner raceway", "element": "smooth outer raceway"}[defect["on"]]
    spin = "spin of the element (degrees),<br>0: the defect faces the outer raceway"
    rows[:, 0] *= scale
    return {
        "title": f"Defect {number}: {body if not element else 'element ' + str(defect['element'])}, {told} passages",
        "body": body,
        "axis": spin if element else "arc from the defect's middle (mm)",
        "along": "°" if element else "mm",
        "surface": outline.tolist(),
        **dict(zip(("x", "y", "time", "element"), map(packed, rows.T))),
    }


# In the order in which one needs the other.
SCRIPTS = ("run_motion.js", "run_section.js", "run_player.js", "run_page.js")
HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy"
 content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:">
<title>{name}</title>
<style>
body {{ font: 15px system-ui, sans-serif; max-width: 1200px; margin: 1.5em auto; padding: 0 1em; color: #222; }}
h1 {{ font-size: 1.5em; margin-bottom: 0.2em; }}
h2 {{ font-size: 1.1em; margin: 1.6em 0 0.3em; }}
p {{ margin: 0.3em 0; color: #555; }}
.bar {{ display: flex; flex-wrap: wrap; gap: 0.6em; align-items: center; margin: 0.5em 0; }}
.bar input {{ flex: 1 1 200px; min-width: 120px; }}
.bar output {{ min-width: 6em; text-align: right; font-variant-numeric: tabular-nums; }}
.moving {{ display: flex; flex-wrap: wrap; gap: 10px; }}
.moving canvas {{ display: block; width: 100%; }}
#motion-bearing {{ flex: 1 1 420px; min-width: 300px; height: 560px; }}
.beside {{ flex: 1 1 420px; min-width: 300px; }}
#motion-zoom {{ height: 300px; }}
#motion-signal {{ height: 260px; }}
#section-ball {{ flex: 1 1 420px; min-width: 300px; height: 560px; }}
#section-angles {{ height: 440px; }}
.beside table {{ border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; width: 100%; }}
.beside td, .beside th {{ border-bottom: 1px solid #ddd; padding: 3px 6px; text-align: left; }}
#around {{ position: relative; }}
#motion-cursor {{ position: absolute; width: 1px; background: #D55E00; pointer-events: none; display: none; }}
#errors {{ color: #b00020; white-space: pre-line; }}
</style>
<script>
const tell = (what) => {{ document.getElementById("errors").textContent += what + "\\n"; }};
addEventListener("error", (event) => tell(event.message));
addEventListener("unhandledrejection", (event) => tell(event.reason));
</script>
</head>
<body data-state="empty">
<h1>{name}</h1>
{lines}
<div id="errors"></div>
{moving}<h2>Signals</h2>
<p>Drag to zoom, double-click to see all.
Zoomed out, a line goes through the least and the greatest value of each pixel.</p>
<p id="asked"></p>
<div id="around"><div id="signals"></div><div id="motion-cursor"></div></div>
"""

BAND = """<p>Band <input id="band-low" type="number" min="0" step="0.1" aria-label="from"> to
<input id="band-high" type="number" min="0" step="0.1" aria-label="to"> kHz <button id="band-take">Take it</button>
<span id="band-said"></span></p>
"""
MOVING = """<h2>The bearing</h2>
<p>Vermilion: forces of the elements on both rings. A click on a signal below goes to its time.</p>
<div class="bar"><button id="motion-play">Play</button>
<input id="motion-time" type="range" min="0" max="1" step="any" value="0" aria-label="time"><output id="motion-said"></output>
<label>slower by <select id="motion-speed"><option value="1">1</option><option value="0.1">10</option>
<option value="0.01" selected>100</option><option value="0.002">500</option></select></label>
<select id="motion-defect" aria-label="defect"></select><button id="motion-sound">Sound</button></div>
<div class="moving"><canvas id="motion-bearing"></canvas><div class="beside"><canvas id="motion-zoom"></canvas>
<canvas id="motion-signal"></canvas></div></div>
"""
# Numbers of the outer contact, then of the inner.
ROWS = "".join("<tr>" + "".join(f'<td id="section-{k}-{i}"></td>' for i in range(5)) + "</tr>" for k in range(2))
SECTION = f"""<h2>Across the grooves</h2>
<div class="bar"><select id="section-element" aria-label="ball"></select><span id="section-said"></span></div>
<div class="moving"><canvas id="section-ball"></canvas><div class="beside"><canvas id="section-angles"></canvas>
<table><tr><th>groove</th><th>contact angle</th><th>force (N)</th><th>half of the ellipse across</th>
<th>to the shoulder</th></tr>{ROWS}</table></div></div>
<p>To scale except the arrows; vermilion: the ellipse along the groove and the forces on the rings. Below it the centres
of grooves and ball, enlarged. Beside it, over the angle around the bearing, where the contacts of all balls are now and,
light, in the whole run. Grooves are drawn smooth; how wide rings are is not in the scene.</p>
"""


def main():
    about = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    run = Run(about)
    shown, said = signals(run, about["count"], about["sensor"])
    if about["recorder_rate"]:
        rate = about["recorder_rate"]
        said += f". What the recorder samples at {rate:g} Hz of accelerations and forces on rings is filtered"
    paths = [path(run, about, defect, k) for k, defect in enumerate(about["defects"], 1)]
    paths = [one for one in paths if one]
    drawn = list(spectra(about))
    moving = motion(run, about)
    data = {"panels": shown, "paths": paths, "spectra": [of for _, of in drawn], "motion": moving}
    data["spectrogram"] = spectrogram(run, about) if about["changes"] else None
    lines = "\n".join(f"<p>{html.escape(line)}</p>" for line in [about["description"], said, *about["notes"]] if line)
    pictures = (MOVING + SECTION * bool(about["section"])) if moving else ""
    text = HEAD.format(name=html.escape(about["name"]), lines=lines, moving=pictures)
    text += "".join(f'<h2>{html.escape(one["title"])}</h2><div id="path-{k}"></div>\n' for k, one in enumerate(paths))
    text += "".join(
        f'<h2>{html.escape(title)}</h2>{BAND if one["band"] else ""}<div id="spectrum-{k}"></div>\n'
        for k, (title, one) in enumerate(drawn)
    )
    if data["spectrogram"]:
        text += '<h2>Spectrogram of the acceleration</h2><div id="spectrogram"></div>\n'
    library = (Path(plotly.__file__).parent / "package_data" / "plotly.min.js").read_text(encoding="utf-8")
    here = Path(__file__).parent
    program = "".join((here / name).read_text(encoding="utf-8") for name in SCRIPTS)
    # No "</" inside a script ends it.
    told = json.dumps(data).replace("</", "<\\/")
    text += f"<script>{library}</script>\n<script>const DATA = {told};\n{program}</script>\n"
    text += "</body>\n</html>\n"
    with plotting.whole(sys.argv[2]) as part:
        part.write_text(text, encoding="utf-8")
    print(sys.argv[2])


if __name__ == "__main__":
    main()
