// The panel, from the table of settings.

import { controlRow } from './controls.js';
import { byId, el } from './dom.js';

const GROUPS = { clouds: 'Clouds', air: 'Air', light: 'Light', weather: 'Weather', time: 'Time', camera: 'Camera' };

/**
 * Builds the panel.
 * @param {{keys: object[], methods: object[], presets: object[]}} table
 * @param {import('./controls.js').Change & {preset(name: string): void}} change
 * @returns {{show(state: {values: Record<string, string>, applies: Set<string>, changed: Set<string>, weather: string | null}): void}}
 */
export function buildPanel({ keys, methods, presets }, change) {
  const method = choiceOfMethod(methods, change);
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
function choiceOfMethod(methods, change) {
  const place = byId('methods');
  const published = byId('paper');
  const radios = methods.map(({ name, paper }) => {
    const radio = el('input', { type: 'radio', name: 'method', id: `method-${name}`, value: name, on: { change: () => change.set('method', name) } });
    place.append(el('span', { class: 'segment' }, radio, el('label', { for: radio.id, title: paper }, name)));
    return radio;
  });
  return (now) => {
    for (const radio of radios) radio.checked = radio.value === now;
    published.textContent = methods.find(({ name }) => name === now)?.paper ?? '';
    published.title = published.textContent;
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
