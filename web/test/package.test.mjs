// The package `welkin`: from another origin, through a bundler, as an element, and with three.js.

import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { compare, openBrowser, serve } from './page-browser.mjs';
import { ROOT, SITE, VIEW } from './places.mjs';

const MODULES = join(ROOT, 'web/node_modules');
/** Bakes in a moment: nothing is larger than it has to be. */
const RECIPE = '[clouds]\nsize = 64\n[clouds.photo]\nfile = "../photos/clouds-web.jpg"\n[fbm]\nsize = 64\n[layers]\nsize = 64\n[sprites]\nsize = 128\n';

let [browser, folder, own] = [null, null, null];
const closing = [];
before(async () => {
  execFileSync(join(ROOT, 'scripts/npm-package'));
  browser = await openBrowser();
  closing.push(() => browser.close());
  folder = mkdtempSync(join(tmpdir(), 'welkin-package-'));
  closing.push(() => rmSync(folder, { recursive: true }));
  writeFileSync(join(folder, 'index.html'), '<!doctype html><link rel="icon" href="data:,"><script type="importmap">{"imports":{"three":"/three/three.module.js"}}</script><body style="margin:0"></body>');
  own = await serve(folder, { mounts: { welkin: join(ROOT, 'out/npm'), pack: join(SITE, 'pack'), three: join(MODULES, 'three/build'), jsm: join(MODULES, 'three/examples/jsm') } });
  closing.push(() => own.close());
});
after(async () => { for (const close of closing) await close(); });

/** An empty page of our own server. */
const visit = (work, options = {}) => browser.visit({ at: own.address, drawn: false, ...options }, work);

test('from another origin it draws, and its baker bakes', async () => {
  const far = await serve(join(ROOT, 'out/npm'), { mounts: { pack: join(SITE, 'pack') }, shared: true });
  try {
    assert.notEqual(new URL(far.address).origin, new URL(own.address).origin);
    await visit(async (page) => {
      const told = await page.evaluate(async ([address, recipe]) => {
        const { bake, createSky } = await import(`${address}welkin.js`);
        const canvas = document.body.appendChild(document.createElement('canvas'));
        const sky = await createSky(canvas, `${address}pack/`, { backend: 'webgl2' });
        sky.draw();
        const picture = canvas.toDataURL().length;
        const files = await bake(recipe, { seed: 7 }).catch((error) => error.message);
        return { picture, files: files instanceof Map ? [...files.keys()] : files };
      }, [far.address, RECIPE]);
      assert.ok(told.picture > 10_000, `${told.picture}`);
      assert.ok(Array.isArray(told.files) && told.files.includes('pack.json'), String(told.files));
    });
  } finally {
    await far.close();
  }
});

test('an element draws, takes its attributes, and tells what is wrong', () => visit(async (page) => {
  const told = await page.evaluate(async () => {
    await import('/welkin/element.js');
    const element = document.createElement('welkin-sky');
    const heard = (name) => new Promise((resolve) => { element.addEventListener(name, (event) => { event.preventDefault(); resolve(event.message ?? ''); }, { once: true }); });
    for (const [name, value] of [['pack', '/pack/'], ['method', 'lit'], ['time', '0.7'], ['paused', ''], ['backend', 'webgl2']]) element.setAttribute(name, value);
    element.style.cssText = 'width: 320px; height: 180px';
    const opened = heard('open');
    document.body.append(element);
    await opened;
    const values = () => { const { method, time, cover } = element.sky.get(); return { method, time, cover }; };
    const first = values();
    element.setAttribute('cover', '0.9');
    element.removeAttribute('time');
    await new Promise(requestAnimationFrame);
    const second = values();
    const wrong = heard('error');
    element.setAttribute('cover', '7');
    const message = await wrong;
    const { width } = element.shadowRoot.querySelector('canvas');
    const missing = heard('error');
    element.removeAttribute('pack');
    return { first, second, message, width, missing: await missing };
  });
  assert.deepEqual([told.first.method, told.first.time], ['lit', '0.7']);
  assert.equal(told.second.cover, '0.9');
  assert.notEqual(told.second.time, '0.7');
  assert.match(told.message, /cover is "7", expected/);
  assert.equal(told.width, 320);
  assert.match(told.missing, /attribute "pack"/);
}));

