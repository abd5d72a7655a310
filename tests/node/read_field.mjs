// Reads a field of clouds with programs that share no code with Welkin: Khronos's glTF-Validator and glTF-Transform. Prints one
// JSON object: what the validator counts, the scene's extras, and every attribute of every instanced node.
//
// node read_field.mjs FIELD.glb

import { readFileSync } from 'node:fs';
import { NodeIO } from '@gltf-transform/core';
import { EXTMeshGPUInstancing } from '@gltf-transform/extensions';
import validator from 'gltf-validator';

const bytes = new Uint8Array(readFileSync(process.argv[2]));
const report = await validator.validateBytes(bytes, { maxIssues: 0 });
const document = await new NodeIO().registerExtensions([EXTMeshGPUInstancing]).readBinary(bytes);

const nodes = {};
for (const node of document.getRoot().listNodes()) {
  const instances = node.getExtension('EXT_mesh_gpu_instancing');
  const attributes = {};
  for (const name of instances.listSemantics()) {
    const accessor = instances.getAttribute(name);
    const element = (i) => accessor.getElement(i, new Array(accessor.getElementSize()));
    attributes[name] = [...Array(accessor.getCount()).keys()].map(element);
  }
  const mesh = node.getMesh().listPrimitives()[0];
  nodes[node.getName()] = { corners: mesh.getAttribute('POSITION').getCount(), attributes };
}
const { numErrors, numWarnings } = report.issues;
const extras = document.getRoot().listScenes()[0].getExtras();
console.log(JSON.stringify({ numErrors, numWarnings, messages: report.issues.messages, extras, nodes }));
