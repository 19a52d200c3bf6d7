// Draws a run's page. DATA is what run_page.py has written before it; Plotly stands before that.
"use strict";

// Nothing of a run leaves the page.
const CONFIG = { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["sendChartToCloud"] };
const FONT = { family: "system-ui, sans-serif", size: 13 };
// Points across a window: more than there are pixels.
const ACROSS = 2000;
const GRID = { gridcolor: "#e4e4e4", zeroline: false };
// Above a plot stands its toolbar alone, however narrow the window: what curves are is said below, in three lines at most.
const MARGIN = { l: 80, r: 20, t: 40, b: 45 };
const MARGIN_OF_LEGEND = { ...MARGIN, b: 120 };
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
    said = `The address ends with #${text}: two times in seconds are understood, the earlier first, as #0.1,0.2. All is shown.`;
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

function drawSignals(place) {
  const signals = DATA.panels.flatMap((panel, row) => panel.signals.map((signal) => ({ ...signal, row })));
  signals.forEach((signal) => (signal.values = numbers(signal.values)));
  const all = [Math.min(...signals.map((s) => s.start)), Math.max(...signals.map((s) => s.end))];
  const range = asked(all);
  const traces = signals.map((signal) => ({
    ...shown(signal, ...range),
    name: signal.name, type: "scatter", mode: "lines", line: { width: 1, color: signal.colour, dash: signal.dash },
    yaxis: signal.row ? `y${signal.row + 1}` : "y", showlegend: false,
    hovertemplate: `%{y:.5g} ${signal.unit}<extra>${signal.name}</extra>`,
  }));
  const count = DATA.panels.length;
  const layout = {
    font: FONT, height: 90 + 150 * count, margin: MARGIN, hovermode: "x", dragmode: "zoom",
    xaxis: { ...GRID, range, title: { text: "time (s)" }, anchor: count > 1 ? `y${count}` : "y", showspikes: true, spikemode: "across", spikethickness: 1 },
    annotations: [],
  };
  DATA.panels.forEach((panel, row) => {
    const top = 1 - row / count;
    layout[row ? `yaxis${row + 1}` : "yaxis"] = { ...GRID, domain: [top - 0.88 / count, top - 0.04 / count], title: { text: panel.unit }, fixedrange: false };
    const inOrder = [...panel.signals].sort((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
    const names = [panel.title, ...inOrder.map((s) => `<span style="color:${s.colour}">${s.label}</span>`)].join("&nbsp; ");
    layout.annotations.push({ text: names, x: 0, y: top, xref: "paper", yref: "paper", xanchor: "left", yanchor: "middle", showarrow: false, font: { size: 12 } });
  });
  return Plotly.newPlot(place, traces, layout, CONFIG).then(() => {
    place.on("plotly_relayout", (change) => {
      let window = null;
      if (change["xaxis.range[0]"] !== undefined) window = [change["xaxis.range[0]"], change["xaxis.range[1]"]];
      if (change["xaxis.range"]) window = change["xaxis.range"];
      if (change["xaxis.autorange"]) window = all;
      if (!window) return;
      const drawn = signals.map((signal) => shown(signal, Number(window[0]), Number(window[1])));
      Plotly.restyle(place, { x: drawn.map((d) => d.x), y: drawn.map((d) => d.y) });
    });
    addEventListener("hashchange", () => Plotly.relayout(place, { "xaxis.range": asked(all) }));
    document.body.dataset.points = traces.reduce((sum, trace) => sum + trace.x.length, 0);
  });
}

function drawPath(place, defect) {
  const x = numbers(defect.x), y = numbers(defect.y), time = numbers(defect.time), element = numbers(defect.element);
  // A gap stands between two passages.
  const gaps = (values) => Array.from(values, (value) => (Number.isNaN(value) ? null : value));
  const traces = [
    { x: defect.surface.map((p) => p[0]), y: defect.surface.map((p) => p[1]), name: defect.body, mode: "lines", line: { color: "#666666", width: 1.5 }, fill: "tozeroy", fillcolor: "rgba(0,0,0,0.06)", hovertemplate: "%{x:.3f} " + defect.along + ", %{y:.2f} µm<extra>surface</extra>" },
    { x: gaps(x), y: gaps(y), name: "an element's centre, passage after passage", mode: "lines", opacity: 0.5, line: { color: "#0072B2", width: 1 }, customdata: Array.from(time, (t, i) => [t, element[i]]), hovertemplate: "element %{customdata[1]} at %{customdata[0]:.5f} s<br>%{x:.3f} " + defect.along + ", %{y:.2f} µm<extra></extra>" },
  ];
  const layout = { font: FONT, height: 460, margin: MARGIN_OF_LEGEND, hovermode: "closest", legend: LEGEND, xaxis: { ...GRID, title: { text: defect.axis, standoff: 8 } }, yaxis: { ...GRID, title: { text: "µm" } } };
  return Plotly.newPlot(place, traces, layout, CONFIG);
}

function drawSpectrum(place, spectrum) {
  const y = numbers(spectrum.y);
  const x = spectrum.x ? numbers(spectrum.x) : Array.from(y, (_, i) => i * spectrum.step);
  const top = spectrum.top, floor = spectrum.floor;
  const traces = spectrum.marks.map((mark) => {
    const at = [], high = [], said = [];
    mark.at.forEach((f, k) => {
      for (let part = 0; part <= 20; part++) {
        at.push(f);
        high.push(part ? (spectrum.log ? floor * Math.pow(top / floor, part / 20) : (top * part) / 20) : floor);
        said.push(`${k ? `${k + 1} × ` : ""}${mark.name} = ${f.toPrecision(5)} ${spectrum.unit}`);
      }
      at.push(null); high.push(null); said.push("");
    });
    return { x: at, y: high, text: said, name: `${mark.name} ${mark.at[0].toPrecision(4)} ${spectrum.unit}`, mode: "lines", opacity: 0.8, line: { color: mark.colour, width: 1.5, dash: mark.dash }, hovertemplate: "%{text}<extra></extra>" };
  });
  traces.push({ x, y, name: spectrum.name, mode: "lines", line: { color: "black", width: 1 }, hovertemplate: `%{x:.5g} ${spectrum.unit}: %{y:.4g}<extra></extra>` });
  const scale = spectrum.log ? { type: "log", range: [Math.log10(floor), Math.log10(top)] } : { range: [0, top] };
  const layout = { font: FONT, height: 480, margin: MARGIN_OF_LEGEND, hovermode: "closest", legend: LEGEND, xaxis: { ...GRID, range: [0, spectrum.shown], title: { text: spectrum.axis, standoff: 8 } }, yaxis: { ...GRID, exponentformat: "power", title: { text: spectrum.label }, ...scale } };
  return Plotly.newPlot(place, traces, layout, CONFIG);
}

const drawn = [drawSignals(document.getElementById("signals"))];
DATA.paths.forEach((defect, k) => drawn.push(drawPath(document.getElementById(`path-${k}`), defect)));
DATA.spectra.forEach((spectrum, k) => drawn.push(drawSpectrum(document.getElementById(`spectrum-${k}`), spectrum)));
Promise.all(drawn).then(() => (document.body.dataset.state = "drawn"));
