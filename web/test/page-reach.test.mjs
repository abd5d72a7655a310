// Who reaches the page: small screens, fingers, keyboards.

import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { addressHas, changedPicture, openBrowser, picture } from './page-browser.mjs';

let browser;
before(async () => { browser = await openBrowser(); });
after(() => browser.close());

const PHONE = { size: [360, 740], touch: true };
const unfold = async (page) => {
  await page.tap('#fold');
  await page.waitForSelector('#six', { state: 'visible' });
};

test('on a phone nothing is wider than the screen, whatever is open', () => browser.visit({ ...PHONE, search: '?paused=true&sky=perez&perez=-1,-0.3,10,-3,0.4' }, async (page) => {
  assert.equal(await page.isVisible('#six'), false, 'the sheet is folded at first');
  await unfold(page);
  await page.$$eval('#body details', (all) => all.forEach((one) => { one.open = true; }));
  for (const method of ['packed', 'octaves', 'fbm', 'lit', 'sprites']) {
    await page.click(`#method-${method}`);
    await addressHas(page, { method: method === 'packed' ? null : method });
    const wide = await page.evaluate(() => ({
      page: document.documentElement.scrollWidth, body: document.getElementById('body').scrollWidth,
      beyond: [...document.querySelectorAll('#panel *')].filter((one) => one.checkVisibility() && !one.closest('.unseen, textarea, select') && one.getBoundingClientRect().right > 360.5).map((one) => one.outerHTML.slice(0, 90)),
    }));
    assert.deepEqual(wide, { page: 360, body: 360, beyond: [] }, method);
  }
}));

test('on a phone what one taps is large enough', () => browser.visit({ ...PHONE, search: '?paused=true&method=lit&cover=0.3' }, async (page) => {
  await unfold(page);
  await page.$$eval('#body details', (all) => all.forEach((one) => { one.open = true; }));
  const small = await page.$$eval('#panel :is(button, select, summary, .button, input:not(.unseen, [type=checkbox]))', (all) => all
    .filter((one) => one.checkVisibility({ visibilityProperty: true }))
    .map((one) => [one.id || one.outerHTML.slice(0, 90), one.getBoundingClientRect().height])
    .filter(([, height]) => height < 38));
  assert.deepEqual(small, []);
}));

test('on a phone a slider is moved by a finger, and the sky is seen meanwhile', () => browser.visit({ ...PHONE, search: '?paused=true&cover=1' }, async (page) => {
  await unfold(page);
  const first = await picture(page);
  await page.locator('#key-cover').scrollIntoViewIfNeeded();
  const box = await page.locator('#key-cover').boundingBox();
  await page.touchscreen.tap(box.x + box.width * 0.15, box.y + box.height / 2);
  await page.waitForFunction(() => Number(new URLSearchParams(location.search).get('cover') ?? 1) < 0.3);
  await changedPicture(page, first);
  const sheet = await page.locator('#panel').boundingBox();
  assert.ok(sheet.y > 740 * 0.4 && Math.abs(sheet.y + sheet.height - 740) < 1, `the sheet is at ${sheet.y}`);
}));

test('Tab reaches every control in order, and the focus is seen', () => browser.visit({ search: '?paused=true&method=lit', size: [900, 700] }, async (page) => {
  await page.$$eval('#body details', (all) => all.forEach((one) => { one.open = true; }));
  const wanted = await page.evaluate(() => {
    const all = [...document.querySelectorAll('#view, #panel :is(button, select, input, textarea, summary)')]
      .filter((one) => one.checkVisibility({ visibilityProperty: true }) && !one.disabled)
      // Of a group of radio buttons, Tab reaches the one that is chosen.
      .filter((one) => one.type !== 'radio' || one.checked);
    all.forEach((one, i) => { one.dataset.reach = String(i); });
    return all.length;
  });
  assert.ok(wanted > 60, `there are ${wanted}`);
  const reached = [];
  const unseen = [];
  for (let i = 0; i < wanted + 10; i += 1) {
    await page.keyboard.press('Tab');
    const now = await page.evaluate(() => {
      const one = document.activeElement;
      const ring = [one, one.nextElementSibling, one.parentElement].some((shown) => shown && getComputedStyle(shown).outlineStyle !== 'none');
      return { reach: one.dataset?.reach, ring, what: one.id || one.outerHTML.slice(0, 80) };
    });
    if (now.reach === undefined) continue;
    if (reached.includes(Number(now.reach))) break;
    reached.push(Number(now.reach));
    if (!now.ring) unseen.push(now.what);
  }
  assert.deepEqual(reached, Array.from({ length: wanted }, (_, i) => i));
  assert.deepEqual(unseen, [], 'without a ring around them');
}));

test('every control has a name', () => browser.visit({ search: '?paused=true&method=lit&sky=perez' }, async (page) => {
  await page.$$eval('#body details', (all) => all.forEach((one) => { one.open = true; }));
  const nameless = await page.$$eval('#panel :is(button, select, input, textarea)', (all) => all
    .filter((one) => one.checkVisibility() && !one.labels?.length && !one.textContent.trim() && !one.getAttribute('aria-label') && !one.getAttribute('aria-labelledby'))
    .map((one) => one.outerHTML.slice(0, 90)));
  assert.deepEqual(nameless, []);
  const ids = await page.$$eval('[id]', (all) => all.map((one) => one.id));
  assert.equal(new Set(ids).size, ids.length, 'ids are unique');
}));

test('the method is chosen by arrow keys', () => browser.visit({ search: '?paused=true' }, async (page) => {
  await page.focus('#method-packed');
  await page.keyboard.press('ArrowRight');
  await addressHas(page, { method: 'octaves' });
  await page.keyboard.press('ArrowRight');
  await addressHas(page, { method: 'fbm' });
}));

test('two fingers zoom, one looks around', () => browser.visit({ ...PHONE, search: '?paused=true' }, async (page) => {
  const session = await page.context().newCDPSession(page);
  const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  await touch('touchStart', [150, 200], [210, 200]);
  await touch('touchMove', [120, 200], [240, 200]);
  await touch('touchEnd');
  // Twice as far apart is half of the view.
  await page.waitForFunction(() => new URLSearchParams(location.search).has('fov'));
  const fov = await page.evaluate(() => Number(new URLSearchParams(location.search).get('fov')));
  assert.ok(Math.abs(fov - 30) < 1, `the view is ${fov} degrees`);
  await touch('touchStart', [180, 200]);
  await touch('touchMove', [120, 240]);
  await touch('touchEnd');
  await page.waitForFunction(() => {
    const has = new URLSearchParams(location.search);
    return Number(has.get('azimuth')) > 180 && Number(has.get('elevation')) > 25;
  });
}));
