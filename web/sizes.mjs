// `node sizes.mjs FOLDER`: prints what each file of a built page weighs, and writes it to FOLDER/sizes.json for the page.

import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, gzipSync } from 'node:zlib';

const [folder] = process.argv.slice(2);
const files = {};
const total = { bytes: 0, compressed: 0, brotli: 0 };
for (const name of readdirSync(folder, { recursive: true }).map(String).sort()) {
  const path = join(folder, name);
  // Types are for editors; no browser fetches them.
  if (!statSync(path).isFile() || /\.d\.ts$|^sizes\.json$/.test(name)) continue;
  const bytes = readFileSync(path);
  files[name] = { bytes: bytes.length, compressed: gzipSync(bytes, { level: 9 }).length, brotli: brotliCompressSync(bytes).length };
  for (const kind of Object.keys(total)) total[kind] += files[name][kind];
}
writeFileSync(join(folder, 'sizes.json'), `${JSON.stringify({ files, total }, null, 1)}\n`);
const row = (name, { bytes, compressed, brotli }) => [name.padEnd(24), ...[bytes, compressed, brotli].map((n) => String(n).padStart(10))].join('');
console.log(`${' '.repeat(24)}${['bytes', 'gzip -9', 'brotli'].map((word) => word.padStart(10)).join('')}`);
for (const [name, sizes] of Object.entries(files)) console.log(row(name, sizes));
console.log(row('in all', total));
