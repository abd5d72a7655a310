// Elements, without a framework.

/**
 * An element with properties and children. Texts become text nodes, never markup.
 * @param {string} tag
 * @param {Record<string, any>} [given] properties; `class`, `data-`, `aria-` and `role` are attributes, `on` holds listeners
 * @param {...(Node | string | null)} children
 */
export function el(tag, given = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (name === 'on') {
      for (const [event, listener] of Object.entries(value)) element.addEventListener(event, listener);
    } else if (/^(class|role|for|list|form|data-|aria-)/.test(name)) {
      element.setAttribute(name, value);
    } else {
      element[name] = value;
    }
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** The element of this id, which the page has. */
export const byId = (id) => document.getElementById(id);

/** What went wrong, as text. */
export const reason = (error) => (error instanceof Error ? error.message : String(error));

/** Bytes, as people read them. */
export function bytesText(bytes) {
  if (bytes < 1000) return `${bytes} B`;
  if (bytes < 999_500) return `${(bytes / 1e3).toFixed(0)} kB`;
  return `${(bytes / 1e6).toFixed(2)} MB`;
}

/** Whether the person's keys go into a text. */
export function isTyping(target) {
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement
    || (target instanceof HTMLInputElement && !['range', 'radio', 'checkbox', 'color', 'file'].includes(target.type));
}
