// Reads KTX2 files with readers that share no code with Welkin: ktx-parse for the container and zstddec
// (the reference Zstandard, compiled to WebAssembly) for the levels. For each FILE it writes the texels of
// all levels, largest first, to OUT/NAME.raw, and prints one JSON line about the container.
//
// node read.mjs OUT FILE...

import { readFileSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { KHR_SUPERCOMPRESSION_ZSTD, read } from 'ktx-parse';
import { ZSTDDecoder } from 'zstddec';

const [out, ...files] = process.argv.slice(2);
const zstd = new ZSTDDecoder();
await zstd.init();

for (const file of files) {
  const container = read(new Uint8Array(readFileSync(file)));
  const levels = container.levels.map((level) =>
    container.supercompressionScheme === KHR_SUPERCOMPRESSION_ZSTD
      ? zstd.decode(level.levelData, level.uncompressedByteLength)
      : level.levelData,
  );
  writeFileSync(join(out, `${basename(file)}.raw`), Buffer.concat(levels));
  console.log(
    JSON.stringify({
      file: basename(file),
      vkFormat: container.vkFormat,
      width: container.pixelWidth,
      height: container.pixelHeight,
      layers: container.layerCount,
      faces: container.faceCount,
      levels: levels.map((level) => level.byteLength),
      orientation: container.keyValue.KTXorientation,
      writer: container.keyValue.KTXwriter,
      bytesPlane0: container.dataFormatDescriptor[0].bytesPlane[0],
      transfer: container.dataFormatDescriptor[0].transferFunction,
    }),
  );
}
