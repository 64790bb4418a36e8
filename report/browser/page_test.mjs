// SPDX-License-Identifier: Apache-2.0
// The page of `luciole report` in a real browser, from file://, in light and dark, wide and as narrow as a phone.
//   node page_test.mjs CHROMIUM LUCIOLE SCRATCH_FOLDER
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, rmSync, unlinkSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [browser_program, luciole, scratch] = process.argv.slice(2).map((name) => resolve(name));
const kWide = { width: 1280, height: 900 }, kPhone = { width: 360, height: 740 };

const kNames = ["noisy.exr", '<b>"&.exr'];  // the second is no HTML

function report(pictures, exposure, folder) {
  const files = pictures.map((name) => join(scratch, name));
  execFileSync(luciole, ["report", "--compare", ...files, "--reference", join(scratch, "truth.exr"), "--exposure", exposure,
    "-o", join(scratch, folder)]);
}

function make_pages() {
  rmSync(scratch, { recursive: true, force: true });
  mkdirSync(scratch, { recursive: true });
  const render = (name, settings) =>
    execFileSync(luciole, ["render", "recipe:cornell", "--size", "64x36", "--vpls", "256", "--filter", "none", ...settings,
      "-o", join(scratch, name)]);
  kNames.forEach((name, i) => render(name, ["--seed", i + 1]));
  render("truth.exr", ["--culling", "none", "--ranges", "infinite", "--interleave", "1"]);
  report(kNames, 3, "page");
  report(kNames.slice(0, 1), 12, "brighter");
  make_site();
}

// What ./do reproduce ends with: two groups of pictures, a map, a plot, tables and claims; and a figure without pictures.
function make_site() {
  execFileSync(luciole, ["render", "recipe:cornell", "--size", "64x36", "--vpls", "256", "--layers", "lights_listed,lights_false",
    "-o", join(scratch, "lights.exr")]);
  const cell = (ours, paper) => ({ ours, paper, ratio: paper && ours / paper, reason: "" });
  const row = (name) => ({ name, cells: Array.from({ length: 7 }, (_, i) => cell(10 * i + 1, i ? 3 : null)) });
  const group = (title) => ({ title, exposure: 3, reference: { name: "reference", file: "truth.exr" },
    pictures: kNames.map((file) => ({ name: `${title}, ${file}`, file, time: "5 ms a frame" })) });
  const claim = { text: "fewer", held: true, kept: 2, of: 2, low: 1, high: 2, worst: "", at_least: 1, at_most: null, paper: [1.6, 4],
    of_time: false, note: "" };
  const points = [1024, 4096, 65536].map((n) => [n, n ** 0.5]);
  const figure = {
    name: "th17-fig0", paper: "TH17", paper_title: "A paper", figure: "Figure 0", title: "A title", says: "so.", stands_in: ["a room"],
    differs: [], missing: ["a scene"], quick: true, commands: ["luciole render a-very-long-name".repeat(9)], machine: { threads: 2 },
    tables: [{ title: "Counts", unit: "ms", note: "", row_title: "scene", columns: [..."abcdefg"], has_paper: true, rows: [row("ring")] }],
    plots: [{ title: "Cost", x_title: "lights", y_title: "ms", note: "", series: [{ name: "clamped", points }],
      laws: [{ name: "clamped: law", points }] }],
    claims: [claim, { ...claim, held: false, of_time: true }], comparisons: [group("one"), group("two")],
    maps: [{ title: "spheroid", file: "lights.exr" }],
  };
  const bare = { ...figure, name: "th17-table0", plots: [], comparisons: [], maps: [] };
  const files = [figure, bare].map((content) => {
    mkdirSync(join(scratch, content.name));
    for (const file of [...kNames, "truth.exr", "lights.exr"]) cpSync(join(scratch, file), join(scratch, content.name, file));
    const file = join(scratch, content.name, "figure.json");
    writeFileSync(file, JSON.stringify(content));
    return file;
  });
  execFileSync(luciole, ["report", "--figures", ...files, "-o", join(scratch, "site")]);
}

const browser = await chromium.launch({ executablePath: browser_program });

// Whatever a reader could find missing or broken.
async function open_page(folder, viewport, scheme) {
  const page = await browser.newPage({ viewport, colorScheme: scheme });
  const faults = [];
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && faults.push(`console: ${message.text()}`));
  page.on("pageerror", (error) => faults.push(`script: ${error.message}`));
  page.on("requestfailed", (request) => faults.push(`missing: ${request.url()}`));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || faults.push(`network: ${request.url()}`));
  await page.goto(pathToFileURL(join(folder, "index.html")).href, { waitUntil: "load" });
  if (await page.$(".stage")) {
    await page.waitForSelector("html[data-ready]");
    if (!(await page.$("html[data-ready=true]"))) faults.push("the pixels did not arrive");
  }
  const broken = await page.$$eval("img", (images) => images.filter((image) => !image.naturalWidth).map((image) => image.src));
  faults.push(...broken.map((name) => `not shown: ${name}`));
  const { wide, room } = await page.evaluate(() => ({ wide: document.documentElement.scrollWidth, room: innerWidth }));
  if (wide > room) faults.push(`${wide} pixels wide in ${room}`);
  return { page, faults };
}

