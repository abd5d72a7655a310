// Parts of the page that need no browser.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { namePhoto } from '../page/baking.js';
import { ofPack, sortOut } from '../page/drop.js';
import { readLayers, writeLayers } from '../page/layers.js';
import { readLink, throttled, writeLink } from '../page/link.js';
import { clock, fromHex, niceStep, scale, toHex } from '../page/scale.js';
import { makeZip } from './page-zips.mjs';

test('a link comes back', () => {
  const pairs = [['method', 'lit'], ['layers', 'cumulus:0.7:1,cirrus:0.3:6'], ['lightning', '1,-2'], ['odd', 'a b&c=d+e#ü']];
  const own = { pack: 'packs/other/', backend: undefined, paused: '' };
  const search = writeLink(own, pairs);
  assert.equal(search.slice(0, 70), '?pack=packs/other/&method=lit&layers=cumulus:0.7:1,cirrus:0.3:6&lightn');
  assert.deepEqual(readLink(search), { own: { pack: 'packs/other/' }, pairs });
  assert.equal(writeLink({ pack: undefined }, []), '');
});

test('a throttled function is called after the last call, and not for each', async () => {
  let calls = 0;
  const call = throttled(() => { calls += 1; }, 5);
  for (let i = 0; i < 100; i += 1) call();
  assert.equal(calls, 0);
  await new Promise((resolve) => { setTimeout(resolve, 50); });
  assert.equal(calls, 1);
});

test('every scale gives a value back, and its ends', () => {
  const ranges = [
    { low: 0, high: 1 }, { low: -90, high: 90, unit: 'degrees' }, { low: 1, high: 8, whole: true }, { low: 0.1, high: 86_400, logarithmic: true },
    { low: 0, high: 1000, logarithmic: true }, { low: -1e6, high: 1e6 }, { low: 0, high: 1e9 }, { low: 0.02, high: 1 },
  ];
  for (const range of ranges) {
    const on = scale(range);
    assert.deepEqual([on.place(range.low), on.place(range.high)], [on.min, on.max]);
    assert.deepEqual([on.value(on.min), on.value(on.max)], [range.low, range.high]);
    for (let place = on.min; place <= on.max; place += (on.max - on.min) / 64) {
      const value = on.value(place);
      assert.ok(Math.abs(on.place(value) - place) <= 0.006 * (on.max - on.min), `${place} of ${JSON.stringify(range)}`);
    }
    assert.deepEqual([on.place(-Infinity), on.place(Infinity)], [on.min, on.max]);
  }
  assert.equal(scale({ low: 0, high: 1 }).step, 0.01);
  assert.equal(scale({ low: -1e6, high: 1e6 }).value(0), 0);
  assert.deepEqual([1, 1.48, 0.01, 7.2, 520, 0.16].map(niceStep), [1, 1, 0.01, 5, 500, 0.1]);
});

test('hours and colours read as people write them', () => {
  assert.deepEqual([0, 0.25, 0.5, 0.9999].map(clock), ['00:00', '06:00', '12:00', '00:00']);
  assert.equal(toHex([1, 0, 0.2159]), '#ff0080');
  assert.deepEqual(fromHex('#ff0080'), [1, 0, 0.2159]);
  for (const hex of ['#000000', '#123456', '#fedcba']) assert.equal(toHex(fromHex(hex)), hex);
});

test('layers come back', () => {
  const text = 'cumulus:0.7:1.2:-12.5:3,cirrus:0.3:6:60:110';
  assert.equal(writeLayers(readLayers(text)), text);
  assert.equal(writeLayers([{ kind: 'cirrus', share: '0.5', height: undefined }]), 'cirrus:0.5');
});

test('a pack is found in the folders that it lies in', () => {
  const one = new Uint8Array(1);
  const files = new Map([['x/pack.json', one], ['x/sun.ktx2', one], ['x/old/pack.json', one], ['y.txt', one]]);
  assert.deepEqual([...ofPack(files, 'x').keys()], ['pack.json', 'sun.ktx2', 'old/pack.json']);
  assert.throws(() => ofPack(new Map([['a', one]]), 'a.zip'), /a\.zip has no pack\.json, so it is no pack/);
});

test('what is given is told by what it is', async () => {
  const file = (path, bytes) => ({ path, file: new File([bytes], path) });
  const pack = { name: 'sky/pack.json', bytes: new TextEncoder().encode('{}') };
  const zip = await sortOut([file('sky.zip', makeZip([pack]))]);
  assert.deepEqual([zip.kind, zip.name, [...zip.files.keys()]], ['pack', 'sky.zip', ['pack.json']]);
  const folder = await sortOut([file('sky/pack.json', '{}'), file('sky/sun.ktx2', 'x')]);
  assert.deepEqual([folder.kind, folder.name, [...folder.files.keys()]], ['pack', 'sky', ['pack.json', 'sun.ktx2']]);
  assert.equal((await sortOut([file('a.JPG', 'x')])).kind, 'photo');
  assert.equal((await sortOut([file('a.toml', 'x')])).kind, 'recipe');
  await assert.rejects(sortOut([file('a.doc', 'x')]), /a\.doc is no pack: expected a folder or a zip/);
  await assert.rejects(sortOut([file('a.zip', 'PK, but no more')]), /a\.zip: this is no zip file/);
  await assert.rejects(sortOut([]), /nothing was given/);
});

test('a photograph is named in the recipe', () => {
  const line = 'file = "a \\"b\\".png"';
  const name = 'a "b".png';
  assert.equal(namePhoto('', name), `[clouds.photo]\n${line}\n`);
  assert.equal(namePhoto('seed = 1\n', name), `seed = 1\n\n[clouds.photo]\n${line}\n`);
  assert.equal(namePhoto('[clouds.photo]\nmean = 0.2\n\n[sky]\nhaze = 1\n', name), `[clouds.photo]\n${line}\nmean = 0.2\n\n[sky]\nhaze = 1\n`);
  assert.equal(namePhoto('[clouds.photo]  # here\nfile = "$&"\n[sky]\nfile = 1', name), `[clouds.photo]  # here\n${line}\n[sky]\nfile = 1`);
});
