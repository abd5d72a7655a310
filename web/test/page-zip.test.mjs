// The reader of zips: what it reads, and what it refuses.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { LIMITS, crc32, readZip } from '../page/zip.js';
import { makeZip } from './page-zips.mjs';

const text = (words) => new TextEncoder().encode(words);
const HELLO = { name: 'a/hello.txt', bytes: text('hello hello hello hello') };
const refuses = (zip, words, limits) => assert.rejects(readZip(zip, limits), (error) => {
  assert.equal(error.constructor.name, 'ZipError');
  assert.match(error.message, words);
  return true;
});

test('stored and deflated entries come back, folders do not', async () => {
  const big = Uint8Array.from({ length: 300_000 }, (_, i) => (i * i) >> 7);
  const files = await readZip(makeZip([
    { name: 'a/', bytes: text(''), stored: true }, HELLO, { name: 'b', bytes: big }, { name: 'c', bytes: big, stored: true },
    { name: 'empty', bytes: text('') }, { name: 'wölkchen.png', bytes: text('x'), stored: true },
  ], { comment: 'made by hand' }));
  assert.deepEqual([...files.keys()], ['a/hello.txt', 'b', 'c', 'empty', 'wölkchen.png']);
  assert.deepEqual(files.get('a/hello.txt'), HELLO.bytes);
  assert.deepEqual([files.get('b'), files.get('c'), files.get('empty')], [big, big, text('')]);
});

test('an empty zip has no files', async () => {
  assert.equal((await readZip(makeZip([]))).size, 0);
});

test('sizes after the contents are those of the directory', async () => {
  const files = await readZip(makeZip([{ ...HELLO, local: { flags: 0x0808, crc: 0, packed: 0, bytes: 0 } }]));
  assert.deepEqual(files.get(HELLO.name), HELLO.bytes);
});

test('the checksum is the one that everybody has', () => {
  assert.equal(crc32(text('123456789')), 0xcbf43926);
});

test('what is no zip is told', async () => {
  await refuses(text(''), /no zip file/);
  await refuses(text('hello, this is a text of some length'), /no zip file/);
  await refuses(makeZip([HELLO]).slice(0, -1), /no zip file/);
});

test('a damaged entry is told by its name', async () => {
  const zip = makeZip([{ ...HELLO, stored: true }]);
  zip[30 + HELLO.name.length] ^= 1;
  await refuses(zip, /a\/hello\.txt is damaged: its checksum/);
  await refuses(makeZip([{ ...HELLO, central: { crc: 1 } }]), /its checksum/);
  const deflated = makeZip([HELLO]);
  deflated.fill(0xff, 30 + HELLO.name.length, 40 + HELLO.name.length);
  await refuses(deflated, /cannot be inflated/);
});

test('every cut of a zip is refused, and none crashes', async () => {
  const zip = makeZip([HELLO, { ...HELLO, name: 'b', stored: true }]);
  for (let end = 0; end < zip.length; end += 1) await refuses(zip.slice(0, end), /no zip file|directory/);
});

test('every changed byte gives the same files or an error of ours', async () => {
  const zip = makeZip([HELLO]);
  for (let at = 0; at < zip.length; at += 1) {
    const changed = zip.slice();
    changed[at] ^= 0xff;
    const files = await readZip(changed).catch((error) => {
      assert.equal(error.constructor.name, 'ZipError', `byte ${at}: ${error.stack}`);
      return null;
    });
    for (const bytes of files?.values() ?? []) assert.deepEqual(bytes, HELLO.bytes);
  }
});

test('offsets that lead out of the file are refused', async () => {
  await refuses(makeZip([{ ...HELLO, central: { offset: 0x7fffffff } }]), /does not lie in the file/);
  await refuses(makeZip([{ ...HELLO, central: { offset: 1 } }]), /not where the directory says/);
  await refuses(makeZip([HELLO], { end: { start: 1_000_000 } }), /directory does not lie in the file/);
  await refuses(makeZip([HELLO], { end: { start: 0 } }), /directory is damaged/);
  await refuses(makeZip([HELLO], { end: { count: 2 } }), /entry 2 of its directory is damaged/);
});

test('a zip that swells is refused by what it says and by what it does', async () => {
  const zeros = new Uint8Array(4_000_000);
  await refuses(makeZip([{ name: 'bomb', bytes: zeros, central: { bytes: 0xfffffff0 } }]), /more than 268435456 bytes/);
  await refuses(makeZip([{ name: 'bomb', bytes: zeros, central: { bytes: 100 } }]), /more than the 100 bytes that it says/);
  await refuses(makeZip([{ name: 'bomb', bytes: zeros.slice(0, 10), central: { bytes: 4000 } }]), /has 10 bytes, not the 4000/);
  await refuses(makeZip([{ name: 'a', bytes: zeros }, { name: 'b', bytes: zeros }]), /more than 5000000 bytes/, { ...LIMITS, bytes: 5_000_000 });
  const many = Array.from({ length: 11 }, (_, i) => ({ name: `f${i}`, bytes: text('') }));
  await refuses(makeZip(many), /11 entries, expected at most 10/, { ...LIMITS, entries: 10 });
});

test('entries that share their bytes are refused', async () => {
  const noise = Uint8Array.from({ length: 5000 }, (_, i) => (i * 2654435761) >>> 13);
  const shared = { offset: 0, packed: 5000, bytes: 5000, crc: crc32(noise), method: 0 };
  const copies = Array.from({ length: 9 }, (_, i) => ({ name: `copy${i}`, bytes: text(''), stored: true, central: shared }));
  await refuses(makeZip([{ name: 'first', bytes: noise, stored: true }, ...copies]), /lie over each other/);
});

test('encryption, other methods, parts and zip64 are told', async () => {
  await refuses(makeZip([{ ...HELLO, central: { flags: 1 } }]), /a\/hello\.txt is encrypted/);
  await refuses(makeZip([{ ...HELLO, central: { method: 14 } }]), /compressed by method 14, expected 0 \(stored\) or 8/);
  await refuses(makeZip([HELLO], { end: { disk: 1 } }), /several parts/);
  await refuses(makeZip([HELLO], { end: { start: 0xffffffff } }), /zip64/);
});

test('names that lead elsewhere, and names that come twice, are refused', async () => {
  for (const name of ['../a', 'a/../b', '/etc/a', 'C:/a', 'a\\b', 'a//b', 'a\0b']) {
    await refuses(makeZip([{ ...HELLO, name }]), /is no name for a file in a pack/);
  }
  await refuses(makeZip([HELLO, HELLO]), /is in it twice/);
});
