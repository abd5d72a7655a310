// The baker in WebAssembly makes the files of the native program, byte for byte: manifest, textures and field.
//
// WebAssembly is another architecture: 32-bit addresses, floating point that its standard fixes to the bit, one thread, and a
// compiler of its own. What still comes out alike does not lean on any of these.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { ROOT, SITE, WELKIN } from './places.mjs';

const folder = mkdtempSync(join(tmpdir(), 'welkin-bake-'));
after(() => rmSync(folder, { recursive: true }));

let baker = null;
before(async () => {
  baker = await import(pathToFileURL(join(SITE, 'baker.js')));
  await baker.default({ module_or_path: readFileSync(join(SITE, 'baker_bg.wasm')) });
});

const hash = (bytes) => createHash('sha256').update(bytes).digest('hex');
/** Names and hashes of files, in the order of the names. */
const hashes = (files) => files.map(([name, bytes]) => `${name} ${hash(bytes)}`).sort();

/** What the native program bakes. */
function native(recipe, seed) {
  const place = join(folder, `native-${seed ?? 'own'}-${(recipe ?? 'default').replaceAll('/', '-')}`);
  const words = [recipe && join(ROOT, recipe), '-o', place, seed !== undefined && '--seed', seed !== undefined && String(seed)];
  execFileSync(WELKIN, ['bake', ...words.filter((word) => word)], { stdio: ['ignore', 'ignore', 'pipe'] });
  return hashes(readdirSync(place).map((name) => [name, readFileSync(join(place, name))]));
}

/** What WebAssembly bakes. */
function web(recipe, seed, inputs) {
  const text = recipe ? readFileSync(join(ROOT, recipe), 'utf8') : baker.defaultRecipe();
  const read = (path) => new Uint8Array(readFileSync(path));
  const files = new Map(inputs.map((name) => [name, read(resolve(ROOT, dirname(recipe), name))]));
  files.set(baker.builtInPhoto(), read(join(ROOT, 'assets-src/photos/god-rays-1024.png')));
  const steps = [];
  const baked = baker.bake(text, seed, files, (step, done, total) => steps.push({ step, done, total }));
  assert.ok(steps.every(({ done }, i) => done >= (steps[i - 1]?.done ?? 0)), 'progress goes back');
  assert.ok(steps.at(-1).step === 'done' && steps.at(-1).done === steps.at(-1).total);
  return hashes([...baked]);
}

const RECIPES = [
  { recipe: undefined, inputs: [] },
  { recipe: 'assets-src/recipes/web.toml', inputs: ['../photos/clouds-web.jpg'] },
  // A skybox from an OpenEXR file.
  { recipe: 'assets-src/recipes/skybox.toml', inputs: ['../skies/sky-512x256.exr'] },
  // Clouds from glTF files.
  { recipe: 'assets-src/recipes/fields/models.toml', inputs: ['../../models/heap.gltf', '../../models/tower.glb'] },
];

for (const { recipe, inputs } of RECIPES) {
  for (const seed of [undefined, 2n ** 64n - 3n]) {
    test(`${recipe ?? 'the built-in recipe'} with ${seed === undefined ? 'its own seed' : `seed ${seed}`}`, (t) => {
      const started = performance.now();
      const baked = web(recipe, seed, inputs);
      t.diagnostic(`baked in ${Math.round(performance.now() - started)} ms`);
      assert.deepEqual(baked, native(recipe, seed));
    });
  }
}

test('a recipe that is wrong is told with its place', () => {
  const wrong = (text) => assert.throws.bind(null, () => baker.bake(text, undefined, new Map(), () => {}));
  wrong('[clouds]\nsize = 3\n')(/recipe:2:8: clouds.size is 3, expected a power of two from 64 to 4096/);
  wrong('[cloud]\n')(/recipe:1:2: /);
  wrong('')(/built-in photograph: cannot be read: it was not given/);
});

test('another photograph is not taken for the built-in one', () => {
  const inputs = new Map([[baker.builtInPhoto(), Uint8Array.of(1, 2, 3)]]);
  assert.throws(() => baker.bake('', undefined, inputs, () => {}), /built-in photograph: BLAKE3 is/);
});