// Two frames: the first carries out what was asked for, the second follows it.
const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

const visible_layers = (page) =>
  page.$$eval(".stage", (stages) =>
    stages.map((stage) =>
      [...stage.querySelectorAll(".layer")].filter((layer) => getComputedStyle(layer).visibility === "visible")
        .map((layer) => layer.dataset.layer).join("+")));

const computed = (page, selector, property) =>
  page.$$eval(selector, (elements, name) => elements.map((element) => getComputedStyle(element)[name]), property);

// Every ninth pixel's codes of what the function finds or loads in the page. It is copied first: a browser moves a canvas
// that is read often to other memory, and warns.
const codes_of = (page, find, what) =>
  page.evaluate(`(async () => {
    const picture = await (${find})(${JSON.stringify(what)});
    const copy = Object.assign(document.createElement("canvas"), { width: picture.width, height: picture.height });
    const context = copy.getContext("2d", { willReadFrequently: true });
    context.drawImage(picture, 0, 0);
    return [...context.getImageData(0, 0, copy.width, copy.height).data].filter((_, i) => i % 36 < 3);
  })()`);

const canvas_codes = (page, layer) =>
  codes_of(page, (name) => document.querySelector(`.layer[data-layer=${name}] canvas`), layer);

// Of a PNG, as a data: URL, for a script may not read the pixels of files.
const png_codes = (page, file) =>
  codes_of(page, (url) => {
    const image = Object.assign(new Image(), { src: url });
    return image.decode().then(() => image);
  }, `data:image/png;base64,${readFileSync(file).toString("base64")}`);

const largest_difference = (a, b) => Math.max(...a.map((code, i) => Math.abs(code - b[i])));

async function set_range(page, id, value) {
  await page.$eval(id, (range, to) => { range.value = to; range.dispatchEvent(new Event("input", { bubbles: true })); }, value);
  await settled(page);
}

