// What happens when something changes: at once, at rest, and one after another.
let module, quick, whole, last, run, spectrum, playing = 0, at = 0;
let atRest = 0, wanted = false, asking = false, version = 0, lastRecord = null;
const REST_MS = 300, WAIT_MS = 400;
let answered = 0, since = 0;
window.measures = { moves: [], tune: 0, memory: () => [quick?.memory ?? 0, whole?.memory ?? 0] };

// another record or structure: what was asked before it is not shown any more
function changedAll() { since = version + 1; clearAnswer(); changed(); }
function clearAnswer() {
  $("verdict").className = "verdict";
  $("word").textContent = "Computing ...";
  for (const id of ["sentence", "stage", "tiles", "remarks"]) $(id).replaceChildren();
  $("asked").textContent = missing() ? "" : askedLine();
  $("gauge-fill").style.width = "0";
}
function changed() {
  version++;
  window.measures.from = performance.now();
  history.replaceState(null, "", toHash());
  clearTimeout(atRest);
  if (whole?.busy) whole.restart();
  run = null;
  $("fixed").classList.add("old");
  atRest = setTimeout(rest, REST_MS);
  const of = version;
  // an answer to what was asked before does not stay
  setTimeout(() => { if (of === version && answered !== of) clearAnswer(); }, WAIT_MS);
  askAtOnce();
}
// a pulse is a file like any other
async function givePulse(worker) {
  if (state.rec !== "pulse") return;
  const { answer } = await quick.call("pulse", state.amp, state.per);
  const bytes = new TextEncoder().encode(answer);
  files.set(PULSE, bytes);
  await worker.call("give_file", PULSE, bytes);
}
const missing = () => state.rec === "file" && !files.has(state.file);
async function askAtOnce() {
  if (!quick) return;
  wanted = true;
  if (asking) return;
  asking = true;
  while (wanted) {
    wanted = false;
    const began = window.measures.from, of = version;
    try {
      if (missing()) throw new Error(state.file ? `This case is of the record ${state.file}: drop that file here.` : "Drop a record, or choose a file.");
      await givePulse(quick);
      const { answer, took } = await quick.call("at_once", caseText(), 0.5);
      if (of >= since) last = JSON.parse(answer);
      if (of >= since && (!run || of === version)) { showSaid(last); window.measures.moves.push([performance.now() - began, took]); requestAnimationFrame(() => setTimeout(() => window.measures.moves.at(-1).push(performance.now() - began))); }
    } catch (error) { if (error.message !== "stopped" && of >= since) showError(error.message); }
    answered = of;
  }
  asking = false;
}
async function askRecord() {
  const of = version;
  lastRecord = null;
  if (missing()) { $("record-line").textContent = ""; fileOptions(null); return; }
  try {
    await givePulse(quick);
    const { answer } = await quick.call("read_record", caseText());
    if (of < since) return;
    lastRecord = JSON.parse(answer);
    $("record-line").textContent = [lastRecord.line, ...lastRecord.notices.map(onPage)].join(". ");
    $("file-error").hidden = true;
  } catch (error) {
    if (of < since) return;
    $("record-line").textContent = "";
    if (state.rec === "file") tableOf(state.file, error.message);
    if (state.rec === "file") { $("file-error").textContent = onPage(error.message); $("file-error").hidden = false; }
  }
  fileOptions(lastRecord);
}
// at rest: a step to go back to, the whole run, the charts
async function rest() {
  if (location.hash !== history.state?.rest) {
    const hash = toHash();
    if (restHash !== hash) { history.replaceState(null, "", restHash || hash); history.pushState({ rest: hash }, "", hash); restHash = hash; }
  }
  const of = version;
  askRecord();
  fixedStep(of);
  if (missing() || !module) return;
  tune(of);
  charts(of);
}
let restHash = "";
async function tune(of) {
  $("tune-state").textContent = isRigid() ? "searching for springs as accurate as asked, a few seconds ..." : "searching for springs as accurate as asked, ten seconds to a minute for a structure that gives ...";
  $("tuned").replaceChildren();
  try {
    whole ??= new Computer(module);
    if (files.has(state.file)) await whole.call("give_file", state.file, files.get(state.file));
    await givePulse(whole);
    if (of !== version) return;
    const text = caseText(), began = performance.now();
    const { answer } = await whole.call("tune", text, 0.5);
    if (of !== version) return;
    window.measures.tune = performance.now() - began;
    run = JSON.parse(answer);
    answered = of;
    showSaid(run.said, true);
    await showTuned(run, text);
  } catch (error) {
    if (error.message === "stopped" || of !== version) return;
    $("tune-state").textContent = "";
    $("stage").textContent = "Preliminary: the whole run has no answer (see the ground springs).";
    $("tuned").innerHTML = `<p class="error">${escape(onPage(error.message))}</p>`;
  }
}

