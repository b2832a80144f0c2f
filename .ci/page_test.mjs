// The committed page in a browser: no request, times, memory, files dropped, accessibility, widths of screens, and
// the same bytes as the program's.
//   node page_test.mjs REPOSITORY TUNE CHROMIUM
import { chromium } from "playwright-core";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

const [, , root, tune, executablePath] = process.argv;
const pageFile = path.join(root, "docs/groundspring.html");
const url = `file://${pageFile}`;
const axe = fs.readFileSync(new URL("node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const problems = [];
const check = (good, what) => { console.log(`${good ? "good" : "BAD "} ${what}`); if (!good) problems.push(what); };
const median = (all) => [...all].sort((a, b) => a - b)[Math.floor(all.length / 2)];
const quantile = (all, q) => [...all].sort((a, b) => a - b)[Math.min(all.length - 1, Math.floor(all.length * q))];

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const open = async (hash = "", { width = 1440, dark = false } = {}) => {
  const context = await browser.newContext({ viewport: { width, height: 900 }, colorScheme: dark ? "dark" : "light" });
  const page = await context.newPage();
  page.requests = []; page.errors = [];
  page.on("request", (r) => { if (!/^(blob|data):/.test(r.url()) && !r.url().startsWith(url)) page.requests.push(r.url()); });
  page.on("pageerror", (e) => page.errors.push(e.message));
  page.on("console", (m) => { if (m.type() === "error") page.errors.push(m.text()); });
  await page.goto(url + hash);
  return page;
};
const drawn = (page) => page.waitForFunction(() => window.measures?.moves.some((m) => m.length > 2), null, { timeout: 60000 });
const tuned = (page, timeout = 600000) => page.waitForFunction(() => window.runFiles, null, { timeout });

// ---- size, first history, moves of a slider, the whole run, memory: medians of five on a
// quiet machine, which alone judges times (TIMES=1)
const quiet = process.env.TIMES === "1";
check(fs.statSync(pageFile).size <= 1_500_000, `size: ${fs.statSync(pageFile).size} bytes of 1 500 000 at most`);
const firsts = [], paints = [], tunes = [], memories = [];
for (let i = 0; i < (quiet ? 5 : 2); i++) {
  const page = await open("#kind=aframe");
  await drawn(page);
  firsts.push(await page.evaluate(() => window.measures.ready + window.measures.moves[0][2]));
  await tuned(page);
  await page.waitForTimeout(300);
  tunes.push(await page.evaluate(() => window.measures.tune));
  if (i === 0) {
    await page.evaluate(() => { window.measures.moves.length = 0; });
    for (let k = 0; k < 60; k++) {
      const before = await page.evaluate(() => window.measures.moves.filter((m) => m.length > 2).length);
      await page.evaluate((x) => { const s = document.getElementById("s-w"); s.value = String(x); s.dispatchEvent(new Event("input", { bubbles: true })); }, 0.6 + 0.002 * k);
      await page.waitForFunction((n) => window.measures.moves.filter((m) => m.length > 2).length > n, before);
    }
    paints.push(...(await page.evaluate(() => window.measures.moves.map((m) => m[2]))));
  }
  memories.push(...(await page.evaluate(() => window.measures.memory())));
  check(page.requests.length === 0, `no request to a network (${page.requests.join(" ") || "none"})`);
  check(page.errors.length === 0, `no error (${page.errors.join("; ") || "none"})`);
  await page.context().close();
}
const timed = (good, what) => (quiet ? check(good, what) : console.log(`time ${what}`));
timed(median(firsts) < 1000, `first history drawn after ${median(firsts).toFixed(0)} ms (below 1000)`);
timed(quantile(paints, 0.9) <= 60, `slider to paint: median ${median(paints).toFixed(0)} ms, 90 % within ${quantile(paints, 0.9).toFixed(0)} ms (60)`);
timed(median(tunes) <= 2000, `the whole run: ${median(tunes).toFixed(0)} ms (2000)`);
check(Math.max(...memories) <= 32 * 2 ** 20, `memory of one worker: ${(Math.max(...memories) / 2 ** 20).toFixed(1)} MiB (32)`);

// ---- a file is dropped, as a person does it
const drop = async (page, name, bytes) => {
  const data = await page.evaluateHandle(({ name, text }) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
    return transfer;
  }, { name, text: bytes.toString("base64") });
  for (const event of ["dragenter", "dragover", "drop"]) await page.dispatchEvent("#drop, body >> nth=0", event, { dataTransfer: data });
};
const records = path.join(root, "tests/records");
{
  const page = await open();
  await drawn(page);
  for (const name of fs.readdirSync(records).filter((n) => !n.endsWith(".md"))) {
    await page.evaluate(() => { document.getElementById("record-line").textContent = ""; });
    await drop(page, name, fs.readFileSync(path.join(records, name)));
    await page.waitForFunction((name) => document.getElementById("record-line").textContent.includes(name), name, { timeout: 30000 }).catch(() => {});
    const line = await page.textContent("#record-line");
    check(line.includes(name.replace(/\.[^.]*$/, "")), `dropped ${name}: ${line.slice(0, 90)}`);
  }
  const dir = fs.mkdtempSync(path.join(os.tmpdir(), "page-"));
  const whole = fs.readFileSync(path.join(records, "20180212_211557_WPWS_20.V2A"), "latin1").split("\n");
  const at2 = fs.readFileSync(path.join(root, "tuning/records/IELC180.AT2"), "latin1").split("\n");
  // a small file of a format without its last lines
  const cut = (name, lines) => fs.readFileSync(path.join(root, "fuzz/corpus/record", name), "latin1").trimEnd().split("\n").slice(0, -lines).join("\n");
  const broken = {
    "cut.V2A": whole.slice(0, 40).join("\n"),
    "letters.AT2": at2.map((l, i) => (i === 20 ? "  not numbers at all" : l)).join("\n"),
    "header.AT2": at2.slice(4).join("\n"),
    "empty.txt": "",
    "units.txt": "0.1\n0.2\n-0.1\n",
    "nan.csv": "t,a (g)\n0,0.1\n0.01,nan\n0.02,0.1\n",
    "cosmos.v2c": cut("cosmos_v2c", 2),
    "csmip.v2": cut("csmip_v2", 10),
    "knet.EW": cut("knet", 1),
    "esm.asc": cut("esm", 1),
    "picture.png": "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0",
  };
  for (const [name, text] of Object.entries(broken)) {
    const bytes = Buffer.from(text, "latin1");
    fs.writeFileSync(path.join(dir, name), bytes);
    let line = "";
    try { execFileSync(tune, ["record", name], { cwd: dir, stdio: "pipe" }); } catch (e) { line = e.stderr.toString().trim().replace(/^error: /, ""); }
    await page.evaluate(() => { document.getElementById("file-error").textContent = ""; });
    await drop(page, name, bytes);
    // of this file: a slow machine may still say what it said of the last one
    await page.waitForFunction((name) => document.getElementById("file-error").textContent.startsWith(name), name, { timeout: 30000 }).catch(() => {});
    const shown = await page.textContent("#file-error");
    // where the program advises by its options, the page does by its controls
    const option = line.indexOf(" --"), end = line.lastIndexOf("; ", option);
    const same = option < 0 ? shown === line : end > 0 && shown.startsWith(line.slice(0, end)) && (!shown.includes(" --") || shown.includes("with the program tune"));
    check(shown !== "" && same, `malformed ${name}: ${shown}${same ? "" : ` | the program: ${line}`}`);
  }
  await page.context().close();
  fs.rmSync(dir, { recursive: true });
}

// ---- the same bytes as `tune run --no-figures --no-front`; springs for a program as options ask for them
const stepped = "#kind=aframe&h=28&w=6&m=1834862&prog=opensees-even&step=0.005&integ=trbdf2";
const asked = ["--for", "opensees-even", "--step", "0.005", "--integrator", "trbdf2"];
const kaikoura = "20161113_110259_WTMC_20.V2A";
const cases = ["#kind=aframe", "#kind=block&h=1.9&w=0.5&m=250", "#kind=aframe&h=12&w=2.4&m=350000&scale=1.5", "#kind=block&h=2.6&w=0.7&m=1000&rec=pulse&amp=0.5&per=1.1", `#kind=block&h=4&w=1.2&m=3000&rec=file&file=${kaikoura}&vert=1`, "#kind=pier", "#kind=frame", stepped];
const chosen = process.env.CASES ? cases.slice(0, Number(process.env.CASES)) : cases;
for (const hash of chosen) {
  const page = await open(hash);
  if (hash.includes("rec=file")) { await page.waitForTimeout(500); await page.setInputFiles("#file", path.join(records, kaikoura)); if (hash.includes("vert=1")) { await page.waitForSelector("#file-options input[type=checkbox]"); await page.check("#file-options input[type=checkbox]"); } }
  await tuned(page);
  await page.waitForTimeout(200);
  const files = await page.evaluate(() => window.runFiles.map(([name, content]) => [name, typeof content === "string" ? content : new TextDecoder("latin1").decode(content)]));
  const dir = fs.mkdtempSync(path.join(os.tmpdir(), "page-"));
  for (const [name, content] of files) if (!name.includes("/") && (name === "case.toml" || name === "pulse.txt" || name === kaikoura)) fs.writeFileSync(path.join(dir, name), name === kaikoura ? fs.readFileSync(path.join(records, kaikoura)) : content);
  execFileSync(tune, ["run", "case.toml", "--quiet", "--no-figures", ...(/pier|frame&|kind=frame/.test(hash) && !/aframe/.test(hash) ? [] : ["--no-front"])], { cwd: dir, stdio: "pipe" });
  const inputs = ["case.toml", "pulse.txt", kaikoura];
  if (hash === stepped) {
    const plain = fs.readFileSync(path.join(dir, "case.toml"), "utf8").replace(/\[program\][^[]*/, "");
    fs.writeFileSync(path.join(dir, "plain.toml"), plain);
    execFileSync(tune, ["run", "plain.toml", ...asked, "--quiet", "--no-figures", "--no-front", "--out", "asked"], { cwd: dir, stdio: "pipe" });
    const [own, other] = ["out", "asked"].map((out) => fs.readFileSync(path.join(dir, out, "parameters.json"), "utf8"));
    check(own === other, `${hash}: case.toml asks what the options ${asked.join(" ")} do`);
    const program = JSON.parse(other).program, cells = await page.$$eval("#fixed table:first-of-type tbody td", (all) => all.map((td) => td.textContent));
    check(Math.abs(Number(cells[0]) / program.vertical.k1_n_per_m - 1) < 1e-3, `${hash}: k1 for the program is ${cells[0]}, the run's ${program.vertical.k1_n_per_m}`);
    const errors = await page.textContent("#program-errors");
    check(errors.includes("earthquake-like motions"), `${hash}: ${errors}`);
  }
  const different = files.filter(([name]) => !inputs.includes(name)).filter(([name, content]) => !fs.existsSync(path.join(dir, "out", name)) || fs.readFileSync(path.join(dir, "out", name), "utf8") !== content).map(([name]) => name);
  check(different.length === 0, `${hash}: ${files.length - 1} files, ${different.length ? `different: ${different.join(", ")}` : "the same bytes as the program's"}`);
  if (different.length && process.env.KEEP) { for (const [name, content] of files) { const to = path.join(dir, "page", name); fs.mkdirSync(path.dirname(to), { recursive: true }); fs.writeFileSync(to, content); } console.log(`     kept in ${dir}`); } else fs.rmSync(dir, { recursive: true });
  await page.context().close();
}

// ---- accessibility and width of every screen
for (const width of [1440, 1024, 390]) {
  for (const dark of [false, true]) {
    const page = await open("#kind=aframe", { width, dark });
    await tuned(page);
    await page.waitForTimeout(1500);
    await page.evaluate(() => { document.getElementById("working-details").open = true; });
    check((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, `${width} px: nothing is wider than the screen`);
    // by the browser's tools, since the page allows no other script
    const cdp = await page.context().newCDPSession(page);
    await cdp.send("Page.setBypassCSP", { enabled: true }).catch(() => {});
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run());
    check(violations.length === 0, `${width} px, ${dark ? "dark" : "light"}: axe finds ${violations.length} violations ${violations.map((v) => `${v.id} (${v.nodes.map((n) => n.target).slice(0, 3).join("; ")})`).join(", ")}`);
    if (process.env.SHOTS) await page.screenshot({ path: path.join(process.env.SHOTS, `page-${width}-${dark ? "dark" : "light"}.png`), fullPage: true });
    await page.context().close();
  }
}
// ---- a record chosen while a run is on: its name at once, the run ends; messages in the page's own fields
{
  const page = await open("#kind=frame&rec=file");
  const choose = (name, text) => page.setInputFiles("#file", { name, mimeType: "text/plain", buffer: Buffer.from(text) });
  const wave = (step, most = 0.3) => `time (s),a (g)\n${Array.from({ length: 1500 }, (_, i) => `${(step * i).toFixed(4)},${(most * Math.sin(0.05 * i)).toFixed(5)}`).join("\n")}\n`;
  await page.waitForFunction(() => window.measures.ready);
  await choose("first.csv", wave(0.02));
  await page.waitForFunction(() => document.getElementById("tune-state").textContent.startsWith("searching"), null, { timeout: 60000 });
  await page.waitForTimeout(1500);
  await choose("second.csv", wave(0.02, 0.2));
  const at = Date.now();
  await page.waitForFunction(() => ["drop", "asked", "record-line"].every((id) => document.getElementById(id).textContent.includes("second")), null, { timeout: 20000 }).catch(() => {});
  check(Date.now() - at < 5000, `a record chosen while a run is on is named after ${Date.now() - at} ms (5000)`);
  const told = async (name, text, wanted) => {
    await choose(name, text);
    await page.waitForFunction((name) => document.getElementById("file-error").textContent.startsWith(name), name, { timeout: 20000 }).catch(() => {});
    const said = await page.textContent("#file-error");
    check(said.includes(wanted) && !said.includes("--") && !said.includes("not on this page"), `${name}: ${said}`);
  };
  await told("uneven.csv", "t,a (g)\n0,0.1\n0.01,0.2\n0.025,-0.1\n", 'give it under "time step"');
  await told("huge.csv", wave(0.01, 900), 'under "unit of the numbers"');
  await page.selectOption("#file-options select", "mm/s2");
  await page.waitForFunction(() => document.getElementById("file-error").textContent.includes("its unit is"), null, { timeout: 20000 }).catch(() => {});
  const unit = await page.textContent("#file-error");
  check(unit.includes('choose "as the file says"') && !unit.includes("--"), `another unit than the file's: ${unit}`);
  await page.context().close();
}
// ---- numbers: a decimal comma is a point, groups of thousands are refused, what is refused is said for a while
{
  const page = await open();
  await drawn(page);
  const type = async (text) => { await page.fill("#n-h", ""); await page.locator("#n-h").pressSequentially(text); };
  const height = () => page.evaluate(() => value("h"));
  await type("1,7");
  check((await height()) === 1.7, `1,7 is ${await height()}`);
  for (const text of ["1,234.5", "1.234,5", "1,234", "1 234", "1..7", "99", ""]) {
    await page.fill("#n-h", "1.5");
    await page.fill("#n-h", text);
    const shown = await page.inputValue("#n-h"), note = page.locator("#structure .error").first();
    const [says, held] = [await note.textContent(), await height()];
    await page.locator("#n-w").focus();
    check(shown === text && held === 1.5 && (await note.isVisible()) && says.includes("the answer is for 1.5 m"), `"${text}" is refused: ${says}`);
    check((await page.inputValue("#n-h")) === "1.5", "the field shows what is computed, once it is left");
  }
  await page.fill("#step", "0,002");
  check((await page.evaluate(() => state.step)) === 0.002, "a step of 0,002 s is one of 0.002 s");
  await page.context().close();
}
// ---- what the page says is of one and the same history
{
  const page = await open();
  await tuned(page);
  const [word, share] = await page.evaluate(() => [document.getElementById("word").textContent, last.share_of_overturning]);
  check(share < 0.1 && !word.includes("by chance"), `at ${(100 * share).toFixed(1)} % of overturning: ${word}`);
  await page.context().close();
}
{
  const page = await open("#kind=block&h=2.286&w=0.6096&m=952.5");
  await tuned(page);
  const [eq, tile] = await page.evaluate(() => [document.getElementById("working").textContent, last.peaks.springs.uplift_m]);
  const [, angle, lifted] = eq.match(/on springs, as above:2 b sin \u03b8 = 0\.6096 · sin ([\d.]+) = ([\d.]+) m/) ?? [];
  const [, largest] = eq.match(/largest found on springs: .*? = ([\d.]+) rad/) ?? [];
  check(Math.abs(lifted / tile - 1) < 1e-3 && Math.abs(angle / largest - 1) < 1e-3, `the working: ${largest} rad, ${angle} rad, ${lifted} m; the tile ${tile} m`);
  await page.context().close();
}
{
  const page = await open("#kind=aframe&u=ft");
  await tuned(page);
  const springs = await page.textContent("#springs"), forces = await page.textContent("#tuned");
  check(springs.includes("In SI units") && forces.includes("In SI units"), "feet: springs and forces say that they are in SI units");
  await page.context().close();
}
// ---- on a telephone tables fit
for (const hash of ["#kind=aframe", "#kind=pier"]) {
  const page = await open(hash, { width: 390 });
  await tuned(page);
  const wide = await page.$$eval(".scroll", (all) => all.filter((box) => box.scrollWidth > box.clientWidth + 1).map((box) => `${box.ariaLabel} ${box.scrollWidth} of ${box.clientWidth}`));
  check(wide.length === 0, `${hash}: tables fit 390 px${wide.length ? `: ${wide.join(", ")}` : ""}`);
  if (process.env.SHOTS) await page.screenshot({ path: path.join(process.env.SHOTS, `page-390-${hash.slice(6)}.png`), fullPage: true });
  await page.context().close();
}
// ---- the browser's own back undoes; a link is a case
{
  const page = await open("#kind=block&h=1.9&w=0.5");
  await tuned(page);
  await page.fill("#n-w", "0.8");
  await page.waitForTimeout(900);
  const there = await page.evaluate(() => location.hash);
  await page.goBack();
  await page.waitForFunction(() => document.getElementById("n-w").value === "0.5", null, { timeout: 5000 }).catch(() => {});
  check(there.includes("w=0.8") && (await page.inputValue("#n-w")) === "0.5", "back undoes the last change");
  await page.context().close();
}
await browser.close();
if (problems.length) { console.error(`${problems.length} problems:\n${problems.join("\n")}`); process.exit(1); }
