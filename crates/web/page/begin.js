// Events, and the beginning.
for (const radio of document.querySelectorAll("[name=kind]")) radio.addEventListener("change", () => { state.kind = radio.value; state.values = {}; movedTime = false; buildForm(); changedAll(); });
for (const radio of document.querySelectorAll("[name=rec]")) radio.addEventListener("change", () => { state.rec = radio.value; movedTime = false; buildForm(); changedAll(); askRecord(); });
for (const radio of document.querySelectorAll("[name=units]")) radio.addEventListener("change", () => { state.u = radio.value; buildForm(); changed(); });
$("form").addEventListener("submit", (e) => e.preventDefault());
$("program-name").addEventListener("change", () => { state.prog = $("program-name").value; state.integ = ""; programForm(); changed(); });
$("integrator").addEventListener("change", () => { state.integ = $("integrator").value; changed(); });
$("step").addEventListener("input", stepTyped);
$("step").addEventListener("blur", () => showStep(true));
$("magnify").addEventListener("change", showTime);
$("time").addEventListener("input", () => { movedTime = true; at = Number($("time").value); showTime(); });
for (const id of ["plot-top", "plot-ground"]) {
  const go = (e) => {
    if (!last || (e.type === "pointermove" && !e.buttons)) return;
    const box = $(id).getBoundingClientRect(), end = Number($("time").max);
    movedTime = true;
    at = Math.max(0, Math.min(end, ((e.clientX - box.left - 52) / (box.width - 64)) * end));
    showTime();
  };
  $(id).addEventListener("pointerdown", go);
  $(id).addEventListener("pointermove", go);
}
$("play").addEventListener("click", () => {
  const on = !playing;
  $("play").textContent = on ? "Pause" : "Play";
  $("play").setAttribute("aria-pressed", String(on));
  if (!on) { cancelAnimationFrame(playing); playing = 0; return; }
  movedTime = true;
  let before = performance.now();
  const frame = (now) => {
    at += (now - before) / 1000;
    before = now;
    if (at > Number($("time").max)) at = 0;
    showTime();
    playing = requestAnimationFrame(frame);
  };
  playing = requestAnimationFrame(frame);
});

// ---- files, chosen or dropped anywhere
let taken;
async function take(file) {
  const name = file.name.replace(/[\u0000-\u001f\u007f]/g, "_");
  taken = file;
  $("drop").firstElementChild.textContent = name;
  const bytes = new Uint8Array(await file.arrayBuffer());
  if (taken !== file) return;
  files.set(name, bytes);
  // not awaited: workers take calls in order, and a run that is on ends with what has changed
  quick?.call("give_file", name, bytes).catch(() => {});
  Object.assign(state, { rec: "file", file: name, comp: "", vert: false, dt: "", units: "" });
  movedTime = false;
  $("record-line").textContent = "";
  $("file-error").hidden = true;
  buildForm();
  changedAll();
  askRecord();
}
$("file").addEventListener("change", () => { const [file] = $("file").files; if (file) take(file); $("file").value = ""; });
addEventListener("dragover", (e) => { e.preventDefault(); $("over").hidden = false; });
addEventListener("dragleave", (e) => { if (!e.relatedTarget) $("over").hidden = true; });
addEventListener("drop", (e) => { e.preventDefault(); $("over").hidden = true; const [file] = e.dataTransfer.files; if (file) take(file); });

// what of a link was not taken stands there until something is changed
function takeLink() {
  const told = fromHash(location.hash);
  $("link-note").textContent = told;
  $("link-note").hidden = told === "";
}
for (const happens of ["input", "change"]) $("form").addEventListener(happens, () => ($("link-note").hidden = true));
addEventListener("popstate", () => { takeLink(); restHash = toHash(); movedTime = false; buildForm(); changedAll(); askRecord(); });
const again = () => { if (last) showTime(); for (const plot of Object.values(replot)) plot(); };
addEventListener("resize", again);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
addEventListener("beforeprint", () => ($("working-details").open = true));

takeLink();
restHash = toHash();
history.replaceState({ rest: restHash }, "", restHash);
buildForm();
drawStructure(null, 0, 1, 1);
compiled().then(async (made) => {
  module = made;
  quick = new Computer(module);
  $("version").textContent = (await quick.ready).answer;
  window.measures.ready = performance.now();
  changed();
  askRecord();
}).catch((error) => showError(`This browser cannot run the page (${error.message}); take one of 2023 or later.`));
