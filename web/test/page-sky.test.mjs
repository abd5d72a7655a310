// The page in a browser, as a person uses it: real mouse and keys, on WebGPU and on WebGL2.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { DRAWING, addressHas, changedPicture, compare, frames, inAddress, openBrowser, picture } from './page-browser.mjs';

const METHODS = ['packed', 'octaves', 'fbm', 'lit', 'sprites'];
const NAMES = { webgpu: 'WebGPU', webgl2: 'WebGL2' };

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser.close());

for (const backend of ['webgpu', 'webgl2']) {
  test(`${backend}: every method draws its own sky`, () => browser.visit({ search: `?backend=${backend}&paused=true&at=20` }, async (page) => {
    assert.equal(await page.textContent('#status-backend'), NAMES[backend]);
    const seen = [];
    for (const method of METHODS) {
      await page.click(`#method-${method}`);
      await addressHas(page, { method: method === 'packed' ? null : method });
      const now = seen.length ? await changedPicture(page, seen.at(-1)) : await picture(page);
      const { spread } = await compare(page, now, now);
      assert.ok(spread > 5, `${method} has a spread of ${spread}`);
      for (const other of seen) assert.ok((await compare(page, now, other)).difference > 1, `${method} is like another`);
      seen.push(now);
      const shown = await page.$$eval('[data-group=clouds] .row[data-key]:not([hidden])', (rows) => rows.map((row) => row.dataset.key));
      assert.equal(shown.includes('layers'), method === 'lit');
      assert.equal(shown.includes('domes'), method === 'octaves');
      assert.equal(shown.includes('upper'), method === 'packed' || method === 'sprites');
    }
  }));

  test(`${backend}: sliders moved by mouse and keys change picture and address`, () => browser.visit({ search: `?backend=${backend}&paused=true` }, async (page) => {
    const first = await picture(page);
    const box = await page.locator('#key-cover').boundingBox();
    const middle = box.y + box.height / 2;
    await page.mouse.move(box.x + box.width * 0.6, middle);
    await page.mouse.down();
    for (const share of [0.5, 0.35, 0.2]) await page.mouse.move(box.x + box.width * share, middle);
    await page.mouse.up();
    const cover = Number(await page.inputValue('#key-cover'));
    assert.ok(cover > 0.1 && cover < 0.3, `cover is ${cover}`);
    await addressHas(page, { cover: String(cover) });
    assert.equal(Number(await page.inputValue('.row[data-key=cover] .number')), cover);
    const second = await changedPicture(page, first);

    await page.focus('#key-time');
    for (let i = 0; i < 10; i += 1) await page.keyboard.press('ArrowRight');
    await addressHas(page, { time: '0.6' });
    const third = await changedPicture(page, second);

    // Both are taken back: by the button, and by a double click.
    await page.click('.row[data-key=cover] .reset');
    await page.dblclick('.row[data-key=time] label');
    await addressHas(page, { cover: null, time: null });
    await changedPicture(page, third);
    assert.deepEqual(await picture(page), first);
  }));
}

test('a number can be typed, and a wrong one is told and changes nothing', () => browser.visit({ search: '?paused=true' }, async (page) => {
  const number = page.locator('.row[data-key=cover] .number');
  await number.fill('0.123');
  await number.press('Enter');
  await addressHas(page, { cover: '0.123' });
  await number.fill('7');
  await number.press('Enter');
  assert.equal(await page.textContent('.row[data-key=cover] [role=alert]'), 'cover is "7", expected a number from 0 to 1');
  assert.equal(await number.getAttribute('aria-invalid'), 'true');
  await page.click('#method-fbm');
  await addressHas(page, { method: 'fbm', cover: '0.123' });
}));

test('a weather comes over seconds and is pressed when it is there', () => browser.visit({ search: '?paused=true' }, async (page) => {
  const first = await picture(page);
  const seen = page.evaluate(() => new Promise((resolve) => {
    const number = document.querySelector('.row[data-key=cover] .number');
    const values = [];
    const watch = () => {
      const value = Number(number.value);
      if (values.at(-1) !== value) values.push(value);
      if (value === 0.95) resolve(values);
      else requestAnimationFrame(watch);
    };
    watch();
  }));
  await page.click('[data-weather=storm]');
  const values = await seen;
  assert.deepEqual([values[0], values.at(-1)], [0.6, 0.95]);
  assert.ok(values.length > 3 && values.every((value, i) => i === 0 || value > values[i - 1]), `went by ${values}`);
  await page.waitForSelector('[data-weather=storm][aria-pressed=true]');
  await addressHas(page, { cover: '0.95', rain: '0.7', flashes: '10' });
  await changedPicture(page, first);
}));

