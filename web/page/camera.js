// Looking and flying. What a gesture does to the view is the engine's; here is which gesture it was.

import { isTyping } from './dom.js';

const TURNS = { ArrowLeft: ['turnRight', -1], ArrowRight: ['turnRight', 1], ArrowUp: ['turnUp', 1], ArrowDown: ['turnUp', -1] };
const FLIGHT = { KeyW: ['forward', 1], KeyS: ['forward', -1], KeyD: ['right', 1], KeyA: ['right', -1], KeyE: ['up', 1], KeyQ: ['up', -1] };
const AXES = ['turnRight', 'turnUp', 'forward', 'right', 'up'];

/** Pixels of a wheel that are one notch. */
const NOTCH_PX = 100;

/**
 * @param {HTMLElement} view where gestures are made
 * @param {{drag(way_px: number[]): void, zoom(notches: number): void, wake(): void}} to
 * @returns {{held(flies: boolean): object | null}} keys that are held, as the engine takes them
 */
export function watchCamera(view, to) {
  watchPointers(view, to);
  view.addEventListener('wheel', (event) => {
    event.preventDefault();
    const px = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? event.deltaY * 33 : event.deltaY;
    to.zoom(-px / NOTCH_PX);
  }, { passive: false });
  return watchKeys(view, to);
}

/** One pointer looks around; two zoom. */
function watchPointers(view, to) {
  const down = new Map();
  const apart = () => {
    const [a, b] = [...down.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  view.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    view.setPointerCapture(event.pointerId);
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    view.classList.add('held');
  });
  view.addEventListener('pointermove', (event) => {
    const last = down.get(event.pointerId);
    if (!last) return;
    const before = down.size === 2 ? apart() : 0;
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (down.size === 1) to.drag([event.clientX - last.x, event.clientY - last.y]);
    // A notch is a tenth of the view.
    else if (before > 0 && apart() > 0) to.zoom(Math.log(apart() / before) / -Math.log(0.9));
  });
  for (const end of ['pointerup', 'pointercancel', 'lostpointercapture']) {
    view.addEventListener(end, (event) => {
      down.delete(event.pointerId);
      view.classList.toggle('held', down.size > 0);
    });
  }
}

function watchKeys(view, to) {
  const held = new Set();
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turns = event.code in TURNS && document.activeElement === view;
    const flies = event.code in FLIGHT && !isTyping(event.target);
    if (!turns && !flies && event.key !== 'Shift') return;
    if (turns) event.preventDefault();
    held.add(event.key === 'Shift' ? 'Shift' : event.code);
    to.wake();
  });
  addEventListener('keyup', (event) => held.delete(event.key === 'Shift' ? 'Shift' : event.code));
  addEventListener('blur', () => held.clear());
  return {
    held(flies) {
      const keys = Object.fromEntries(AXES.map((axis) => [axis, 0]));
      for (const code of held) {
        const [axis, way] = TURNS[code] ?? (flies ? FLIGHT[code] : undefined) ?? [];
        if (axis) keys[axis] += way;
      }
      if (AXES.every((axis) => keys[axis] === 0)) return null;
      return { ...keys, haste: held.has('Shift') };
    },
  };
}