const tests = {
  async nothing_is_missing_wide_or_narrow_in_light_and_dark() {
    const papers = new Set();
    for (const viewport of [kWide, kPhone]) {
      for (const scheme of ["light", "dark"]) {
        const { page, faults } = await open_page(join(scratch, "page"), viewport, scheme);
        assert.deepEqual(faults, []);
        papers.add((await computed(page, "body", "backgroundColor"))[0]);
        await page.close();
      }
    }
    assert.equal(papers.size, 2, "light and dark have one background");
  },

  // Without this the test above could be blind.
  async a_missing_file_and_an_error_are_seen() {
    for (const file of ["picture-1.js", "picture-2-error.png", "reference.png"]) {
      const copy = join(scratch, "sabotaged");
      cpSync(join(scratch, "page"), copy, { recursive: true });
      unlinkSync(join(copy, file));
      const { page, faults } = await open_page(copy, kWide, "light");
      assert.ok(faults.some((fault) => fault.includes(file)), `${file}: ${faults}`);
      await page.close();
      rmSync(copy, { recursive: true });
    }
    const copy = join(scratch, "sabotaged");
    cpSync(join(scratch, "page"), copy, { recursive: true });
    const text = readFileSync(join(copy, "index.html"), "utf8");
    writeFileSync(join(copy, "index.html"), text.replace("</body>", "<script>no_such_function()</script></body>"));
    const { page, faults } = await open_page(copy, kWide, "light");
    assert.ok(faults.some((fault) => fault.includes("no_such_function")), `${faults}`);
    await page.close();
  },

  async the_site_of_figures_is_whole_wide_or_narrow_in_light_and_dark() {
    for (const folder of ["site", "site/th17-fig0", "site/th17-table0"]) {
      for (const [viewport, scheme] of [[kWide, "light"], [kPhone, "dark"]]) {
        const { page, faults } = await open_page(join(scratch, folder), viewport, scheme);
        assert.deepEqual(faults, [], folder);
        await page.close();
      }
    }
    const { page } = await open_page(join(scratch, "site"), kWide, "light");
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    await page.waitForSelector("html[data-ready=true]");
    assert.match(page.url(), /th17-fig0\/index\.html$/);
    await page.close();
    const copy = join(scratch, "site/sabotaged");
    cpSync(join(scratch, "site/th17-fig0"), copy, { recursive: true });
    unlinkSync(join(copy, "map-1.png"));
    const { page: broken, faults } = await open_page(copy, kWide, "light");
    assert.ok(faults.some((fault) => fault.includes("map-1.png")), `${faults}`);
    await broken.close();
  },

  async the_pictures_of_all_groups_of_a_figure_are_in_step() {
    const { page, faults } = await open_page(join(scratch, "site/th17-fig0"), kWide, "light");
    assert.deepEqual(await visible_layers(page), Array(4).fill("picture+reference"));
    await page.focus(".split");
    for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
    await page.focus(".stage");
    await page.keyboard.press("Digit3");
    await settled(page);
    assert.deepEqual(await computed(page, ".layer.on-right", "clipPath"), Array(4).fill("inset(0px 0px 0px 60%)"));
    assert.deepEqual(await visible_layers(page), Array(4).fill("reference+error"));
    assert.deepEqual(faults, []);
    await page.close();
  },

  async without_scripts_all_pictures_are_shown() {
    const context = await browser.newContext({ javaScriptEnabled: false, viewport: kPhone });
    const page = await context.newPage();
    await page.goto(pathToFileURL(join(scratch, "page/index.html")).href, { waitUntil: "load" });
    assert.equal(await page.locator("img:visible").count(), 8);
    assert.equal(await page.locator(".controls:visible").count(), 0);
    await context.close();
  },

  async the_border_moves_by_keyboard_in_all_pictures() {
    const { page, faults } = await open_page(join(scratch, "page"), kWide, "light");
    assert.deepEqual(await visible_layers(page), ["picture+reference", "picture+reference"]);
    await page.focus(".split");
    for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
    await settled(page);
    const clips = await computed(page, ".layer.on-right", "clipPath");
    assert.deepEqual(clips, Array(2).fill("inset(0px 0px 0px 60%)"));
    assert.deepEqual(await page.$$eval(".split", (ranges) => ranges.map((range) => range.value)), ["60", "60"]);
    assert.deepEqual(faults, []);
    await page.close();
  },

  async the_border_follows_the_mouse_and_lies_under_its_handle() {
    const { page } = await open_page(join(scratch, "page"), kPhone, "light");
    await page.locator(".stage").first().scrollIntoViewIfNeeded();
    const box = await page.locator(".stage").first().boundingBox();
    const middle = box.y + box.height / 2;
    await page.mouse.move(box.x + box.width / 2, middle);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.2, middle, { steps: 4 });
    await page.mouse.up();
    await settled(page);
    const split = Number(await page.$eval(".split", (range) => range.value));
    assert.ok(Math.abs(split - 20) <= 1, `${split} %`);
    await page.close();
  },

  async keys_choose_layers_and_flip() {
    const { page, faults } = await open_page(join(scratch, "page"), kWide, "light");
    await page.focus(".stage");
    await page.keyboard.press("Digit3");
    await page.keyboard.press("Shift+Digit4");
    await settled(page);
    assert.deepEqual(await visible_layers(page), ["error+flip", "error+flip"]);
    await page.keyboard.press("f");
    await settled(page);
    assert.deepEqual(await visible_layers(page), ["error", "error"]);
    assert.match(await page.textContent("#status"), /Relative error/);
    await page.keyboard.press("f");
    await settled(page);
    assert.deepEqual(await visible_layers(page), ["flip", "flip"]);
    await page.locator(".stage").first().click();
    await settled(page);
    assert.deepEqual(await visible_layers(page), ["error", "error"]);
    assert.deepEqual(faults, []);
    await page.close();
  },

  async zoom_and_place_are_those_of_all_pictures() {
    const { page } = await open_page(join(scratch, "page"), kWide, "light");
    const before = await computed(page, ".layer canvas, .layer img", "transform");
    await page.focus(".stage");
    for (const key of ["+", "+", "ArrowRight", "ArrowDown"]) await page.keyboard.press(key);
    await settled(page);
    const after = await computed(page, ".layer canvas, .layer img", "transform");
    assert.equal(after.length, 8);
    assert.notEqual(after[0], before[0]);
    assert.match(after[0], /^matrix\(2, 0, 0, 2, /);
    // A page grid may give panels widths that differ by less than a pixel.
    const numbers = (text) => text.match(/-?[\d.]+/g).map(Number);
    for (const other of after) assert.ok(largest_difference(numbers(other), numbers(after[0])) < 1, `${other} ${after[0]}`);
    await page.click("#reset");
    await settled(page);
    assert.match((await computed(page, ".layer canvas", "transform"))[0], /^matrix\(1, 0, 0, 1, 0, 0\)$/);
    await page.close();
  },

  // The page's own arithmetic against the program's: half floats and a table of sRGB codes may round the other way.
  async exposure_shows_what_the_program_would_have_written() {
    const { page, faults } = await open_page(join(scratch, "page"), kWide, "light");
    const off_by = async (layer, file) =>
      largest_difference(await canvas_codes(page, layer), await png_codes(page, join(scratch, file)));
    assert.equal(Math.max(await off_by("picture", "page/picture-1.png"), 1), 1);
    assert.equal(Math.max(await off_by("reference", "page/reference.png"), 1), 1);
    await set_range(page, "#exposure", 2);
    assert.equal(Math.max(await off_by("reference", "brighter/reference.png"), 1), 1);
    assert.ok((await off_by("reference", "page/reference.png")) > 20, "all exposures look alike: this proves nothing");
    assert.deepEqual(faults, []);
    await page.close();
  },
};

let failed = 0;
try {
  make_pages();
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test();
      console.log(`passed ${name}`);
    } catch (error) {
      ++failed;
      console.log(`FAILED ${name}\n${error.stack}`);
    }
  }
} finally {
  await browser.close();
}
console.log(`${Object.keys(tests).length - failed} passed, ${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
