// The state of a case and its case file; the workers that compute; units.
const $ = (id) => document.getElementById(id);
const G = 9.81;

// What users set, in SI units: name in the case file, least, most, what it is, unit.
const LENGTH = "length", MASS = "mass";
const KINDS = {
  block: { title: "block", width: "w", fields: {
    h: { key: "total_height_m", name: "height of the whole block", unit: LENGTH, least: 0.1, most: 60, start: 1.9 },
    w: { key: "width_m", name: "width", unit: LENGTH, least: 0.03, most: 40, start: 0.5 },
    m: { key: "mass_kg", name: "mass", unit: MASS, least: 1, most: 1e7, start: 250 } } },
  aframe: { title: "A-frame", width: "w", fields: {
    h: { key: "height_m", name: "height of the mass", unit: LENGTH, least: 0.3, most: 200, start: 61 },
    w: { key: "width_m", name: "between the feet", unit: LENGTH, least: 0.05, most: 80, start: 12.2 },
    m: { key: "mass_kg", name: "mass at the apex", unit: MASS, least: 1, most: 1e8, start: 680100 } } },
  pier: { title: "pier", width: "w", fields: {
    h: { key: "height_m", name: "height of the mass above the sole", unit: LENGTH, least: 2, most: 80, start: 12 },
    w: { key: "width_m", name: "width of the footing", unit: LENGTH, least: 0.5, most: 30, start: 4 },
    m: { key: "mass_kg", name: "mass at the top", unit: MASS, least: 1e3, most: 2e7, start: 600000 },
    mf: { key: "footing_mass_kg", name: "mass of the footing", unit: MASS, least: 100, most: 5e6, start: 60000 },
    hf: { key: "footing_height_m", name: "height of the footing", unit: LENGTH, least: 0.2, most: 8, start: 1.5 },
    f: { key: "frequency_hz", name: "frequency if fixed to the ground", unit: "Hz", least: 0.2, most: 20, start: 2 },
    d: { key: "damping_ratio", name: "damping ratio", unit: "%", least: 0.002, most: 0.2, start: 0.02 } } },
  frame: { title: "portal frame", width: "w", fields: {
    h: { key: "height_m", name: "height of the beam's axis", unit: LENGTH, least: 2, most: 60, start: 12 },
    s: { key: "span_m", name: "between the columns", unit: LENGTH, least: 1, most: 60, start: 10 },
    w: { key: "footing_width_m", name: "width of each footing", unit: LENGTH, least: 0.3, most: 15, start: 3 },
    hf: { key: "footing_height_m", name: "height of each footing", unit: LENGTH, least: 0.2, most: 6, start: 1.5 },
    mf: { key: "footing_mass_kg", name: "mass of each footing", unit: MASS, least: 100, most: 5e6, start: 40000 },
    m: { key: "beam_mass_kg", name: "mass of the beam and its load", unit: MASS, least: 1e3, most: 2e7, start: 500000 },
    ea: { key: "column_ea_n", name: "EA of a column", unit: "N", least: 1e7, most: 1e13, start: 3.4e10 },
    ei: { key: "column_ei_nm2", name: "EI of a column", unit: "N m²", least: 1e6, most: 1e13, start: 3e9 },
    ba: { key: "beam_ea_n", name: "EA of the beam", unit: "N", least: 1e7, most: 1e13, start: 4e10 },
    bi: { key: "beam_ei_nm2", name: "EI of the beam", unit: "N m²", least: 1e6, most: 1e13, start: 1e10 },
    d: { key: "damping_ratio", name: "damping ratio", unit: "%", least: 0.002, most: 0.2, start: 0.02 } } },
};
const MOTION = {
  scale: { name: "scale of the record", unit: "times", least: 0.1, most: 5, start: 1 },
  amp: { name: "amplitude of the pulse", unit: "g", least: 0.02, most: 3, start: 0.5 },
  per: { name: "period of the pulse", unit: "s", least: 0.1, most: 6, start: 1 },
};
const PULSE = "pulse.txt";

