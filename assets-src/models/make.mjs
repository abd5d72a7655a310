// Makes the example models of clouds: boxes as an artist would place them in Blender or any other tool that exports glTF with
// custom properties. heap.gltf is text with its bytes inside, tower.glb is binary.
//
// node make.mjs [FOLDER]

import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = process.argv[2] ?? dirname(fileURLToPath(import.meta.url));

// A cube of side 2 about the origin, as Blender adds it; bit 0 of a corner's number is x, bit 1 y, bit 2 z.
const corners = [...Array(8).keys()].map((n) => [0, 1, 2].map((bit) => ((n >> bit) & 1 ? 1 : -1)));
const triangles = [
  0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6,
];
const cube = Buffer.concat([
  Buffer.from(new Float32Array(corners.flat()).buffer),
  Buffer.from(new Uint16Array(triangles).buffer),
]);

// `boxes`: name, middle, size and what the artist says of its sprites, in metres and degrees.
function model(name, boxes, uri) {
  return {
    asset: { version: '2.0', generator: 'assets-src/models/make.mjs' },
    scene: 0,
    scenes: [{ name, nodes: [boxes.length] }],
    nodes: [
      ...boxes.map(([box, translation, size, extras]) => ({
        name: box,
        mesh: 0,
        translation,
        scale: size.map((side) => side / 2),
        extras,
      })),
      { name, children: boxes.map((_, index) => index) },
    ],
    meshes: [{ name: 'Cube', primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 8, type: 'VEC3', min: [-1, -1, -1], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5123, count: 36, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: 96, target: 34962 },
      { buffer: 0, byteOffset: 96, byteLength: 72, target: 34963 },
    ],
    buffers: [{ byteLength: cube.length, ...(uri && { uri }) }],
  };
}

const round = { width_m: [210, 330], height_m: [190, 290], category: 'cumulus' };
const base = { ...round, group: 0, flat_bottom: true, sprites: 14, rotation_deg: [-180, 180] };
const heap = model(
  'heap',
  [
    ['base', [0, 110, 0], [900, 220, 520], base],
    ['base across', [-60, 110, 20], [560, 220, 800], { ...base, sprites: 12 }],
    ['crown', [-80, 420, 0], [460, 420, 430], { ...round, group: 1, sprites: 20 }],
    ['shoulder', [270, 300, -60], [340, 260, 340], { ...round, group: 2, sprites: 10 }],
    ['knob', [-330, 270, 170], [280, 220, 300], { ...round, group: 3, sprites: 8 }],
    [
      'fringe',
      [520, 160, 60],
      [180, 140, 320],
      { sprites: 4, width_m: [200, 320], height_m: [130, 200], category: 'wispy', rotation_deg: [-20, 20], group: 0 },
    ],
  ],
  `data:application/octet-stream;base64,${cube.toString('base64')}`,
);

const large = { width_m: [400, 600], height_m: [360, 540], category: 'cumulus' };
const foot = { ...large, group: 0, flat_bottom: true, sprites: 22 };
const storeys = [...Array(5).keys()].map((i) => [
  `storey ${i + 1}`,
  [60 * [0, 1, 0, -1, 0][i], 500 + 560 * i, 60 * [1, 0, -1, 0, 1][i]],
  [1150 - 110 * i, 640, 1080 - 100 * i],
  { ...large, group: 1 + (i >> 1), sprites: 26 - 3 * i },
]);
const tower = model('tower', [
  ['foot', [0, 180, 0], [1700, 360, 1000], foot],
  ['foot across', [0, 180, 0], [1000, 360, 1500], { ...foot, sprites: 18 }],
  ...storeys,
  ['side', [560, 620, 260], [700, 800, 640], { ...large, group: 4, sprites: 14 }],
  ['other side', [-520, 540, -320], [620, 640, 600], { ...large, group: 5, sprites: 12, cull: 0.25 }],
]);

function binary(json, bytes) {
  const chunk = (type, data, filler) => {
    const padded = Buffer.concat([data, Buffer.alloc(-data.length & 3, filler)]);
    const head = Buffer.alloc(8);
    head.writeUInt32LE(padded.length, 0);
    head.write(type, 4, 'latin1');
    return Buffer.concat([head, padded]);
  };
  const chunks = [chunk('JSON', Buffer.from(JSON.stringify(json)), ' '), chunk('BIN\0', bytes, 0)];
  const head = Buffer.from('glTF\x02\0\0\0\0\0\0\0', 'latin1');
  head.writeUInt32LE(head.length + chunks[0].length + chunks[1].length, 8);
  return Buffer.concat([head, ...chunks]);
}

writeFileSync(join(folder, 'heap.gltf'), `${JSON.stringify(heap, null, 1)}\n`);
writeFileSync(join(folder, 'tower.glb'), binary(tower, cube));
