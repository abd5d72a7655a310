// The JavaScript interface in a browser: what a page of one's own leans on.

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { openBrowser } from './page-browser.mjs';
import { ROOT, SITE } from './places.mjs';

let browser = null;
before(async () => { browser = await openBrowser(); });
after(() => browser?.close());

/** An empty page of the site with a sky, by WebGL2 if nothing else is said. */
const visit = (work, { backend = 'webgl2', expected } = {}) => browser.visit({ search: 'sizes.json', drawn: false, expected }, async (page) => {
  await page.evaluate(async (wanted) => {
    window.welkin = await import('./welkin.js');
    window.canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [96, 54];
    window.lost = [];
    window.sky = await welkin.createSky(canvas, 'pack/', { backend: wanted, onlost: (why) => lost.push(why) });
    window.picture = () => {
      sky.draw();
      return canvas.toDataURL();
    };
  }, backend);
  await work(page);
});

test('ten lines draw a sky that moves', () => browser.visit({ search: 'minimal.html', drawn: false }, async (page) => {
  const shown = () => page.screenshot({ animations: 'allow' });
  await page.waitForFunction(() => document.querySelector('canvas').width > 300);
  const drawn = async () => page.evaluate(async (png) => {
    const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob());
    const flat = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
    flat.drawImage(picture, 0, 0);
    const { data } = flat.getImageData(0, 0, picture.width, picture.height);
    return new Set(new Uint32Array(data.buffer)).size;
  }, (await shown()).toString('base64'));
  const until = Date.now() + 60_000;
  while (await drawn() < 1000) assert.ok(Date.now() < until, 'the picture stays flat');
}));

test('settings are set, all or none, and told', () => visit(async (page) => {
  const told = await page.evaluate(() => {
    const complaint = (values) => { try { sky.set(values); return null; } catch (error) { return error.message; } };
    sky.set({ method: 'lit', cover: 0.25, domes: [1, 0.5, 0.5] });
    return {
      changes: sky.changes(), value: sky.get().cover, lacks: sky.lacks,
      unknown: complaint({ covr: 1 }), wrong: complaint({ height: 0.125, cover: 2 }), height: sky.get().height,
      weather: sky.preset('storm').weather(), cover: sky.get().cover,
      after: sky.reset().changes(), options: sky.set({ time: 0.75 }).options(),
    };
  });
  assert.deepEqual(told.changes.filter(([name]) => name !== 'domes'), [['cover', '0.25'], ['method', 'lit']]);
  assert.equal(told.unknown, 'there is no setting "covr"; did you mean "cover"?');
  assert.equal(told.wrong, 'cover is "2", expected a number from 0 to 1');
  assert.notEqual(told.height, '0.125');
  assert.deepEqual([told.value, told.lacks, told.weather, told.cover, told.after], ['0.25', null, 'storm', '0.95', []]);
  assert.ok(told.options.includes('--time'));
}));

test('settings come back from their texts', () => visit(async (page) => {
  assert.ok(await page.evaluate(() => {
    sky.preset('storm').set({ method: 'fbm', azimuth: 12.5 });
    const [all, text] = [sky.get(), JSON.stringify(sky.changes())];
    sky.reset().set(all);
    return JSON.stringify(sky.changes()) === text;
  }));
}));

test('every setting has words, and the presets are there', () => visit(async (page) => {
  const table = await page.evaluate(async () => welkin.controls());
  assert.ok(table.keys.length > 40 && table.keys.every(({ name, label, help, input }) => name && label && help && input.kind));
  assert.ok(table.presets.some(({ name }) => name === 'starry') && table.layers.kinds.includes('cirrus') && table.layers.most === 6);
}));

test('a broken pack is told, and the sky stays', () => visit(async (page) => {
  const told = await page.evaluate(async () => {
    const before = picture();
    const broken = async (change) => {
      const files = new Map(sky.files);
      change(files);
      try { await sky.load(files); return null; } catch (error) { return error.message; }
    };
    return {
      missing: await broken((files) => files.delete('stars.ktx2')),
      flipped: await broken((files) => {
        const bytes = files.get('fbm.ktx2').slice();
        bytes[bytes.length >> 1] ^= 1;
        files.set('fbm.ktx2', bytes);
      }),
      empty: await broken((files) => files.clear()),
      nowhere: await sky.load('nowhere/').catch((error) => error.message),
      same: picture() === before,
    };
  });
  assert.match(told.missing, /^pack\/stars\.ktx2: missing, expected a file of the pack/);
  assert.match(told.flipped, /^pack\/fbm\.ktx2: /);
  assert.match(told.empty, /^pack\/pack\.json: missing/);
  assert.match(told.nowhere, /^nowhere\/pack\.json: missing/);
  assert.ok(told.same, 'the sky has changed');
}, { expected: /404/ }));