// ---- what is shown
const WORDS = { overturns: "It falls over", rocks: "It rocks and stands", stays_down: "It does not lift", unknown: "No answer" };
function askedLine() {
  const named = state.rec === "elcentro" ? "El Centro 1940" : state.rec === "pulse" ? `a pulse of ${digits(state.amp)} g and ${digits(state.per)} s` : state.file;
  return `${state.kind === "aframe" ? "An" : "A"} ${KINDS[state.kind].title} ${withUnit(value("h"), LENGTH)} high, ${state.kind === "frame" ? "on footings " : state.kind === "pier" ? "on a footing " : ""}${withUnit(value("w"), LENGTH)} wide, in ${named}${state.scale === 1 ? "" : ` times ${digits(state.scale)}`}:`;
}
function showSaid(said, ofRun = false) {
  const h = said.history, w = said.working;
  h.rigid = w.frequency_hz === undefined;
  h.uplift_g = w.uplift_g;
  h.least = 2e-4 * w.height_m;
  // beyond the height the top lies on the ground
  h.limit = said.does === "overturns" ? 1.2 * Math.sin(Math.min(1.5, w.alpha)) * 2 * w.radius_m : undefined;
  last = said;
  const share = said.does === "overturns" ? 1 : (said.share_of_overturning ?? 0), back = said.does === "rocks" && share > 1;
  const box = $("verdict"), doubt = said.by_chance;
  box.className = `verdict ${said.does}${doubt || back ? " doubt" : ""}`;
  $("asked").textContent = askedLine();
  const word = back ? "It passes its balance and comes back" : WORDS[said.does];
  $("word").textContent = doubt ? `${word} here, by chance` : word;
  $("sentence").textContent = said.verdict;
  $("stage").textContent = ofRun ? "" : "Preliminary, on springs from the geometry: the run that follows decides, and tells how far the motion can be predicted.";
  $("gauge-fill").style.width = `${Math.min(100, 100 * share)}%`;
  $("gauge").setAttribute("aria-label", said.does === "overturns" ? "It overturns" : `Largest rotation: ${digits(100 * share, 3)} % of what overturns it`);
  const p = said.peaks?.with_members ?? said.peaks?.springs, down = said.does === "stays_down";
  const small = (x) => (down && x < 1e-5 ? `0 ${unitOf("small").unit}` : withUnit(x, "small", 3));
  const pga = Math.max(...h.ground.accel_g.map(Math.abs)), until = said.does === "overturns" ? "before it falls" : "";
  const tiles = [
    ["largest rotation", said.does === "overturns" ? "100 %" : `${digits(100 * share, 3)} %`, "of overturning"],
    ["top moves", p ? small(p.top_displacement_m) : "-", until || (p && !down ? `${digits(100 * p.drift_ratio, 3)} % of the height` : "")],
    ["a foot lifts", p ? small(p.uplift_m) : "-", until],
    ["impacts", p ? String(p.impacts) : "-", impactsCounted(said)],
    ["lifts at", `${digits(w.uplift_g, 3)} g`, `the ground has ${digits(pga, 3)}\u00a0g`],
    ["restitution", digits(w.restitution, 3), "speed kept in an impact"],
  ];
  if (typeof p?.bending_m === "number") tiles.splice(2, 0, ["by bending", small(p.bending_m), "largest of a column"]);
  if (typeof said.friction_needed === "number") tiles.push(["friction needed", digits(said.friction_needed, 3), "not to slide"]);
  $("tiles").innerHTML = tiles.map(([name, x, more]) => `<div><dt>${name}</dt><dd>${escape(x)}<small>${escape(more) || "&nbsp;"}</small></dd></div>`).join("");
  $("remarks").innerHTML = said.findings.filter((f) => f.weight !== "answer").map((f) => `<li class="${escape(f.weight)}">${escape(onPage(`${f.message}${f.remedy ? `; ${f.remedy}` : ""}`))}</li>`).join("");
  $("springs").innerHTML = springsTable(said.springs, said.springs_at) + (ofRun ? "" : '<p class="small">From the geometry, at once; the search for the accuracy asked for begins when nothing moves.</p>');
  $("working").innerHTML = working(said);
  const end = (h.springs.top.length - 1) * h.step_s;
  $("time").max = String(end || 1);
  if (at > end) at = 0;
  if (!playing && !movedTime) at = peakTime(h);
  showTime();
}
// as the program counts them: of a rigid body those of some strength, as long as Housner's solution goes
const impactsCounted = (said) => !isRigid() ? "a foot lands, 0.1/p apart" : typeof said.peaks?.reference_ends_s === "number" ? "times a foot lands" : "harder than a fall from 0.02 \u03b1";
let movedTime = false;
function peakTime(h) {
  let most = 0;
  h.springs.top.forEach((x, i) => { if (Math.abs(x) > Math.abs(h.springs.top[most])) most = i; });
  const fall = h.limit ? h.springs.top.findIndex((x) => Math.abs(x) > h.limit / 2) : -1;
  return (fall > 0 ? fall : most) * h.step_s;
}
function showTime() {
  if (!last) return;
  const h = last.history;
  $("time").value = String(at);
  $("time").setAttribute("aria-valuetext", `${at.toFixed(2)} s`);
  $("now").textContent = `${at.toFixed(2)} s`;
  plotTop(h, at);
  plotGround(h, at);
  drawStructure(h, Math.round(at / h.step_s), last.share_of_overturning ?? 1, last.working.alpha);
}
function showError(message) {
  $("verdict").className = "verdict";
  $("word").textContent = "No answer yet";
  $("sentence").textContent = onPage(message);
  $("asked").textContent = $("stage").textContent = "";
  $("gauge-fill").style.width = "0";
  for (const id of ["tiles", "remarks", "springs", "tuned", "working", "fixed"]) $(id).replaceChildren();
  $("tune-state").textContent = "";
  last = null;
  spectrum = null;
  for (const id of Object.keys(replot)) delete replot[id];
  for (const id of ["width-caption", "scale-caption", "spectrum-caption", "else-progress"]) $(id).textContent = "";
  for (const id of ["plot-top", "plot-ground", "plot-width", "plot-scale", "plot-spectrum"]) canvasOf(id);
  drawStructure(null, 0, 1, 1);
}
async function showTuned({ said, accuracy, forces, design_by_many: many, program, screen, files: names, left_out }, text) {
  $("tune-state").textContent = accuracy?.reached ? "as accurate as asked" : "the accuracy asked for is not reached";
  const rows = (accuracy?.measured ?? []).map((a) => `<tr><th scope="row">${escape(a.on)}</th><td>${a.history === null ? "-" : `${E(100 * a.history, 2)} %`}</td><td>${a.peaks === null ? "-" : `${E(100 * a.peaks, 2)} %`}</td></tr>`);
  $("tuned").innerHTML = `<h3>Their accuracy, measured</h3><div class="scroll" tabindex="0" role="region" aria-label="Accuracy"><table><caption class="hidden">Accuracy of the springs</caption><thead><tr><th scope="col">on</th><th scope="col">history (NRMSE)</th><th scope="col">peaks</th></tr></thead><tbody>${rows.join("")}</tbody></table></div>${forcesOf(forces, many)}<h3>Files <small>as <code>tune run case.toml --no-figures --no-front</code> writes them</small></h3><ul class="files" id="files"></ul>${left_out.map((l) => `<p class="small">${escape(l)}</p>`).join("")}<details><summary>What the program prints</summary><pre tabindex="0">${escape(screen)}</pre></details>`;
  $("fixed").classList.remove("old");
  $("fixed").innerHTML = programOf(program, said.springs_at);
  const entries = [["case.toml", text]];
  for (const [name] of names) entries.push([name, (await whole.call("run_file", name)).answer]);
  const record = state.rec === "pulse" ? PULSE : state.rec === "file" ? state.file : null;
  if (record) entries.push([record, files.get(record)]);
  window.runFiles = entries;
  const save = (name, blob) => { const a = document.createElement("a"); a.href = URL.createObjectURL(blob); a.download = name.split("/").at(-1); a.click(); setTimeout(() => URL.revokeObjectURL(a.href), 5000); };
  const button = (label, className, act) => { const li = document.createElement("li"), b = document.createElement("button"); b.type = "button"; b.textContent = label; b.className = className; b.addEventListener("click", act); li.append(b); $("files")?.append(li); };
  button("Download all (zip)", "main", () => save("tune-out.zip", zip(entries)));
  for (const [name, content] of entries) button(name, "", () => save(name, new Blob([content])));
}
// what the run tries first, until it is there
async function fixedStep(of) {
  if (missing() || !quick) return;
  const show = (html) => { if (of === version && !run) { $("fixed").classList.remove("old"); $("fixed").innerHTML = html; } };
  if (!isRigid()) return show('<p class="small">They come with the run.</p>');
  try {
    show(preliminaryProgram(JSON.parse((await quick.call("fixed_step", caseText())).answer)));
  } catch (error) { if (error.message !== "stopped") show(`<p class="error">${escape(onPage(error.message))}</p>`); }
}