// Programs with steps of one size, as `[program]` of a case names them; the integrator that each is set to first.
const HHT = "hht:-0.3333333333333333";
const INTEGRATORS = { [HHT]: "Hilber-Hughes-Taylor, alpha -1/3", newmark: "Newmark, average acceleration", "backward-euler": "backward Euler", trbdf2: "TRBDF2", "generalized-alpha:0": "generalized-alpha, rho 0" };
const PROGRAMS = {
  sap2000: { title: "SAP2000", integrators: [HHT, "newmark"] },
  etabs: { title: "ETABS", integrators: [HHT, "newmark"] },
  "opensees-even": { title: "OpenSees with even steps", integrators: ["backward-euler", "trbdf2", HHT, "newmark"] },
  other: { title: "another one", integrators: Object.keys(INTEGRATORS) },
};
const STEP = { least: 1e-6, most: 0.1, usual: 0.001 };

// ---- units
const FOOT = 0.3048, POUND = 0.45359237;
const shown = {
  length: (u) => (u === "ft" ? { by: 1 / FOOT, unit: "ft" } : { by: 1, unit: "m" }),
  mass: (u) => (u === "ft" ? { by: 1 / POUND, unit: "lb" } : { by: 1, unit: "kg" }),
  small: (u) => (u === "ft" ? { by: 12 / FOOT, unit: "in" } : { by: 1000, unit: "mm" }),
  "%": () => ({ by: 100, unit: "%" }),
};
const unitOf = (unit) => (shown[unit] ? shown[unit](state.u) : { by: 1, unit: unit === "times" ? "×" : unit });
// digits that count, without an exponent where that can be read
function digits(x, n = 4) {
  if (!Number.isFinite(x)) return "-";
  if (x === 0) return "0";
  const a = Math.abs(x);
  if (a >= 1e7 || a < 1e-4) return x.toExponential(n - 1).replace("e+", "e");
  const rounded = Number(x.toPrecision(n));
  return a >= 10000 ? Math.round(rounded).toLocaleString("en-US").replace(/,/g, "\u00a0") : String(rounded);
}
// three digits, never above x or never below it: an edge is told on its safe side
const digitsDown = (x, way = Math.floor) => { const by = 10 ** (2 - Math.floor(Math.log10(x))); return digits(way(x * by * (1 + (way === Math.floor ? 1e-12 : -1e-12))) / by, 3); };
const digitsUp = (x) => digitsDown(x, Math.ceil);
const withUnit = (x, unit, n = 4) => `${digits(x * unitOf(unit).by, n)} ${unitOf(unit).unit}`;

// ---- what the charts tell
// of a structure that gives they are of another body, and say so first
const chartsOf = (text) => (isRigid() ? text : `The rigid body: ${text[0].toLowerCase()}${text.slice(1)}`);
const WIDTH_STEP = 0.005, SCALE_STEP = 0.002;
// from one number to another in equal shares, on a lattice that does not hang on them
const steps = (low, high, share) => { const by = Math.log(1 + share), from = Math.ceil(Math.log(low) / by); return Array.from({ length: Math.floor(Math.log(high) / by) - from + 1 }, (_, i) => Math.exp((from + i) * by)); };
const scanned = (what, share) => `${what} tried in steps of ${100 * share} %; narrower bands may be missed, so take a margin.`;
// rows of [width, share of overturning or null], from narrow to wide; the least width from which on all stand
function widthCaption(rows, least, unit) {
  const falls = rows.findLastIndex(([, s]) => s === null), how = scanned("Widths", WIDTH_STEP);
  if (falls < 0) return `No width tried falls (${digits(rows[0][0], 3)} to ${digits(rows.at(-1)[0], 3)} ${unit}). ${how}`;
  if (least === null) return `It falls even ${digits(rows[falls][0], 3)} ${unit} wide.`;
  const narrow = rows.findIndex(([, s]) => s !== null);
  const edge = narrow < falls ? `From ${digits(rows[narrow][0], 3)} to ${digits(rows[falls][0], 3)} ${unit} some stand and some fall: small changes decide there. ` : "";
  return `${edge}From ${digitsUp(least)} ${unit} on every width tried stands. ${how}`;
}
// the same over scales of the record; the weakest that overturns
function scaleCaption(rows, weakest) {
  const how = scanned("Scales", SCALE_STEP);
  if (weakest === null) return `Nothing up to ${digits(rows.at(-1)[0], 3)} times the record overturns it. ${how}`;
  const stands = rows.findLastIndex(([, s]) => s !== null);
  const some = stands >= 0 && rows[stands][0] > weakest ? ` Up to ${digits(rows[stands][0], 3)} times some stand and some fall: small changes decide there.` : "";
  return `The weakest found to overturn it: ${digitsDown(weakest)} times the record.${some} ${how}`;
}

