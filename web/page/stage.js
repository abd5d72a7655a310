// The canvas and its sky: opened, given another backend or pack, and made anew when the browser takes the device away.

import { el } from './dom.js';
import { fit } from './fit.js';

/** Losing the device more often than this in `SPAN_MS` is no accident. */
const MOST_LOSSES = 3;
const SPAN_MS = 60_000;

/**
 * @param {HTMLElement} view
 * @param {(canvas: HTMLCanvasElement, files: Map<string, Uint8Array>, options: object) => Promise<object>} createSky
 * @param {{opened(sky: object): void, lost(reason: string): void, back(): void, gone(reason: string): void}} tell
 */
export function createStage(view, createSky, tell) {
  let [sky, canvas, files, backend] = [null, null, null, 'auto'];
  let losses = [];

  /** A sky on a canvas of its own, with the settings of the one before; that one stays if it cannot be. */
  async function open(next_files, next_backend = backend) {
    const fresh = el('canvas');
    fresh.style.visibility = 'hidden';
    view.append(fresh);
    fit(fresh, view);
    let made;
    try {
      made = await createSky(fresh, next_files, {
        backend: next_backend,
        onlost: (why) => { if (made === sky) lose(why); },
      });
      if (sky) made.set(sky.get());
    } catch (error) {
      fresh.remove();
      throw error;
    }
    const old = [sky, canvas];
    [sky, canvas, files, backend] = [made, fresh, next_files, next_backend];
    tell.opened(sky);
    draw();
    fresh.style.visibility = '';
    old[0]?.destroy?.();
    old[1]?.remove();
  }

  async function lose(why) {
    const now = Date.now();
    losses = [...losses.filter((then) => now - then < SPAN_MS), now];
    if (losses.length > MOST_LOSSES) return tell.gone(why);
    tell.lost(why);
    try {
      await open(files);
      tell.back();
    } catch (error) {
      tell.gone(error.message);
    }
  }

  function draw() {
    fit(canvas, view);
    sky.draw();
  }

  return {
    open, draw,
    /** Draws another pack, or throws and stays. */
    async load(next_files) {
      await sky.load(next_files);
      files = next_files;
    },
    /** Another try after the device was lost too often. */
    again() {
      losses = [];
      return open(files);
    },
    /** The picture as a PNG: drawn now, because a canvas keeps none. */
    picture() {
      draw();
      return new Promise((resolve, reject) => {
        canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the browser makes no PNG of the picture'))), 'image/png');
      });
    },
    get sky() { return sky; },
    get files() { return files; },
    get backend() { return backend; },
  };
}
