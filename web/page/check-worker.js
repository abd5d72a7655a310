// Checks a pack beside the page, so that the sky does not stand still meanwhile: a map of files comes in, `{report}` or `{error}` goes out.

import { check, controls } from './welkin.js';

onmessage = async ({ data: files }) => {
  try {
    // Loads the engine.
    await controls();
    postMessage({ report: check(files) });
  } catch (error) {
    postMessage({ error: error.message });
  }
};
