// The files of a pack, from the network or from memory.

const MANIFEST = 'pack.json';
/** What a pack's file may be called: nothing that leads out of its folder. */
const NAME = /^[\w-][\w.-]*$/;

/** Files by name as a map, whatever they came as. */
export const asMap = (files) => (files instanceof Map ? files : new Map(Object.entries(files)));

/** Fetches a pack from its folder: the manifest, then all that it names at once. */
export async function fetchPack(address, onprogress) {
  const folder = new URL(String(address).replace(/\/?$/, '/'), document.baseURI);
  const files = new Map();
  const manifest = await fetchFile(folder, MANIFEST);
  // What is missing is told by the reader of packs, in its own words.
  if (manifest === null) return files;
  files.set(MANIFEST, manifest);
  const named = entries(manifest);
  const total = named.reduce((sum, { bytes }) => sum + bytes, manifest.length);
  let done = manifest.length;
  onprogress?.(done, total);
  await Promise.all(named.map(async ({ name, bytes }) => {
    const file = await fetchFile(folder, name);
    if (file !== null) files.set(name, file);
    done += bytes;
    onprogress?.(done, total);
  }));
  return files;
}

/** Names and lengths of the files that a manifest has; none if it is not one. */
function entries(bytes) {
  let manifest;
  try {
    manifest = JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    return [];
  }
  const { textures, field } = manifest ?? {};
  return [...(Array.isArray(textures) ? textures : []), field]
    .filter((entry) => typeof entry?.file === 'string' && NAME.test(entry.file))
    .map(({ file, file_bytes }) => ({ name: file, bytes: Number(file_bytes) || 0 }));
}

/** A file's bytes, or null if there is none. */
async function fetchFile(folder, name) {
  const address = new URL(name, folder);
  let answer;
  try {
    answer = await fetch(address);
  } catch (cause) {
    throw new Error(`${address}: cannot be fetched: ${cause.message}`, { cause });
  }
  if (answer.status === 404 || answer.status === 410) return null;
  if (!answer.ok) throw new Error(`${address}: cannot be fetched: the server answers ${answer.status}`);
  return new Uint8Array(await answer.arrayBuffer());
}