test('an element whose device is lost goes on, with its settings', () => visit(async (page) => {
  const told = await page.evaluate(async () => {
    await import('/welkin/element.js');
    document.body.innerHTML = '<welkin-sky pack="/pack/" backend="webgl2" paused cover="0.75" style="width:64px;height:36px"></welkin-sky>';
    const element = document.querySelector('welkin-sky');
    const opened = () => new Promise((resolve) => { element.addEventListener('open', resolve, { once: true }); });
    await opened();
    element.sky.set({ azimuth: 77 });
    const again = opened();
    element.shadowRoot.querySelector('canvas').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext();
    await again;
    return element.sky.get();
  });
  assert.deepEqual([told.cover, told.azimuth], ['0.75', '77']);
}, { expected: /context|CONTEXT/i }));

test('after two losses of WebGPU it is WebGL2, but only where nobody chose', () => visit(async (page) => {
  const tried = await page.evaluate(async () => {
    const { createLosses } = await import('/welkin/losses.js');
    const after = (wanted, drew, times) => {
      const losses = createLosses(() => times[0]);
      return times.splice(0).map((time) => { times[0] = time; return losses.next(wanted, drew); });
    };
    return [after('auto', 'webgpu', [0, 1]), after('webgpu', 'webgpu', [0, 1, 2, 3]), after('auto', 'webgl2', [0, 100_000, 200_000, 300_000])];
  });
  assert.deepEqual(tried, [[['auto', 'webgl2'], ['webgl2']], [['webgpu'], ['webgpu'], ['webgpu'], []], [['auto'], ['auto'], ['auto'], ['auto']]]);
}));

test('with three.js the sky stands where its camera looks, and is a cube', () => visit(async (page) => {
  const pictures = await page.evaluate(async () => {
    const [THREE, { createSky }, { cubeTexture, follow }] = await Promise.all(['/three/three.module.js', '/welkin/welkin.js', '/welkin/three.js'].map((module) => import(module)));
    const [ours, theirs] = [0, 1].map(() => Object.assign(document.createElement('canvas'), { width: 256, height: 256 }));
    const sky = await createSky(ours, '/pack/', { backend: 'webgl2', settings: { method: 'octaves', cover: 0.4, flare: 0, time: 0.62 } });
    const renderer = new THREE.WebGLRenderer({ canvas: theirs, preserveDrawingBuffer: true });
    renderer.setSize(256, 256, false);
    const scene = new THREE.Scene();
    scene.background = await cubeTexture(THREE, sky, ours);
    const pairs = [];
    for (const [x, y, z] of [[0, 0.3, -1], [1, 0.4, 0.2], [-1, 0.1, 0.1], [-0.2, 0.5, 1], [0.3, 1, -0.4]]) {
      const camera = new THREE.PerspectiveCamera(50, 1);
      camera.lookAt(x, y, z);
      renderer.render(scene, camera);
      follow(sky, camera).draw();
      pairs.push([ours, theirs].map((canvas) => canvas.toDataURL().split(',')[1]));
    }
    // What a scene is lit by can be made of it.
    const light = new THREE.PMREMGenerator(renderer).fromCubemap(scene.background);
    return { pairs, light: light.texture.isTexture };
  });
  assert.ok(pictures.light);
  for (const [ours, theirs] of pictures.pairs) {
    const { difference } = await compare(page, Buffer.from(ours, 'base64'), Buffer.from(theirs, 'base64'));
    // Of a byte: 256 texels across 90 degrees are less sharp than the picture.
    assert.ok(difference < 5, `they differ by ${difference}`);
  }
}));

