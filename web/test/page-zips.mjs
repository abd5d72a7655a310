// Zip files made by hand, sound ones and others.

import { deflateRawSync } from 'node:zlib';
import { crc32 } from '../page/zip.js';

/**
 * A zip of these entries.
 * @param {{name: string, bytes: Uint8Array, stored?: boolean, local?: object, central?: object}[]} entries fields in `local` and
 *   `central` take the place of the right ones
 * @param {{comment?: string, end?: object}} options
 */
export function makeZip(entries, { comment = '', end = {} } = {}) {
  const parts = [];
  const directory = [];
  let offset = 0;
  for (const { name, bytes, stored = false, local = {}, central = {} } of entries) {
    const packed = stored ? Buffer.from(bytes) : deflateRawSync(bytes);
    const fields = {
      flags: 0x0800, method: stored ? 0 : 8, crc: crc32(bytes), packed: packed.length, bytes: bytes.length, offset, name: Buffer.from(name),
    };
    const head = localHeader({ ...fields, ...local });
    parts.push(head, packed);
    directory.push(centralHeader({ ...fields, ...central }));
    offset += head.length + packed.length;
  }
  const central = Buffer.concat(directory);
  const fields = { disk: 0, count: entries.length, size: central.length, start: offset, comment: Buffer.from(comment), ...end };
  return new Uint8Array(Buffer.concat([...parts, central, endRecord(fields)]));
}

function localHeader({ flags, method, crc, packed, bytes, name }) {
  const head = Buffer.alloc(30);
  head.writeUInt32LE(0x04034b50, 0);
  head.writeUInt16LE(20, 4);
  head.writeUInt16LE(flags, 6);
  head.writeUInt16LE(method, 8);
  head.writeUInt32LE(crc, 14);
  head.writeUInt32LE(packed, 18);
  head.writeUInt32LE(bytes, 22);
  head.writeUInt16LE(name.length, 26);
  return Buffer.concat([head, name]);
}

function centralHeader({ flags, method, crc, packed, bytes, offset, name, signature = 0x02014b50 }) {
  const head = Buffer.alloc(46);
  head.writeUInt32LE(signature, 0);
  head.writeUInt16LE(flags, 8);
  head.writeUInt16LE(method, 10);
  head.writeUInt32LE(crc, 16);
  head.writeUInt32LE(packed, 20);
  head.writeUInt32LE(bytes, 24);
  head.writeUInt16LE(name.length, 28);
  head.writeUInt32LE(offset, 42);
  return Buffer.concat([head, name]);
}

function endRecord({ disk, count, size, start, comment }) {
  const end = Buffer.alloc(22);
  end.writeUInt32LE(0x06054b50, 0);
  end.writeUInt16LE(disk, 4);
  end.writeUInt16LE(disk, 6);
  end.writeUInt16LE(count, 8);
  end.writeUInt16LE(count, 10);
  end.writeUInt32LE(size, 12);
  end.writeUInt32LE(start, 16);
  end.writeUInt16LE(comment.length, 20);
  return Buffer.concat([end, comment]);
}
