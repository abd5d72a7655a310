// Packs and bakes in the page: dropped, broken, fetched, baked.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { PACK, changedPicture, drop, openBrowser, packFiles, picture } from './page-browser.mjs';
import { makeZip } from './page-zips.mjs';

let browser;
let files;
before(async () => {
  browser = await openBrowser();
  files = await packFiles();
});
after(() => browser.close());

const zip = (list) => [{ name: 'sky.zip', bytes: makeZip(list.map(({ name, bytes }) => ({ name: `sky/${name}`, bytes }))) }];
const sound = (page) => page.waitForSelector('#report[data-sound=true]', { state: 'attached' });
const alert = (page, topic) => page.textContent(`[data-topic=${topic}][role=alert] p`);
const QUIET_404 = /404/;

test('the pack of the page is checked and sound', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await sound(page);
  assert.match(await page.textContent('#report .verdict'), /^Sound: .*\d+ passed/);
  await page.click('#pack-group summary');
  await page.click('#report details:last-child summary');
  assert.ok(await page.locator('.finding.passed [aria-label=passed]').count() > 50);
}));

test('a dropped zip is loaded and checked', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await sound(page);
  const first = await picture(page);
  await drop(page, zip(files));
  await page.waitForSelector('[data-topic=pack][role=status]');
  assert.equal(await page.textContent('#pack-name'), 'sky.zip');
  await sound(page);
  assert.deepEqual(await picture(page), first, 'the same pack is the same sky');
  assert.equal(await page.isVisible('#veil'), false);
}));

test('what hovers over the window raises a veil', () => browser.visit({ search: '?paused=true' }, async (page) => {
  const hover = (type) => page.evaluate((name) => {
    const data = new DataTransfer();
    data.items.add(new File(['x'], 'x.zip'));
    document.body.dispatchEvent(new DragEvent(name, { dataTransfer: data, bubbles: true, cancelable: true }));
  }, type);
  await hover('dragenter');
  assert.equal(await page.isVisible('#veil'), true);
  await hover('dragleave');
  assert.equal(await page.isVisible('#veil'), false);
}));

test('a flipped byte is told, in the message and in the check, and the old sky stays', () => browser.visit({ search: '?paused=true&at=3' }, async (page) => {
  await sound(page);
  const first = await picture(page);
  const broken = files.map(({ name, bytes }) => {
    if (name !== 'clouds.ktx2') return { name, bytes };
    const changed = bytes.slice();
    changed[changed.length >> 1] ^= 1;
    return { name, bytes: changed };
  });
  await drop(page, zip(broken));
  assert.match(await alert(page, 'pack'), /^sky\.zip: .*clouds\.ktx2.*; the sky is as it was$/);
  await page.waitForSelector('#report[data-sound=false]');
  assert.match(await page.textContent('#report .verdict'), /^Not sound: \d+ failed/);
  assert.equal(await page.textContent('#report-of'), 'Check of sky.zip');
  assert.equal(await page.textContent('#pack-name'), 'pack/');
  // Failures first, and open.
  assert.equal(await page.getAttribute('#report .finding', 'data-rule'), 'file-hash');
  assert.match(await page.textContent('#report .finding'), /clouds\.ktx2/);
  assert.deepEqual(await picture(page), first);
  // A sound pack takes the complaint away.
  await drop(page, zip(files));
  await page.waitForSelector('[data-topic=pack][role=status]');
  assert.equal(await page.locator('[role=alert][data-topic=pack]').count(), 0);
  await sound(page);
}));

test('what is no pack is told', () => browser.visit({ search: '?paused=true' }, async (page) => {
  const told = async (list, words) => {
    await page.evaluate(() => document.querySelector('[data-topic=pack]')?.remove());
    await drop(page, list);
    assert.match(await alert(page, 'pack'), words);
  };
  const text = new TextEncoder().encode('PK is how a zip begins, but this is none');
  await told([{ name: 'a.zip', bytes: text }], /a\.zip: this is no zip file/);
  await told([{ name: 'a.txt', bytes: new Uint8Array(3) }], /a\.txt is no pack/);
  await told(zip(files.filter(({ name }) => name !== 'pack.json')), /sky\.zip has no pack\.json/);
  await told(zip(files.filter(({ name }) => name !== 'sun.ktx2')), /sun\.ktx2/);
  const damaged = zip(files);
  damaged[0].bytes[100] ^= 0xff;
  await told(damaged, /sky\.zip: sky\/.* is damaged/);
  const newer = files.map(({ name, bytes }) => (name === 'pack.json' ? { name, bytes: new TextEncoder().encode('{"format": 1}') } : { name, bytes }));
  await told(zip(newer), /pack\.json/);
  await page.waitForSelector('#report .unsound');
  assert.match(await page.textContent('#report'), /Cannot be checked: .*pack\.json/);
}));

test('files that are chosen are loaded as those that are dropped', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await page.click('#pack-group summary');
  await page.setInputFiles('#pack-file', { name: 'chosen.zip', mimeType: 'application/zip', buffer: Buffer.from(zip(files)[0].bytes) });
  await page.waitForFunction(() => document.getElementById('pack-name').textContent === 'chosen.zip');
  await sound(page);
}));

