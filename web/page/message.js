// What the page has to say: errors stay until they are closed or their cause is gone, the rest goes by itself.

import { byId, el } from './dom.js';

const SHORT_MS = 6000;

/** Says an error. One of the same `topic` is replaced. */
export function complain(topic, text, ...more) {
  const close = el('button', { type: 'button', class: 'icon', textContent: '×', title: 'Close', 'aria-label': 'Close', on: { click: () => settle(topic) } });
  const words = el('p', {}, text);
  put(topic, el('div', { class: 'message error', role: 'alert', 'data-topic': topic }, words, ...more, close));
}

/** Says what happened. */
export function tell(topic, text) {
  const message = el('div', { class: 'message', role: 'status', 'data-topic': topic }, el('p', {}, text));
  put(topic, message);
  setTimeout(() => message.remove(), SHORT_MS);
}

/** Takes back what was said of a topic. */
export function settle(topic) {
  for (const message of byId('messages').children) if (message.dataset.topic === topic) message.remove();
}

function put(topic, message) {
  settle(topic);
  byId('messages').append(message);
}