// ---- state
const state = { kind: "block", u: "m", rec: "elcentro", scale: 1, amp: 0.5, per: 1, file: "", comp: "", vert: false, dt: "", units: "", prog: "sap2000", step: "", integ: "", values: {} };
const files = new Map();
const fields = () => KINDS[state.kind].fields;
const value = (name) => state.values[name] ?? fields()[name].start;
const isRigid = () => state.kind === "block" || state.kind === "aframe";
const integrator = () => state.integ || PROGRAMS[state.prog].integrators[0];
// of an elastic structure the run looks for a step that gets it through, unless one is given
const stepGiven = () => state.step || (isRigid() ? STEP.usual : "");
const goodStep = (x) => x >= STEP.least && x <= STEP.most;

function toHash() {
  const q = new URLSearchParams({ kind: state.kind });
  for (const name of Object.keys(fields())) q.set(name, String(value(name)));
  q.set("u", state.u);
  q.set("rec", state.rec);
  q.set("scale", String(state.scale));
  if (state.rec === "pulse") { q.set("amp", state.amp); q.set("per", state.per); }
  if (state.rec === "file") {
    q.set("file", state.file);
    for (const k of ["comp", "dt", "units"]) if (state[k]) q.set(k, state[k]);
    if (state.vert) q.set("vert", "1");
  }
  if (state.prog !== "sap2000") q.set("prog", state.prog);
  for (const k of ["step", "integ"]) if (state[k]) q.set(k, state[k]);
  return "#" + q.toString();
}
// takes the address; what of it was not taken and what is used instead, in words
function fromHash(hash) {
  const q = new URLSearchParams(hash.replace(/^#/, "")), not = [];
  const refuse = (name, used) => not.push(`${name} = ${q.get(name).slice(0, 40)} (${used})`);
  const number = (name, { least, most, start, unit }) => {
    const text = q.get(name), x = Number(text);
    if (text === null) return start;
    const used = text !== "" && Number.isFinite(x) ? Math.min(most, Math.max(least, x)) : start;
    if (used !== x || text === "") refuse(name, withUnit(used, unit));
    return used;
  };
  const oneOf = (name, all, usual) => {
    if (q.get(name) === null || all.includes(q.get(name))) return q.get(name) ?? usual;
    refuse(name, usual || "as the program has it");
    return usual;
  };
  state.kind = oneOf("kind", Object.keys(KINDS), "block");
  state.u = oneOf("u", ["m", "ft"], "m");
  state.values = {};
  for (const [name, field] of Object.entries(fields())) state.values[name] = number(name, field);
  state.rec = oneOf("rec", ["elcentro", "file", "pulse"], "elcentro");
  for (const k of ["scale", "amp", "per"]) state[k] = number(k, MOTION[k]);
  for (const k of ["file", "comp", "dt", "units"]) state[k] = q.get(k) ?? "";
  state.vert = q.get("vert") === "1";
  state.prog = oneOf("prog", Object.keys(PROGRAMS), "sap2000");
  state.step = goodStep(Number(q.get("step"))) ? Number(q.get("step")) : "";
  if (q.get("step") && state.step === "") refuse("step", stepGiven() ? `${stepGiven()} s` : "as the run finds it");
  state.integ = oneOf("integ", PROGRAMS[state.prog].integrators, "");
  const known = ["kind", "u", "rec", "scale", "amp", "per", "file", "comp", "dt", "units", "vert", "prog", "step", "integ", ...Object.values(KINDS).flatMap((kind) => Object.keys(kind.fields))];
  for (const name of q.keys()) if (!known.includes(name)) not.push(`${name.slice(0, 40)} (not known)`);
  return not.length > 0 ? `Of the link these values are not taken, and what stands in brackets is used: ${not.join(", ")}.` : "";
}

// ---- the case file: what `tune run` reads
const toml = (text) => JSON.stringify(text).replace(/\x7f/g, "\\u007f");
const float = (x) => (/[.e]/.test(String(x)) ? String(x) : `${x}.0`);
function caseText() {
  const lines = ["[structure]", `kind = "${state.kind}"`];
  for (const [name, field] of Object.entries(fields())) lines.push(`${field.key} = ${float(value(name))}`);
  lines.push("", "[record]");
  if (state.rec === "file") {
    lines.push(`file = ${toml(state.file)}`);
    if (state.comp) lines.push(`component = ${toml(state.comp)}`);
    if (state.vert) lines.push(`vertical = "auto"`);
    if (Number(state.dt) > 0) lines.push(`dt_s = ${float(Number(state.dt))}`);
    if (state.units) lines.push(`units = ${toml(state.units)}`);
  }
  if (state.rec === "pulse") lines.push(`file = "${PULSE}"`, `dt_s = ${float(pulseStep(state.per))}`, `units = "g"`);
  lines.push(`scale = ${float(state.scale)}`, "");
  // springs that nobody asked for are those of a run that nobody asked for a program: fewer motions, half of the time
  if (state.prog === "sap2000" && !state.step && !state.integ) return lines.join("\n");
  lines.push("[program]");
  if (state.prog !== "other") lines.push(`for = "${state.prog}"`);
  if (stepGiven()) lines.push(`step_s = ${float(stepGiven())}`);
  lines.push(`integrator = "${integrator()}"`, "");
  return lines.join("\n");
}
const pulseStep = (period) => [0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005].find((s) => s <= period / 100) ?? 0.0005;

// ---- the workers
const ALPHABET = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!\"#$%&'()*+,-./:;=>?@[]^_{|}~";
function bytesOf91(text, length) {
  const place = new Uint8Array(128);
  for (let i = 0; i < 91; i++) place[ALPHABET.charCodeAt(i)] = i;
  const bytes = new Uint8Array(length + 2);
  let bits = 0, count = 0, at = 0;
  for (let i = 0; i < text.length; i += 2) {
    const pair = place[text.charCodeAt(i)] + 91 * place[text.charCodeAt(i + 1)];
    bits |= pair << count;
    // 14 bits where two letters hold them
    count += (pair & 8191) > 88 ? 13 : 14;
    while (count > 7) {
      bytes[at++] = bits & 255;
      bits >>>= 8;
      count -= 8;
    }
  }
  return bytes.subarray(0, length);
}
// The program; before it the worker's script.
let source;
async function compiled() {
  const [length, script, ...lines] = $("program").textContent.trim().split("\n");
  const packed = bytesOf91(lines.join(""), Number(length));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const all = await new Response(stream).arrayBuffer();
  source = URL.createObjectURL(new Blob([all.slice(0, Number(script))], { type: "text/javascript" }));
  return WebAssembly.compile(all.slice(Number(script)));
}

// One worker, its calls in order; what is still waiting is dropped when the worker ends.
class Computer {
  constructor(module) { this.module = module; this.waiting = new Map(); this.next = 0; this.memory = 0; this.start(); }
  start() {
    this.worker = new Worker(source);
    this.worker.onmessage = ({ data }) => {
      const asked = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (data.memory) this.memory = Math.max(this.memory, data.memory);
      if (data.crash) { this.end(); this.start(); asked?.reject(new Error("This case stops the program, which is a fault of it: please report the address of this page.")); }
      else if (data.error !== undefined) asked?.reject(new Error(data.error));
      else asked?.resolve(data);
    };
    this.worker.onerror = () => { this.end(); this.start(); };
    this.ready = this.call("begin", this.module, [...files]);
  }
  end() {
    this.worker.terminate();
    for (const { reject } of this.waiting.values()) reject(new Error("stopped"));
    this.waiting.clear();
  }
  restart() { this.end(); this.start(); }
  get busy() { return this.waiting.size > 0; }
  call(call, ...args) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, call, args });
    });
  }
}
