// Bakes a pack from a recipe and a seed, in a worker.

import { bytesText, byId, reason } from './dom.js';

/**
 * Wires the baker's form.
 * @param {(recipe: string, options: object) => Promise<Map<string, Uint8Array>>} bake
 * @param {(files: Map<string, Uint8Array>) => Promise<void>} take loads the new pack, or throws
 */
export function watchBaker(bake, take) {
  const [form, seed, recipe, photo, start, cancel, bar, text, wrong] = ['baker', 'seed', 'recipe', 'photo', 'bake', 'cancel-bake', 'bake-progress', 'bake-text', 'bake-wrong'].map(byId);
  const photos = new Map();
  let running = null;

  const show = (busy) => {
    start.disabled = busy;
    cancel.hidden = !busy;
    bar.hidden = !busy;
    form.setAttribute('aria-busy', String(busy));
  };
  const complain = (message) => {
    wrong.textContent = message;
    wrong.hidden = !message;
    if (message) pointAt(recipe, message);
  };

  form.addEventListener('submit', async (event) => {
    event.preventDefault();
    if (running) return;
    running = new AbortController();
    complain('');
    show(true);
    bar.removeAttribute('value');
    text.textContent = 'Baking…';
    const notices = [];
    try {
      const files = await bake(recipe.value, {
        seed: seed.value.trim(), files: photos, signal: running.signal,
        onprogress(share, what, notice) {
          if (notice) notices.push(notice);
          bar.value = share;
          text.textContent = `${Math.floor(100 * share)} %${what ? `, ${what}` : ''}`;
        },
      });
      text.textContent = 'Loading…';
      await take(files);
      const bytes = bytesText([...files.values()].reduce((sum, file) => sum + file.length, 0));
      text.textContent = [`Baked: ${bytes}`, ...notices].join('; ');
    } catch (error) {
      const stopped = error.name === 'AbortError';
      text.textContent = stopped ? 'Cancelled; the sky is as it was' : 'Not baked; the sky is as it was';
      if (!stopped) complain(reason(error));
    } finally {
      running = null;
      show(false);
    }
  });
  cancel.addEventListener('click', () => {
    running?.abort();
    start.focus();
  });

  return {
    /** Fills the form with what a pack was baked from. */
    fill({ seed: number, recipe: lines }) {
      if (running) return;
      if (number !== undefined) seed.value = String(number);
      if (lines) recipe.value = lines;
      complain('');
    },
    /** A photograph for the channel of clouds: the recipe names it. */
    photograph(name, bytes) {
      photos.set(name, bytes);
      recipe.value = namePhoto(recipe.value, name);
      photo.textContent = `${name}, ${bytesText(bytes.length)}`;
      photo.hidden = false;
    },
  };
}

/** The recipe with this file as the clouds' photograph. */
export function namePhoto(recipe, name) {
  const line = `file = ${JSON.stringify(name)}`;
  const heading = /^\[clouds\.photo\][^\n]*\n/m;
  const section = recipe.match(/^\[clouds\.photo\][^\n]*\n(?:(?!^\[)[^\n]*\n?)*/m)?.[0];
  if (section === undefined) return `${recipe.replace(/\n*$/, recipe.trim() ? '\n\n' : '')}[clouds.photo]\n${line}\n`;
  const changed = /^file\s*=.*$/m.test(section) ? section.replace(/^file\s*=.*$/m, () => line) : section.replace(heading, (head) => `${head}${line}\n`);
  return recipe.replace(section, () => changed);
}

/** Puts the caret where an error says: line and column count from 1. */
function pointAt(area, message) {
  const [, line, column] = message.match(/:(\d+):(\d+):/) ?? [];
  if (!line) return;
  const before = area.value.split('\n').slice(0, Number(line) - 1);
  const at = before.reduce((sum, one) => sum + one.length + 1, 0) + Number(column) - 1;
  area.closest('details').open = true;
  area.focus();
  area.setSelectionRange(at, at + 1);
}
