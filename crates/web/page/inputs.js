// Sliders and numbers, the record's part of the form.
const places = {};
// A decimal comma is a point. What may group thousands is no number here: "1,234" and "1,234.5" are read in two ways.
function numberIn(text) {
  const t = text.trim();
  return /^[-+]?(\d+[.,]?\d*|[.,]\d+)(e[-+]?\d+)?$/i.test(t) && !/^[-+]?[1-9]\d{0,2},\d{3}$/.test(t) ? Number(t.replace(",", ".")) : NaN;
}
const notRead = (text) => (text.trim() === "" || Number.isFinite(numberIn(text)) ? "" : `"${text}" is not clear: write 1.5 or 1,5, nothing between thousands; `);
// what is said of a number that is not taken stands a while after the field shows again what is
const STAYS_MS = 8000;
const fades = new WeakMap();
const fade = (note) => { clearTimeout(fades.get(note)); if (!note.hidden) fades.set(note, setTimeout(() => (note.hidden = true), STAYS_MS)); };
const tell = (note, text) => { clearTimeout(fades.get(note)); note.hidden = text === ""; note.textContent = text; };
// a slider is even in the logarithm
const toSlide = (x, { least, most }) => Math.log(x / least) / Math.log(most / least);
const fromSlide = (s, { least, most }) => Number((least * (most / least) ** s).toPrecision(3));
function field(name, of, get, set) {
  const unit = unitOf(of.unit), box = document.createElement("div");
  box.className = "field";
  const inUnit = (x) => Number((x * unit.by).toPrecision(unit.by === 1 ? 9 : 5));
  box.innerHTML = `<div class="top"><label for="n-${name}">${of.name}</label><span class="number"><input inputmode="decimal" id="n-${name}"><b>${unit.unit}</b></span></div><small class="error" role="alert" hidden></small><input type="range" id="s-${name}" min="0" max="1" step="0.002" aria-label="${of.name}, slider">`;
  const number = box.querySelector("[inputmode]"), slider = box.querySelector("[type=range]"), limits = box.querySelector("small");
  const show = (skip) => {
    if (skip !== number) number.value = String(inUnit(get()));
    slider.value = String(toSlide(get(), of));
    slider.setAttribute("aria-valuetext", `${inUnit(get())} ${unit.unit}`);
  };
  slider.addEventListener("input", () => { set(fromSlide(Number(slider.value), { least: of.least, most: of.most })); show(slider); changed(); });
  number.addEventListener("input", () => {
    const x = numberIn(number.value) / unit.by;
    const good = x >= of.least * 0.999999 && x <= of.most * 1.000001;
    number.setAttribute("aria-invalid", String(!good));
    tell(limits, good ? "" : `${of.name}: ${notRead(number.value)}from ${digits(of.least * unit.by, 3)} to ${digits(of.most * unit.by, 3)} ${unit.unit}; the answer is for ${inUnit(get())} ${unit.unit}`);
    if (good) { set(Number(x.toPrecision(9))); show(number); changed(); }
  });
  number.addEventListener("blur", () => { number.removeAttribute("aria-invalid"); fade(limits); show(); });
  // arrows change the second digit
  number.addEventListener("keydown", (event) => {
    const way = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!way) return;
    event.preventDefault();
    const x = numberIn(number.value) || get() * unit.by, by = 10 ** (Math.floor(Math.log10(Math.abs(x) || 1)) - 1);
    number.value = String(Number((x + way * by).toPrecision(6)));
    number.dispatchEvent(new Event("input"));
  });
  show();
  places[name] = show;
  return box;
}
function buildForm() {
  for (const radio of document.querySelectorAll("[name=kind]")) radio.checked = radio.value === state.kind;
  for (const radio of document.querySelectorAll("[name=rec]")) radio.checked = radio.value === state.rec;
  for (const radio of document.querySelectorAll("[name=units]")) radio.checked = radio.value === state.u;
  const of = (name) => field(name, fields()[name], () => value(name), (x) => (state.values[name] = x));
  const all = Object.keys(fields()), rest = all.slice(state.kind === "pier" ? 3 : 6);
  const few = state.kind === "pier" || state.kind === "frame" ? all.slice(0, all.length - rest.length) : all;
  $("structure").replaceChildren(...few.map(of));
  if (few.length < all.length) {
    const more = document.createElement("details");
    more.innerHTML = "<summary>more of it</summary>";
    more.append(...rest.map(of));
    $("structure").append(more);
  }
  const motion = (name) => field(name, MOTION[name], () => state[name], (x) => (state[name] = x));
  $("pulse-part").replaceChildren(motion("amp"), motion("per"));
  $("record-part").replaceChildren(motion("scale"));
  $("pulse-part").hidden = state.rec !== "pulse";
  $("file-part").hidden = state.rec !== "file";
  $("else-of").hidden = isRigid();
  $("else-how").hidden = !isRigid();
  $("else-of").textContent = isRigid() ? "" : `These charts are of the rigid body of the same shape and masses, by Housner's equation, and not of the ${KINDS[state.kind].title}, which gives: the answer above may differ from them.`;
  programForm();
}
// the program with steps of one size; its integrators are those that it has
function programForm() {
  const options = (id, all, chosen) => $(id).replaceChildren(...all.map(([v, text]) => new Option(text, v, false, v === chosen)));
  options("program-name", Object.entries(PROGRAMS).map(([key, { title }]) => [key, title]), state.prog);
  options("integrator", PROGRAMS[state.prog].integrators.map((key) => [key, INTEGRATORS[key]]), integrator());
  showStep();
}
function showStep(left) {
  $("step").value = String(stepGiven());
  $("step").placeholder = isRigid() ? "" : "as it needs";
  $("step").removeAttribute("aria-invalid");
  if (left) fade($("step-error")); else tell($("step-error"), "");
}
function stepError(text) {
  $("step").setAttribute("aria-invalid", String(text !== ""));
  tell($("step-error"), text);
}
function stepTyped() {
  const text = $("step").value, x = numberIn(text);
  const none = text.trim() === "" && !isRigid();
  if (!none && !goodStep(x)) return stepError(`step: ${notRead(text)}from ${STEP.least} to ${STEP.most} s; the answer is for ${stepGiven() ? `${stepGiven()} s` : "the step that the run finds"}`);
  stepError("");
  state.step = none ? "" : x;
  changed();
}
// the columns of files that are tables, as the program lists those that are accelerations
const tables = new Map();
function tableOf(file, message) {
  if (!/ columns; choose the acceleration/.test(message)) return;
  const found = [...message.matchAll(/column (\d+)(?: \(((?:[^()]|\([^()]*\))*)\))?(?=, column \d|[;)])/g)];
  tables.set(file, found.map(([, number, name]) => [`column ${number}`, name ? `${number}: ${name}` : number]));
}
// what a file has to choose from
function fileOptions(record) {
  const box = $("file-options");
  box.replaceChildren();
  if (state.rec !== "file" || !files.has(state.file)) return;
  const select = (label, options, chosen, set) => {
    const l = document.createElement("label");
    l.className = "field";
    l.style.display = "block";
    l.append(`${label} `);
    const s = document.createElement("select");
    for (const [v, t] of options) { const o = document.createElement("option"); o.value = v; o.textContent = t; o.selected = v === chosen; s.append(o); }
    s.addEventListener("change", () => { set(s.value); changed(); askRecord(); });
    l.append(s);
    box.append(l);
  };
  const level = record?.components.filter((c) => !c.vertical) ?? [], up = record?.components.filter((c) => c.vertical) ?? [];
  // of a link the columns are known when none is chosen
  const columns = tables.get(state.file) ?? (/^column \d+$/.test(state.comp) ? [[state.comp, state.comp]] : []);
  if (columns.length > 0) select("column of the acceleration", [["", "choose"], ...columns], state.comp, (v) => (state.comp = v));
  if (level.length > 1) select("component", [["", "the stronger one"], ...level.map((c) => [c.name, `${c.label}, peak ${digits(c.pga_g, 3)} g`])], state.comp, (v) => (state.comp = v));
  if (up.length === 1 && level.length) {
    const l = document.createElement("label");
    l.className = "field"; l.style.display = "block";
    const c = document.createElement("input");
    c.type = "checkbox"; c.checked = state.vert;
    c.addEventListener("change", () => { state.vert = c.checked; changed(); askRecord(); });
    l.append(c, ` with its vertical component, peak ${digits(up[0].pga_g, 3)} g`);
    box.append(l);
  }
  if (!record || state.units || state.dt) {
    select("unit of the numbers", [["", "as the file says"], ...["g", "m/s2", "cm/s2", "mm/s2", "mg", "%g", "ft/s2", "in/s2", "mGal"].map((u) => [u, u.replace("s2", "s²")])], state.units, (v) => (state.units = v));
    const l = document.createElement("label");
    l.className = "field"; l.style.display = "block";
    const n = document.createElement("input");
    const note = document.createElement("small");
    note.className = "error"; note.setAttribute("role", "alert"); note.hidden = true;
    n.inputMode = "decimal"; n.value = state.dt;
    n.addEventListener("change", () => {
      const x = numberIn(n.value), none = n.value.trim() === "";
      if (!none && !(x >= 1e-6 && x <= 1)) return tell(note, `time step: ${notRead(n.value)}from 0.000001 to 1 s`);
      state.dt = none ? "" : String(x); changed(); askRecord();
    });
    l.append("time step ", n, " s (empty: as the file says)", note);
    box.append(l);
  }
}
