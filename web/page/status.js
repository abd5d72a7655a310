// The line at the bottom: what draws, what it weighs, how long it takes.

import { byId, bytesText } from './dom.js';

const NAMES = { webgpu: 'WebGPU', webgl2: 'WebGL2' };

/** Shows a part of the line; `title` tells it in a sentence. */
function part(name, text, title) {
  const place = byId(`status-${name}`);
  place.textContent = text;
  place.title = title;
  place.hidden = !text;
}

export function showBackend({ backend, adapter }) {
  const name = NAMES[backend] ?? backend;
  part('backend', name, `Drawn with ${name}`);
  showAdapter(adapter);
  if (!adapter && backend === 'webgpu') askAdapter();
}

const showAdapter = (name) => part('adapter', name, `Graphics adapter: ${name}`);

/** What the browser tells of the adapter itself. */
async function askAdapter() {
  const adapter = await navigator.gpu.requestAdapter({ powerPreference: 'high-performance' }).catch(() => null);
  const { description, vendor, architecture } = adapter?.info ?? {};
  showAdapter(description || [vendor, architecture].filter(Boolean).join(' '));
}

/** What the textures of the method weigh on the graphics card. */
export function showTextures(bytes) {
  part('textures', bytes ? `textures ${bytesText(bytes)}` : '', `The textures that this method reads have ${bytes} bytes on the graphics card`);
}

export function showPack(files) {
  const bytes = [...files.values()].reduce((sum, file) => sum + file.length, 0);
  part('pack', `pack ${bytesText(bytes)}`, `${files.size} files of the pack have ${bytes} bytes`);
}

/** The sizes of what is downloaded, which the build writes beside the page; a page without them says nothing. */
export async function showSizes() {
  const answer = await fetch('sizes.json').catch(() => null);
  if (!answer?.ok) return;
  const sizes = await answer.json();
  const { brotli, compressed } = sizes.total;
  part('download', `download ${bytesText(compressed)}`, `All that the page may load, the baker too: ${bytesText(compressed)} as gzip, ${bytesText(brotli)} as brotli`);
}

/**
 * The time from the end of the downloads to the first picture on the screen. A frame's work is done when the frame after it begins.
 */
export function showFirstFrame() {
  const loaded_ms = Math.max(0, ...performance.getEntriesByType('resource').map((entry) => entry.responseEnd));
  requestAnimationFrame(() => requestAnimationFrame(() => {
    const first_ms = Math.round(performance.now() - loaded_ms);
    part('first', `first frame ${first_ms} ms`, `The first frame came ${first_ms} ms after the download`);
    document.documentElement.dataset.firstFrame = String(first_ms);
  }));
}

export function showFrameTime(ms) {
  part('frame', ms === null ? '' : `${ms.toFixed(1)} ms a frame`, 'Median time between frames, which the screen\'s rate limits');
}
