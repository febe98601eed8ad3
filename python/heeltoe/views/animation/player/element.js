/**
 * An element of a page. Texts go in as texts alone, so that what a case is called is never taken for markup.
 * @param {string} tag
 * @param {Record<string, unknown>} properties Attributes; those that begin with "on" are listeners.
 * @param {...(Node | string)} content
 * @returns {HTMLElement}
 */
export function element(tag, properties = {}, ...content) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), /** @type {EventListener} */ (value));
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value != null) made.setAttribute(name, String(value));
  }
  made.append(...content);
  return made;
}
