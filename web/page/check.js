// What `welkin check` finds, as a list.

import { el } from './dom.js';

const ORDER = ['failed', 'skipped', 'passed'];
const MARKS = { failed: '✕', skipped: '–', passed: '✓' };

/**
 * @typedef {{rule: string, severity: 'error' | 'warning', subject: string, outcome: string, figure: number | null, expected: string, note: string}} Finding
 */

/**
 * Shows a report in `place`.
 * @param {HTMLElement} place
 * @param {{sound: boolean, findings: Finding[]}} report
 */
function showReport(place, report) {
  const of = (outcome) => report.findings.filter((finding) => finding.outcome === outcome);
  const [failed, skipped, passed] = ORDER.map(of);
  const errors = failed.filter(({ severity }) => severity === 'error').length;
  place.dataset.sound = String(report.sound);
  place.replaceChildren(
    el('p', { class: `verdict ${report.sound ? 'sound' : 'unsound'}`, role: 'status' }, verdict(errors, failed.length - errors, passed.length, skipped.length)),
    ...section(failed.sort((a, b) => a.severity.localeCompare(b.severity)), 'failed', true),
    ...section(skipped, 'skipped', false),
    ...section(passed, 'passed', false),
  );
}

/** The check that is going on. */
let worker = null;

/** Checks a pack in a worker, which is ended after it; a later pack ends the check of an earlier one. */
export function showCheck(place, files) {
  worker?.terminate();
  const mine = new Worker(new URL('./check-worker.js', import.meta.url), { type: 'module', name: 'welkin check' });
  worker = mine;
  delete place.dataset.sound;
  place.replaceChildren(el('p', { class: 'quiet', role: 'status' }, 'Checking…'));
  const none = (why) => place.replaceChildren(el('p', { class: 'verdict unsound' }, `Cannot be checked: ${why}`));
  mine.onmessage = ({ data: { report, error } }) => {
    if (report) showReport(place, report);
    else none(error);
    mine.terminate();
  };
  mine.onerror = (event) => {
    event.preventDefault();
    none(event.message ?? 'the check could not be loaded');
  };
  mine.postMessage(files);
}

function verdict(errors, warnings, passed, skipped) {
  const rest = `${passed} passed${skipped ? `, ${skipped} skipped` : ''}`;
  const warned = warnings ? `${warnings} ${warnings === 1 ? 'warning' : 'warnings'}, ` : '';
  return errors ? `Not sound: ${errors} failed, ${warned}${rest}` : `Sound: ${warned}${rest}`;
}

function section(findings, outcome, open) {
  if (findings.length === 0) return [];
  const list = el('ul', { class: 'findings' }, ...findings.map(item));
  if (open) return [list];
  return [el('details', {}, el('summary', {}, `${findings.length} ${outcome}`), list)];
}

function item({ rule, severity, subject, outcome, figure, expected, note }) {
  const words = outcome === 'passed' ? [expected] : [note, expected && `expected ${expected}`].filter(Boolean);
  return el('li', { class: `finding ${outcome} ${severity}`, 'data-rule': rule },
    el('span', { class: 'mark', 'aria-label': outcome === 'failed' && severity === 'warning' ? 'warning' : outcome }, MARKS[outcome] ?? ''),
    el('code', {}, rule),
    el('span', { class: 'subject' }, subject),
    figure === null || figure === undefined ? null : el('span', { class: 'figure' }, shorter(figure)),
    words.length && words[0] ? el('p', {}, words.join('; ')) : null);
}

const shorter = (figure) => String(Number(Number(figure).toPrecision(4)));
