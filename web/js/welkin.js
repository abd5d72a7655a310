// A sky on a canvas. The types, with units and ranges, are in welkin.d.ts.

import init, { Engine, check as checkMap, controls as table } from './engine.js';
import { asMap, fetchPack } from './files.js';
import { fit } from './fit.js';

export { bake } from './bake.js';
export { fetchPack } from './files.js';

/** The longest that a frame of the loop may count, in seconds: a hidden page does not leap when it is seen again. */
const LONGEST_S = 0.25;

let loaded = null;
/** Loads the engine, once. */
const load = () => (loaded ??= init({ module_or_path: new URL('./engine_bg.wasm', import.meta.url) }));

/** Opens a sky. */
export async function createSky(canvas, source, options = {}) {
  if (options.resize) fit(canvas);
  // At once: the device is opened while the pack is on its way.
  const opening = load().then(() => Engine.open(canvas, options.backend ?? 'auto'));
  const [files, engine] = await both(filesOf(source, options.onprogress), opening);
  try {
    engine.load(placeOf(source), files);
    const sky = new Sky(canvas, engine, files, options);
    if (options.settings) sky.set(options.settings);
    return sky;
  } catch (error) {
    engine.free();
    throw error;
  }
}

/** Files and an engine; no engine is left behind without files. */
async function both(fetching, opening) {
  try {
    return await Promise.all([fetching, opening]);
  } catch (error) {
    opening.then((engine) => engine.free(), () => {});
    throw error;
  }
}

/** Every setting, the presets, what layers may be. */
export async function controls() {
  await load();
  return JSON.parse(table());
}

/** `welkin check --json` of files; after `controls` or `createSky` has come. */
export const check = (files, place = 'pack') => JSON.parse(checkMap(place, asMap(files)));

class Sky {
  #canvas;
  #engine;
  #files;
  #options;
  #asked = 0;
  #last = null;
  #running = false;
  #observer = null;
  #onlost = (event) => {
    event.preventDefault();
    this.#engine?.contextLost();
  };

  constructor(canvas, engine, files, options) {
    [this.#canvas, this.#engine, this.#files, this.#options] = [canvas, engine, files, options];
    canvas.addEventListener('webglcontextlost', this.#onlost);
    engine.lost().then((why) => {
      if (this.#engine !== engine) return;
      this.stop();
      options.onlost?.(why);
    });
    if (options.resize) {
      this.#observer = new ResizeObserver(() => { if (!this.#running) this.#ask(); });
      this.#observer.observe(canvas);
    }
  }

  set(values) {
    this.#engine.set(Object.entries(values).flatMap(([name, value]) => [name, Array.isArray(value) ? value.join(',') : String(value)]));
    return this;
  }

  get() { return Object.fromEntries(pairs(this.#engine.all())); }

  changes() { return pairs(this.#engine.changes()); }

  applies() { return this.#engine.applies(); }

  reset(name) {
    this.#engine.reset(name);
    return this;
  }

  preset(name, seconds = 0) {
    this.#engine.preset(name, seconds);
    return this;
  }

  weather() { return this.#engine.weather() ?? null; }

  options() { return this.#engine.options(); }

  get blending() { return this.#engine.blending(); }

  get lacks() { return this.#engine.lacks() ?? null; }

  get info() { return JSON.parse(this.#engine.info()); }

  get pack() { return JSON.parse(this.#engine.pack()); }

  get files() { return this.#files; }

  advance(seconds, { time = true } = {}) {
    this.#engine.advance(seconds, time);
    return this;
  }

  drag([right_px, down_px], height_px = this.#canvas.clientHeight) {
    this.#engine.drag(right_px, down_px, height_px);
    return this;
  }

  zoom(notches) {
    this.#engine.zoom(notches);
    return this;
  }

  pilot({ turnRight = 0, turnUp = 0, forward = 0, right = 0, up = 0, haste = false }, seconds) {
    this.#engine.pilot(Float32Array.of(turnRight, turnUp), Float32Array.of(forward, right, up), haste, seconds);
    return this;
  }

  draw(seconds) {
    if (seconds !== undefined) this.set({ at: seconds });
    if (this.#options.resize) fit(this.#canvas);
    this.#engine.resize(this.#canvas.width, this.#canvas.height);
    this.#engine.draw();
    return this;
  }

  start() {
    this.#running = true;
    this.#ask();
    return this;
  }

  stop() {
    cancelAnimationFrame(this.#asked);
    [this.#asked, this.#last, this.#running] = [0, null, false];
    return this;
  }

  async load(source) {
    const files = await filesOf(source);
    this.#engine.load(placeOf(source), files);
    this.#files = files;
    return this;
  }

  check() { return check(this.#files); }

  destroy() {
    this.stop();
    this.#observer?.disconnect();
    this.#canvas.removeEventListener('webglcontextlost', this.#onlost);
    this.#engine?.free();
    this.#engine = null;
  }

  #ask() { this.#asked ||= requestAnimationFrame((now_ms) => this.#tick(now_ms)); }

  #tick(now_ms) {
    this.#asked = 0;
    if (this.#running) {
      if (this.#last !== null) this.advance(Math.min((now_ms - this.#last) / 1000, LONGEST_S));
      this.#last = now_ms;
    }
    try {
      this.draw();
    } catch (error) {
      this.stop();
      throw error;
    }
    if (this.#running) this.#ask();
  }
}

/** Names and values that follow each other, as pairs. */
const pairs = (list) => Array.from({ length: list.length / 2 }, (_, i) => [list[2 * i], list[2 * i + 1]]);

const isAddress = (source) => typeof source === 'string' || source instanceof URL;
const placeOf = (source) => (isAddress(source) ? String(source).replace(/\/$/, '') : 'pack');
const filesOf = async (source, onprogress) => (isAddress(source) ? fetchPack(source, onprogress) : asMap(source));
