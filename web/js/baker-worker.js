// Bakes one pack: `{recipe, seed, inputs}` comes in, `{step, done, total, notice}` goes out, then `{files}` or `{error}`.

import init, { bake } from './baker.js';

onmessage = async ({ data: { recipe, seed, inputs } }) => {
  try {
    await init({ module_or_path: new URL('./baker_bg.wasm', import.meta.url) });
    const files = bake(recipe, seed, inputs, (step, done, total, notice) => postMessage({ step, done, total, notice }));
    postMessage({ files }, [...files.values()].map((bytes) => bytes.buffer));
  } catch (error) {
    postMessage({ error: error.message });
  }
};
