// The working: every equation with this case's numbers, and the springs' tables.
const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
const E = (x, n = 4) => escape(digits(x, n));
function working(said) {
  const w = said.working, rows = [], add = (what, eq) => rows.push(`<li>${what}<span class="eq">${eq}</span></li>`);
  const { half_width_m: b, height_m: h, mass_kg: m, inertia_kgm2: Icg, radius_m: R, alpha, p, restitution: e, mass_share: share } = w;
  if (w.frequency_hz !== undefined) rows.push("<li>The structure gives. Its rigid body of the same masses, on one footing, is worked out here; lengths and angles are those of that body.</li>");
  add("From a foot to the centre of mass:", `R = √(b² + h²) = √(${E(b)}² + ${E(h)}²) = ${E(R)} m`);
  add("Slenderness, the lean of balance on one foot:", `α = atan(b/h) = atan(${E(b)}/${E(h)}) = ${E(alpha)} rad = ${E((alpha * 180) / Math.PI)}°`);
  add("Inertia about a foot:", `I<sub>0</sub> = I<sub>cg</sub> + m R² = ${E(Icg)} + ${E(m)} · ${E(R)}² = ${E(Icg + m * R * R)} kg m²`);
  add("Frequency parameter:", `p² = m g R / I<sub>0</sub> = ${E(m)} · 9.81 · ${E(R)} / ${E(Icg + m * R * R)} = ${E(p * p)} 1/s², p = ${E(p)} 1/s`);
  add("It lifts when the ground's acceleration passes", w.frequency_hz === undefined ? `a = g b/h${w.uplift_g > (b / h) * (1 + 1e-9) ? " (1 + T/W), T a tendon's tension and W the weight," : ""} = ${E(w.uplift_g)} g = ${E(w.uplift_g * G)} m/s²` : `a = ${E(w.uplift_g)} g for the elastic structure; the rigid body g b/h = ${E(b / h)} g`);
  add("Restitution, velocity after an impact over that before (equation 2):", `e = 1 − (m R²/I<sub>0</sub>)(1 − cos 2α) = 1 − ${E(share)} · (1 − cos ${E(2 * alpha)}) = ${E(e)}`);
  add("Rocking between impacts (equations 1 and 3), s = sign of θ, a<sub>g</sub> the ground's acceleration:", `θ″ = −${E(p * p)} · [sin(${E(alpha)} s − θ) + (a<sub>g</sub>/9.81) cos(${E(alpha)} s − θ)]; at θ = 0: θ′ → ${E(e)} θ′`);
  add("It falls when |θ| passes α and does not come back:", `α = ${E(alpha)} rad; largest found on springs: ${said.share_of_overturning === null ? "see the verdict" : `${E(100 * said.share_of_overturning, 3)} % of α = ${E(said.share_of_overturning * alpha)} rad`}`);
  const peaks = said.peaks?.with_members ?? said.peaks?.springs, reference = said.peaks?.reference;
  if (peaks && w.frequency_hz === undefined && said.does === "rocks") {
    const lifted = ({ uplift_m }) => `2 b sin θ = ${E(2 * b)} · sin ${E(Math.asin(uplift_m / (2 * b)))} = ${E(uplift_m)} m`;
    add("Uplift of the foot that is in the air, on springs, as above:", `${lifted(peaks)}${reference ? `; by Housner's equation ${lifted(reference)}` : ""}`);
  }
  for (const s of said.springs) {
    const on = Math.sqrt(s.k1_n_per_m / m);
    add(`The ${escape(s.name)} unit at ${escape(said.springs_at)}: gap spring k<sub>1</sub>, absorber m<sub>2</sub>, spring k<sub>2</sub> and dashpot c in parallel below it.`,
      `Ω<sub>n</sub> = √(k<sub>1</sub>/m) = √(${E(s.k1_n_per_m)}/${E(m)}) = ${E(on)} rad/s = ${E(on / (2 * Math.PI))} Hz; K = k<sub>2</sub>/k<sub>1</sub> = ${E(s.k2_n_per_m / s.k1_n_per_m)}; μ = m<sub>2</sub>/m = ${E(s.m2_kg / m)}; C = c/(m Ω<sub>n</sub>) = ${E(s.c_ns_per_m / (m * on))}`);
  }
  return `${inSi()}<ol class="work">${rows.join("")}</ol>`;
}
// of whoever has chosen feet
const inSi = () => state.u === "ft" ? '<p class="small"><strong>In SI units, as in the files:</strong> 1 kN = 0.2248 kip, 1 kN m = 0.7376 kip ft, 1 kN/m = 0.06852 kip/ft, 1 kg = 2.205 lb.</p>' : "";
function springsTable(springs, at, which = "Springs") {
  const row = (s) => `<tr><th scope="row">${escape(s.name)}</th><td>${E(s.k1_n_per_m)}</td><td>${E(s.k2_n_per_m)}</td><td>${E(s.m2_kg)}</td><td>${E(s.c_ns_per_m)}</td></tr>`;
  return `${inSi()}<div class="scroll" tabindex="0" role="region" aria-label="${which} at ${escape(at)}"><table><caption class="hidden">${which} at ${escape(at)}</caption><thead><tr><th scope="col">at ${escape(at)}</th><th scope="col">k1, N/m</th><th scope="col">k2, N/m</th><th scope="col">m2, kg</th><th scope="col">c, N s/m</th></tr></thead><tbody>${springs.map(row).join("")}</tbody></table></div>`;
}
// a table of the report
function reportTable({ head, rows }, name) {
  const columns = head.map((cell) => `<th scope="col">${escape(cell)}</th>`).join("");
  const row = ([first, ...rest]) => `<tr><th scope="row">${escape(first)}</th>${rest.map((cell) => `<td>${escape(cell)}</td>`).join("")}</tr>`;
  return `<div class="scroll" tabindex="0" role="region" aria-label="${name}"><table><caption class="hidden">${name}</caption><thead><tr>${columns}</tr></thead><tbody>${rows.map(row).join("")}</tbody></table></div>`;
}
const small = (texts) => texts.map((text) => `<p class="small">${escape(onPage(text))}</p>`).join("");
// the design forces, as the report has them
function forcesOf(section, many) {
  if (!section) return "";
  const mark = many ? ' <small class="mark">not predictable: design by many motions</small>' : "";
  return `<h3>${escape(section.title)}${mark}</h3>${inSi()}${reportTable(section.table, section.title)}${small([...section.text, ...section.notes])}`;
}
// springs for a program before the run has measured them
function preliminaryProgram(f) {
  const percent = (x) => `${E(100 * x, 2)} %`;
  return `<p class="small"><strong>Preliminary:</strong> for ${escape(f.program)} with steps of ${escape(f.steps)}, ${escape(f.integrator)}, in closed form. The run below measures such springs, and may take softer or stiffer ones.</p>${springsTable(f.springs, "each foot", "Preliminary springs for the program")}<p class="small">Expected error of a history (NRMSE): median ${percent(f.median)}, nine in ten below ${percent(f.ninety)}; the step alone makes ${percent(f.floor)}.</p>`;
}
// those that the run has, with what they err
function programOf(program, at) {
  if (!program) return '<p class="small">There are none for this structure.</p>';
  const { section, springs, usable, errors } = program;
  const [set] = section.text;
  const told = `<p class="${usable ? "" : "error"}" id="program-errors">${escape(onPage(errors))}</p>`;
  return `<p class="small">${escape(section.title)}, as the run has measured them:</p>${springsTable(springs, at, "Springs for the program")}${told}${reportTable(section.table, "Their errors in the program")}${small([set, ...section.notes])}`;
}
// What the program tune advises by its options, by the controls of this page; of others it is said whose they are.
const CONTROLS = [
  [/take it: --vertical auto|take it with --vertical auto \([^)]*\)/, 'tick "with its vertical component"'],
  [/choose the acceleration with --column.*$/, 'choose the one of the acceleration under "column of the acceleration"'],
  [/; if each column is a component, choose one with --column/, ""],
  [/tune verify judges the deck over/, "the deck for OpenSees can be compared with this history over"],
  [/--baseline removes it[^)]*\)/, "the program tune removes it"],
  [/choose with --component/, 'choose under "component"'],
  [/\(--component\)/, 'under "component"'],
  [/: --scale/, ': "scale of the record"'],
  [/give --step ([\d.e-]+)/, "give a step of $1 s"],
  [/another --step/, "another step"],
  [/give --for opensees-even/, "choose OpenSees with even steps"],
  [/ \(leave --integrator out\)/, ", the first of the list"],
  [/or --integrator backward-euler/, "or backward Euler as integrator"],
  [/; bare values are read row by row.*$/, ""],
  [/numbers in cm\/s2 need --units .*$/, 'choose the unit under "unit of the numbers"; one that the file itself names is to be corrected in the file'],
  [/but --units is (\S+); drop --units or correct one of them/, 'but $1 is chosen; choose "as the file says" under "unit of the numbers", or correct the file'],
  [/but --dt is (\S+ s); drop --dt or correct one of them/, 'but $1 is given; empty the field "time step", or correct the file'],
  [/: --dt (\S+) does not/, ': the time step of $1 s does not'],
  [/pass another --component.*$/, "choose the file again to see what it has"],
  [/pass --dt(?: SECONDS)?/, 'give it under "time step"'],
  [/pass --units .*$/, 'choose it under "unit of the numbers"'],
];
function onPage(text) {
  const said = CONTROLS.reduce((text, [option, control]) => text.replace(option, control), text);
  return / \(?--[a-z]/.test(said) || /\btune [a-z]+\b/.test(said) ? `${said} (with the program tune, not on this page)` : said;
}
// ---- a zip of stored files, for one click
const CRC = Uint32Array.from({ length: 256 }, (_, n) => { for (let k = 0; k < 8; k++) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1; return n; });
function zip(entries) {
  const parts = [], directory = [], text = new TextEncoder();
  let at = 0;
  for (const [name, content] of entries) {
    const bytes = typeof content === "string" ? text.encode(content) : content, called = text.encode(name);
    let crc = -1;
    for (const b of bytes) crc = CRC[(crc ^ b) & 255] ^ (crc >>> 8);
    const head = (signature, extra) => {
      const v = new DataView(new ArrayBuffer(extra ? 46 : 30));
      v.setUint32(0, signature, true);
      const o = extra ? 2 : 0;
      if (extra) v.setUint16(4, 20, true);
      v.setUint16(4 + o, 20, true); v.setUint16(6 + o, 0x800, true); v.setUint16(12 + o, 0x21, true);
      v.setUint32(14 + o, (crc ^ -1) >>> 0, true); v.setUint32(18 + o, bytes.length, true); v.setUint32(22 + o, bytes.length, true); v.setUint16(26 + o, called.length, true);
      if (extra) v.setUint32(42, at, true);
      return new Uint8Array(v.buffer);
    };
    directory.push(head(0x02014b50, true), called);
    const local = head(0x04034b50, false);
    parts.push(local, called, bytes);
    at += local.length + called.length + bytes.length;
  }
  const size = directory.reduce((sum, d) => sum + d.length, 0), end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true); end.setUint16(8, entries.length, true); end.setUint16(10, entries.length, true); end.setUint32(12, size, true); end.setUint32(16, at, true);
  return new Blob([...parts, ...directory, new Uint8Array(end.buffer)], { type: "application/zip" });
}
