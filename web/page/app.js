// The page: puts the sky, the panel and the address together.

import { bake, check, controls, createSky, fetchPack } from './welkin.js';
import { copyText, saveBlob, watchShortcuts } from './actions.js';
import { watchBaker } from './baker.js';
import { watchCamera } from './camera.js';
import { showNoReport, showReport } from './check.js';
import { byId, bytesText, el, reason } from './dom.js';
import { chosen, watchDrops } from './drop.js';
import { readLink, throttled, writeLink } from './link.js';
import { createClock, createLoop } from './loop.js';
import { complain, settle, tell } from './message.js';
import { buildPanel, isNarrow } from './panel.js';
import { createStage } from './stage.js';
import { showBackend, showFirstFrame, showFrameTime, showPack, showSizes } from './status.js';

const USUAL_PACK = 'pack/';
/** How long a weather takes to become another. */
const BLEND_S = 4;
/** How often numbers that move by themselves are shown. */
const SHOW_S = 0.1;

const calm = matchMedia('(prefers-reduced-motion: reduce)');
const { own, pairs } = readLink(location.search);
const view = byId('view');
let playing = own.paused === undefined ? !calm.matches : own.paused === 'false';
let [panel, baker, camera] = [null, null, null];
let unshown_s = Infinity;

const clock = createClock();
const loop = createLoop((seconds) => {
  const { sky } = stage;
  const keys = camera.held();
  if (keys) sky.pilot(keys, seconds);
  sky.advance(seconds, { time: playing });
  try {
    stage.draw();
  } catch (error) {
    complain('draw', reason(error));
    return false;
  }
  clock.add(seconds);
  unshown_s += seconds;
  if (unshown_s >= SHOW_S) show();
  if (keys) written();
  return playing || sky.blending || keys !== null;
});

const stage = createStage(view, createSky, {
  opened: (sky) => showBackend(sky.info),
  lost: (why) => tell('device', `${why} The sky is being made anew.`),
  back() {
    tell('device', 'The graphics device was lost; the sky was made anew.');
    changed();
  },
  gone(why) {
    loop.stop();
    const again = el('button', { type: 'button', class: 'small', on: { click: () => attempt('device', async () => { await stage.again(); changed(); }) } }, 'Try again');
    complain('device', `The graphics device is gone: ${why}`, again);
  },
});

/** The settings have changed: a new picture, and a new address. */
function changed() {
  unshown_s = Infinity;
  loop.wake();
  written();
}

function show() {
  const { sky } = stage;
  unshown_s = 0;
  showFrameTime(playing ? clock.median() : null);
  panel.show({ values: sky.get(), applies: new Set(sky.applies()), changed: new Set(sky.changes().map(([name]) => name)), weather: sky.weather() });
}

/** The address of what is seen. A moment that moves on is no part of it, unless it is asked for. */
function address(moment) {
  const told = stage.sky.changes().filter(([name]) => moment || !playing || name !== 'at');
  const paused = playing === !calm.matches ? '' : String(!playing);
  return writeLink({ pack: own.pack, backend: own.backend, paused }, told);
}
const written = throttled(() => history.replaceState(null, '', address(false) || location.pathname), 250);

/** Does something that may fail, and says so; tells whether it went well. */
async function attempt(topic, work) {
  settle(topic);
  try {
    await work();
    return true;
  } catch (error) {
    complain(topic, reason(error));
    return false;
  }
}

const change = {
  layers: null,
  set(name, text) {
    try {
      stage.sky.set({ [name]: text });
    } catch (error) {
      return reason(error);
    }
    changed();
    return null;
  },
  reset(name) {
    stage.sky.reset(name);
    changed();
  },
  preset(name) {
    stage.sky.preset(name, calm.matches ? 0 : BLEND_S);
    changed();
  },
};

function play(on) {
  playing = on;
  const button = byId('play');
  button.setAttribute('aria-pressed', String(on));
  button.title = on ? 'Let the clouds stand still (Space)' : 'Let the clouds move (Space)';
  if (stage.sky) changed();
}

/** Settings from the address. Those that are wrong are told and left out. */
function restore() {
  const wrong = [];
  const good = pairs.filter(([name, text]) => {
    const problem = change.set(name, text);
    if (problem !== null) wrong.push(problem);
    return problem === null;
  });
  // Together, so that none undoes another.
  stage.sky.reset();
  if (good.length) stage.sky.set(Object.fromEntries(good));
  if (wrong.length) complain('link', `In the address, ${wrong.join('; ')}`);
}

