// Reads zip files: stored and deflated entries, through their central directory. PKWARE, APPNOTE.TXT 6.3.10, section 4.3.

const END = 0x06054b50;
const CENTRAL = 0x02014b50;
const LOCAL = 0x04034b50;

/** More than any pack has. */
export const LIMITS = { entries: 1000, bytes: 256 * 1024 * 1024 };

/** What is wrong with a zip file. */
export class ZipError extends Error {}

/**
 * The files in a zip, by their names; folders are left out.
 * @param {Uint8Array} zip
 * @param {{entries: number, bytes: number}} limits of the number of entries and of all their bytes
 * @returns {Promise<Map<string, Uint8Array>>}
 */
export async function readZip(zip, limits = LIMITS) {
  const view = new DataView(zip.buffer, zip.byteOffset, zip.byteLength);
  const entries = directory(view, zip, limits);
  const files = new Map();
  for (const entry of entries) {
    if (files.has(entry.name)) throw new ZipError(`${entry.name} is in it twice`);
    const packed = contents(view, zip, entry);
    const bytes = entry.method === 0 ? packed.slice() : await inflate(packed, entry);
    if (crc32(bytes) !== entry.crc) throw new ZipError(`${entry.name} is damaged: its checksum is another`);
    files.set(entry.name, bytes);
  }
  return files;
}

/** The entries that the central directory names, within the limits. */
function directory(view, zip, limits) {
  const end = findEnd(view);
  const [disk, first_disk, here, count] = [4, 6, 8, 10].map((at) => view.getUint16(end + at, true));
  const [size, start] = [12, 16].map((at) => view.getUint32(end + at, true));
  if (disk !== 0 || first_disk !== 0 || here !== count) throw new ZipError('a zip in several parts cannot be read');
  if (count === 0xffff || start === 0xffffffff) throw new ZipError('a zip64 cannot be read; a pack needs none');
  if (count > limits.entries) throw new ZipError(`${count} entries, expected at most ${limits.entries}`);
  if (start + size > end) throw new ZipError('its directory does not lie in the file');
  const entries = [];
  let [at, declared, stored] = [start, 0, 0];
  for (let i = 0; i < count; i += 1) {
    if (at + 46 > start + size || view.getUint32(at, true) !== CENTRAL) throw new ZipError(`entry ${i + 1} of its directory is damaged`);
    const [flags, method] = [8, 10].map((place) => view.getUint16(at + place, true));
    const [crc, packed, bytes] = [16, 20, 24].map((place) => view.getUint32(at + place, true));
    const [name_size, extra_size, comment_size] = [28, 30, 32].map((place) => view.getUint16(at + place, true));
    const next = at + 46 + name_size + extra_size + comment_size;
    if (next > start + size) throw new ZipError(`entry ${i + 1} of its directory is damaged`);
    const name = new TextDecoder().decode(zip.subarray(at + 46, at + 46 + name_size));
    const local = view.getUint32(at + 42, true);
    at = next;
    declared += bytes;
    stored += packed;
    if (declared > limits.bytes) throw new ZipError(`its files have more than ${limits.bytes} bytes`);
    // More than the file has means that entries share bytes, as in a zip that swells beyond measure.
    if (stored > zip.byteLength) throw new ZipError('its entries lie over each other');
    if (name.endsWith('/')) continue;
    verify(name, flags, method);
    entries.push({ name, method, crc, packed, bytes, local });
  }
  return entries;
}

function verify(name, flags, method) {
  const parts = name.split('/');
  if (!name || name.includes('\\') || name.includes('\0') || /^[a-z]:/i.test(name) || parts.some((part) => part === '..' || part === '')) {
    throw new ZipError(`"${name}" is no name for a file in a pack`);
  }
  if (flags & 0x2041) throw new ZipError(`${name} is encrypted`);
  if (method !== 0 && method !== 8) throw new ZipError(`${name} is compressed by method ${method}, expected 0 (stored) or 8 (deflated)`);
}

/** The record at the end, which a comment of at most 65535 bytes may follow. */
function findEnd(view) {
  const size = view.byteLength;
  for (let at = size - 22; at >= Math.max(0, size - 22 - 0xffff); at -= 1) {
    if (view.getUint32(at, true) === END && at + 22 + view.getUint16(at + 20, true) === size) return at;
  }
  throw new ZipError('this is no zip file: it has no directory');
}

/** The bytes of an entry as they lie in the file. */
function contents(view, zip, { name, local, packed, bytes, method }) {
  const outside = () => new ZipError(`${name} does not lie in the file`);
  if (local + 30 > zip.byteLength) throw outside();
  if (view.getUint32(local, true) !== LOCAL) throw new ZipError(`${name} is not where the directory says`);
  const start = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
  if (start + packed > zip.byteLength) throw outside();
  if (method === 0 && packed !== bytes) throw new ZipError(`${name} is stored with two sizes`);
  return zip.subarray(start, start + packed);
}

/** Inflates an entry, and stops as soon as it has more bytes than it says. */
async function inflate(packed, { name, bytes }) {
  const out = new Uint8Array(bytes);
  let filled = 0;
  const reader = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw')).getReader();
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (filled + value.length > bytes) throw new ZipError(`${name} has more than the ${bytes} bytes that it says`);
      out.set(value, filled);
      filled += value.length;
    }
  } catch (error) {
    reader.cancel().catch(() => {});
    if (error instanceof ZipError) throw error;
    throw new ZipError(`${name} is damaged: it cannot be inflated`);
  }
  if (filled !== bytes) throw new ZipError(`${name} has ${filled} bytes, not the ${bytes} that it says`);
  return out;
}

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k += 1) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

/** The checksum of ISO 3309, as zip has it. */
export function crc32(bytes) {
  let c = 0xffffffff;
  for (let i = 0; i < bytes.length; i += 1) c = TABLE[(c ^ bytes[i]) & 0xff] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}
