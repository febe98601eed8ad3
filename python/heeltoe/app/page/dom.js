/** Elements of the page. Texts go in as texts alone, so that what a case is called is never taken for markup. */

export { element } from "../player/element.js";

/**
 * An element of a drawing.
 * @param {string} tag
 * @param {Record<string, unknown>} attributes
 * @param {...(Node | string)} content
 */
export function svg(tag, attributes, ...content) {
  const made = /** @type {SVGElement} */ (document.createElementNS("http://www.w3.org/2000/svg", tag));
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...content);
  return made;
}

/**
 * @param {string} id
 * @returns {HTMLElement}
 */
export function byId(id) {
  const node = document.getElementById(id);
  if (!node) throw new Error(`there is no ${id} in the page`);
  return node;
}

/**
 * A colour of the page's style, by its name there.
 * @param {string} name
 */
export function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