// ---- charts that fill in, a few histories at a time, so that sliders go before
const spread = (low, high, n, log) => Array.from({ length: n }, (_, i) => (log ? low * (high / low) ** (i / (n - 1)) : low + ((high - low) * i) / (n - 1)));
// histories asked for at once: the solver takes sixteen side by side
const LANES = 32;
async function charts(of) {
  while (asking) await new Promise((go) => setTimeout(go, 20));
  const w = last?.working;
  if (!w) return;
  const text = caseText(), stale = () => of !== version;
  const ask = async (items) => JSON.parse((await quick.call("variations", text, JSON.stringify(items))).answer);
  const fill = async (id, xs, item, options, caption) => {
    const rows = [];
    for (let i = 0; i < xs.length; i += LANES) {
      const part = xs.slice(i, i + LANES), answers = await ask(part.map(item));
      if (stale()) return;
      part.forEach((x, k) => rows.push([x * (options.by ?? 1), answers[k]]));
      plotShare(id, rows, options);
      $("else-progress").textContent = `${Math.min(i + LANES, xs.length)} of ${xs.length} histories`;
    }
    replot[id] = () => plotShare(id, rows, options);
    await caption(rows);
  };
  // where the first falls between a number that stands and one that falls, in units of by
  const edge = async (stands, falls, item, by = 1) => {
    const share = Number((await quick.call("first_fall", text, JSON.stringify([item(stands / by), item(falls / by)]))).answer);
    return stands + share * (falls - stands);
  };
  try {
    const len = unitOf(LENGTH), b = w.half_width_m;
    // a lattice of its own, so that what is found of widths does not hang on the one given
    const lattice = steps(0.8 * b, 5 * b, WIDTH_STEP).map((x) => x / (2 * b)), widths = lattice.filter((f) => { const a = Math.atan((f * b) / w.height_m); return a > 0.006 && a < 0.88; });
    // the rigid body's own width: of a portal that of one footing
    const own = value(KINDS[state.kind].width) * len.by;
    const wide = (f) => ({ alpha: Math.atan((f * b) / w.height_m), radius_m: Math.hypot(f * b, w.height_m) });
    await fill("plot-width", widths, wide, { own, by: own, xName: `width, ${len.unit}; dashed: as given`, range: [widths[0] * own, widths.at(-1) * own] }, async (rows) => {
      const falls = rows.findLastIndex(([, s]) => s === null);
      const least = falls < 0 || falls === rows.length - 1 ? null : await edge(rows[falls + 1][0], rows[falls][0], wide, own);
      if (!stale()) $("width-caption").textContent = chartsOf(widthCaption(rows, least, len.unit));
    });
    if (stale()) return;
    const range = [0.05, Math.max(3, 2 * state.scale)], scales = steps(...range, SCALE_STEP);
    await fill("plot-scale", scales, (scale) => ({ scale }), { own: state.scale, xName: "scale of the record, times; dashed: as given", range: [0, range[1]] }, async (rows) => {
      const first = rows.findIndex(([, s]) => s === null);
      const weakest = first < 0 ? null : first === 0 ? rows[0][0] : await edge(rows[first - 1][0], rows[first][0], (scale) => ({ scale }));
      if (!stale()) $("scale-caption").textContent = chartsOf(scaleCaption(rows, weakest));
    });
    if (stale()) return;
    const sizes = spread(Math.max(0.05, w.radius_m / 12), w.radius_m * 12, 48, true), alphas = spread(0.03, Math.min(0.85, Math.max(0.5, 1.5 * w.alpha)), 28);
    spectrum = { sizes, alphas, rows: [], own: { radius: w.radius_m, alpha: w.alpha } };
    replot["plot-spectrum"] = () => plotSpectrum(spectrum);
    for (let j = 0; j < alphas.length; j++) {
      const row = await ask(sizes.map((radius_m) => ({ alpha: alphas[j], radius_m })));
      if (stale()) return;
      spectrum.rows[j] = row;
      plotSpectrum(spectrum);
      $("else-progress").textContent = `${(j + 1) * sizes.length} of ${alphas.length * sizes.length} histories`;
    }
    $("spectrum-caption").textContent = `The ring: ${isRigid() ? "this structure" : "the rigid body of this structure"}, R = ${withUnit(w.radius_m, LENGTH, 3)}, ${digits((w.alpha * 180) / Math.PI, 3)} degrees. Larger bodies of the same slenderness are harder to overturn.`;
    $("else-progress").textContent = "";
  } catch (error) { if (error.message !== "stopped") $("else-progress").textContent = error.message; }
}
const replot = {};
