// A row of the panel for each kind of setting.

import { el } from './dom.js';
import { layersControl } from './layers.js';
import { clock, fromHex, scale, toHex } from './scale.js';

/**
 * @typedef {object} Change what a row may do to the sky
 * @property {(name: string, text: string) => string | null} set tells what is wrong, or null
 * @property {(name: string) => void} reset
 * @property {object} layers kinds of layers and how many there may be
 */

/** The row of a setting: `{element, show(text, changed)}`. */
export function controlRow(key, change) {
  const wrong = el('p', { class: 'wrong', role: 'alert', hidden: true });
  const set = (text) => {
    const problem = change.set(key.name, text);
    wrong.textContent = problem ?? '';
    wrong.hidden = problem === null;
    return problem === null;
  };
  const made = MAKERS[key.input.kind](key, set, change);
  const reset = el('button', {
    type: 'button', class: 'reset', title: 'Reset', 'aria-label': `Reset ${key.label}`, textContent: '↺',
    on: { click: () => change.reset(key.name) },
  });
  const label = made.id
    ? el('label', { for: made.id, title: key.help }, key.label)
    : el('span', { class: 'label', id: `label-${key.name}`, title: key.help }, key.label);
  const element = el('div', { class: `row ${made.wide ? 'wide' : ''}`, 'data-key': key.name }, label, ...made.parts, reset, wrong);
  label.addEventListener('dblclick', () => change.reset(key.name));
  made.slider?.addEventListener('dblclick', () => change.reset(key.name));
  let shown = null;
  return {
    element,
    show(text, changed) {
      element.classList.toggle('changed', changed);
      reset.disabled = !changed;
      if (text === shown) return;
      shown = text;
      made.show(text);
    },
  };
}

const MAKERS = { slider, switch: toggle, choice, numbers, colour, layers: layersControl, text };

/** A slider with the number beside it, for a setting or for one number of several. */
export function sliderParts(id, label, input, set) {
  const on = scale(input);
  const unit = input.unit ? ` ${input.unit}` : '';
  const range = el('input', { type: 'range', id, min: on.min, max: on.max, step: on.step });
  const number = el('input', {
    type: 'text', class: 'number', inputMode: 'decimal', autocomplete: 'off', spellcheck: false,
    'aria-label': `${label}, number${unit ? ` in${unit}` : ''}`, title: unit.trim(),
  });
  let told = '';
  const show = (text) => {
    const value = Number(text);
    told = text;
    range.value = on.place(value);
    range.style.setProperty('--share', (on.place(value) - on.min) / (on.max - on.min));
    const words = id === 'key-time' ? clock(value) : `${shorter(value)}${unit}`;
    range.setAttribute('aria-valuetext', words);
    range.title = words;
    number.setAttribute('aria-invalid', 'false');
    // What a person types is theirs until they leave.
    if (document.activeElement !== number) number.value = shorter(value);
  };
  const isWrong = () => number.getAttribute('aria-invalid') === 'true';
  range.addEventListener('input', () => set(String(on.value(Number(range.value)))));
  number.addEventListener('change', () => number.setAttribute('aria-invalid', String(!set(number.value.trim()))));
  number.addEventListener('focus', () => { if (!isWrong()) number.value = told; });
  number.addEventListener('blur', () => { if (!isWrong()) number.value = shorter(Number(told)); });
  return { id, parts: [range, number], show, slider: range };
}

function slider(key, set) {
  return sliderParts(`key-${key.name}`, key.label, key.input, set);
}

/** A number in at most six digits. */
const shorter = (value) => String(Number(value.toPrecision(6)));

function toggle(key, set) {
  const id = `key-${key.name}`;
  const box = el('input', { type: 'checkbox', id, on: { change: () => set(String(box.checked)) } });
  return { id, parts: [box], show: (text) => { box.checked = text === 'true'; } };
}

function choice(key, set) {
  const id = `key-${key.name}`;
  const options = key.input.choices.map((name) => el('option', { value: name }, name));
  const select = el('select', { id, on: { change: () => set(select.value) } }, ...options);
  return { id, parts: [select], show: (text) => { select.value = text; } };
}

function colour(key, set) {
  const id = `key-${key.name}`;
  const picker = el('input', { type: 'color', id, on: { input: () => set(fromHex(picker.value).join(',')) } });
  const field = el('input', {
    type: 'text', class: 'field', spellcheck: false, autocomplete: 'off', 'aria-label': `${key.label}, linear red, green, blue`,
    on: { change: () => set(field.value) },
  });
  return {
    id, parts: [picker, field],
    show(text) { picker.value = toHex(text.split(',').map(Number)); field.value = text; },
  };
}

function text(key, set) {
  const id = `key-${key.name}`;
  const field = el('input', {
    type: 'text', class: 'field', id, spellcheck: false, autocomplete: 'off', placeholder: key.input.form, title: key.input.form,
    on: { change: () => set(field.value.trim() || 'none') },
  });
  return { id, parts: [field], show: (to) => { field.value = to === 'none' ? '' : to; } };
}

/** Several numbers: a slider each; where they may be left out, a box before them. */
function numbers(key, set) {
  const { names, ranges, optional } = key.input;
  let values = ranges.map(([low, high]) => Math.min(Math.max(0, low), high));
  const tell = () => set(values.join(','));
  const sliders = names.map((name, i) => sliderParts(`key-${key.name}-${i}`, `${key.label} ${name}`, { low: ranges[i][0], high: ranges[i][1] }, (to) => {
    const before = values;
    values = values.map((value, j) => (j === i ? to : value));
    const good = tell();
    if (!good) values = before;
    return good;
  }));
  const rows = sliders.map((made, i) => el('div', { class: 'row' }, el('label', { for: made.id }, names[i]), ...made.parts));
  const list = el('div', { class: 'several', role: 'group', 'aria-labelledby': `label-${key.name}` }, ...rows);
  const box = optional
    ? el('input', { type: 'checkbox', 'aria-labelledby': `label-${key.name}`, on: { change: () => (box.checked ? tell() : set('none')) } })
    : null;
  return {
    wide: true, parts: [box ?? el('span'), list],
    show(to) {
      const there = to !== 'none';
      if (box) box.checked = there;
      list.hidden = !there;
      if (!there) return;
      values = to.split(',');
      values.forEach((value, i) => sliders[i].show(value));
    },
  };
}