/** Draws another pack and shows its check. The sky stays as it is if the pack is not sound. */
async function loadPack(files, name) {
  try {
    await stage.load(files);
  } catch (error) {
    try {
      showReport(byId('report'), check(files));
    } catch (cause) {
      showNoReport(byId('report'), `Cannot be checked: ${reason(cause)}`);
    }
    byId('pack-group').open = true;
    throw new Error(`${name}: ${reason(error)} The sky is as it was.`, { cause: error });
  }
  aboutPack(name);
  changed();
}

function aboutPack(name) {
  showPack(stage.files);
  byId('pack-name').textContent = name;
  baker.fill(stage.sky.pack);
  showReport(byId('report'), check(stage.files));
}

async function take(given) {
  await attempt('pack', async () => {
    const { kind, name, files, bytes } = await given();
    if (kind === 'pack') {
      await loadPack(files, name);
      own.pack = undefined;
      written();
      tell('pack', `${name} is loaded.`);
    } else {
      byId('baker-group').open = true;
      if (kind === 'photo') baker.photograph(name, bytes);
      else baker.fill({ recipe: new TextDecoder().decode(bytes) });
      byId('bake').focus();
    }
  });
}

const progress = (done, total) => {
  byId('loading').textContent = total ? `Loading… ${Math.floor((100 * done) / total)} %` : `Loading… ${bytesText(done)}`;
};

async function openFirst() {
  let [files, name] = [null, own.pack ?? USUAL_PACK];
  const wanted = own.pack && (await attempt('pack', async () => { files = await fetchPack(own.pack, progress); await stage.open(files, own.backend); }));
  if (wanted) return name;
  // A wrong address of a pack or a broken one is told; there is a sky all the same.
  [own.pack, name] = [undefined, USUAL_PACK];
  files = await fetchPack(USUAL_PACK, progress);
  try {
    await stage.open(files, own.backend);
  } catch (error) {
    if (!own.backend || own.backend === 'auto') throw error;
    complain('backend', reason(error));
    own.backend = undefined;
    await stage.open(files, 'auto');
  }
  return name;
}

async function start() {
  play(playing);
  const table = await controls();
  change.layers = table.layers;
  const name = await openFirst();
  byId('loading').hidden = true;
  panel = buildPanel(table, change);
  baker = watchBaker(bake, async (files) => {
    await loadPack(files, 'the baked pack');
    own.pack = undefined;
    written();
  });
  camera = watchCamera(view, {
    drag: (way) => { stage.sky.drag(way, view.clientHeight); changed(); },
    zoom: (notches) => { stage.sky.zoom(notches); changed(); },
    wake: loop.wake,
  });
  restore();
  wire();
  changed();
  showFirstFrame();
  showSizes();
  // After the first frame, which nobody shall wait for.
  requestAnimationFrame(() => setTimeout(() => aboutPack(name)));
}

function wire() {
  new ResizeObserver(loop.wake).observe(view);
  byId('play').addEventListener('click', () => play(!playing));
  calm.addEventListener('change', () => play(!calm.matches));
  watchDrops(take);
  for (const id of ['pack-file', 'pack-folder']) {
    byId(id).addEventListener('change', ({ target }) => {
      const list = [...target.files];
      target.value = '';
      if (list.length) take(() => chosen(list));
    });
  }
  byId('pack-form').addEventListener('submit', (event) => {
    event.preventDefault();
    const url = byId('pack-url').value.trim();
    if (!url) return;
    attempt('pack', async () => {
      await loadPack(await fetchPack(url), url);
      own.pack = url;
      written();
    });
  });
  byId('backend').value = stage.backend;
  byId('backend').addEventListener('change', async ({ target }) => {
    if (await attempt('backend', () => stage.open(stage.files, target.value))) own.backend = target.value === 'auto' ? undefined : target.value;
    target.value = stage.backend;
    changed();
  });
  byId('copy-link').addEventListener('click', () => copyText('The link', new URL(address(true) || '.', location.href).href));
  byId('copy-command').addEventListener('click', () => copyText('The command', ['welkin-view', 'render', 'PACK', '-o', 'sky.png', ...stage.sky.options()].join(' ')));
  byId('save').addEventListener('click', () => attempt('save', async () => saveBlob(await stage.picture(), 'sky.png')));
  byId('reset-all').addEventListener('click', () => { stage.sky.reset(); changed(); });
  watchShortcuts({ play: () => play(!playing), method: (number) => document.querySelectorAll('#methods input')[number]?.click() });
  if (isNarrow()) byId('fold').click();
}

start().catch((error) => {
  byId('loading').hidden = true;
  complain('start', `The sky cannot be drawn: ${reason(error)}`);
});
