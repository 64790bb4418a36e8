// SPDX-License-Identifier: Apache-2.0
// A picture of a page for docs/: node screenshot.mjs CHROMIUM PAGE_FOLDER WIDTHxHEIGHT FILE.jpg [HEADING]
// With a heading: what is to be seen from there on, at that size. Else all of the page.
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [program, folder, size, file, heading] = process.argv.slice(2);
const [width, height] = size.split("x").map(Number);
const browser = await chromium.launch({ executablePath: program });
const page = await browser.newPage({ viewport: { width, height }, colorScheme: "light" });
await page.goto(pathToFileURL(join(resolve(folder), "index.html")).href);
await page.waitForSelector("html[data-ready]");
await page.selectOption("#right", "error");
await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const top = heading ? await page.getByRole("heading", { name: heading, exact: true }).evaluate((found) => found.getBoundingClientRect().top) : 0;
const clip = heading ? { x: 0, y: top - 16, width, height } : undefined;
await page.screenshot({ path: file, fullPage: true, type: "jpeg", quality: 80, clip });
await browser.close();
