// Settings in the page's address: `?method=lit&cover=0.5`. What is not a setting is the page's own.

/** Names that are the page's own. */
export const OWN = ['pack', 'backend', 'paused'];

/**
 * What an address asks for.
 * @param {string} search such as `?cover=0.5`
 * @returns {{own: Record<string, string>, pairs: [string, string][]}}
 */
export function readLink(search) {
  const own = {};
  const pairs = [];
  for (const [name, text] of new URLSearchParams(search)) {
    if (OWN.includes(name)) own[name] = text;
    else pairs.push([name, text]);
  }
  return { own, pairs };
}

/**
 * The address of these settings, `?` and all, or nothing where there are none.
 * @param {Record<string, string>} own
 * @param {[string, string][]} pairs
 */
export function writeLink(own, pairs) {
  const all = [...Object.entries(own), ...pairs].filter(([, text]) => text !== undefined && text !== null && text !== '');
  return all.length ? `?${all.map((pair) => pair.map(readable).join('=')).join('&')}` : '';
}

/** Escaped, but for what may stand in a query and is in every link of ours. */
const readable = (text) => encodeURIComponent(text).replace(/%(2C|3A|2F)/g, decodeURIComponent);

/** Calls `write` at most every `wait_ms`, and always after the last call. */
export function throttled(write, wait_ms) {
  let timer = null;
  return () => {
    timer ??= setTimeout(() => {
      timer = null;
      write();
    }, wait_ms);
  };
}
