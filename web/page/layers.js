// Layers of clouds: a row each, from the lowest to the highest.

import { el } from './dom.js';

/** `KIND:SHARE:HEIGHT:EAST:SOUTH` between commas, as rows; and back. */
export const readLayers = (text) => text.split(',').map((one) => {
  const [kind, share, height, east, south] = one.split(':');
  return { kind, share, height, east, south };
});
export const writeLayers = (layers) => layers
  .map(({ kind, share, height, east, south }) => [kind, share, height, east, south].filter((part) => part !== undefined).join(':')).join(',');

/** What stands in fields of its own, in their order. */
const NUMBERS = ['height', 'east', 'south'];

/** The control of the setting `layers`. */
export function layersControl(key, set, change) {
  const { kinds, most } = change.layers;
  const list = el('ol', { class: 'layers', 'aria-labelledby': `label-${key.name}` });
  const add = el('button', { type: 'button', class: 'small', on: { click: () => put([...layers, { kind: kinds[0], share: '0.5' }], -1) } }, 'Add a layer');
  let layers = [];

  /** Sets other layers; the focus goes where it was, or to the row that is told. */
  function put(next, focus = null) {
    if (!set(writeLayers(next))) return show(writeLayers(layers));
    // What a person does before the next frame shows this one builds on it.
    layers = next;
    if (focus !== null) list.children.item(focus < 0 ? list.children.length - 1 : focus)?.querySelector('select').focus();
  }
  const with_ = (i, part) => layers.map((layer, j) => (j === i ? { ...layer, ...part } : layer));

  function row(layer, i) {
    const names = kinds.map((kind) => el('option', { value: kind }, kind));
    const kind = el('select', { 'aria-label': `Layer ${i + 1}, kind`, on: { change: () => put(with_(i, { kind: kind.value, height: undefined, east: undefined, south: undefined }), i) } }, ...names);
    kind.value = layer.kind;
    const range = el('input', { type: 'range', min: 0, max: 1, step: 0.01, value: layer.share, 'aria-label': `Layer ${i + 1}, share of the cover`, title: 'Share of the cover' });
    range.style.setProperty('--share', layer.share);
    // A share of nothing would take the layer away under the person's hand.
    range.addEventListener('input', () => put(with_(i, { share: String(Math.max(Number(range.value), 0.01)) })));
    const number = (part, label, title) => {
      const field = el('input', {
        type: 'text', class: 'number', inputMode: 'decimal', value: layer[part], 'aria-label': `Layer ${i + 1}, ${label}`, title,
        on: { change: () => put(with_(i, { [part]: field.value.trim() })) },
      });
      return field;
    };
    const height = number('height', 'height', 'Height, in heights of the dome');
    const east = number('east', 'velocity to the east', 'Metres a second to the east, at speed 1');
    const south = number('south', 'velocity to the south', 'Metres a second to the south, at speed 1');
    const remove = el('button', {
      type: 'button', class: 'icon', textContent: '×', title: 'Remove', 'aria-label': `Remove layer ${i + 1}`, disabled: layers.length === 1,
      on: { click: () => put(layers.filter((_, j) => j !== i), Math.max(i - 1, 0)) },
    });
    return el('li', {}, kind, range, height, remove, el('span', { class: 'way quiet' }, 'm/s to the east, south'), east, south);
  }

  function show(text) {
    const next = readLayers(text);
    const same = next.length === layers.length && next.every((layer, i) => ['kind', ...NUMBERS].every((part) => layer[part] === layers[i][part]));
    layers = next;
    add.disabled = layers.length >= most;
    // A slider that is being moved stays the same element.
    if (same && list.children.length === layers.length) {
      layers.forEach((layer, i) => {
        const range = list.children[i].querySelector('input[type=range]');
        if (document.activeElement !== range) range.value = layer.share;
        range.style.setProperty('--share', layer.share);
        list.children[i].querySelectorAll('.number').forEach((field, k) => { field.value = layer[NUMBERS[k]]; });
      });
    } else {
      list.replaceChildren(...layers.map(row));
    }
  }
  return { wide: true, parts: [el('span'), el('div', { class: 'several' }, list, add)], show };
}
