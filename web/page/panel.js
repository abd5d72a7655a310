// The panel, from the table of settings.

import { controlRow } from './controls.js';
import { byId, el } from './dom.js';

const GROUPS = { clouds: 'Clouds', air: 'Air', light: 'Light', weather: 'Weather', time: 'Time', camera: 'Camera' };

/** Where the methods were published. */
const PAPERS = {
  packed: 'T. Roden, I. Parberry, “Clouds and Stars”, 2005',
  octaves: 'A. Meena and others, “Realistic Real-Time Skies”, USC',
  fbm: 'I. Quilez, “Dynamic Clouds”, 2005',
  lit: 'K. Mukhina, A. Bezgodov, “The Method for Real-time Cloud Rendering”, 2015',
  sprites: 'N. Wang, “Let There Be Clouds!”, 2004',
};

/**
 * Builds the panel.
 * @param {{keys: object[], presets: object[]}} table
 * @param {import('./controls.js').Change & {preset(name: string): void}} change
 * @returns {{show(state: {values: Record<string, string>, applies: Set<string>, changed: Set<string>, weather: string | null}): void}}
 */
export function buildPanel({ keys, presets }, change) {
  const method = methods(keys.find(({ name }) => name === 'method'), change);
  const weather = weathers(presets, change);
  const rows = keys.filter(({ name }) => name !== 'method').map((key) => ({ key, row: controlRow(key, change) }));
  const of = (group) => rows.filter(({ key }) => key.group === group).map(({ row }) => row.element);
  byId('six').append(...of('sky'));
  const groups = Object.entries(GROUPS).map(([group, name]) => {
    const element = el('details', { class: 'group', 'data-group': group, open: group === 'clouds' && !isNarrow() },
      el('summary', {}, name), el('div', { class: 'rows' }, ...of(group)));
    return { group, element };
  });
  byId('groups').append(...groups.map(({ element }) => element));
  return {
    show({ values, applies, changed, weather: now }) {
      method(values.method);
      weather(now);
      for (const { key, row } of rows) {
        row.element.hidden = !applies.has(key.name);
        row.show(values[key.name], changed.has(key.name));
      }
      for (const { group, element } of groups) {
        element.hidden = !rows.some(({ key }) => key.group === group && applies.has(key.name));
      }
    },
  };
}

export const isNarrow = () => matchMedia('(max-width: 640px)').matches;

/** One of five, side by side. */
function methods(key, change) {
  const place = byId('methods');
  const paper = byId('paper');
  const radios = key.input.choices.map((name) => {
    const radio = el('input', { type: 'radio', name: 'method', id: `method-${name}`, value: name, on: { change: () => change.set('method', name) } });
    place.append(el('span', { class: 'segment' }, radio, el('label', { for: radio.id, title: PAPERS[name] ?? '' }, name)));
    return radio;
  });
  return (now) => {
    for (const radio of radios) radio.checked = radio.value === now;
    paper.textContent = PAPERS[now] ?? '';
    paper.title = paper.textContent;
  };
}

/** Weathers to go over to. */
function weathers(presets, change) {
  const buttons = presets.map(({ name, help }) => el('button', {
    type: 'button', title: help, 'data-weather': name, on: { click: () => change.preset(name) },
  }, name));
  byId('weathers').append(...buttons);
  return (now) => {
    for (const button of buttons) button.setAttribute('aria-pressed', String(button.dataset.weather === now));
  };
}
