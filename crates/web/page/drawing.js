// The structure at scale, as it stands at one instant of its history.
const SVG = (name, attributes, text) => {
  const e = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  if (text !== undefined) e.textContent = text;
  return e;
};
// factor on the motion so that its largest is seen
function magnified(peakShare) {
  const asked = $("magnify").value;
  if (asked !== "auto") return Number(asked);
  return [1, 2, 5, 10, 20, 50].filter((k) => k * peakShare <= 0.75).at(-1) ?? 1;
}
// rotation about the corner that stands, in drawing units (y down)
const turned = ([x, y], half, centre, theta) => {
  const px = centre + (theta > 0 ? half : -half), [c, s] = [Math.cos(theta), Math.sin(theta)];
  return [px + (x - px) * c + y * s, y * c - (x - px) * s];
};
function drawStructure(history, at, peakShare, alpha) {
  const svg = $("drawing"), W = 280, H = 340;
  svg.setAttribute("viewBox", `0 0 ${W} ${H}`);
  svg.replaceChildren();
  const v = Object.fromEntries(Object.keys(fields()).map((name) => [name, value(name)]));
  const height = v.h, full = state.kind === "frame" ? v.s + v.w : v.w;
  const k = Math.min(200 / height, 160 / full), ground = 262, middle = 148;
  const ink = css("--ink"), soft = css("--soft"), blue = css("--blue"), fill = css("--calmbg");
  const by = magnified(peakShare), most = Math.PI / 2;
  const bases = history?.springs.bases ?? [{ rotation: [0] }];
  const pick = (s) => (s?.length ? s[Math.min(s.length - 1, at)] : 0);
  const rotation = (i) => Math.max(-most, Math.min(most, pick(bases[i]?.rotation) * (Math.abs(pick(bases[i]?.rotation)) > alpha ? 1 : by)));
  const drift = (i) => pick(bases[i]?.drift) * by;
  const P = ([x, y]) => [middle + x * k, ground - y * k];
  const poly = (points, extra = {}) => svg.append(SVG("path", { d: points.map((p, i) => (i ? "L" : "M") + P(p).map((n) => n.toFixed(2)).join(" ")).join("") + (extra.open ? "" : "Z"), fill: extra.open ? "none" : fill, stroke: blue, "stroke-width": extra.wide ?? 2, "stroke-linejoin": "round" }));
  const dot = (p, r, color = blue) => svg.append(SVG("circle", { cx: P(p)[0], cy: P(p)[1], r, fill: color }));
  // ground and the springs under the feet, which are numbers, not soil
  svg.append(SVG("path", { d: `M8 ${ground}H${W - 8}`, stroke: ink, "stroke-width": 1.6 }));
  const feet = state.kind === "frame" ? [-v.s / 2 - v.w / 2, -v.s / 2 + v.w / 2, v.s / 2 - v.w / 2, v.s / 2 + v.w / 2] : [-v.w / 2, v.w / 2];
  for (const x of feet) {
    const [fx] = P([x, 0]);
    svg.append(SVG("path", { d: `M${fx} ${ground}v4l4 2-8 3 8 3-8 3 8 3-4 2v4m-6 0h12`, fill: "none", stroke: soft, "stroke-width": 1.1 }));
  }
  const foot = (i, centre, width, tall, points) => {
    const t = rotation(i), turn = (p) => turned(p, width / 2, centre, t);
    return { t, turn, points: points.map(turn) };
  };
  let mass;
  if (state.kind === "block") {
    const b = v.w / 2, { points, turn } = foot(0, 0, v.w, v.h, [[-b, 0], [b, 0], [b, v.h], [-b, v.h]]);
    poly(points); mass = turn([0, v.h / 2]); dot(mass, 4);
  } else if (state.kind === "aframe") {
    const b = v.w / 2, { points, turn } = foot(0, 0, v.w, v.h, [[-b, 0], [0, v.h], [b, 0]]);
    poly(points, { open: true, wide: 3 }); mass = turn([0, v.h]); dot(mass, 8); dot(turn([-b, 0]), 3.5); dot(turn([b, 0]), 3.5);
  } else {
    const centres = state.kind === "pier" ? [0] : [-v.s / 2, v.s / 2], tops = [];
    centres.forEach((centre, i) => {
      const b = v.w / 2, { points, turn } = foot(i, centre, v.w, v.hf, [[centre - b, 0], [centre + b, 0], [centre + b, v.hf], [centre - b, v.hf]]);
      poly(points);
      const L = v.h - v.hf, bend = Array.from({ length: 9 }, (_, j) => { const z = j / 8; return turn([centre + drift(i) * (3 * z * z - z ** 3) / 2, v.hf + L * z]); });
      poly(bend, { open: true, wide: 3 });
      tops.push(bend.at(-1));
    });
    if (state.kind === "frame") { poly(tops, { open: true, wide: 5 }); mass = [(tops[0][0] + tops[1][0]) / 2, (tops[0][1] + tops[1][1]) / 2]; } else { mass = tops[0]; dot(mass, 9); }
  }
  // what the numbers mean
  const text = (x, y, what, anchor = "middle") => svg.append(SVG("text", { x, y, fill: soft, "font-size": 12, "text-anchor": anchor }, what));
  const dim = ground + 36, [l, r] = [P([feet[0], 0])[0], P([feet.at(-1), 0])[0]];
  svg.append(SVG("path", { d: `M${l} ${dim - 5}v10M${r} ${dim - 5}v10M${l} ${dim}H${r}`, stroke: soft, fill: "none" }));
  text((l + r) / 2, dim + 17, state.kind === "frame" ? withUnit(v.s + v.w, LENGTH) : withUnit(v.w, LENGTH));
  const side = 24, up = P([0, height])[1];
  svg.append(SVG("path", { d: `M${side - 5} ${up}h10M${side - 5} ${ground}h10M${side} ${up}V${ground}`, stroke: soft, fill: "none" }));
  const label = SVG("text", { x: 0, y: 0, fill: soft, "font-size": 12, "text-anchor": "middle", transform: `translate(${side - 6} ${(up + ground) / 2}) rotate(-90)` }, withUnit(height, LENGTH));
  svg.append(label);
  const accel = history ? history.ground.accel_g[Math.min(history.ground.accel_g.length - 1, Math.round(at * history.step_s / history.ground.step_s))] : 0;
  const arrow = Math.max(-60, Math.min(60, (accel / Math.max(history?.uplift_g ?? 1, 0.05)) * 22));
  if (Math.abs(arrow) > 3) svg.append(SVG("path", { d: `M${middle} 331h${arrow.toFixed(1)}m${arrow > 0 ? -6 : 6} -4l${arrow > 0 ? 6 : -6} 4 ${arrow > 0 ? -6 : 6} 4`, stroke: css("--ok"), "stroke-width": 2, fill: "none" }));
  if (history) text(8, 335, `ground ${digits(accel, 2)} g`, "start");
  $("drawing-caption").textContent = `Drawn at scale${history ? `, its motion ${by === 1 ? "as it is" : `${by} times as large`}` : ""}. Under each ${state.kind === "pier" || state.kind === "frame" ? "corner" : "foot"}: ground springs, a numerical contact, not soil.`;
}