test('a folder is chosen, or dropped as a browser drops it', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await page.click('#pack-group summary');
  await page.setInputFiles('#pack-folder', PACK);
  await page.waitForFunction(() => document.getElementById('pack-name').textContent === 'pack');
  await sound(page);
  await page.evaluate(() => { document.getElementById('pack-name').textContent = ''; });
  const session = await page.context().newCDPSession(page);
  for (const type of ['dragEnter', 'dragOver', 'drop']) {
    await session.send('Input.dispatchDragEvent', { type, x: 200, y: 200, data: { items: [], files: [PACK], dragOperationsMask: 1 } });
  }
  await page.waitForFunction(() => document.getElementById('pack-name').textContent === 'pack');
  await sound(page);
}));

test('a pack is opened by its address, and the address is in the link', () => browser.visit({ search: '?paused=true', expected: QUIET_404 }, async (page) => {
  await page.click('#pack-group summary');
  await page.fill('#pack-url', 'nowhere');
  await page.press('#pack-url', 'Enter');
  assert.match(await alert(page, 'pack'), /nowhere.*pack\.json/);
  await page.fill('#pack-url', './pack');
  await page.press('#pack-url', 'Enter');
  await page.waitForFunction(() => new URLSearchParams(location.search).get('pack') === './pack');
  assert.equal(await page.locator('[role=alert][data-topic=pack]').count(), 0);
  await page.reload();
  await page.waitForFunction(() => document.getElementById('pack-name').textContent === './pack');
}));

test('a wrong address of a pack in the link is told, and there is a sky all the same', () => browser.visit({ search: '?pack=nowhere/&paused=true', expected: QUIET_404 }, async (page) => {
  assert.match(await alert(page, 'pack'), /pack\.json/);
  assert.equal(await page.textContent('#pack-name'), 'pack/');
  await sound(page);
}));

test('another seed is baked here, with progress, and is sound', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await sound(page);
  const first = await picture(page);
  await page.click('#baker-group > summary');
  assert.match(await page.inputValue('#recipe'), /\[clouds/);
  await page.fill('#seed', '7');
  const steps = page.evaluate(() => new Promise((resolve) => {
    const bar = document.getElementById('bake-progress');
    const seen = [];
    new MutationObserver(() => {
      if (bar.hidden && seen.length) resolve(seen);
      else if (bar.hasAttribute('value') && seen.at(-1) !== bar.value) seen.push(bar.value);
    }).observe(bar, { attributes: true });
  }));
  await page.click('#bake');
  const seen = await steps;
  assert.ok(seen.length > 5 && seen.every((value, i) => i === 0 || value > seen[i - 1]), `progress was ${seen}`);
  assert.match(await page.textContent('#bake-text'), /^Baked: /);
  assert.equal(await page.textContent('#pack-name'), 'the baked pack');
  assert.equal(await page.inputValue('#seed'), '7');
  await sound(page);
  await changedPicture(page, first);
}));

test('a wrong recipe is told with its place, and the sky stays', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await sound(page);
  const first = await picture(page);
  await page.click('#baker-group > summary');
  await page.click('#baker summary');
  await page.fill('#recipe', 'name = "x"\n[stars]\ncount = "many"\n');
  await page.click('#bake');
  await page.waitForSelector('#bake-wrong:not([hidden])');
  assert.match(await page.textContent('#bake-wrong'), /:3:\d+: /);
  assert.equal(await page.evaluate(() => document.activeElement.id), 'recipe');
  assert.match(await page.evaluate(() => {
    const { value, selectionStart } = document.getElementById('recipe');
    return value.slice(0, selectionStart);
  }), /\[stars\]\n/);
  await page.fill('#recipe', 'seed = 1');
  await page.fill('#seed', '-3');
  await page.click('#bake');
  assert.match(await page.textContent('#bake-wrong'), /seed is -3, expected a whole number/);
  assert.deepEqual(await picture(page), first);
}));

test('a bake can be cancelled', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await page.click('#baker-group > summary');
  await page.click('#bake');
  await page.click('#cancel-bake');
  await page.waitForFunction(() => /^Cancelled/.test(document.getElementById('bake-text').textContent));
  assert.equal(await page.isEnabled('#bake'), true);
  assert.equal(await page.textContent('#pack-name'), 'pack/');
}));

test('a dropped recipe and a dropped photograph go into the form', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await drop(page, [{ name: 'mine.toml', bytes: new TextEncoder().encode('name = "mine"\n') }]);
  await page.waitForFunction(() => document.getElementById('recipe').value === 'name = "mine"\n');
  const png = await page.screenshot({ clip: { x: 0, y: 0, width: 256, height: 256 } });
  await drop(page, [{ name: 'mine.png', bytes: png }]);
  await page.waitForFunction(() => document.getElementById('recipe').value.includes('[clouds.photo]\nfile = "mine.png"'));
  assert.match(await page.textContent('#photo'), /^mine\.png, /);
  await page.click('#bake');
  await page.waitForFunction(() => /^(Baked|Not baked)/.test(document.getElementById('bake-text').textContent));
  assert.match(await page.textContent('#bake-text'), /^Baked/, await page.textContent('#bake-wrong'));
}));
