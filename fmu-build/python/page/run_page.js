// Draws a run's page. DATA is what run_page.py has written before it; Plotly stands before that.
"use strict";

// Nothing of a run leaves the page.
const CONFIG = { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["sendChartToCloud"] };
const FONT = { family: "system-ui, sans-serif", size: 13 };
// Points across a window: more than there are pixels.
const ACROSS = 2000;
const GRID = { gridcolor: "#e4e4e4", zeroline: false };
// Above a plot stands its toolbar alone, however narrow the window: what curves are is said below, in five lines at
// most.
const MARGIN = { l: 80, r: 20, t: 40, b: 45 };
const MARGIN_OF_LEGEND = { ...MARGIN, b: 150 };
const LEGEND = { orientation: "h", yref: "container", y: 0, yanchor: "bottom" };

function numbers(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

// What of a signal is drawn between two times: its samples where they are few, else the least and the greatest of
// equal numbers of them, in the order in which they come.
function shown(signal, from, to) {
  const { start, step, values } = signal;
  const first = Math.max(0, Math.floor((from - start) / step) - 1);
  const last = Math.min(values.length, Math.ceil((to - start) / step) + 2);
  const every = Math.max(1, Math.ceil((last - first) / ACROSS));
  const x = [], y = [];
  for (let begin = first; begin < last; begin += every) {
    const end = Math.min(begin + every, last);
    let low = begin, high = begin;
    for (let i = begin + 1; i < end; i++) {
      if (values[i] < values[low]) low = i;
      if (values[i] > values[high]) high = i;
    }
    for (const i of low === high ? [low] : [Math.min(low, high), Math.max(low, high)]) {
      x.push(start + i * step);
      y.push(values[i]);
    }
  }
  return { x, y };
}

// The times between which the address wants to look, as far as the run has them; what was wrong with it is said.
function asked(all) {
  const text = location.hash.slice(1);
  const [from, to, ...more] = text.split(",").map(Number);
  const run = `the run goes from ${digits(all[0])} to ${digits(all[1])} s`;
  let said = "", range = all;
  if (!text) {
    // Nothing is asked.
  } else if (!(from < to) || more.length) {
    const understood = "two times in seconds are understood, the earlier first, as #0.1,0.2";
    said = `The address ends with #${text}: ${understood}. All is shown.`;
  } else if (from >= all[1] || to <= all[0]) {
    said = `The address asks for ${from} to ${to} s, but ${run}. All of it is shown.`;
  } else {
    range = [Math.max(from, all[0]), Math.min(to, all[1])];
    // A rounded end is no other end.
    const beyond = Math.max(all[0] - from, to - all[1]) > 1e-6 * (all[1] - all[0]);
    if (beyond) said = `The address asks for ${from} to ${to} s, but ${run}. Shown is what there is of it.`;
  }
  document.getElementById("asked").textContent = said;
  return range;
}

function digits(value) {
  return Number(value.toPrecision(6));
}

// What Plotly puts behind the "y" or "yaxis" of a row: nothing for the first, 2 for the second.
function suffix(row) {
  return row > 0 ? row + 1 : "";
}

function signalTrace(signal, range) {
  return {
    ...shown(signal, ...range),
    name: signal.name, type: "scatter", mode: "lines", line: { width: 1, color: signal.colour, dash: signal.dash },
    yaxis: `y${suffix(signal.row)}`, showlegend: false,
    hovertemplate: `%{y:.5g} ${signal.unit}<extra>${signal.name}</extra>`,
  };
}

function panelAxis(panel, top, count) {
  const domain = [top - 0.88 / count, top - 0.04 / count];
  return { ...GRID, domain, title: { text: panel.unit }, fixedrange: false };
}

// What the curves of a panel are, above it.
function panelNames(panel, top) {
  const inOrder = [...panel.signals].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  const names = inOrder.map((signal) => `<span style="color:${signal.colour}">${signal.label}</span>`);
  return {
    text: [panel.title, ...names].join("&nbsp; "),
    x: 0, y: top, xref: "paper", yref: "paper", xanchor: "left", yanchor: "middle",
    showarrow: false, font: { size: 12 },
  };
}

function signalsLayout(range) {
  const count = DATA.panels.length;
  const top = (row) => 1 - row / count;
  const layout = {
    font: FONT, height: 90 + 150 * count, margin: MARGIN, hovermode: "x", dragmode: "zoom",
    xaxis: {
      ...GRID, range, title: { text: "time (s)" }, anchor: `y${suffix(count - 1)}`,
      showspikes: true, spikemode: "across", spikethickness: 1,
    },
    annotations: DATA.panels.map((panel, row) => panelNames(panel, top(row))),
  };
  DATA.panels.forEach((panel, row) => (layout[`yaxis${suffix(row)}`] = panelAxis(panel, top(row), count)));
  return layout;
}

function drawSignals(graph) {
  const signals = DATA.panels.flatMap((panel, row) => panel.signals.map((signal) => ({ ...signal, row })));
  signals.forEach((signal) => (signal.values = numbers(signal.values)));
  const all = [Math.min(...signals.map((s) => s.start)), Math.max(...signals.map((s) => s.end))];
  const range = asked(all);
  const traces = signals.map((signal) => signalTrace(signal, range));
  return Plotly.newPlot(graph, traces, signalsLayout(range), CONFIG).then(() => {
    graph.on("plotly_relayout", (change) => {
      let window = null;
      if (change["xaxis.range[0]"] !== undefined) window = [change["xaxis.range[0]"], change["xaxis.range[1]"]];
      if (change["xaxis.range"]) window = change["xaxis.range"];
      if (change["xaxis.autorange"]) window = all;
      if (!window) return;
      const drawn = signals.map((signal) => shown(signal, Number(window[0]), Number(window[1])));
      Plotly.restyle(graph, { x: drawn.map((d) => d.x), y: drawn.map((d) => d.y) });
    });
    addEventListener("hashchange", () => Plotly.relayout(graph, { "xaxis.range": asked(all) }));
    document.body.dataset.points = traces.reduce((sum, trace) => sum + trace.x.length, 0);
  });
}

function surfaceTrace(defect) {
  return {
    x: defect.surface.map((p) => p[0]), y: defect.surface.map((p) => p[1]),
    name: defect.body, mode: "lines", line: { color: "#666666", width: 1.5 },
    fill: "tozeroy", fillcolor: "rgba(0,0,0,0.06)",
    hovertemplate: `%{x:.3f} ${defect.along}, %{y:.2f} µm<extra>surface</extra>`,
  };
}

function passagesTrace(defect) {
  const x = numbers(defect.x), y = numbers(defect.y), time = numbers(defect.time), element = numbers(defect.element);
  // A gap stands between two passages.
  const gaps = (values) => Array.from(values, (value) => (Number.isNaN(value) ? null : value));
  const point = `%{x:.3f} ${defect.along}, %{y:.2f} µm`;
  return {
    x: gaps(x), y: gaps(y), name: "an element's centre, passage after passage",
    mode: "lines", opacity: 0.5, line: { color: "#0072B2", width: 1 },
    customdata: Array.from(time, (t, i) => [t, element[i]]),
    hovertemplate: `element %{customdata[1]} at %{customdata[0]:.5f} s<br>${point}<extra></extra>`,
  };
}

function drawPath(graph, defect) {
  const traces = [surfaceTrace(defect), passagesTrace(defect)];
  const layout = {
    font: FONT, height: 460, margin: MARGIN_OF_LEGEND, hovermode: "closest", legend: LEGEND,
    xaxis: { ...GRID, title: { text: defect.axis, standoff: 8 } },
    yaxis: { ...GRID, title: { text: "µm" } },
  };
  return Plotly.newPlot(graph, traces, layout, CONFIG);
}

// Heights of the points of a mark from the floor to the top: a line can be hovered over where it has points.
function heights({ log, floor, top }) {
  const height = (part) => (log ? floor * Math.pow(top / floor, part / 20) : (top * part) / 20);
  return Array.from({ length: 21 }, (_, part) => (part ? height(part) : floor));
}

// A frequency and its multiples: upright lines, with a gap behind each.
function markTrace(mark, spectrum) {
  const up = heights(spectrum);
  const told = (f, k) => `${mark.words[k]} = ${f.toPrecision(5)} ${spectrum.unit}`;
  return {
    x: mark.at.flatMap((f) => [...up.map(() => f), null]),
    y: mark.at.flatMap(() => [...up, null]),
    text: mark.at.flatMap((f, k) => [...up.map(() => told(f, k)), ""]),
    name: mark.hidden ? mark.name : `${mark.name} ${mark.at[0].toPrecision(4)} ${spectrum.unit}`,
    visible: mark.hidden ? "legendonly" : true,
    mode: "lines", opacity: 0.8, line: { color: mark.colour, width: 1.5, dash: mark.dash },
    hovertemplate: "%{text}<extra></extra>",
  };
}

function spectrumTrace(spectrum) {
  const y = numbers(spectrum.y);
  const x = spectrum.x ? numbers(spectrum.x) : Array.from(y, (_, i) => i * spectrum.step);
  return {
    x, y, name: spectrum.name, mode: "lines", line: { color: "black", width: 1 },
    hovertemplate: `%{x:.5g} ${spectrum.unit}: %{y:.4g}<extra></extra>`,
  };
}

function spectrumLayout(spectrum) {
  const { log, floor, top } = spectrum;
  // Powers of ten: between them there is no room for numbers.
  const scale = log ? { type: "log", dtick: 1, range: [Math.log10(floor), Math.log10(top)] } : { range: [0, top] };
  return {
    font: FONT, height: 480, margin: MARGIN_OF_LEGEND, hovermode: "closest", legend: LEGEND,
    xaxis: { ...GRID, range: [0, spectrum.shown], title: { text: spectrum.axis, standoff: 8 } },
    yaxis: { ...GRID, exponentformat: "power", automargin: true, title: { text: spectrum.label, standoff: 6 }, ...scale },
  };
}

function drawSpectrum(graph, spectrum) {
  const traces = [...spectrum.marks.map((mark) => markTrace(mark, spectrum)), spectrumTrace(spectrum)];
  return Plotly.newPlot(graph, traces, spectrumLayout(spectrum), CONFIG);
}

// Of samples of the sensor their means over equal angles of the shaft between two times, as many as there are samples:
// means, so that nothing is folded. And the step in seconds at the mean speed.
function atEqualAngles(signal, values, { speed, from, to }) {
  const { shaft, start, step } = DATA.motion;
  const angle = (i) => Motion.at(shaft.angle, (signal.start + i * signal.step - start) / step);
  const first = Math.round(from / signal.step), last = Math.min(values.length - 1, Math.round(to / signal.step));
  const count = last - first, begin = angle(first), whole = angle(last) - begin, even = new Float64Array(count);
  for (let i = first, at = 0; i < last; i++) {
    const next = Math.min(count, (count * (angle(i + 1) - begin)) / whole), value = 0.5 * (values[i] + values[i + 1]);
    while (at < next) {
      const k = Math.floor(at), end = Math.min(k + 1, next);
      even[k] += value * (end - at);
      at = end;
    }
  }
  return { square: even, step: Math.abs(whole) / (2 * Math.PI * speed * count) };
}

// The squared envelope of a band of the sensor's signal, as shares of its mean: amplitudes, the step of frequency, and
// beyond what frequency nothing is left of what the window makes of 0 Hz. Where the speed changes, at equal angles.
function envelope(signal, low, high, turning) {
  const all = signal.values.length, n = 2 ** Math.ceil(Math.log2(all)), line = 1 / (n * signal.step);
  const [re, im] = [new Float64Array(n), new Float64Array(n)];
  re.set(signal.values);
  Motion.transform(re, im);
  for (let k = 0; k < n; k++) {
    const inside = k < n / 2 && k * line >= low && k * line <= high;
    // Turned round, so that the same transform goes back.
    [re[k], im[k]] = inside ? [2 * re[k], -2 * im[k]] : [0, 0];
  }
  Motion.transform(re, im);
  const inTime = re.subarray(0, all).map((v, i) => v * v + im[i] * im[i]);
  const { square, step } = turning ? atEqualAngles(signal, inTime, turning) : { square: inTime, step: signal.step };
  const count = square.length;
  const mean = square.reduce((sum, v) => sum + v, 0) / count;
  // Four times as many lines as there are: a peak is seen wherever it is.
  const [y, zero] = [new Float64Array(4 * n), new Float64Array(4 * n)];
  y.set(square.map((v, i) => (v / mean - 1) * (1 - Math.cos((2 * Math.PI * (i + 0.5)) / count))));
  Motion.transform(y, zero);
  const amplitudes = y.subarray(0, 2 * n).map((v, k) => (2 * Math.hypot(v, zero[k])) / count);
  return { step: 1 / (4 * n * step), y: amplitudes, beyond: 2 / (count * step) };
}

// Another band for the spectrum of the envelope.
function offerBand(graph, spectrum) {
  const by = (name) => document.getElementById(`band-${name}`);
  const signal = DATA.motion && DATA.motion.signal;
  [by("low").value, by("high").value] = spectrum.band.map((f) => digits(1e-3 * f));
  by("take").disabled = !signal;
  by("take").addEventListener("click", () => {
    const [low, high] = ["low", "high"].map((name) => Number(by(name).value));
    const possible = low >= 0 && high > low;
    by("said").textContent = possible ? "" : "The first must be below the second.";
    if (!possible) return;
    const heading = graph.previousElementSibling.previousElementSibling;
    const said = `${digits(low)} to ${digits(high)} kHz`;
    heading.textContent = heading.textContent.replace(/[\d.]+ to [\d.]+ kHz/, said);
    const { step, y, beyond } = envelope(signal, 1e3 * low, 1e3 * high, spectrum.turning);
    const shown = Math.min(y.length, Math.ceil(spectrum.shown / step));
    const x = Array.from({ length: shown }, (_, i) => i * step), last = spectrum.marks.length;
    const top = 1.08 * y.subarray(Math.ceil(beyond / step), shown).reduce((a, b) => Math.max(a, b), 0);
    Plotly.restyle(graph, { x: [x], y: [Array.from(y.subarray(0, shown))] }, [last]);
    Plotly.relayout(graph, { "yaxis.range": [0, top] });
  });
}

function drawSpectrogram(graph, { time, step, rows, level, name }) {
  const [x, values] = [numbers(time), numbers(level)];
  const z = Array.from({ length: rows }, (_, row) => values.subarray(row * x.length, (row + 1) * x.length));
  const trace = {
    type: "heatmap", x, y: z.map((_, row) => row * step), z, zmin: -60, zmax: 0, colorscale: "Viridis",
    colorbar: { title: { text: "dB" } }, hovertemplate: `%{x:.4f} s, %{y:.0f} Hz: %{z:.0f} dB<extra>${name}</extra>`,
  };
  const layout = {
    font: FONT, height: 460, margin: MARGIN,
    xaxis: { title: { text: "time (s)" } }, yaxis: { title: { text: "frequency (Hz)" } },
  };
  return Plotly.newPlot(graph, [trace], layout, CONFIG);
}

const drawn = [drawSignals(document.getElementById("signals"))];
DATA.paths.forEach((defect, k) => drawn.push(drawPath(document.getElementById(`path-${k}`), defect)));
DATA.spectra.forEach((spectrum, k) => drawn.push(drawSpectrum(document.getElementById(`spectrum-${k}`), spectrum)));
if (DATA.spectrogram) drawn.push(drawSpectrogram(document.getElementById("spectrogram"), DATA.spectrogram));
Promise.all(drawn).then(() => {
  startMotion();
  DATA.spectra.forEach((one, k) => one.band && offerBand(document.getElementById(`spectrum-${k}`), one));
  document.body.dataset.state = "drawn";
});