test('a link restores the settings and the picture exactly', async () => {
  const pairs = { method: 'lit', cover: '0.437', layers: 'cumulus:0.7:1.3:36:18,cirrus:0.3:6.2:-40:12.5', k1: '0.31', sky: 'perez', cie: '12', time: '0.31', at: '123.25', azimuth: '77.5', fov: '48', rays: '0.5' };
  let [link, before_] = ['', null];
  await browser.visit({ search: `?${new URLSearchParams({ ...pairs, paused: 'true' })}` }, async (page) => {
    before_ = await picture(page);
    await page.click('#copy-link');
    await page.waitForSelector('[data-topic=copy][role=status]');
    link = await page.evaluate(() => navigator.clipboard.readText());
    });
  const has = new URL(link).searchParams;
  for (const [name, text] of Object.entries(pairs)) assert.equal(has.get(name), text, name);
  await browser.visit({ search: new URL(link).search }, async (page) => {
    assert.deepEqual(await picture(page), before_);
    assert.equal(await page.evaluate(() => location.search), new URL(link).search);
  });
});

test('a palette does not undo a colour in its link', async () => {
  const shaded = '.row[data-key=shaded] .field';
  let stormy = '';
  await browser.visit({ search: '?method=fbm&palette=stormy&paused=true' }, async (page) => { stormy = await page.inputValue(shaded); });
  await browser.visit({ search: '?method=fbm&lit=0.1,0.2,0.9&palette=stormy&paused=true' }, async (page) => {
    await addressHas(page, { lit: '0.1,0.2,0.9', shaded: stormy });
    assert.equal(await page.inputValue(shaded), stormy);
  });
});

test('what is wrong in a link is told, and the rest counts', () => browser.visit({ search: '?covr=1&height=7&density=0.75&paused=true' }, async (page) => {
  const told = await page.textContent('[data-topic=link][role=alert] p');
  assert.match(told, /there is no setting "covr"; did you mean "cover"\?/);
  assert.match(told, /height is "7", expected a number from 0 to 1/);
  await addressHas(page, { covr: null, height: null, density: '0.75' });
  await page.click('[data-topic=link] [aria-label=Close]');
  assert.equal(await page.locator('[data-topic=link]').count(), 0);
}));

test('one looks around by mouse, wheel and keys, and flies among sprites', () => browser.visit({ search: '?method=sprites&paused=true' }, async (page) => {
  await page.mouse.move(300, 300);
  await page.mouse.down();
  await page.mouse.move(220, 330, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => Number(new URLSearchParams(location.search).get('azimuth')) > 180);
  assert.ok(await inAddress(page, 'elevation') > 25);
  await page.mouse.wheel(0, -300);
  await page.waitForFunction(() => Number(new URLSearchParams(location.search).get('fov') ?? 60) < 50);

  await page.focus('#view');
  const azimuth = await inAddress(page, 'azimuth');
  await page.keyboard.down('ArrowLeft');
  await page.waitForFunction((from) => Number(new URLSearchParams(location.search).get('azimuth')) < from - 2, azimuth);
  await page.keyboard.up('ArrowLeft');
  await page.keyboard.down('w');
  await page.waitForFunction(() => Number(new URLSearchParams(location.search).get('up')) > 1.7);
  await page.keyboard.up('w');
  // The sky stands again when no key is held.
  const still = await picture(page);
  await frames(page, 5);
  assert.deepEqual(await picture(page), still);
}));

test('H folds the panel away, keys choose the method, and ? tells them', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await page.keyboard.press('h');
  assert.equal(await page.isVisible('#six'), false);
  assert.equal(await page.getAttribute('#fold', 'aria-expanded'), 'false');
  await page.keyboard.press('h');
  assert.equal(await page.isVisible('#six'), true);
  await page.keyboard.press('4');
  await addressHas(page, { method: 'lit' });
  await page.keyboard.press('?');
  assert.equal(await page.isVisible('#keys'), true);
  await page.keyboard.press('Escape');
  assert.equal(await page.isVisible('#keys'), false);
  await page.click('#keys-button');
  await page.click('#keys button');
  assert.equal(await page.isVisible('#keys'), false);
  await page.focus('#view');
  for (const playing of ['true', 'false']) {
    await page.keyboard.press('Space');
    assert.equal(await page.getAttribute('#play', 'aria-pressed'), playing);
  }
  // What is typed into a text is no command.
  await page.click('#pack-group summary');
  await page.fill('#pack-url', '');
  await page.type('#pack-url', 'h1?');
  assert.equal(await page.inputValue('#pack-url'), 'h1?');
  assert.equal(await page.isVisible('#six'), true);
}));

