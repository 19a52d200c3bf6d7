// Plays the moving bearing: slider, speed, choice of the defect, sound. What it draws is in run_motion.js.
"use strict";

function startMotion() {
  const m = DATA.motion && Motion.read(DATA.motion);
  if (!m) return;
  const by = (name) => document.getElementById(`motion-${name}`);
  const end = m.start + (m.frames - 1) * m.step;
  m.wholeForce = 0;
  for (let i = 0; i < m.frames; i++) {
    m.wholeForce = Math.max(m.wholeForce, Math.hypot(Motion.at(m.shaft["force.x"], i), Motion.at(m.shaft["force.y"], i)));
  }
  let time = m.opens, defect = 0, playing = false, last = 0;
  const show = () => {
    const f = (time - m.start) / m.step, d = m.defects[defect], met = Motion.nearest(m, d, f);
    Motion.drawBearing(m, f, met.j);
    Motion.drawZoom(m, d, met, f);
    Motion.drawSignal(m, time);
    Section.draw(m, met.j, f);
    Motion.cursor(time);
    by("time").value = String((time - m.start) / (end - m.start));
    by("said").textContent = `${(1e3 * time).toFixed(3)} ms`;
  };
  const step = (now) => {
    if (!playing) return;
    time += (Math.min(now - last, 100) / 1000) * Number(by("speed").value);
    last = now;
    if (time > end) time = m.start;
    show();
    requestAnimationFrame(step);
  };
  by("play").addEventListener("click", () => {
    playing = !playing;
    by("play").textContent = playing ? "Pause" : "Play";
    last = performance.now();
    requestAnimationFrame(step);
  });
  by("time").addEventListener("input", () => {
    time = m.start + Number(by("time").value) * (end - m.start);
    show();
  });
  m.defects.forEach((d, k) => by("defect").add(new Option(`defect ${k + 1}: ${d.on}${d.element ? ` ${d.element}` : ""}`, k)));
  by("defect").hidden = m.defects.length < 2;
  if (!m.defects.length) by("zoom").style.display = "none";
  if (!m.signal) by("signal").style.display = "none";
  by("defect").addEventListener("change", () => {
    defect = Number(by("defect").value);
    show();
  });
  if (m.section) {
    const element = document.getElementById("section-element");
    element.add(new Option(m.defects.length ? "at the defect" : "of the greatest force", 0));
    for (let j = 1; j <= m.count; j++) element.add(new Option(`ball ${j}`, j));
    element.addEventListener("change", show);
  }
  offerSound(by("sound"), m);
  document.getElementById("signals").on("plotly_click", (event) => {
    time = Math.max(m.start, Math.min(end, event.points[0].x));
    show();
  });
  document.getElementById("signals").on("plotly_relayout", () => Motion.cursor(time));
  addEventListener("resize", show);
  show();
  // For tests: milliseconds of a picture, the mean of so many over the run.
  window.costOfPicture = (count) => {
    const begin = performance.now();
    for (let i = 0; i < count; i++) {
      time = m.start + ((i + 0.5) / count) * (end - m.start);
      show();
    }
    return (performance.now() - begin) / count;
  };
  document.body.dataset.motion = "drawn";
}

// A button that plays what the sensor shows, once; pressed again it ends that. Without a signal it says why.
function offerSound(button, { signal, sensor }) {
  let sound = null;
  const end = (of) => {
    // What has been silenced may end later.
    if (of !== sound) return;
    sound.close();
    sound = null;
    button.textContent = "Sound";
  };
  button.disabled = !signal;
  if (!signal) button.textContent = `No sound: ${sensor} stays as it is`;
  button.addEventListener("click", () => {
    if (sound) return end(sound);
    sound = playSound(signal, end);
    button.textContent = "Silence";
  });
}

// What the sensor shows as sound, its largest value at four fifths of full scale.
function playSound(signal, ended) {
  // Buffers have these rates everywhere; a signal of another is played by so much faster or slower.
  const rate = Math.min(96000, Math.max(8000, Math.round(1 / signal.step)));
  const context = new AudioContext(), buffer = context.createBuffer(1, signal.values.length, rate);
  const peak = signal.values.reduce((most, v) => Math.max(most, Math.abs(v)), 1e-12);
  buffer.copyToChannel(signal.values.map((v) => (0.8 * v) / peak), 0);
  const source = context.createBufferSource();
  source.buffer = buffer;
  source.playbackRate.value = 1 / (signal.step * rate);
  source.connect(context.destination);
  source.onended = () => ended(context);
  source.start();
  return context;
}
