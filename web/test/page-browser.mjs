// The page in a browser, and pictures of it.

import assert from 'node:assert/strict';
import { createServer } from 'node:http';
import { readFile, readdir } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import { chromium } from 'playwright-core';
import { SITE } from './places.mjs';

const CHROMIUM = process.env.CHROMIUM ?? '/usr/bin/chromium';
const QUIET = ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'];
/** WebGPU on SwiftShader and WebGL2 on the system's GL, both without a screen. */
export const DRAWING = ['--enable-unsafe-webgpu', '--use-angle=gl-egl', '--ignore-gpu-blocklist'];

/** Software adapters take their time on a machine that does other things. */
const PATIENCE_MS = 120_000;

const TYPES = {
  '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml', '.json': 'application/json', '.wasm': 'application/wasm', '.png': 'image/png',
};

/** Serves a folder, and others below `/name/`; with `shared`, to pages of other origins too, as a CDN does. */
export async function serve(folder, { mounts = {}, shared = false } = {}) {
  const server = createServer(async (request, answer) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://page').pathname)).replace(/\/$/, '/index.html');
    // Browsers ask for it where a document names no icon.
    if (path === '/favicon.ico') return answer.writeHead(204).end();
    try {
      const [, name] = path.split('/');
      const file = mounts[name] ? join(mounts[name], path.slice(name.length + 1)) : join(folder, path);
      const bytes = await readFile(file);
      const type = { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' };
      answer.writeHead(200, shared ? { ...type, 'access-control-allow-origin': '*' } : type);
      answer.end(bytes);
    } catch {
      answer.writeHead(404);
      answer.end();
    }
  });
  await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => new Promise((resolve) => { server.close(resolve); }) };
}

/**
 * A browser and a server, until `close`.
 * @param {{flags?: string[]}} options flags in place of those for drawing
 */
export async function openBrowser({ flags = DRAWING } = {}) {
  const site = await serve(SITE);
  const browser = await chromium.launch({ executablePath: CHROMIUM, args: [...QUIET, ...flags] });

  /**
   * Opens the page, does `work` with it, and asserts that nothing was said on the console but what `expected` matches.
   * @param {{at?: string, search?: string, size?: [number, number], calm?: boolean, touch?: boolean, drawn?: boolean, expected?: RegExp}} options
   */
  async function visit({ at = site.address, search = '', size = [900, 560], calm = false, touch = false, drawn = true, expected = null }, work) {
    const context = await browser.newContext({
      viewport: { width: size[0], height: size[1] }, reducedMotion: calm ? 'reduce' : 'no-preference', hasTouch: touch,
      permissions: ['clipboard-read', 'clipboard-write'], acceptDownloads: true,
    });
    try {
      const page = await context.newPage();
      page.setDefaultTimeout(PATIENCE_MS);
      const said = [];
      page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) said.push(message.text()); });
      page.on('pageerror', (error) => said.push(String(error)));
      await page.goto(new URL(search, at).href);
      if (drawn) await page.waitForFunction(() => document.documentElement.dataset.firstFrame !== undefined);
      await work(page);
      assert.deepEqual(said.filter((text) => !expected?.test(text)), [], 'the console');
    } finally {
      await context.close();
    }
  }

  return {
    visit,
    address: site.address,
    async close() {
      await browser.close();
      await site.close();
    },
  };
}

/** The sky beside the panel and above the line at the bottom, once what was asked for has been drawn. */
export async function picture(page) {
  await page.evaluate(() => { document.getElementById('messages').style.visibility = 'hidden'; });
  await frames(page, 2);
  const { width, height } = page.viewportSize();
  const wide = width > 640;
  const clip = wide ? { x: 0, y: 0, width: width - 344, height: height - 48 } : { x: 0, y: 0, width, height: Math.floor(height * 0.4) };
  const png = await page.screenshot({ clip });
  await page.evaluate(() => { document.getElementById('messages').style.visibility = ''; });
  return png;
}

/** Lets frames go by. */
export const frames = (page, count) => page.evaluate(async (n) => {
  for (let i = 0; i < n; i += 1) await new Promise((resolve) => { requestAnimationFrame(resolve); });
}, count);

/** Compares two pictures: mean difference and spread of the first, in steps of a byte. */
export async function compare(page, one, other) {
  const scratch = await page.context().newPage();
  try {
    return await scratch.evaluate(async (texts) => {
      const [a, b] = await Promise.all(texts.map(async (text) => {
        const image = new Image();
        image.src = `data:image/png;base64,${text}`;
        await image.decode();
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, image.width, image.height).data;
      }));
      let [difference, sum, squares, largest] = [0, 0, 0, 0];
      for (let i = 0; i < a.length; i += 1) {
        const step = Math.abs(a[i] - b[i]);
        difference += step;
        largest = Math.max(largest, step);
        if (i % 4 === 1) {
          sum += a[i];
          squares += a[i] * a[i];
        }
      }
      const pixels = a.length / 4;
      return { difference: difference / (3 * pixels), largest, spread: Math.sqrt(Math.max(squares / pixels - (sum / pixels) ** 2, 0)) };
    }, [one, other].map((png) => png.toString('base64')));
  } finally {
    await scratch.close();
  }
}

/** Waits until the picture is another than `before` by more than noise, and tells it. */
export async function changedPicture(page, before) {
  let last = 0;
  for (let tries = 0; tries < 100; tries += 1) {
    const now = await picture(page);
    last = now.equals(before) ? 0 : (await compare(page, now, before)).difference;
    if (last > 0.5) return now;
  }
  return assert.fail(`the picture is still the same, but for ${last}`);
}

/** Waits until the address has these settings: a text, a pattern, or null for none. */
export async function addressHas(page, wanted) {
  await page.waitForFunction((list) => {
    const has = new URLSearchParams(location.search);
    return list.every(([name, text]) => has.get(name) === text);
  }, Object.entries(wanted));
}

/** A setting in the address, as a number. */
export const inAddress = async (page, name) => Number(await page.evaluate((key) => new URLSearchParams(location.search).get(key), name));

/** The pack that the page is delivered with. */
export const PACK = join(SITE, 'pack');

/** Its files. */
export async function packFiles() {
  const names = await readdir(PACK);
  return Promise.all(names.map(async (name) => ({ name, bytes: new Uint8Array(await readFile(join(PACK, name))) })));
}

/** Drops files on the window as a browser tells it. */
export async function drop(page, files) {
  const list = files.map(({ name, bytes }) => ({ name, text: Buffer.from(bytes).toString('base64') }));
  await page.evaluate((given) => {
    const data = new DataTransfer();
    for (const { name, text } of given) data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
    for (const type of ['dragenter', 'dragover', 'drop']) {
      document.body.dispatchEvent(new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
    }
  }, list);
}
