// `<welkin-sky>`: the types of element.js.

import type { Sky } from './welkin.js';

/**
 * A sky that fills its box and moves. The attribute `pack` is the address of a pack's folder, `backend` as in `SkyOptions`, `paused` keeps it still; every
 * other is a setting by its name. It tells `open` when the sky is there, and `error` with a message; without a listener for that it is on the console.
 */
export class WelkinSky extends HTMLElement {
  /** The sky; null until `open`. */
  readonly sky: Sky | null;
}

declare global {
  interface HTMLElementTagNameMap {
    'welkin-sky': WelkinSky;
  }
}
