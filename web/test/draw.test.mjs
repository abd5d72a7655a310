// The sky in a browser, by WebGPU and by WebGL2, is the picture that the native program draws.
//
// Both round to 8 bits, and their drivers compute with other last bits of sines, powers and texture filters: so most bytes are the same and
// the others a step off. Two numbers that differ by less than a step, rounded, are a step apart no more often than not, so the mean stays below half a
// step. WebGL2 has no canvas that shows an sRGB texture: wgpu decodes and encodes the picture once more on its way to the canvas, which rounds it a
// second time, so there the mean may be twice that.
//
// A byte is off by more where a map that is drawn off screen was rounded before, and clouds' edges are cut out of it with up to three times its
// contrast: three steps for one. 99.5 % of the bytes are within that; the others lie on outlines of clouds, which pass through a
// pixel in twenty of such a picture, and where a tenth may fall to the other side. That the bounds can fail is tested too: a little more cover breaks both.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser } from './page-browser.mjs';
import { SITE, VIEW } from './places.mjs';

const SIZE = [320, 180];
const MOST_MEAN = { webgpu: 0.5, webgl2: 1 };
const STEPS = 3;
const LEAST_WITHIN = 0.995;

const METHODS = ['packed', 'octaves', 'fbm', 'lit', 'sprites'];
const SKIES = {
  noon: { time: 0.45, cover: 0.5, azimuth: 100, elevation: 28, at: 30 },
  sunset: { time: 0.742, sunset: 1, cover: 0.62, height: 0.6, azimuth: 270, elevation: 20, at: 30 },
  night: { time: 0.02, cover: 0.35, azimuth: 72, elevation: 42, at: 30 },
};

const folder = mkdtempSync(join(tmpdir(), 'welkin-draw-'));
let browser = null;
before(async () => { browser = await openBrowser(); });
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

/** The native program's picture, as the address of its bytes. */
function native(options, name) {
  const file = join(folder, `${name}.png`);
  execFileSync(VIEW, ['render', join(SITE, 'pack'), '-o', file, '--size', SIZE.join('x'), ...options], { stdio: ['ignore', 'ignore', 'pipe'] });
  return `data:image/png;base64,${readFileSync(file).toString('base64')}`;
}

/** Opens an empty page of the site. */
const visit = (work) => browser.visit({ search: 'sizes.json', drawn: false }, async (page) => {
  await page.evaluate(async (size) => {
    const { createSky } = await import('./welkin.js');
    const pixels = (picture) => {
      const flat = new OffscreenCanvas(...size).getContext('2d', { willReadFrequently: true });
      flat.drawImage(picture, 0, 0);
      return flat.getImageData(0, 0, ...size).data;
    };
    Object.assign(window, {
      async open(backend) {
        window.sky?.destroy();
        const canvas = document.createElement('canvas');
        [canvas.width, canvas.height] = size;
        window.sky = await createSky(canvas, 'pack/', { backend, onlost: (why) => console.error(why) });
        // In the task of the drawing: a canvas keeps no picture.
        window.draw = (settings) => {
          sky.set(settings).draw();
          return pixels(canvas);
        };
        return sky.info;
      },
      async compare(drawn, address, steps) {
        const other = pixels(await createImageBitmap(await (await fetch(address)).blob(), { colorSpaceConversion: 'none' }));
        const found = { mean: 0, within: 0, most: 0, opaque: true, least: 255, largest: 0 };
        const count = drawn.length / 4 * 3;
        drawn.forEach((byte, i) => {
          if (i % 4 === 3) {
            found.opaque &&= byte === 255;
            return;
          }
          const difference = Math.abs(byte - other[i]);
          found.mean += difference / count;
          found.within += (difference <= steps) / count;
          found.most = Math.max(found.most, difference);
          found.least = Math.min(found.least, byte);
          found.largest = Math.max(found.largest, byte);
        });
        return found;
      },
    });
  }, SIZE);
  await work(page);
});

for (const backend of ['webgpu', 'webgl2']) {
  for (const method of METHODS) {
    test(`${backend} draws ${method} as the native program does`, (t) => visit(async (page) => {
      for (const [name, settings] of Object.entries(SKIES)) {
        // A new sky, as the native program has: `sprites` keeps its ring from frame to frame.
        const info = await page.evaluate((wanted) => open(wanted), backend);
        assert.equal(info.backend, backend);
        const options = await page.evaluate((wanted) => sky.set(wanted).options(), { ...settings, method });
        const address = native(options, `${backend}-${method}-${name}`);
        const found = await page.evaluate(async ([picture, steps]) => compare(draw({}), picture, steps), [address, STEPS]);
        t.diagnostic(`${name}: ${JSON.stringify(found)}`);
        assert.ok(found.opaque, 'the canvas is not opaque');
        assert.ok(found.largest - found.least > 50, `${name}: the picture is flat`);
        assert.ok(found.mean < MOST_MEAN[backend] && found.within >= LEAST_WITHIN, `${name}: ${JSON.stringify(found)}`);
      }
    }));
  }

  test(`a little more cover is told apart by ${backend}`, () => visit(async (page) => {
    await page.evaluate((wanted) => open(wanted), backend);
    const options = await page.evaluate((wanted) => sky.set(wanted).options(), SKIES.noon);
    const address = native(options, `${backend}-cover`);
    const found = await page.evaluate(async ([picture, steps]) => compare(draw({ cover: 0.55 }), picture, steps), [address, STEPS]);
    assert.ok(found.mean >= MOST_MEAN[backend] && found.within < LEAST_WITHIN, JSON.stringify(found));
  }));
}