test('layers are added, changed and taken away', () => browser.visit({ search: '?method=lit&layers=cumulus:0.5:1&paused=true' }, async (page) => {
  const rows = page.locator('.layers li');
  assert.equal(await rows.count(), 1);
  assert.equal(await page.isDisabled('[aria-label="Remove layer 1"]'), true);
  await page.click('text=Add a layer');
  // The panel shows it with the next frame.
  await rows.nth(1).waitFor();
  assert.equal(await rows.count(), 2);
  await rows.nth(1).locator('select').selectOption('cirrus');
  await page.waitForFunction(() => /cumulus:0.5:1:36:18,cirrus:0.5:/.test(new URLSearchParams(location.search).get('layers')));
  await rows.nth(0).locator('input[type=range]').focus();
  await page.keyboard.press('ArrowLeft');
  await page.waitForFunction(() => new URLSearchParams(location.search).get('layers').startsWith('cumulus:0.49:1:'));
  await page.click('[aria-label="Remove layer 1"]');
  await page.waitForFunction(() => new URLSearchParams(location.search).get('layers').startsWith('cirrus:'));
}));

test('without motion wanted the sky stands until a person lets it go, and weathers come at once', () => browser.visit({ calm: true }, async (page) => {
  assert.equal(await page.getAttribute('#play', 'aria-pressed'), 'false');
  const first = await picture(page);
  await frames(page, 10);
  assert.deepEqual(await picture(page), first);
  await page.click('[data-weather=overcast]');
  await frames(page, 3);
  assert.equal(await page.inputValue('.row[data-key=cover] .number'), '1');
  const second = await changedPicture(page, first);
  // Fast clouds, so that a few frames are enough.
  await page.fill('.row[data-key=speed] .number', '1');
  await page.press('.row[data-key=speed] .number', 'Enter');
  await page.click('#play');
  assert.equal(await page.getAttribute('#play', 'aria-pressed'), 'true');
  const third = await changedPicture(page, second);
  await changedPicture(page, third);
  await page.click('#play');
  const last = await picture(page);
  await frames(page, 10);
  assert.deepEqual(await picture(page), last);
}));

test('the picture is saved and the command copied', () => browser.visit({ search: '?method=octaves&cover=0.5&paused=true', size: [640 + 260, 400] }, async (page) => {
  const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
  assert.equal(download.suggestedFilename(), 'sky.png');
  const { readFile } = await import('node:fs/promises');
  const png = await readFile(await download.path());
  assert.deepEqual([png.readUInt32BE(16), png.readUInt32BE(20)], [900, 400]);
  const shown = await picture(page);
  const wide = await compare(page, png, png);
  assert.ok(wide.spread > 5, `the saved picture has a spread of ${wide.spread}`);
  assert.ok((await compare(page, shown, shown)).spread > 5);
  await page.click('#copy-command');
  await page.waitForSelector('[data-topic=copy][role=status]');
  const command = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(command, /^welkin-view render PACK -o sky\.png .*--method octaves/);
  assert.match(command, /--cover 0\.5/);
}));

test('the line at the bottom tells what draws and what it weighs', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await page.waitForFunction(() => document.getElementById('status-download').textContent);
  const line = await page.textContent('#status');
  assert.match(line, /Web(GPU|GL2)/);
  assert.match(line, /textures [\d.]+ (kB|MB)/);
  assert.match(line, /pack [\d.]+ (kB|MB)/);
  assert.match(line, /download [\d.]+ (kB|MB)/);
  assert.match(line, /first frame \d+ ms/);
}));

test('a lost WebGL context is said, and the sky made anew', () => browser.visit({ search: '?backend=webgl2&method=lit&paused=true&at=5', expected: /context|CONTEXT/i }, async (page) => {
  const first = await picture(page);
  const lose = () => page.evaluate(() => {
    const canvas = document.querySelector('#view canvas');
    canvas.dataset.old = 'true';
    canvas.getContext('webgl2').getExtension('WEBGL_lose_context').loseContext();
  });
  const isNew = () => page.waitForFunction(() => document.querySelectorAll('#view canvas').length === 1 && !document.querySelector('#view canvas[data-old]'));
  for (let i = 0; i < 3; i += 1) {
    await lose();
    await isNew();
    await page.waitForSelector('[data-topic=device][role=status]');
    assert.match(await page.textContent('[data-topic=device]'), /made anew/);
    assert.deepEqual(await picture(page), first);
  }
  // That often is no accident: then it is left to the person.
  await lose();
  await page.click('[data-topic=device][role=alert] >> text=Try again');
  await isNew();
  assert.deepEqual(await picture(page), first);
  assert.equal(await page.locator('[role=alert].error').count(), 0);
}));

