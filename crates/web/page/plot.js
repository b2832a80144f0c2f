// Plots on canvases: sharp on every screen, in the colours of the theme.
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
function canvasOf(id) {
  const canvas = $(id), ratio = window.devicePixelRatio || 1;
  const { width, height } = canvas.getBoundingClientRect();
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) { canvas.width = w; canvas.height = h; }
  const c = canvas.getContext("2d");
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, width, height);
  c.font = "12px system-ui, sans-serif";
  c.lineJoin = "round";
  return { c, width, height };
}
// round numbers between two ends
function ticks(low, high, about) {
  const raw = (high - low) / about, ten = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * ten).find((s) => s >= raw * 0.999) ?? 10 * ten;
  const all = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) all.push(Number((i * step).toPrecision(12)));
  return all;
}
function logTicks(low, high) {
  const all = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); e++)
    for (const k of [1, 2, 5]) if (k * 10 ** e >= low * 0.999 && k * 10 ** e <= high * 1.001) all.push(Number((k * 10 ** e).toPrecision(3)));
  return all;
}
// axes; gives the places of values
function axes({ c, width, height }, { x, y, xName, yName, xTicks, yTicks, left = 52, bottom = 34, top = 18, right = 12, logX, logY }) {
  const [x0, x1] = x, [y0, y1] = y;
  const at = (v, a, b, log) => (log ? Math.log(v / a) / Math.log(b / a) : (v - a) / (b - a));
  const px = (v) => left + at(v, x0, x1, logX) * (width - left - right);
  const py = (v) => height - bottom - at(v, y0, y1, logY) * (height - bottom - top);
  c.lineWidth = 1;
  c.strokeStyle = css("--line");
  c.fillStyle = css("--soft");
  c.textAlign = "center"; c.textBaseline = "top";
  let last = -99;
  for (const t of xTicks) {
    c.beginPath(); c.moveTo(px(t), top); c.lineTo(px(t), height - bottom); c.stroke();
    const text = digits(t, 3), half = c.measureText(text).width / 2;
    if (bottom > 12 && px(t) - half > last + 6) { c.fillText(text, px(t), height - bottom + 4); last = px(t) + half; }
  }
  c.textAlign = "right"; c.textBaseline = "middle";
  for (const t of yTicks) {
    c.beginPath(); c.moveTo(left, py(t)); c.lineTo(width - right, py(t)); c.stroke();
    c.fillText(digits(t, 3), left - 6, py(t));
  }
  c.textBaseline = "bottom"; c.textAlign = "right";
  if (xName) c.fillText(xName, width - right, height);
  c.textAlign = "left"; c.textBaseline = "top";
  c.fillText(yName, 2, 0);
  return { px, py, left, right: width - right, top, bottom: height - bottom };
}
function line(c, points, color, { dash = [], wide = 1.6 } = {}) {
  c.save(); c.strokeStyle = color; c.lineWidth = wide; c.setLineDash(dash); c.beginPath();
  points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
  c.stroke(); c.restore();
}
const seriesPoints = (series, step, px, py, by) => Array.from(series, (v, i) => [px(i * step), py(v * by)]);

// ---- histories
function plotTop(history, now) {
  const on = canvasOf("plot-top"), { c } = on, { by, unit } = unitOf("small");
  const all = [...history.springs.top, ...(history.reference?.top ?? [])].map(Math.abs);
  // a body that falls leaves the plot
  const limit = Math.max(history.least, Math.min(Math.max(...all), history.limit ?? Infinity)) * by * 1.1;
  const end = Math.max(history.ground.step_s * (history.ground.accel_g.length - 1), history.step_s);
  const { px, py, left, right, top, bottom } = axes(on, { x: [0, end], y: [-limit, limit], xTicks: ticks(0, end, 8), yTicks: ticks(-limit, limit, 5), yName: on.width < 460 ? `top, ${unit}` : `top displacement, ${unit}`, bottom: 20 });
  c.save(); c.beginPath(); c.rect(left, top, right - left, bottom - top); c.clip();
  line(c, seriesPoints(history.springs.top, history.step_s, px, py, by), css("--blue"), { wide: 1.8 });
  if (history.reference) line(c, seriesPoints(history.reference.top, history.step_s, px, py, by), css("--ref"), { dash: [5, 4], wide: 1.3 });
  line(c, [[px(now), top], [px(now), bottom]], css("--ink"), { wide: 1 });
  c.restore();
  c.textBaseline = "top"; c.textAlign = "right";
  const narrow = on.width < 460, springs = narrow ? "on springs" : "finite elements on springs", other = history.rigid ? "Housner" : "rigid ground";
  c.fillStyle = css("--blue"); c.fillText(springs, right, 0);
  const w = c.measureText(springs).width;
  if (history.reference) { c.fillStyle = css("--ref"); c.fillText(narrow ? other : `${other} (dashed)`, right - w - 10, 0); }
}
function plotGround(history, now) {
  const on = canvasOf("plot-ground"), { c } = on, { step_s, accel_g } = history.ground;
  const most = Math.max(1e-9, ...accel_g.map(Math.abs)), end = Math.max(step_s * (accel_g.length - 1), step_s);
  const { px, py, left, right, top, bottom } = axes(on, { x: [0, end], y: [-most * 1.1, most * 1.1], xTicks: ticks(0, end, 8), yTicks: ticks(-most, most, 2), yName: "ground, g", xName: "time, s", bottom: 33 });
  line(c, seriesPoints(accel_g, step_s, px, py, 1), css("--grey"), { wide: 1 });
  c.save(); c.setLineDash([3, 3]); c.strokeStyle = css("--ok");
  for (const s of [-1, 1]) { const y = py(s * history.uplift_g); if (y > top && y < bottom) { c.beginPath(); c.moveTo(left, y); c.lineTo(right, y); c.stroke(); } }
  c.restore();
  line(c, [[px(now), top], [px(now), bottom]], css("--ink"), { wide: 1 });
  c.textAlign = "right"; c.textBaseline = "top"; c.fillStyle = css("--ok");
  if (history.uplift_g < most) c.fillText(`lifts at ${digits(history.uplift_g, 3)} g`, right, 0);
}

