// The page: puts the sky, the panel and the address together.

import { controls, createSky } from './welkin.js';
import { attempt, copyText, saveBlob, watchShortcuts } from './actions.js';
import { watchCamera } from './camera.js';
import { byId, el, reason } from './dom.js';
import { readLink, throttled, writeLink } from './link.js';
import { createClock, createLoop } from './loop.js';
import { complain, settle, tell } from './message.js';
import { createPacks } from './packs.js';
import { buildPanel, isNarrow } from './panel.js';
import { createStage } from './stage.js';
import { showBackend, showFirstFrame, showFrameTime, showSizes, showTextures } from './status.js';

/** How long a weather takes to become another. */
const BLEND_S = 4;
/** How often numbers that move by themselves are shown. */
const SHOW_S = 0.1;
/** How often the address changes; browsers forbid more than a few a second. */
const WRITE_MS = 300;

const calm = matchMedia('(prefers-reduced-motion: reduce)');
const { own, pairs } = readLink(location.search);
const view = byId('view');
let playing = own.paused === undefined ? !calm.matches : own.paused === 'false';
let [panel, camera, unshown_s, method] = [null, null, Infinity, ''];

const clock = createClock();
const loop = createLoop((seconds) => {
  const { sky } = stage;
  // Only among the sprites is there anywhere to fly to.
  const keys = camera.held(method === 'sprites');
  if (keys) sky.pilot(keys, seconds);
  const blended = sky.blending;
  sky.advance(seconds, { time: playing });
  try {
    stage.draw();
  } catch (error) {
    complain('draw', reason(error));
    return false;
  }
  clock.add(seconds);
  unshown_s += seconds;
  const goes_on = playing || sky.blending || keys !== null;
  if (unshown_s >= SHOW_S || !goes_on) show();
  if (keys || blended || sky.blending) written();
  return goes_on;
});

const stage = createStage(view, createSky, {
  opened(sky) {
    // What a frame of the one before said is no matter any more.
    settle('draw');
    showBackend(sky.info);
  },
  lost: (why) => tell('device', `${why} The sky is being made anew.`),
  back(backend) {
    tell('device', `The graphics device was lost; the sky was made anew${backend === 'webgl2' ? ', with WebGL2' : ''}.`);
    changed();
  },
  gone(why) {
    loop.stop();
    const again = () => attempt('device', async () => {
      await stage.again();
      changed();
    });
    complain('device', `The graphics device is gone: ${why}`, el('button', { type: 'button', on: { click: again } }, 'Try again'));
  },
});
const packs = createPacks(stage, own, changed);

/** Something has changed: a new picture, and a new address. */
function changed() {
  unshown_s = Infinity;
  loop.wake();
  written();
}

function show() {
  const { sky } = stage;
  unshown_s = 0;
  showFrameTime(playing ? clock.median() : null);
  const values = sky.get();
  if (values.method !== method) {
    ({ method } = values);
    showTextures(sky.info.methodBytes);
  }
  byId('lacks').textContent = sky.lacks ?? '';
  byId('lacks').hidden = sky.lacks === null;
  panel.show({ values, applies: new Set(sky.applies()), changed: new Set(sky.changes().map(([name]) => name)), weather: sky.weather() });
}

/** The address of what is seen. A moment that moves on is no part of it, unless it is asked for. */
function address(moment) {
  const told = stage.sky.changes().filter(([name]) => moment || !playing || name !== 'at');
  const paused = playing === !calm.matches ? '' : String(!playing);
  return writeLink({ pack: own.pack, backend: own.backend, paused }, told) || location.pathname;
}
const written = throttled(() => history.replaceState(null, '', address(false)), WRITE_MS);

/** What the panel may do. */
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
  if (panel) changed();
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

function wire() {
  new ResizeObserver(loop.wake).observe(view);
  byId('play').addEventListener('click', () => play(!playing));
  calm.addEventListener('change', () => play(!calm.matches));
  const backend = byId('backend');
  backend.value = stage.backend;
  backend.addEventListener('change', async () => {
    if (await attempt('backend', () => stage.open(stage.files, backend.value))) own.backend = backend.value === 'auto' ? undefined : backend.value;
    backend.value = stage.backend;
    changed();
  });
  byId('copy-link').addEventListener('click', () => copyText('The link', new URL(address(true), location.href).href));
  byId('copy-command').addEventListener('click', () => copyText('The command', ['welkin-view', 'render', 'PACK', '-o', 'sky.png', ...stage.sky.options()].join(' ')));
  byId('save').addEventListener('click', () => attempt('save', async () => saveBlob(await stage.picture(), 'sky.png')));
  byId('reset-all').addEventListener('click', () => change.reset());
  watchShortcuts({ play: () => play(!playing), method: (number) => document.querySelectorAll('#methods input')[number]?.click() });
  if (isNarrow()) byId('fold').click();
}

async function start() {
  // Both at once: the pack is fetched while the engine is compiled.
  const [table, name] = await Promise.all([controls(), packs.openFirst()]);
  byId('loading').hidden = true;
  change.layers = table.layers;
  panel = buildPanel(table, change);
  byId('panel').hidden = false;
  camera = watchCamera(view, {
    drag(way_px) {
      stage.sky.drag(way_px, view.clientHeight);
      changed();
    },
    zoom(notches) {
      stage.sky.zoom(notches);
      changed();
    },
    wake: loop.wake,
  });
  restore();
  packs.watch();
  wire();
  play(playing);
  showFirstFrame();
  showSizes();
  // After the first frame, for which nobody shall wait longer.
  requestAnimationFrame(() => setTimeout(() => packs.about(name)));
}

start().catch((error) => {
  byId('loading').hidden = true;
  complain('start', `The sky cannot be drawn: ${reason(error)}`);
});
