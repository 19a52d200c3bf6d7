// The cross-section of a run's page, where balls move across their grooves: one ball between both grooves to scale, and
// the angles of all contacts around the bearing. Lengths in m, angles in rad; z to the right, outwards up.
"use strict";

const Section = (() => {
  const { at, surface, arrow, words, INK, STEEL, EDGE, LOAD, BALL, SIGNAL } = Motion;
  const TAU = 2 * Math.PI, DEGREES = 180 / Math.PI, SIDES = ["outer", "inner"];

  // A contact of ball j: angle, force, half of its ellipse across the groove and what it leaves to the shoulder.
  function contact(m, side, j, f) {
    const groove = m.section[side], force = Math.max(0, at(m.force[side][j], f)), angle = at(m.contact[side][j], f);
    const half = groove.half_length * Math.cbrt(force), reach = half / groove.radius;
    const margin = groove.shoulder === null ? null : groove.shoulder - Math.abs(angle) - reach;
    return { angle, force, half, reach, margin, groove };
  }

  // Where ball j and both grooves are in the plane through the bearing's axis and the ball, as [along z, outwards],
  // seen from the outer ring's centre. A ring's tilt leans its groove in that plane.
  function places(m, j, f) {
    const angle = at(m.angle[j], f), [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const moved = (axis) => at(m.shaft[axis], f) - at(m.housing[axis], f);
    const ball = [at(m.axial[j], f), m.outer - m.radius + at(m.path[j], f)];
    const of = (side) => {
      const ring = side === "outer" ? m.housing : m.shaft, sign = side === "outer" ? 1 : -1;
      const [z, r] = side === "outer" ? [0, 0] : [moved("z"), moved("x") * cos + moved("y") * sin];
      const lean = at(ring["tilt.y"], f) * cos - at(ring["tilt.x"], f) * sin;
      const met = contact(m, side, j, f), { centre_radius, shift, radius } = met.groove;
      const centre = [z + shift - lean * centre_radius, r + centre_radius + lean * shift];
      const away = (theta) => {
        const [sin_, cos_] = [Math.sin(theta), Math.cos(theta)];
        return [sign * (sin_ - lean * cos_), sign * (cos_ + lean * sin_)];
      };
      const on = (theta) => away(theta).map((part, k) => centre[k] + radius * part);
      return { ...met, side, sign, centre, away, on };
    };
    return { angle, ball, outer: of("outer"), inner: of("inner") };
  }

  const arc = (from, to, many = 48) => Array.from({ length: many + 1 }, (_, i) => from + ((to - from) * i) / many);

  function line(c, points, colour, width, dash = []) {
    c.beginPath();
    points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
    c.setLineDash(dash);
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.stroke();
    c.setLineDash([]);
    c.lineWidth = 1;
  }

  function dot(c, [x, y], colour, size = 3) {
    c.beginPath();
    c.arc(x, y, size, 0, TAU);
    c.fillStyle = colour;
    c.fill();
  }

  // A ring from its groove to the edge of the picture; without known shoulders the groove alone, to 60 degrees.
  function ring(c, one, place, edge) {
    const end = one.groove.shoulder ?? Math.PI / 3, groove = arc(-end, end).map((theta) => place(one.on(theta)));
    const [first, last] = [groove[0], groove[groove.length - 1]], known = one.groove.shoulder !== null;
    const [low, high] = first[0] < last[0] ? [0, edge.width] : [edge.width, 0], far = one.sign > 0 ? 0 : edge.height;
    const face = known ? [[low, first[1]], ...groove, [high, last[1]]] : groove;
    const behind = (theta) => one.on(theta).map((part, k) => part + 0.1 * one.groove.radius * one.away(theta)[k]);
    const back = known ? [[high, far], [low, far]] : arc(end, -end).map((theta) => place(behind(theta)));
    c.beginPath();
    [...face, ...back].forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
    c.closePath();
    c.fillStyle = STEEL;
    c.fill();
    line(c, face, EDGE, 1);
    if (known) for (const corner of [first, last]) dot(c, corner, EDGE, 2.5);
  }

  // Ball j between its grooves, to scale except the arrows; below, the centres of grooves and ball enlarged.
  function drawSection(m, j, f) {
    const { c, width, height } = surface(document.getElementById("section-ball"));
    const seen = places(m, j, f), inset = 130, high = height - inset, r = m.radius;
    const scale = Math.min(width, high) / (2.9 * r), middle = m.outer - r;
    const place = ([z, out]) => [0.5 * width + scale * z, 0.5 * high - scale * (out - middle)];
    c.save();
    c.beginPath();
    c.rect(0, 0, width, high);
    c.clip();
    for (const side of SIDES) ring(c, seen[side], place, { width, height: high });
    const [x, y] = place(seen.ball);
    c.beginPath();
    c.arc(x, y, scale * r, 0, TAU);
    c.fillStyle = BALL;
    c.globalAlpha = 0.35;
    c.fill();
    c.globalAlpha = 1;
    c.strokeStyle = EDGE;
    c.stroke();
    line(c, [[x, y - 0.8 * scale * r], [x, y + 0.8 * scale * r]], EDGE, 1, [8, 3, 2, 3]);
    for (const side of SIDES) {
      const one = seen[side];
      if (!one.force) continue;
      const foot = one.on(one.angle), [dz, dr] = one.away(one.angle), long = (0.42 * r * scale * one.force) / m.largest;
      line(c, [[x, y], place(foot)], INK, 1, [4, 3]);
      line(c, arc(one.angle - one.reach, one.angle + one.reach).map((theta) => place(one.on(theta))), LOAD, 5);
      arrow(c, place(foot), [long * dz, -long * dr], LOAD);
      const label = place([seen.ball[0] + 0.55 * r * dz, seen.ball[1] + 0.55 * r * dr]);
      const [beside, align] = dz >= 0 ? [8, "left"] : [-8, "right"];
      words(c, `${(one.angle * DEGREES).toFixed(1)}°`, label[0] + beside, label[1], align);
    }
    words(c, String(j + 1), x - 14, y, "center");
    c.restore();
    words(c, "outer ring", 6, 12);
    words(c, "inner ring", 6, high - 10);
    arrow(c, [width - 60, high - 14], [32, 0], INK);
    words(c, "z", width - 20, high - 14);
    centres(m, c, seen, { top: high, width, height });
  }

  // Centres of both grooves and of the ball: distances are those of the contacts, less the grooves' radii.
  function centres(m, c, seen, { top, width, height }) {
    const [a, b] = [seen.outer.centre, seen.inner.centre], apart = Math.hypot(a[0] - b[0], a[1] - b[1]);
    const play = SIDES.reduce((sum, side) => sum + m.section[side].radius - m.radius, 0);
    const k = (height - top - 40) / (1.25 * Math.max(apart, play));
    const middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
    const place = ([z, out]) => [0.5 * width + k * (z - middle[0]), 0.5 * (top + 22 + height) - k * (out - middle[1])];
    line(c, [[0, top + 0.5], [width, top + 0.5]], "#999999", 1);
    for (const side of SIDES) {
      line(c, [place(seen.ball), place(seen[side].centre)], seen[side].force ? LOAD : EDGE, 1.5);
    }
    const named = [[a, "centre of the outer groove", INK], [b, "of the inner groove", INK], [seen.ball, "of the ball", SIGNAL]];
    for (const [of, text, colour] of named) {
      const [x, y] = place(of);
      dot(c, [x, y], colour);
      words(c, text, x + 8, y, "left", colour);
    }
    words(c, `apart ${(1e3 * apart).toFixed(4)} mm, ${(1e3 * play).toFixed(4)} unloaded`, 6, top + 12);
  }

  // The least and the greatest angle on a groove that a panel shows.
  function range(m, side) {
    const { shoulder } = m.section[side];
    let [low, high] = [0, 0.02];
    for (let j = 0; j < m.count; j++) {
      for (let f = 0; f < m.frames; f++) {
        const { angle, force, reach } = contact(m, side, j, f);
        if (force) [low, high] = [Math.min(low, angle - reach), Math.max(high, angle + reach)];
      }
    }
    if (shoulder !== null && high > -low) high = Math.max(high, shoulder);
    if (shoulder !== null && -low > high) low = Math.min(low, -shoulder);
    const room = 0.08 * (high - low);
    return [low - room, high + room];
  }

  // What contacts have swept in the run around the bearing, drawn once for a size of the picture.
  function track(m, side, px, py) {
    const swept = new Path2D(), every = Math.max(1, Math.floor((m.frames * m.count) / 6000));
    for (let j = 0; j < m.count; j++) {
      for (let f = 0; f < m.frames; f += every) {
        const { angle, force, reach } = contact(m, side, j, f);
        if (!force) continue;
        const x = px(at(m.angle[j], f));
        swept.moveTo(x, py(angle - reach));
        swept.lineTo(x, py(angle + reach));
      }
    }
    return swept;
  }

  // Where on the grooves all contacts are, over their balls' angle around the bearing.
  function drawAngles(m, chosen, f) {
    const { c, width, height } = surface(document.getElementById("section-angles")), left = 40, right = width - 8;
    m.ranges ??= Object.fromEntries(SIDES.map((side) => [side, range(m, side)]));
    const px = (angle) => left + ((((angle % TAU) + TAU) % TAU) / TAU) * (right - left);
    const size = `${width} ${height}`;
    if (m.swept?.size !== size) m.swept = { size };
    SIDES.forEach((side, k) => {
      const panel = 0.5 * (height - 30), top = 20 + k * panel, bottom = top + panel - 38, [low, high] = m.ranges[side];
      const py = (angle) => bottom - ((angle - low) / (high - low)) * (bottom - top);
      const { shoulder } = m.section[side];
      c.globalAlpha = 0.25;
      c.strokeStyle = BALL;
      c.lineWidth = 2;
      c.stroke((m.swept[side] ??= track(m, side, px, py)));
      c.globalAlpha = 1;
      for (const edge of shoulder === null ? [] : [-shoulder, shoulder]) {
        if (edge > low && edge < high) line(c, [[left, py(edge)], [right, py(edge)]], INK, 1, [6, 4]);
      }
      if (low < 0) line(c, [[left, py(0)], [right, py(0)]], "#cccccc", 1);
      for (let j = 0; j < m.count; j++) {
        const { angle, force, reach } = contact(m, side, j, f), x = px(at(m.angle[j], f));
        words(c, String(j + 1), x, bottom + 9, "center", j === chosen ? LOAD : INK);
        if (!force) continue;
        line(c, [[x, py(angle - reach)], [x, py(angle + reach)]], j === chosen ? LOAD : SIGNAL, j === chosen ? 5 : 3);
        dot(c, [x, py(angle)], "white", 1.5);
      }
      c.strokeStyle = "#999999";
      c.strokeRect(left, top, right - left, bottom - top);
      const step = [1, 2, 5, 10, 20].find((degrees) => (high - low) * DEGREES <= 6 * degrees) ?? 30;
      for (let d = Math.ceil((low * DEGREES) / step) * step; d <= high * DEGREES; d += step) {
        words(c, `${d}°`, left - 4, py(d / DEGREES), "right");
      }
      words(c, `${side} groove: contact angle and ellipse${shoulder === null ? "" : "; dashed: shoulder"}`, left, top - 9);
    });
    for (const d of [0, 90, 180, 270]) {
      words(c, `${d}°`, left + (d / 360) * (right - left), height - 8, d ? "center" : "left");
    }
  }

  // The numbers of what is drawn.
  function say(m, j, f) {
    const rows = SIDES.map((side) => {
      const { angle, force, half, reach, margin } = contact(m, side, j, f);
      const ellipse = `± ${(1e3 * half).toFixed(3)} mm, ± ${(reach * DEGREES).toFixed(1)}°`;
      const met = force ? [`${(angle * DEGREES).toFixed(2)}°`, force.toFixed(1), ellipse] : ["open", "0", ""];
      return [side, ...met, margin === null ? "not known" : force ? `${(margin * DEGREES).toFixed(1)}°` : ""];
    });
    const cell = (k, i) => document.getElementById(`section-${k}-${i}`);
    rows.forEach((row, k) => row.forEach((text, i) => (cell(k, i).textContent = text)));
    const ring = (name) => {
      const of = m[name], beside = ["tilt.x", "tilt.y"].filter((axis) => of[axis]);
      const tilt = beside.map((axis) => `tilt about ${axis.slice(-1)} ${(1e3 * at(of[axis], f)).toFixed(4)} mrad`);
      return of.z ? [`${name} z ${(1e6 * at(of.z, f)).toFixed(2)} µm`, ...tilt].join(", ") : "";
    };
    const where = ((((at(m.angle[j], f) * DEGREES) % 360) + 360) % 360).toFixed(1);
    document.getElementById("section-said").textContent =
      [`Ball ${j + 1} at ${where}°`, ring("shaft"), ring("housing")].filter(Boolean).join("; ") + ".";
  }

  // The ball that is chosen, or the one at the defect, or that of the greatest force.
  function chosen(m, near, f) {
    const asked = Number(document.getElementById("section-element").value);
    if (asked) return asked - 1;
    if (near >= 0) return near;
    const forces = m.force.inner.map((of) => at(of, f));
    return forces.indexOf(Math.max(...forces));
  }

  function draw(m, near, f) {
    if (!m.section) return;
    const j = chosen(m, near, f);
    drawSection(m, j, f);
    drawAngles(m, j, f);
    say(m, j, f);
  }

  return { draw, places, contact };
})();
