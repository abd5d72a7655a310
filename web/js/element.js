// <welkin-sky pack="pack/" method="lit" cover="0.5" time="0.7"></welkin-sky>: a sky that fills its box and moves. Every setting is an attribute.

import { createLosses } from './losses.js';
import { createSky } from './welkin.js';

/** Attributes that are no settings. */
const OWN = new Set(['pack', 'backend', 'paused', 'class', 'id', 'style', 'slot', 'title', 'hidden', 'lang', 'dir', 'role', 'tabindex', 'part']);
const isSetting = (name) => !OWN.has(name) && !/^(data|aria|on)/.test(name);

const STYLE = ':host { display: block; overflow: hidden } canvas { display: block; width: 100%; height: 100% }';

export class WelkinSky extends HTMLElement {
  #sky = null;
  #wanted = 'auto';
  #losses = createLosses();
  #opening = 0;
  #attributes = new MutationObserver((changes) => { for (const { attributeName } of changes) this.#changed(attributeName); });

  /** The sky, as `createSky` gives it; null until the event `open`. */
  get sky() { return this.#sky; }

  connectedCallback() {
    this.#wanted = this.getAttribute('backend') ?? 'auto';
    this.#attributes.observe(this, { attributes: true });
    this.#open([this.#wanted]);
  }

  disconnectedCallback() {
    this.#attributes.disconnect();
    this.#close();
  }

  #close() {
    this.#opening += 1;
    this.#sky?.destroy();
    this.#sky = null;
  }

  /** With the first of these backends that draws. */
  async #open(backends, last = null) {
    this.#close();
    const opening = this.#opening;
    const root = this.shadowRoot ?? this.attachShadow({ mode: 'open' });
    const source = last?.files ?? this.getAttribute('pack');
    let failure = new Error('there is no attribute "pack"; give it the address of a pack\'s folder');
    for (const backend of source ? backends : []) {
      // A canvas that has drawn by one backend draws by no other.
      const canvas = document.createElement('canvas');
      const style = Object.assign(document.createElement('style'), { textContent: STYLE });
      root.replaceChildren(style, canvas);
      let [sky, lost] = [null, null];
      const onlost = (why) => {
        lost = why;
        if (sky) this.#lost(sky, why);
      };
      try {
        sky = await createSky(canvas, source, { backend, resize: true, onlost });
        if (opening !== this.#opening) return sky.destroy();
        [this.#sky, this.#wanted] = [sky, backend];
        this.#show(last?.settings);
        return lost && this.#lost(sky, lost);
      } catch (error) {
        if (opening !== this.#opening) return undefined;
        failure = error;
      }
    }
    this.#fail(failure.message);
    return undefined;
  }

  #show(settings) {
    if (settings) this.#sky.set(settings);
    for (const { name } of this.attributes) if (isSetting(name)) this.#changed(name);
    this.#play();
    this.dispatchEvent(new Event('open'));
  }

  #play() {
    if (this.hasAttribute('paused')) this.#sky.stop().draw();
    else this.#sky.start();
  }

  #changed(name) {
    if (name === 'pack') return this.#open([this.#wanted]);
    if (!this.#sky) return undefined;
    if (name === 'paused') return this.#play();
    if (!isSetting(name)) return undefined;
    try {
      const value = this.getAttribute(name);
      if (value === null) this.#sky.reset(name);
      else this.#sky.set({ [name]: value });
      if (this.hasAttribute('paused')) this.#sky.draw();
    } catch (error) {
      this.#fail(error.message);
    }
    return undefined;
  }

  #lost(sky, why) {
    if (sky !== this.#sky) return;
    const last = { files: sky.files, settings: sky.get() };
    const backends = this.#losses.next(this.#wanted, sky.info.backend);
    if (backends.length) this.#open(backends, last);
    else this.#fail(why);
  }

  /** Told as an event; who listens to none finds it on the console. */
  #fail(message) {
    const unheard = this.dispatchEvent(new ErrorEvent('error', { message, cancelable: true }));
    if (unheard) console.error(`<welkin-sky>: ${message}`);
  }
}

if (!customElements.get('welkin-sky')) customElements.define('welkin-sky', WelkinSky);
