// SPDX-License-Identifier: Apache-2.0
// A picture of a page for docs/: node screenshot.mjs CHROMIUM PAGE_FOLDER WIDTHxHEIGHT FILE.jpg
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [program, folder, size, file] = process.argv.slice(2);
const [width, height] = size.split("x").map(Number);
const browser = await chromium.launch({ executablePath: program });
const page = await browser.newPage({ viewport: { width, height }, colorScheme: "light" });
await page.goto(pathToFileURL(join(resolve(folder), "index.html")).href);
await page.waitForSelector("html[data-ready]");
await page.selectOption("#right", "error");
await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
await page.screenshot({ path: file, fullPage: true, type: "jpeg", quality: 80 });
await browser.close();
