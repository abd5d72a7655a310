// The canvas and its sky: opened, given another backend or pack, and made anew when the browser takes the device away.

import { el } from './dom.js';
import { fit } from './fit.js';
import { createLosses } from './losses.js';

/**
 * @param {HTMLElement} view
 * @param {(canvas: HTMLCanvasElement, files: Map<string, Uint8Array>, options: object) => Promise<object>} createSky
 * @param {{opened(sky: object): void, lost(reason: string): void, back(backend: string): void, gone(reason: string): void}} tell
 */
export function createStage(view, createSky, tell) {
  let [sky, canvas, files, backend] = [null, null, null, 'auto'];
  const losses = createLosses();

  /** A sky on a canvas of its own, with the settings of the one before; that one stays if it cannot be. */
  async function open(next_files, next_backend = backend) {
    const fresh = el('canvas');
    fresh.style.visibility = 'hidden';
    view.append(fresh);
    fit(fresh, view);
    let [made, lost] = [null, null];
    try {
      made = await createSky(fresh, next_files, {
        backend: next_backend,
        // Perhaps before it is shown.
        onlost: (why) => {
          if (made && made === sky) lose(why);
          else lost = why;
        },
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
    if (lost) lose(lost);
  }

  async function lose(why) {
    const next = losses.next(backend, sky.info.backend);
    let reason = why;
    if (next.length) tell.lost(why);
    for (const wanted of next) {
      try {
        await open(files, wanted);
        return tell.back(sky.info.backend);
      } catch (error) {
        reason = error.message;
      }
    }
    return tell.gone(reason);
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
      losses.forget();
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
