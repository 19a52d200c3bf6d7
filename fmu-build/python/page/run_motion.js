// The bearing that moves on a run's page: to scale beside a slider of time, the element at a defect enlarged, and what
// the sensor shows about that instant. `DATA.motion` is what run_motion.py has written.
"use strict";

const Motion = (() => {
  const INK = "#222222", STEEL = "#c9ced6", EDGE = "#6b7280", LOAD = "#D55E00", BALL = "#56B4E9", SIGNAL = "#0072B2";
  const TAU = 2 * Math.PI;
  const wrap = (angle) => angle - TAU * Math.round(angle / TAU);
  const unpack = (of) => (typeof of === "string" ? numbers(of) : of);
  // A round number no larger than this one.
  const round = (value) => {
    const power = Math.pow(10, Math.floor(Math.log10(value)));
    return power * (value >= 5 * power ? 5 : value >= 2 * power ? 2 : 1);
  };
  const newtons = (force) => `${force.toFixed(force < 10 ? 2 : 0)} N`;
  const depthAt = (surface, s) => {
    for (let k = 1; k < surface.length; k++) {
      const [a, b] = [surface[k - 1], surface[k]];
      if (s >= a[0] && s <= b[0]) return b[0] > a[0] ? a[1] + ((b[1] - a[1]) * (s - a[0])) / (b[0] - a[0]) : b[1];
    }
    return 0;
  };
  const ends = (surface) => [surface[0][0], surface[surface.length - 1][0]];

  function read(m) {
    const { outer, inner } = m.contact || {}, { force, gap } = m;
    const lists = [m.angle, force.outer, force.inner, gap.outer, gap.inner, m.path, m.axial, outer, inner];
    for (const list of lists.filter(Boolean)) list.forEach((v, j) => (list[j] = unpack(v)));
    for (const ring of [m.shaft, m.housing]) for (const key in ring) ring[key] = unpack(ring[key]);
    for (const j in m.spin) m.spin[j] = unpack(m.spin[j]);
    m.frames = m.angle[0].length;
    m.largest = 1e-9;
    for (const of of m.force.outer) for (const force of of) if (force > m.largest) m.largest = force;
    m.deepest = Math.max(1e-9, ...m.defects.flatMap((d) => d.surface.map((p) => Math.abs(p[1]))));
    const panel = DATA.panels.flatMap((p) => p.signals).find((s) => s.name === m.sensor);
    m.signal = panel && { ...panel, values: unpack(panel.values) };
    return m;
  }

  // A value between two frames.
  const at = (values, f) => {
    if (!values) return 0;
    const k = Math.min(Math.floor(f), values.length - 1), next = Math.min(k + 1, values.length - 1);
    return values[k] + (f - k) * (values[next] - values[k]);
  };

  // A canvas as sharp as the screen: its context, width and height in pixels of the page.
  function surface(canvas) {
    const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    const [width, height] = [Math.round(box.width), Math.round(box.height)];
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    }
    const c = canvas.getContext("2d");
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    c.font = "12px system-ui, sans-serif";
    c.lineWidth = 1;
    return { c, width, height };
  }

  function arrow(c, [x, y], [dx, dy], colour) {
    const length = Math.hypot(dx, dy);
    if (length < 3) return;
    const [ex, ey] = [dx / length, dy / length], head = Math.min(9, 0.5 * length);
    c.strokeStyle = c.fillStyle = colour;
    c.lineWidth = 2.2;
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x + dx - head * ex, y + dy - head * ey);
    c.stroke();
    c.beginPath();
    c.moveTo(x + dx, y + dy);
    c.lineTo(x + dx - head * ex - 0.45 * head * ey, y + dy - head * ey + 0.45 * head * ex);
    c.lineTo(x + dx - head * ex + 0.45 * head * ey, y + dy - head * ey - 0.45 * head * ex);
    c.fill();
    c.lineWidth = 1;
  }

  function words(c, text, x, y, align = "left", colour = INK) {
    c.textAlign = align;
    c.textBaseline = "middle";
    c.fillStyle = colour;
    c.fillText(text, x, y);
  }

  // The raceway with its defects, `k` times as deep: outwards outside, inwards inside.
  function raceway(m, on, k, turned) {
    const [radius, outwards] = on === "outer" ? [m.outer, 1] : [m.inner, -1], points = [];
    const defects = m.defects.filter((d) => d.on === on);
    const depth = (angle) => {
      const of = defects.map((d) => depthAt(d.surface, radius * wrap(angle - d.angle)));
      return of.reduce((sum, h) => sum + h, 0);
    };
    const angles = Array.from({ length: 360 }, (_, i) => (i * TAU) / 360);
    for (const d of defects) {
      const [from, to] = ends(d.surface), many = 60;
      for (let i = -2; i <= many + 2; i++) {
        angles.push((d.angle + (from + ((to - from) * i) / many) / radius + 2 * TAU) % TAU);
      }
      for (const s of [from, to]) for (const e of [-1e-6, 1e-6]) angles.push((d.angle + (s + e) / radius + 2 * TAU) % TAU);
    }
    angles.sort((a, b) => a - b);
    for (const angle of angles) points.push([radius + outwards * k * depth(angle), angle + turned]);
    return points;
  }

  function ring(c, points, place, other, fill) {
    c.beginPath();
    points.forEach(([radius, angle], i) => {
      const [x, y] = place(radius, angle);
      if (i) c.lineTo(x, y);
      else c.moveTo(x, y);
    });
    c.closePath();
    const [x, y] = place(0, 0);
    c.moveTo(x + other, y);
    c.arc(x, y, other, 0, TAU, true);
    c.fillStyle = fill;
    c.fill("evenodd");
    c.strokeStyle = EDGE;
    c.stroke();
  }

  // The bearing to scale; depths of defects are not, and forces are arrows.
  function drawBearing(m, f, near) {
    const { c, width, height } = surface(document.getElementById("motion-bearing"));
    const r = m.radius, rim = 0.6 * r, reach = m.outer + rim + 1.1 * r, size = Math.min(width, height);
    const scale = size / (2 * reach), middle = [0.5 * width, 0.5 * height];
    const place = (radius, angle) => [
      middle[0] + scale * radius * Math.cos(angle), middle[1] - scale * radius * Math.sin(angle),
    ];
    const k = round((0.3 * r) / m.deepest), long = (force) => (1.5 * r * scale * force) / m.largest;
    ring(c, raceway(m, "outer", k, at(m.housing.angle, f)), place, scale * (m.outer + rim), STEEL);
    ring(c, raceway(m, "inner", k, at(m.shaft.angle, f)), place, scale * (m.inner - rim), STEEL);
    const shaft = at(m.shaft.angle, f);
    c.strokeStyle = INK;
    c.beginPath();
    c.moveTo(...place(m.inner - rim, shaft));
    c.lineTo(...place(m.inner - 0.25 * rim, shaft));
    c.stroke();
    for (let j = 0; j < m.count; j++) {
      const angle = at(m.angle[j], f), [x, y] = place(m.outer - r, angle);
      const [outer, inner] = [at(m.force.outer[j], f), at(m.force.inner[j], f)];
      c.beginPath();
      c.arc(x, y, scale * r, 0, TAU);
      c.fillStyle = "white";
      c.fill();
      c.globalAlpha = 0.15 + 0.85 * Math.min(1, outer / m.largest);
      c.fillStyle = BALL;
      c.fill();
      c.globalAlpha = 1;
      c.strokeStyle = j === near ? LOAD : EDGE;
      c.lineWidth = j === near ? 2 : 1;
      c.stroke();
      c.lineWidth = 1;
      if (m.spin[j + 1]) {
        const at_ = angle + at(m.spin[j + 1], f);
        c.beginPath();
        c.arc(x + 0.8 * scale * r * Math.cos(at_), y - 0.8 * scale * r * Math.sin(at_), 0.2 * r * scale, 0, TAU);
        c.fillStyle = INK;
        c.fill();
      }
      words(c, String(j + 1), x, y, "center");
      const [ex, ey] = [Math.cos(angle), -Math.sin(angle)];
      arrow(c, place(m.outer, angle), [long(outer) * ex, long(outer) * ey], LOAD);
      arrow(c, place(m.inner, angle), [-long(inner) * ex, -long(inner) * ey], LOAD);
    }
    const force = [at(m.shaft["force.x"], f), at(m.shaft["force.y"], f)], whole = Math.hypot(...force);
    const part = (2.2 * r * scale) / Math.max(m.wholeForce, 1e-9);
    arrow(c, middle, [part * force[0], -part * force[1]], SIGNAL);
    words(c, `bearing on shaft ${newtons(whole)}`, middle[0], middle[1] + 12, "center", SIGNAL);
    words(c, "to scale, but forces", 6, 12);
    words(c, m.defects.length ? `and depths × ${k}` : "", 6, 28);
    words(c, `largest force ${newtons(m.largest)}`, 6, height - 12, "left", LOAD);
  }

  // Where an element is over a defect: arc from its middle to the element (m), how far the element is from the smooth
  // surface (m, negative into it), the curvature between the two, the force, and the shape of both.
  function meeting(m, d, j, f) {
    const angle = at(m.angle[j], f), r = m.radius;
    const of = (side) => ({ gap: at(m.gap[side][j], f), force: at(m.force[side][j], f) });
    const outside = { ...of("outer"), curve: 1 / r - 1 / m.outer };
    const within = { ...of("inner"), curve: 1 / r + 1 / m.inner };
    const surface = (s) => depthAt(d.surface, s);
    if (d.on === "inner") {
      const along = m.inner * wrap(angle - at(m.shaft.angle, f) - d.angle);
      return { ...within, along, steel: surface, ball: () => 0, away: Math.abs(along) };
    }
    if (d.on === "outer") {
      const along = m.outer * wrap(angle - at(m.housing.angle, f) - d.angle);
      return { ...outside, along, steel: surface, ball: () => 0, away: Math.abs(along) };
    }
    const spin = wrap(at(m.spin[d.element], f)), out = Math.abs(spin) < 0.5 * Math.PI;
    const from = out ? r * spin : -r * wrap(spin - Math.PI);
    const one = out ? outside : within;
    return { ...one, along: 0, steel: () => 0, ball: (x) => surface(out ? x - from : -x + from), away: Math.abs(from), out };
  }

  function nearest(m, d, f) {
    if (!d) return { j: -1 };
    if (d.on === "element") return { j: d.element - 1, ...meeting(m, d, d.element - 1, f) };
    let best = { away: Infinity };
    for (let j = 0; j < m.count; j++) {
      const one = meeting(m, d, j, f);
      if (one.away < best.away) best = { j, ...one };
    }
    return best;
  }

  // How far a contact is from the middle of a defect, and which comes first.
  function distance(m, d, met, f) {
    const k = Math.min(Math.floor(f), m.frames - 2), away = (i) => meeting(m, d, met.j, i).away;
    return `${(1e3 * met.away).toFixed(1)} mm ${away(k + 1) < away(k) ? "before" : "past"} it`;
  }

  // The element at the defect, heights enlarged: where its outline lies inside the steel both are pressed flat.
  function drawZoom(m, d, met, f) {
    if (!d) return;
    const { c, width, height } = surface(document.getElementById("motion-zoom"));
    const [from, to] = ends(d.surface), half = Math.max(-from, to), room = half + Math.max(0.8 * half, 0.4e-3);
    const outside = met.away > room, deepest = Math.max(...d.surface.map((p) => Math.abs(p[1])));
    const low = -1.25 * deepest - 4e-6, high = Math.max(2.5 * deepest, 15e-6);
    const [left, right, top, bottom] = [46, width - 8, 26, height - 34];
    const px = (s) => left + ((s + room) / (2 * room)) * (right - left);
    const py = (h) => bottom - ((h - low) / (high - low)) * (bottom - top);
    c.save();
    c.beginPath();
    c.rect(left, top, right - left, bottom - top);
    c.clip();
    const many = 480, arcs = Array.from({ length: many + 1 }, (_, i) => -room + (2 * room * i) / many);
    for (const s of ends(d.surface)) arcs.push(s - 1e-9, s + 1e-9);
    arcs.sort((a, b) => a - b);
    const floor = arcs.map((s) => -met.steel(s));
    const ball = arcs.map((s) => met.gap + 0.5 * (s - met.along) * (s - met.along) * met.curve + met.ball(s));
    const area = (heights, to, colour, alpha) => {
      c.beginPath();
      c.moveTo(px(arcs[0]), to);
      arcs.forEach((s, i) => c.lineTo(px(s), py(heights[i])));
      c.lineTo(px(arcs[arcs.length - 1]), to);
      c.closePath();
      c.globalAlpha = outside ? 0.4 * alpha : alpha;
      c.fillStyle = colour;
      c.fill();
      c.globalAlpha = 1;
    };
    const line = (heights, colour) => {
      c.beginPath();
      arcs.forEach((s, i) => (i ? c.lineTo(px(s), py(heights[i])) : c.moveTo(px(s), py(heights[i]))));
      c.strokeStyle = colour;
      c.lineWidth = 1.5;
      c.stroke();
    };
    area(floor, bottom, STEEL, 1);
    area(ball, top, BALL, 0.35);
    // Both at once: flattened.
    c.fillStyle = LOAD;
    arcs.slice(1).forEach((s, i) => {
      const [up, down] = [floor[i + 1], ball[i + 1]];
      if (down < up) c.fillRect(px(arcs[i]), py(up), px(s) - px(arcs[i]) + 0.5, py(down) - py(up));
    });
    line(floor, EDGE);
    line(ball, SIGNAL);
    arrow(c, [px(met.along), py(met.gap) + 2], [0, -(0.45 * (bottom - top) * met.force) / m.largest], LOAD);
    c.restore();
    scaleBars(c, { left, right, top, bottom, px, py, low, high, room });
    const times = (bottom - top) / (high - low) / ((right - left) / (2 * room));
    const body = d.on === "element" ? `${met.out ? "outer" : "inner"} raceway, element's own defect` : `${d.on} raceway`;
    const name = `element ${met.j + 1}`;
    const said = outside ? `nearest ${name} is ${distance(m, d, met, f)}` : `${name}: ${newtons(met.force)}`;
    words(c, `${said}, ${body}; heights × ${Number(times.toPrecision(2))}`, left, 12);
    if (!outside || d.on === "element") return;
    const side = Math.sign(met.along), edge = side > 0 ? right : left;
    arrow(c, [edge - 60 * side, top + 22], [48 * side, 0], SIGNAL);
    words(c, name, edge - 66 * side, top + 22, side > 0 ? "right" : "left", SIGNAL);
  }

  function scaleBars(c, { left, right, top, bottom, px, py, low, high, room }) {
    c.strokeStyle = "#999999";
    c.strokeRect(left, top, right - left, bottom - top);
    const ticks = (from, to, at_) => {
      const step = round((to - from) / 3);
      for (let v = Math.ceil(from / step) * step; v <= to; v += step) at_(v, Number((v).toPrecision(3)));
    };
    ticks(1e3 * -room, 1e3 * room, (v, text) => words(c, String(text), px(1e-3 * v), bottom + 10, "center"));
    ticks(1e6 * low, 1e6 * high, (v, text) => words(c, String(text), left - 4, py(1e-6 * v), "right"));
    words(c, "arc from the defect's middle (mm)", 0.5 * (left + right), bottom + 25, "center");
    c.save();
    c.translate(10, 0.5 * (top + bottom));
    c.rotate(-0.5 * Math.PI);
    words(c, "height (µm)", 0, 0, "center");
    c.restore();
  }

  // Cooley and Tukey's transform of 2^n samples, in place.
  function transform(re, im) {
    const n = re.length;
    for (let i = 1, j = 0; i < n; i++) {
      let bit = n >> 1;
      for (; j & bit; bit >>= 1) j ^= bit;
      j ^= bit;
      if (i < j) [re[i], re[j], im[i], im[j]] = [re[j], re[i], im[j], im[i]];
    }
    const cos = Float64Array.from({ length: n >> 1 }, (_, k) => Math.cos((TAU * k) / n));
    const sin = Float64Array.from({ length: n >> 1 }, (_, k) => -Math.sin((TAU * k) / n));
    for (let length = 2; length <= n; length <<= 1) {
      const half = length >> 1, stride = n / length;
      for (let begin = 0; begin < n; begin += length) {
        for (let k = 0; k < half; k++) {
          const i = begin + k, h = i + half, wr = cos[k * stride], wi = sin[k * stride];
          const tr = re[h] * wr - im[h] * wi, ti = re[h] * wi + im[h] * wr;
          re[h] = re[i] - tr;
          im[h] = im[i] - ti;
          re[i] += tr;
          im[i] += ti;
        }
      }
    }
  }

  // Amplitudes of a real signal.
  function spectrum(values) {
    const re = Float64Array.from(values), im = new Float64Array(re.length);
    transform(re, im);
    return re.subarray(0, re.length >> 1).map((v, i) => Math.hypot(v, im[i]));
  }

  // What the sensor shows about this instant, and its spectrum there.
  function drawSignal(m, time) {
    const { c, width, height } = surface(document.getElementById("motion-signal")), signal = m.signal;
    if (!signal) return;
    const { start, step, values } = signal, left = 46, right = width - 8, split = Math.round(0.52 * height);
    const reach = 0.75 * m.passage, [first, last] = [time - reach, time + reach];
    m.peak ??= values.reduce((most, v) => Math.max(most, Math.abs(v)), 1e-12);
    const box = (top, bottom) => {
      c.strokeStyle = "#999999";
      c.strokeRect(left, top, right - left, bottom - top);
    };
    const [top, bottom] = [20, split - 22];
    c.save();
    c.beginPath();
    c.rect(left, top, right - left, bottom - top);
    c.clip();
    c.beginPath();
    const [from, to] = [first, last].map((t) => Math.max(0, Math.min(values.length - 1, Math.round((t - start) / step))));
    for (let i = from; i <= to; i++) {
      const x = left + ((start + i * step - first) / (2 * reach)) * (right - left);
      const y = 0.5 * (top + bottom) - (0.48 * (bottom - top) * values[i]) / m.peak;
      if (i === from) c.moveTo(x, y);
      else c.lineTo(x, y);
    }
    c.strokeStyle = SIGNAL;
    c.stroke();
    c.restore();
    c.strokeStyle = LOAD;
    c.beginPath();
    c.moveTo(0.5 * (left + right), top);
    c.lineTo(0.5 * (left + right), bottom);
    c.stroke();
    box(top, bottom);
    words(c, `${signal.name}, ± ${m.peak.toPrecision(3)} ${signal.unit}`, left, 9);
    words(c, `${(1e3 * first).toFixed(1)} ms`, left, bottom + 10);
    words(c, `${(1e3 * last).toFixed(1)} ms`, right, bottom + 10, "right");
    const n = 2 ** Math.max(7, Math.round(Math.log2(reach / step))), begin = Math.round((time - start) / step) - n / 2;
    const window_ = Float64Array.from({ length: n }, (_, i) => {
      const k = begin + i, hann = 0.5 - 0.5 * Math.cos((TAU * (i + 0.5)) / n);
      return k >= 0 && k < values.length ? values[k] * hann : 0;
    });
    const lines = spectrum(window_), low = split + 8, foot = height - 22, shown_ = Math.floor(lines.length / 1.28);
    m.highest = Math.max(m.highest || 0, ...lines);
    c.beginPath();
    for (let i = 1; i < shown_; i++) {
      const level = Math.max(-60, 20 * Math.log10(lines[i] / m.highest + 1e-12));
      c.lineTo(left + (i / shown_) * (right - left), low + (-level / 60) * (foot - low));
    }
    c.strokeStyle = SIGNAL;
    c.stroke();
    box(low, foot);
    words(c, "0", left, foot + 11);
    words(c, `${((shown_ / n / step) * 1e-3).toFixed(1)} kHz`, right, foot + 11, "right");
    words(c, `spectrum of ${(1e3 * n * step).toFixed(1)} ms about it, 60 dB`, 0.5 * (left + right), foot + 11, "center");
  }

  // The instant in the signals above, and in words.
  function cursor(time) {
    const graph = document.getElementById("signals"), axis = graph._fullLayout && graph._fullLayout.xaxis;
    const line = document.getElementById("motion-cursor");
    if (!axis || !line) return;
    const x = axis.l2p(time);
    line.style.display = x < 0 || x > axis._length ? "none" : "block";
    line.style.left = `${axis._offset + x}px`;
    line.style.top = `${graph._fullLayout._size.t}px`;
    line.style.height = `${graph._fullLayout._size.h}px`;
  }

  return {
    read, at, transform, drawBearing, drawZoom, drawSignal, nearest, cursor,
    surface, arrow, words, INK, STEEL, EDGE, LOAD, BALL, SIGNAL,
  };
})();