test('a lost WebGPU device is said, and the sky made anew', () => browser.visit({ search: '?backend=webgpu&method=lit&paused=true&at=5', expected: /external Instance|device|GPU/i }, async (page) => {
  const first = await picture(page);
  await page.evaluate(() => { document.querySelector('#view canvas').dataset.old = 'true'; });
  // The process that draws dies, as by a driver that fails.
  const session = await page.context().browser().newBrowserCDPSession();
  await session.send('Browser.crashGpuProcess');
  await page.waitForFunction(() => document.querySelectorAll('#view canvas').length === 1 && !document.querySelector('#view canvas[data-old]'));
  await page.waitForSelector('[data-topic=device][role=status]');
  assert.match(await page.textContent('[data-topic=device]'), /made anew/);
  assert.equal(await page.textContent('#status-backend'), 'WebGPU');
  const { difference } = await compare(page, await picture(page), first);
  assert.ok(difference < 1, `they differ by ${difference}`);
}));

test('where WebGPU is lost again and again, WebGL2 goes on', async () => {
  // Of its own: a browser gives up where what draws dies often, and keeps WebGL from a page that it died under.
  const frail = await openBrowser({ flags: [...DRAWING, '--disable-gpu-process-crash-limit', '--disable-domain-blocking-for-3d-apis'] });
  try {
    await frail.visit({ search: '?method=lit&paused=true&at=5', expected: /external Instance|device|GPU|gpu/i }, async (page) => {
      assert.equal(await page.textContent('#status-backend'), 'WebGPU');
      const first = await picture(page);
      const session = await page.context().browser().newBrowserCDPSession();
      for (let i = 0; i < 2; i += 1) {
        await page.evaluate(() => { document.querySelector('#view canvas').dataset.old = 'true'; });
        await session.send('Browser.crashGpuProcess');
        await page.waitForFunction(() => document.querySelectorAll('#view canvas').length === 1 && !document.querySelector('#view canvas[data-old]'));
      }
      assert.equal(await page.textContent('#status-backend'), 'WebGL2');
      assert.match(await page.textContent('[data-topic=device]'), /made anew, with WebGL2/);
      assert.equal(await page.locator('[role=alert].error').count(), 0);
      // The browser's own process comes up again and shows it.
      const until = Date.now() + 60_000;
      let difference = Infinity;
      while (difference >= 1) {
        assert.ok(Date.now() < until, `they differ by ${difference}`);
        ({ difference } = await compare(page, await picture(page), first));
      }
    });
  } finally {
    await frail.close();
  }
});

test('another backend can be chosen, with the same sky', () => browser.visit({ search: '?backend=webgl2&cover=0.5&at=9&paused=true' }, async (page) => {
  const first = await picture(page);
  await page.click('#graphics-group summary');
  await page.selectOption('#backend', 'webgpu');
  await page.waitForFunction(() => document.getElementById('status-backend').textContent === 'WebGPU');
  await addressHas(page, { backend: 'webgpu', cover: '0.5' });
  const { difference } = await compare(page, await picture(page), first);
  assert.ok(difference < 1, `they differ by ${difference}`);
}));

test('a backend that there is not is told, and another one draws', () => browser.visit({ search: '?backend=glide&paused=true' }, async (page) => {
  assert.match(await page.textContent('[role=alert][data-topic=backend] p'), /backend is "glide", expected auto, webgpu or webgl2/);
  assert.match(await page.textContent('#status-backend'), /WebGPU|WebGL2/);
  await addressHas(page, { backend: null });
}));

test('where nothing draws, the page says so', async () => {
  const bare = await openBrowser({ flags: ['--disable-gpu', '--disable-3d-apis', '--disable-features=WebGPU'] });
  try {
    await bare.visit({ drawn: false, expected: /WebGL|WebGPU|adapters/i }, async (page) => {
      const told = await page.textContent('[role=alert][data-topic=start] p');
      assert.match(told, /^The sky cannot be drawn: .*(WebGL2|webgl2)/i);
      assert.equal(await page.isVisible('#panel'), false);
    });
  } finally {
    await bare.close();
  }
});
