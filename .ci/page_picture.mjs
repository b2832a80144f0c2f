// figures/page.png: the committed page in headless Chromium, as it opens.
//   node page_picture.mjs REPOSITORY CHROMIUM
import { chromium } from "playwright-core";
import path from "node:path";

const [, , root, executablePath] = process.argv;
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const context = await browser.newContext({ viewport: { width: 1280, height: 1100 }, colorScheme: "light" });
const page = await context.newPage();
await page.goto(`file://${path.join(root, "docs/groundspring.html")}#kind=aframe`);
await page.waitForFunction(() => window.runFiles, null, { timeout: 240000 });
await page.waitForTimeout(1500);
await page.screenshot({ path: path.join(root, "figures/page.png") });
await browser.close();
