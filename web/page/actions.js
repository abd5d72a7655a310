// What buttons and keys do besides the settings.

import { byId, isTyping, reason } from './dom.js';
import { complain, settle, tell } from './message.js';

/** Does something that may fail, and says why; tells whether it went well. */
export async function attempt(topic, work) {
  settle(topic);
  try {
    await work();
    return true;
  } catch (error) {
    complain(topic, reason(error));
    return false;
  }
}

/** Puts a text into the clipboard. */
export async function copyText(what, text) {
  try {
    await navigator.clipboard.writeText(text);
    tell('copy', `${what} is in the clipboard.`);
  } catch {
    // Where the browser keeps the clipboard to itself, a person can still take it by hand.
    complain('copy', `${what} cannot be put into the clipboard: ${text}`);
  }
}

/** Saves a file where the browser saves files. */
export function saveBlob(blob, name) {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  [link.href, link.download] = [url, name];
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** Folds the panel away, or shows it. */
function fold() {
  const folded = document.body.classList.toggle('folded');
  byId('fold').setAttribute('aria-expanded', String(!folded));
}

/** Keys that work wherever no text is typed. */
export function watchShortcuts({ play, method }) {
  const dialog = byId('keys');
  byId('fold').addEventListener('click', fold);
  byId('keys-button').addEventListener('click', () => dialog.showModal());
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.repeat || isTyping(event.target) || dialog.open) return;
    if (event.key === 'h' || event.key === 'H') fold();
    else if (event.key === '?') dialog.showModal();
    else if (event.key >= '1' && event.key <= '5') method(Number(event.key) - 1);
    // Where a button has the focus, the space bar is the button's.
    else if (event.key === ' ' && (event.target === document.body || event.target === byId('view'))) {
      event.preventDefault();
      play();
    }
  });
}