test('the check finds what welkin check finds', () => visit(async (page) => {
  const [sound, broken] = await page.evaluate(() => {
    const files = new Map(sky.files);
    files.delete('sun.ktx2');
    return [sky.check(), welkin.check(files)];
  });
  assert.ok(sound.sound && sound.findings.length > 100);
  assert.deepEqual([broken.sound, broken.findings.find(({ outcome, rule }) => outcome === 'failed' && rule === 'file-hash').subject], [false, 'sun']);
}));

for (const backend of ['webgpu', 'webgl2']) {
  test(`a canvas of another size is drawn whole by ${backend}`, () => visit(async (page) => {
    const colours = await page.evaluate(() => [[33, 200], [640, 17], [1, 1]].map(([width, height]) => {
      [canvas.width, canvas.height] = [width, height];
      sky.draw();
      const flat = new OffscreenCanvas(width, height).getContext('2d');
      flat.drawImage(canvas, 0, 0);
      const { data } = flat.getImageData(0, 0, width, height);
      // The corner that is drawn last by any order of rows and columns.
      return [sky.info.width, sky.info.height, ...data.slice(-4)];
    }));
    assert.deepEqual(colours.map(([width, height, , , , alpha]) => [width, height, alpha]), [[33, 200, 255], [640, 17, 255], [1, 1, 255]]);
    assert.ok(colours.every(([, , ...rgb]) => rgb.slice(0, 3).some((byte) => byte > 0)));
  }, { backend }));
}

test('a lost context is told, and another canvas goes on', () => visit(async (page) => {
  const told = await page.evaluate(async () => {
    const settings = sky.set({ cover: 0.125 }).get();
    canvas.getContext('webgl2').getExtension('WEBGL_lose_context').loseContext();
    while (lost.length === 0) await new Promise((resolve) => { setTimeout(resolve, 10); });
    const files = sky.files;
    sky.destroy();
    const other = document.createElement('canvas');
    const next = await welkin.createSky(other, files, { backend: 'webgl2', settings });
    next.draw();
    return { lost, cover: next.get().cover };
  });
  assert.equal(told.lost.length, 1);
  assert.match(told.lost[0], /^the graphics device was lost: /);
  assert.equal(told.cover, '0.125');
}, { expected: /CONTEXT_LOST|context lost/i }));

test('no such backend is an error', () => visit(async (page) => {
  assert.equal(await page.evaluate(() => welkin.createSky(document.createElement('canvas'), sky.files, { backend: 'metal' }).catch((error) => error.message)),
    'backend is "metal", expected auto, webgpu or webgl2');
}));

test('the worker bakes the pack that was delivered, tells how far it is, and stops when told', () => visit(async (page) => {
  const told = await page.evaluate(async () => {
    const shares = [];
    const files = await welkin.bake(sky.pack.recipe, { onprogress: (share) => shares.push(share) });
    const same = [...sky.files].every(([name, bytes]) => bytes.length === files.get(name)?.length && bytes.every((byte, i) => byte === files.get(name)[i]));
    const stop = new AbortController();
    const stopped = await welkin.bake(sky.pack.recipe, { signal: stop.signal, onprogress: () => stop.abort() }).catch((error) => error.name);
    const wrong = await welkin.bake('seed = -1').catch((error) => error.message);
    const seed = await welkin.bake('', { seed: '1e3' }).catch((error) => error.message);
    return { shares, same, count: files.size, stopped, wrong, seed };
  });
  assert.ok(told.same, 'the bytes differ');
  assert.equal(told.shares[0], 0);
  assert.equal(told.shares.at(-1), 1);
  assert.equal(told.stopped, 'AbortError');
  assert.match(told.wrong, /^recipe:1:8: seed is -1, expected /);
  assert.match(told.seed, /^seed is 1e3, expected a whole number/);
}));

test('the types name what there is', () => {
  const read = (path) => readFileSync(join(ROOT, 'web/js', path), 'utf8');
  const exported = (text, form) => [...text.matchAll(form)].map(([, name]) => name).sort();
  const types = read('welkin.d.ts');
  const code = read('welkin.js');
  const functions = exported(code, /^export (?:async function|const) (\w+)|^export \{ (\w+) \}/gm).concat(['bake', 'fetchPack']).filter(Boolean).sort();
  assert.deepEqual(exported(types, /^export function (\w+)/gm), functions);
  const members = exported(code.slice(code.indexOf('class Sky')), /^ {2}(?:async |get )?([a-z]\w+)\(/gm).filter((name) => name !== 'constructor');
  const told = types.slice(types.indexOf('export interface Sky {'));
  assert.deepEqual(exported(told.slice(0, told.indexOf('\n}')), /^ {2}(?:readonly )?(\w+)[(:]/gm), members);
});

// 3 MB until the baker learnt to read photographs by profile, mask, region and projection, which takes 38 kB.
test('all that is downloaded weighs less than 3.2 MB', () => {
  const { total, files } = JSON.parse(readFileSync(join(SITE, 'sizes.json'), 'utf8'));
  assert.ok(total.compressed < 3_200_000, `${total.compressed} bytes`);
  assert.ok(['index.html', 'engine_bg.wasm', 'baker_bg.wasm', 'pack/pack.json'].every((name) => files[name]));
});
