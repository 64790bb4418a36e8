// SPDX-License-Identifier: Apache-2.0
// The page's pictures: what is seen left and right, where, how bright. One state serves all panels, so that they are in
// step. The pixels come from scripts beside the page (linear_pixels.h says why); until they are there, and in a browser
// that cannot inflate them, the images at the page's exposure are shown.
"use strict";

// What scripts beside the page call: their names and pixels.
const arrived_pixels = new Map();
function luciole_pixels(stem, base64) {
  arrived_pixels.set(stem, base64);
}

(() => {
  const by_id = (id) => document.getElementById(id);
  const panels = document.querySelector(".panels");
  const stages = [...document.querySelectorAll(".stage")];
  const tone_curve = document.body.dataset.toneCurve;
  const kinds = ["picture", "reference", "error", "flip"];
  const kMaxZoom = 64, kMaxStops = 8;

  // x, y: what lies in the middle of a stage, in widths and heights of the picture. split [%].
  const initial = { left: "picture", right: "reference", view: "slider", shown: "left", stops: 0, zoom: 1, x: 0.5, y: 0.5, split: 50 };
  const state = { ...initial };

  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

  // ---- radiance to screen

  // As linear_pixels_text wrote it.
  async function inflated(base64) {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // Half floats of three planes, exposed: what was written are differences from the left neighbour, low bytes first.
  function half_codes(bytes, width) {
    const count = bytes.length / 2, codes = new Uint16Array(count);
    for (let i = 0; i < count; ++i) {
      const left = i % width === 0 ? 0 : codes[i - 1];
      codes[i] = left + bytes[i] + 256 * bytes[count + i];  // an Uint16Array keeps 16 bits
    }
    return codes;
  }

  // Value of each half float that is finite and not negative.
  const half_values = Float32Array.from({ length: 0x7c00 }, (_, code) => {
    const exponent = code >> 10, mantissa = code & 1023;
    return exponent === 0 ? mantissa * 2 ** -24 : (1024 + mantissa) * 2 ** (exponent - 25);
  });

  // Codes of the sRGB transfer function for 2^14 + 1 values in [0,1]: nowhere a quarter of a code off.
  const kSteps = 16384;
  const srgb_codes = Uint8Array.from({ length: kSteps + 1 }, (_, i) => {
    const linear = i / kSteps;
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055) + 0.5;
  });
  const code = (linear) => srgb_codes[(clamp(linear, 0, 1) * kSteps + 0.5) | 0];

  // Khronos PBR Neutral as image/tone_curve.cpp has it; writes three codes.
  function pbr_neutral(r, g, b, codes, at) {
    const start = 0.8 - 0.04, desaturation = 0.15;
    const darkest = Math.min(r, g, b);
    const offset = darkest <= 0.08 ? darkest - (darkest * darkest) / 0.16 : 0.04;
    r -= offset, g -= offset, b -= offset;
    const peak = Math.max(r, g, b);
    let scale = 1, white = 0;
    if (peak > start) {
      const compressed = 1 - ((1 - start) * (1 - start)) / (peak + 1 - 2 * start);
      const saturation = 1 / (desaturation * (peak - compressed) + 1);
      scale = (compressed / peak) * saturation;
      white = compressed * (1 - saturation);
    }
    codes[at] = code(r * scale + white), codes[at + 1] = code(g * scale + white), codes[at + 2] = code(b * scale + white);
  }

  function linear(r, g, b, codes, at) {
    codes[at] = code(r), codes[at + 1] = code(g), codes[at + 2] = code(b);
  }

  // A picture's exposed radiance, and the canvases that show it.
  class Picture {
    constructor(codes, width, height) {
      Object.assign(this, { codes, width, height, canvases: [], stops: null });
    }

    draw(stops) {
      if (this.stops === stops) return;
      this.stops = stops;
      const count = this.width * this.height, codes = this.codes, scale = 2 ** stops;
      const curve = tone_curve === "linear" ? linear : pbr_neutral;
      const image = new ImageData(this.width, this.height), bytes = image.data;
      for (let i = 0; i < count; ++i) {
        const r = half_values[codes[i]], g = half_values[codes[count + i]], b = half_values[codes[2 * count + i]];
        curve(r * scale, g * scale, b * scale, bytes, 4 * i);
        bytes[4 * i + 3] = 255;
      }
      for (const canvas of this.canvases) canvas.getContext("2d").putImageData(image, 0, 0);
    }
  }

  const pictures = new Map();  // by stem

  function load_script(stem) {
    return new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = `${stem}.js`;
      script.onload = resolve;
      script.onerror = () => reject(new Error(`${script.src} cannot be read`));
      document.head.append(script);
    });
  }

  // Puts canvases in the place of the images of one picture, one per panel.
  async function load_picture(stem, layers) {
    await load_script(stem);
    const images = layers.map((layer) => layer.querySelector("img"));
    const [width, height] = ["width", "height"].map((name) => Number(images[0].getAttribute(name)));
    const codes = half_codes(await inflated(arrived_pixels.get(stem)), width);
    arrived_pixels.delete(stem);
    const picture = new Picture(codes, width, height);
    picture.canvases = images.map((image) => {
      const canvas = document.createElement("canvas");
      Object.assign(canvas, { width, height });
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", image.alt);
      return canvas;
    });
    picture.draw(state.stops);
    images.forEach((image, i) => image.replaceWith(picture.canvases[i]));
    pictures.set(stem, picture);
  }

  async function load_pictures() {
    const layers_of = new Map();
    for (const layer of document.querySelectorAll("[data-pixels]")) {
      const stem = layer.dataset.pixels;
      layers_of.set(stem, [...(layers_of.get(stem) ?? []), layer]);
    }
    for (const [stem, layers] of layers_of) await load_picture(stem, layers);
  }

  // ---- state to page

  const text_of = (kind) => by_id("left").querySelector(`[value=${kind}]`).textContent;

  function show_layers() {
    const sliding = state.view === "slider" && state.left !== state.right;
    const left = state.view === "flip" && state.shown === "right" ? state.right : state.left;
    panels.classList.toggle("sliding", sliding);
    for (const layer of panels.querySelectorAll(".layer")) {
      layer.classList.toggle("on-left", layer.dataset.layer === left);
      layer.classList.toggle("on-right", sliding && layer.dataset.layer === state.right);
    }
    for (const scale of document.querySelectorAll("[data-scale]")) {
      scale.hidden = !panels.querySelector(`.on-left[data-layer=${scale.dataset.scale}], .on-right[data-layer=${scale.dataset.scale}]`);
    }
    const said = sliding ? `Left: ${text_of(left)}. Right: ${text_of(state.right)}.` : `Shown: ${text_of(left)}.`;
    if (by_id("status").textContent !== said) by_id("status").textContent = said;
  }

  function show_place() {
    const shift = (middle) => 100 * (0.5 - middle * state.zoom);
    const properties = { "--zoom": state.zoom, "--x": shift(state.x), "--y": shift(state.y), "--split": `${state.split}%` };
    for (const [name, value] of Object.entries(properties)) panels.style.setProperty(name, value);
    panels.classList.toggle("zoomed", state.zoom > 1);
    const image_width = Number(stages[0].querySelector("[width]").getAttribute("width"));  // the first stands for all
    // Pixels of the picture become squares to look at once they are larger than one and a half of the screen's.
    const magnified = (stages[0].clientWidth * state.zoom * devicePixelRatio) / image_width;
    panels.classList.toggle("coarse", magnified > 1.5);
  }

  function show_controls() {
    for (const side of ["left", "right"]) by_id(side).value = state[side];
    document.querySelector(`[name=view][value=${state.view}]`).checked = true;
    by_id("exposure").value = state.stops;
    by_id("zoom").value = Math.log2(state.zoom);
    document.querySelector("[for=exposure]").textContent = `${state.stops > 0 ? "+" : ""}${state.stops} EV`;
    document.querySelector("[for=zoom]").textContent = `${Number(state.zoom.toFixed(1))}×`;
    for (const range of panels.querySelectorAll(".split")) {
      range.value = state.split;
      range.disabled = state.view === "flip";
    }
  }

  // Only pictures that are to be seen are exposed anew.
  function show_exposure() {
    for (const picture of pictures.values()) {
      if (picture.canvases.some((canvas) => canvas.parentElement.matches(".on-left, .on-right"))) picture.draw(state.stops);
    }
  }

  let asked = false;
  function change(values) {
    Object.assign(state, values);
    state.zoom = clamp(state.zoom, 1, kMaxZoom);
    state.stops = clamp(state.stops, -kMaxStops, kMaxStops);
    state.x = clamp(state.x, 0.5 / state.zoom, 1 - 0.5 / state.zoom);
    state.y = clamp(state.y, 0.5 / state.zoom, 1 - 0.5 / state.zoom);
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      show_layers();
      show_place();
      show_controls();
      show_exposure();
    });
  }

  // ---- what the reader does

  // u, v: where in a stage, in [0,1]; what lies there stays there.
  function zoom_at(u, v, zoom) {
    const target = clamp(zoom, 1, kMaxZoom);
    const moved = (middle, at) => middle + (at - 0.5) / state.zoom - (at - 0.5) / target;
    change({ zoom: target, x: moved(state.x, u), y: moved(state.y, v) });
  }

  const flip = () => change({ view: "flip", shown: state.view === "flip" && state.shown === "left" ? "right" : "left" });
  const reset = () => change({ stops: initial.stops, zoom: initial.zoom, x: initial.x, y: initial.y });

  function on_key(event) {
    if (event.target !== event.currentTarget || event.ctrlKey || event.altKey || event.metaKey) return;
    const step = 0.1 / state.zoom;
    const actions = {
      ArrowLeft: () => change({ x: state.x - step }),
      ArrowRight: () => change({ x: state.x + step }),
      ArrowUp: () => change({ y: state.y - step }),
      ArrowDown: () => change({ y: state.y + step }),
      "+": () => zoom_at(0.5, 0.5, state.zoom * Math.SQRT2),
      "=": () => zoom_at(0.5, 0.5, state.zoom * Math.SQRT2),
      "-": () => zoom_at(0.5, 0.5, state.zoom / Math.SQRT2),
      0: () => change({ zoom: 1 }),
      "[": () => change({ stops: state.stops - 0.5 }),
      "]": () => change({ stops: state.stops + 0.5 }),
      f: flip,
      F: flip,
    };
    const digit = /^Digit([1-4])$/.exec(event.code);
    // An arrow moves the page where there is nothing to move in the picture.
    const idle = event.key.startsWith("Arrow") && state.zoom === 1;
    if (digit) {
      change({ [event.shiftKey ? "right" : "left"]: kinds[digit[1] - 1] });
    } else if (actions[event.key] && !idle) {
      actions[event.key]();
    } else {
      return;
    }
    event.preventDefault();
  }

  // One finger or the mouse moves, two fingers zoom; a click without a way flips.
  function follow_pointers(stage) {
    const down = new Map();  // by pointer
    let travelled = 0;
    const place = (event) => {
      const box = stage.getBoundingClientRect();
      return { u: (event.clientX - box.left) / box.width, v: (event.clientY - box.top) / box.height };
    };
    const spread = ([a, b]) => Math.hypot(a.u - b.u, a.v - b.v);
    stage.addEventListener("pointerdown", (event) => {
      if (event.target.matches(".split") || event.button !== 0) return;
      if (down.size === 0) travelled = 0;
      down.set(event.pointerId, place(event));
      stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener("pointermove", (event) => {
      if (!down.has(event.pointerId)) return;
      const before = down.get(event.pointerId), now = place(event);
      const spread_before = down.size === 2 ? spread([...down.values()]) : 0;
      down.set(event.pointerId, now);
      travelled += Math.hypot(now.u - before.u, now.v - before.v);
      if (down.size === 2) {
        const [a, b] = [...down.values()];
        zoom_at((a.u + b.u) / 2, (a.v + b.v) / 2, (state.zoom * spread([a, b])) / Math.max(spread_before, 0.01));
      } else if (state.zoom > 1) {
        change({ x: state.x - (now.u - before.u) / state.zoom, y: state.y - (now.v - before.v) / state.zoom });
      }
    });
    stage.addEventListener("pointerup", (event) => {
      if (down.delete(event.pointerId) && down.size === 0 && travelled < 0.01 && state.view === "flip") flip();
    });
    stage.addEventListener("pointercancel", (event) => down.delete(event.pointerId));
    stage.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) return;  // the wheel alone moves the page
      event.preventDefault();
      const { u, v } = place(event);
      zoom_at(u, v, state.zoom * 2 ** (-event.deltaY / 200));
    }, { passive: false });
  }

  function listen() {
    for (const side of ["left", "right"]) {
      by_id(side).addEventListener("change", (event) => change({ [side]: event.target.value }));
    }
    for (const radio of document.querySelectorAll("[name=view]")) {
      radio.addEventListener("change", () => change({ view: radio.value, shown: "left" }));
    }
    by_id("flip").addEventListener("click", flip);
    by_id("reset").addEventListener("click", reset);
    by_id("exposure").addEventListener("input", (event) => change({ stops: Number(event.target.value) }));
    by_id("zoom").addEventListener("input", (event) => zoom_at(0.5, 0.5, 2 ** Number(event.target.value)));
    for (const range of panels.querySelectorAll(".split")) {
      range.addEventListener("input", () => change({ split: Number(range.value) }));
    }
    for (const stage of stages) {
      stage.addEventListener("keydown", on_key);
      follow_pointers(stage);
    }
    addEventListener("resize", () => change({}));
  }

  document.documentElement.classList.add("scripted");
  for (const element of document.querySelectorAll(".controls, .keys")) element.hidden = false;
  listen();
  change({});
  by_id("exposure").disabled = true;
  load_pictures().then(
    () => {
      by_id("exposure").disabled = false;
      document.documentElement.dataset.ready = "true";
      change({});
    },
    (reason) => {
      document.documentElement.dataset.ready = "false";
      by_id("status").after(Object.assign(document.createElement("p"), { textContent: `The exposure cannot be changed: ${reason.message}.` }));
    },
  );
})();