test('a panorama of ours lies in three.js as docs/engines says', async () => {
  const settings = { method: 'octaves', cover: 0.45, time: 0.62 };
  const options = Object.entries(settings).flatMap(([name, value]) => [`--${name}`, String(value)]);
  execFileSync(VIEW, ['render', join(SITE, 'pack'), '-o', join(folder, 'sky.hdr'), '--equirect', '512', '--azimuth', '90', ...options]);
  await visit(async (page) => {
    const alike = await page.evaluate(async (values) => {
      const [THREE, { HDRLoader }, { createSky }, { follow }] = await Promise.all(['three', '/jsm/loaders/HDRLoader.js', '/welkin/welkin.js', '/welkin/three.js'].map((module) => import(module)));
      const [ours, theirs] = [0, 1].map(() => Object.assign(document.createElement('canvas'), { width: 96, height: 96 }));
      const sky = await createSky(ours, '/pack/', { backend: 'webgl2', settings: { ...values, flare: 0 } });
      const renderer = new THREE.WebGLRenderer({ canvas: theirs, preserveDrawingBuffer: true });
      renderer.toneMapping = THREE.AgXToneMapping;
      renderer.setSize(96, 96, false);
      const texture = await new HDRLoader().loadAsync('/sky.hdr');
      texture.mapping = THREE.EquirectangularReflectionMapping;
      const scene = new THREE.Scene();
      scene.background = texture;
      const brightness = (canvas) => {
        const flat = new OffscreenCanvas(96, 96).getContext('2d');
        flat.drawImage(canvas, 0, 0);
        const { data } = flat.getImageData(0, 0, 96, 96);
        return Array.from({ length: 96 * 96 }, (_, i) => data[4 * i] + data[4 * i + 1] + data[4 * i + 2]);
      };
      const correlation = (a, b) => {
        const mean = (list) => list.reduce((sum, v) => sum + v, 0) / list.length;
        const [ma, mb] = [mean(a), mean(b)];
        const dot = (f) => a.reduce((sum, _, i) => sum + f(i), 0);
        return dot((i) => (a[i] - ma) * (b[i] - mb)) / Math.sqrt(dot((i) => (a[i] - ma) ** 2) * dot((i) => (b[i] - mb) ** 2));
      };
      return [[0, 0.3, -1], [1, 0.4, 0.2], [-1, 0.3, 0.1], [-0.2, 0.5, 1], [0.3, 1, -0.4]].map((way) => {
        const camera = new THREE.PerspectiveCamera(50, 1);
        camera.lookAt(...way);
        renderer.render(scene, camera);
        follow(sky, camera).draw();
        return correlation(brightness(ours), brightness(theirs));
      });
    }, settings);
    // The tone curves are not the same, and 512 texels around blur an edge.
    assert.ok(alike.every((share) => share > 0.9), alike.join(' '));
  });
});

test('packed, installed and bundled by Vite it draws and bakes', async () => {
  const project = join(folder, 'vite');
  mkdirSync(join(project, 'node_modules'), { recursive: true });
  const [{ filename }] = JSON.parse(execFileSync('npm', ['pack', join(ROOT, 'out/npm'), '--json'], { cwd: folder }));
  execFileSync('tar', ['xzf', filename], { cwd: folder });
  cpSync(join(folder, 'package'), join(project, 'node_modules/welkin'), { recursive: true });
  cpSync(join(SITE, 'pack'), join(project, 'public/pack'), { recursive: true });
  writeFileSync(join(project, 'index.html'), '<link rel="icon" href="data:,"><welkin-sky pack="pack/" backend="webgl2" paused style="width:96px;height:54px"></welkin-sky><script type="module" src="main.js"></script>');
  writeFileSync(join(project, 'main.js'), `import 'welkin/element';\nimport { bake } from 'welkin';\nwindow.bake = bake;\ndocument.querySelector('welkin-sky').addEventListener('open', () => { window.opened = true; });\n`);
  execFileSync(join(MODULES, '.bin/vite'), ['build', '--logLevel', 'error'], { cwd: project });
  const built = await serve(join(project, 'dist'));
  try {
    await visit(async (page) => {
      await page.waitForFunction(() => window.opened || document.querySelector('welkin-sky').sky !== null);
      const files = await page.evaluate(async (recipe) => [...(await window.bake(recipe, { seed: 7 })).keys()], RECIPE);
      assert.ok(files.includes('pack.json'));
    }, { at: built.address });
  } finally {
    await built.close();
  }
});

test('every file that a module of the package imports is in it', () => {
  const files = JSON.parse(execFileSync('npm', ['pack', join(ROOT, 'out/npm'), '--json', '--dry-run']))[0].files.map(({ path }) => path);
  for (const file of files.filter((name) => name.endsWith('.js'))) {
    const text = readFileSync(join(ROOT, 'out/npm', file), 'utf8');
    for (const [, name] of text.matchAll(/(?:from |import |new URL\()'\.\/([^']+)'/g)) assert.ok(files.includes(name), `${file}: ${name}`);
  }
});
