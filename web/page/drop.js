// Files that a person gives: a folder, a zip, a photograph or a recipe, dropped on the window or chosen.

import { byId } from './dom.js';
import { readZip } from './zip.js';

const MANIFEST = 'pack.json';
/** More than any pack has, or any picture for one. */
const MOST_BYTES = 256 * 1024 * 1024;

/**
 * What was given.
 * @typedef {{kind: 'pack', name: string, files: Map<string, Uint8Array>} | {kind: 'photo' | 'recipe', name: string, bytes: Uint8Array}} Given
 */

/**
 * Watches the window for things that are dropped.
 * @param {(given: () => Promise<Given>) => void} take
 */
export function watchDrops(take) {
  const veil = byId('veil');
  let depth = 0;
  const show = (on) => {
    depth = on;
    veil.hidden = depth <= 0;
  };
  const has_files = (event) => event.dataTransfer?.types.includes('Files');
  addEventListener('dragenter', (event) => {
    if (!has_files(event)) return;
    event.preventDefault();
    show(depth + 1);
  });
  addEventListener('dragleave', () => show(Math.max(depth - 1, 0)));
  addEventListener('dragover', (event) => { if (has_files(event)) event.preventDefault(); });
  addEventListener('drop', (event) => {
    show(0);
    if (!has_files(event)) return;
    event.preventDefault();
    // The list of what was dropped is gone once this returns.
    const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry?.() ?? item.getAsFile()).filter(Boolean);
    take(async () => sortOut((await Promise.all(entries.map((entry) => walk(entry)))).flat()));
  });
}

/** The files of a file picker: a folder's, or any. */
export const chosen = (list) => sortOut([...list].map((file) => ({ path: file.webkitRelativePath || file.name, file })));

/** All files in a dropped entry, with their paths. */
async function walk(entry) {
  if (entry instanceof File) return [{ path: entry.name, file: entry }];
  if (entry.isFile) {
    const file = await new Promise((resolve, reject) => { entry.file(resolve, reject); });
    return [{ path: entry.fullPath.replace(/^\//, ''), file }];
  }
  const reader = entry.createReader();
  const inside = [];
  for (;;) {
    // It tells a hundred at a time.
    const some = await new Promise((resolve, reject) => { reader.readEntries(resolve, reject); });
    if (some.length === 0) break;
    inside.push(...some);
  }
  return (await Promise.all(inside.map(walk))).flat();
}

/**
 * What a list of files is.
 * @param {{path: string, file: Blob & {name: string}}[]} list
 * @returns {Promise<Given>}
 */
export async function sortOut(list) {
  if (list.length === 0) throw new Error('nothing was given');
  const total = list.reduce((sum, { file }) => sum + file.size, 0);
  if (total > MOST_BYTES) throw new Error(`${total} bytes were given, expected at most ${MOST_BYTES}`);
  const read = async (file) => new Uint8Array(await file.arrayBuffer());
  const [{ path, file }] = list;
  if (list.length === 1 && !path.endsWith(MANIFEST)) {
    const bytes = await read(file);
    // By its first bytes, whatever its name is.
    if (bytes[0] === 0x50 && bytes[1] === 0x4b) return { kind: 'pack', name: path, files: ofPack(await unzip(bytes, path), path) };
    if (/\.(png|jpe?g)$/i.test(path)) return { kind: 'photo', name: path, bytes };
    if (/\.toml$/i.test(path)) return { kind: 'recipe', name: path, bytes };
    throw new Error(`${path} is no pack: expected a folder or a zip with a ${MANIFEST}, a PNG or JPEG photograph, or a recipe (.toml)`);
  }
  const files = new Map(await Promise.all(list.map(async (one) => [one.path, await read(one.file)])));
  const name = path.includes('/') ? path.split('/')[0] : 'the files';
  return { kind: 'pack', name, files: ofPack(files, name) };
}

async function unzip(bytes, path) {
  try {
    return await readZip(bytes);
  } catch (error) {
    throw new Error(`${path}: ${error.message}`, { cause: error });
  }
}

/**
 * The files of a pack, without the folders that it lies in: those beside the manifest that lies highest.
 * @param {Map<string, Uint8Array>} files
 */
export function ofPack(files, name) {
  const manifests = [...files.keys()].filter((path) => path === MANIFEST || path.endsWith(`/${MANIFEST}`));
  if (manifests.length === 0) throw new Error(`${name} has no ${MANIFEST}, so it is no pack`);
  const [highest] = manifests.sort((a, b) => a.split('/').length - b.split('/').length || a.localeCompare(b));
  const folder = highest.slice(0, -MANIFEST.length);
  return new Map([...files].filter(([path]) => path.startsWith(folder)).map(([path, bytes]) => [path.slice(folder.length), bytes]));
}
