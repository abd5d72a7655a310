// Bakes packs in a worker of its own, which is loaded by the first bake and ended after each.

/** Pictures that are delivered with the page, by the names under which recipes ask for them. */
const DELIVERED = { '../photos/clouds-web.jpg': new URL('./clouds-web.jpg', import.meta.url) };

/** Bakes a recipe. */
export async function bake(recipe, { seed, files = new Map(), onprogress, signal } = {}) {
  signal?.throwIfAborted();
  const inputs = new Map(files instanceof Map ? files : Object.entries(files));
  for (const [name, address] of Object.entries(DELIVERED)) {
    if (recipe.includes(name) && !inputs.has(name)) inputs.set(name, await fetchInput(address, signal));
  }
  return work({ recipe, seed: seedOf(seed), inputs }, onprogress, signal);
}

async function fetchInput(address, signal) {
  const answer = await fetch(address, { signal });
  if (!answer.ok) throw new Error(`${address}: cannot be fetched: the server answers ${answer.status}`);
  return new Uint8Array(await answer.arrayBuffer());
}

/** A seed as the baker takes it, or nothing: then it is the recipe's. */
function seedOf(seed) {
  if (seed === undefined || seed === null || seed === '') return undefined;
  if (!/^\d+$/.test(String(seed)) || BigInt(seed) >= 1n << 64n) {
    throw new Error(`seed is ${seed}, expected a whole number from 0 to ${(1n << 64n) - 1n}`);
  }
  return BigInt(seed);
}

/** The worker. No browser starts one of another origin, such as that of a CDN; one of this page's own may import it. */
function open() {
  try {
    // Written out, as bundlers look for it.
    return new Worker(new URL('./baker-worker.js', import.meta.url), { type: 'module', name: 'welkin baker' });
  } catch (error) {
    if (error.name !== 'SecurityError') throw error;
  }
  const module = new URL('./baker-worker.js', import.meta.url).href;
  const address = URL.createObjectURL(new Blob([`import ${JSON.stringify(module)};`], { type: 'text/javascript' }));
  // It is read when the worker starts, a moment after this.
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
  return new Worker(address, { type: 'module', name: 'welkin baker' });
}

function work(order, onprogress, signal) {
  const worker = open();
  const aborted = () => finish(() => reject(signal.reason));
  const finish = (settle) => {
    worker.terminate();
    signal?.removeEventListener('abort', aborted);
    settle();
  };
  let reject;
  const done = new Promise((resolve, refuse) => {
    reject = refuse;
    worker.onmessage = ({ data }) => {
      if (data.files) finish(() => resolve(data.files));
      else if (data.error) finish(() => reject(new Error(data.error)));
      else onprogress?.(data.done / data.total, data.step, data.notice);
    };
    worker.onerror = (event) => {
      event.preventDefault();
      finish(() => reject(new Error(`the baker stopped: ${event.message ?? 'it could not be loaded'}`)));
    };
    signal?.addEventListener('abort', aborted);
  });
  worker.postMessage(order);
  return done;
}
