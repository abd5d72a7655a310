// The pack that is drawn: where it comes from, what the check finds in it, and the baker that makes others.

import { bake, fetchPack } from './welkin.js';
import { attempt } from './actions.js';
import { watchBaker } from './baking.js';
import { showCheck } from './check.js';
import { byId, bytesText, reason } from './dom.js';
import { chosen, watchDrops } from './drop.js';
import { complain, tell } from './message.js';
import { showPack } from './status.js';

const USUAL_PACK = 'pack/';

/**
 * @param {ReturnType<import('./stage.js').createStage>} stage
 * @param {{pack?: string, backend?: string}} own what the address asks for; the pack's address is kept up to date
 * @param {() => void} changed to be called after another pack was loaded
 */
export function createPacks(stage, own, changed) {
  let baker = null;

  /** Draws another pack and shows its check. The sky stays as it is if the pack is not sound. */
  async function load(files, name, address) {
    try {
      await stage.load(files);
    } catch (error) {
      report(files, name);
      byId('pack-group').open = true;
      throw new Error(`${name}: ${reason(error)}; the sky is as it was`, { cause: error });
    }
    own.pack = address;
    about(name);
    changed();
  }

  function about(name) {
    showPack(stage.files);
    byId('pack-name').textContent = name;
    baker.fill(stage.sky.pack);
    report(stage.files, name);
  }

  const take = (given) => attempt('pack', async () => {
    const { kind, name, files, bytes } = await given();
    if (kind === 'pack') {
      await load(files, name);
      tell('pack', `${name} is loaded.`);
      return;
    }
    byId('baker-group').open = true;
    if (kind === 'photo') baker.photograph(name, bytes);
    else baker.fill({ recipe: new TextDecoder().decode(bytes) });
    byId('bake').focus();
  });

  /** Opens the sky with the pack of the address, or else with the usual one; tells its name. */
  async function openFirst() {
    const wanted = own.pack;
    if (wanted && await attempt('pack', async () => openWith(await fetchPack(wanted, progress)))) return wanted;
    // A wrong address or a broken pack is told; there is a sky all the same.
    own.pack = undefined;
    await openWith(await fetchPack(USUAL_PACK, progress));
    return USUAL_PACK;
  }

  /** Opens the sky with the backend of the address, or with any where there is none such. */
  async function openWith(files) {
    try {
      await stage.open(files, own.backend);
    } catch (error) {
      if (!own.backend || own.backend === 'auto') throw error;
      await stage.open(files, 'auto');
      own.backend = undefined;
      complain('backend', reason(error));
    }
  }

  /** Listens to forms and drops, when there is a sky. */
  function watch() {
    baker = watchBaker(bake, (files) => load(files, 'the baked pack'));
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
      if (url) attempt('pack', async () => load(await fetchPack(url), url, url));
    });
  }

  return { openFirst, watch, about };
}

function report(files, name) {
  byId('report-of').textContent = `Check of ${name}`;
  showCheck(byId('report'), files);
}

function progress(done, total) {
  byId('loading').textContent = total ? `Loading… ${Math.floor((100 * done) / total)} %` : `Loading… ${bytesText(done)}`;
}