// ---- peaks over one number: rows of [x, share or null]
function plotShare(id, rows, { own, xName, logX, range }) {
  const on = canvasOf(id), { c } = on;
  const { px, py, left, right, top, bottom } = axes(on, { x: range, y: [0, 130], xTicks: logX ? logTicks(...range) : ticks(...range, 6), yTicks: [0, 20, 40, 60, 80, 100], xName, yName: "largest rotation, % of overturning", logX });
  c.fillStyle = css("--badbg"); c.fillRect(left, top, right - left, py(100) - top);
  c.fillStyle = css("--bad"); c.textAlign = "left"; c.textBaseline = "middle"; c.fillText("falls", left + 5, py(121));
  line(c, [[px(own), top], [px(own), bottom]], css("--ink"), { dash: [4, 3], wide: 1.2 });
  for (const [x, share] of rows) {
    c.beginPath();
    if (share === null) { c.fillStyle = css("--bad"); c.arc(px(x), py(107), 3, 0, 7); } else { c.fillStyle = css("--blue"); c.arc(px(x), py(Math.min(100, 100 * share)), 3, 0, 7); }
    c.fill();
  }
  let part = [];
  for (const [x, share] of [...rows, [0, null]]) {
    if (share === null) { if (part.length > 1) line(c, part, css("--blue"), { wide: 1.3 }); part = []; } else part.push([px(x), py(Math.min(100, 100 * share))]);
  }
}
// the rocking spectrum: rows of slenderness, columns of size
function plotSpectrum(spectrum) {
  const { sizes, alphas, rows, own } = spectrum, on = canvasOf("plot-spectrum"), { c } = on, len = unitOf(LENGTH);
  const x = [sizes[0] * len.by, sizes.at(-1) * len.by], deg = 180 / Math.PI, y = [alphas[0] * deg, alphas.at(-1) * deg];
  const place = axes(on, { x, y, logX: true, xTicks: logTicks(...x), yTicks: ticks(...y, 6), xName: `size R, foot to centre of mass, ${len.unit}`, yName: "slenderness angle, degrees", right: 112 });
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const color = (s) => (s === null ? css("--bad") : s === 0 ? css("--line") : `hsl(210 75% ${dark ? 22 + 48 * Math.min(1, s) : 90 - 55 * Math.min(1, s)}%)`);
  const dx = (place.right - place.left) / sizes.length, dy = (place.bottom - place.top) / alphas.length;
  rows.forEach((row, j) => row?.forEach((share, i) => { c.fillStyle = color(share); c.fillRect(place.left + i * dx, place.bottom - (j + 1) * dy, dx + 0.6, dy + 0.6); }));
  const [ox, oy] = [place.px(own.radius * len.by), place.py(own.alpha * deg)];
  if (ox >= place.left && ox <= place.right && oy >= place.top && oy <= place.bottom) {
    c.beginPath(); c.arc(ox, oy, 6, 0, 7); c.fillStyle = css("--card"); c.fill(); c.lineWidth = 3; c.strokeStyle = css("--ink"); c.stroke();
  }
  c.textAlign = "left"; c.textBaseline = "middle";
  [["falls", null], ["100 %", 0.999], ["75 %", 0.75], ["50 %", 0.5], ["25 %", 0.25], ["5 %", 0.05], ["stays down", 0]].forEach(([name, s], k) => {
    const at = place.top + 10 + k * 22;
    c.fillStyle = color(s); c.fillRect(place.right + 12, at - 7, 18, 14);
    c.fillStyle = css("--soft"); c.fillText(name, place.right + 36, at);
  });
}
