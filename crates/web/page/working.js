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
  add("It lifts when the ground's acceleration passes", w.frequency_hz === undefined ? `a = g b/h = ${E(w.uplift_g)} g = ${E(w.uplift_g * G)} m/s²` : `a = ${E(w.uplift_g)} g for the elastic structure; the rigid body g b/h = ${E(b / h)} g`);
  add("Restitution, velocity after an impact over that before (equation 2):", `e = 1 − (m R²/I<sub>0</sub>)(1 − cos 2α) = 1 − ${E(share)} · (1 − cos ${E(2 * alpha)}) = ${E(e)}`);
  add("Rocking between impacts (equations 1 and 3), s = sign of θ, u<sub>g</sub> the ground's acceleration:", `θ″ = −${E(p * p)} · [sin(${E(alpha)} s − θ) + (u<sub>g</sub>/9.81) cos(${E(alpha)} s − θ)]; at θ = 0: θ′ → ${E(e)} θ′`);
  add("It falls when |θ| passes α and does not come back:", `α = ${E(alpha)} rad; largest found: ${said.share_of_overturning === null ? "see the verdict" : `${E(100 * said.share_of_overturning, 3)} % of α = ${E(said.share_of_overturning * alpha)} rad`}`);
  const peaks = said.peaks?.reference ?? said.peaks?.springs;
  if (peaks && said.working.frequency_hz === undefined && said.does === "rocks") add("Uplift of the foot that is in the air:", `2 b sin θ = ${E(2 * b)} · sin ${E(peaks.uplift_m / (2 * b))} = ${E(peaks.uplift_m)} m`);
  for (const s of said.springs) {
    const on = Math.sqrt(s.k1_n_per_m / m);
    add(`The ${escape(s.name)} unit at ${escape(said.springs_at)}: gap spring k<sub>1</sub>, absorber m<sub>2</sub>, spring k<sub>2</sub> and dashpot c in parallel below it.`,
      `Ω<sub>n</sub> = √(k<sub>1</sub>/m) = √(${E(s.k1_n_per_m)}/${E(m)}) = ${E(on)} rad/s = ${E(on / (2 * Math.PI))} Hz; K = k<sub>2</sub>/k<sub>1</sub> = ${E(s.k2_n_per_m / s.k1_n_per_m)}; μ = m<sub>2</sub>/m = ${E(s.m2_kg / m)}; C = c/(m Ω<sub>n</sub>) = ${E(s.c_ns_per_m / (m * on))}`);
  }
  return `<ol class="work">${rows.join("")}</ol>`;
}
function springsTable(springs, at, which = "Springs") {
  const row = (s) => `<tr><th scope="row">${escape(s.name)}</th><td>${E(s.k1_n_per_m)}</td><td>${E(s.k2_n_per_m)}</td><td>${E(s.m2_kg)}</td><td>${E(s.c_ns_per_m)}</td></tr>`;
  return `<div class="scroll" tabindex="0" role="region" aria-label="${which} at ${escape(at)}"><table><caption class="hidden">${which} at ${escape(at)}</caption><thead><tr><th scope="col">at ${escape(at)}</th><th scope="col">k1, N/m</th><th scope="col">k2, N/m</th><th scope="col">m2, kg</th><th scope="col">c, N s/m</th></tr></thead><tbody>${springs.map(row).join("")}</tbody></table></div>`;
}
const FORCES = [["column_shear_n", "column shear", "N"], ["column_base_moment_nm", "moment at column base", "N m"], ["column_top_moment_nm", "moment at column top", "N m"], ["axial_n", "axial force", "N"], ["axial_tension_n", "tension", "N"], ["apex_moment_nm", "moment at the apex", "N m"], ["sole_shear_n", "shear at the sole, footing included", "N"], ["sole_vertical_n", "vertical force at the sole, footing included", "N"]];
function forcesTable(forces) {
  const rows = FORCES.filter(([key]) => forces?.[key]).map(([key, name, unit]) => {
    const f = forces[key], engineering = (x) => { const [by, prefix] = Math.abs(x) >= 1e6 ? [1e-6, "M"] : Math.abs(x) >= 1e3 ? [1e-3, "k"] : [1, ""]; return `${E(Math.abs(x) * by)} ${prefix}${unit}`; };
    return `<tr><th scope="row">${name}</th><td>${f.holds && typeof f.value === "number" ? engineering(f.value) : "not foretold"}</td></tr>`;
  });
  return rows.length ? `<h3>Forces to design with</h3><div class="scroll" tabindex="0" role="region" aria-label="Forces to design with"><table><caption class="hidden">Forces to design with</caption><tbody>${rows.join("")}</tbody></table></div>` : "";
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
