/** Fields of a form, each with its label, what is said of it, and a place for what is wrong with it. */
import { element } from "../dom.js";

let made = 0;

/** @param {{id?: string, label: string, hint?: string, example?: string, at?: string}} of */
export function field({ id, label, hint = "", example = "", at = "" }) {
  made += 1;
  const own = id || `field-${made}`;
  const input = /** @type {HTMLInputElement} */ (element("input", { type: "text", id: own, placeholder: example, autocomplete: "off", spellcheck: "false", "aria-describedby": `${own}-hint` }));
  const text = element("span", { class: "hint", id: `${own}-hint` }, hint);
  const root = element("div", { class: "entry", "data-field": at }, element("label", { for: own }, label), input, text, element("p", { class: "wrong", role: "status" }));
  return { root, input, hint: text };
}

/** @param {{id?: string, label: string, options: [string, string][], at?: string}} of */
export function select({ id, label, options, at = "" }) {
  made += 1;
  const own = id || `field-${made}`;
  const input = /** @type {HTMLSelectElement} */ (element("select", { id: own }, ...options.map(([value, text]) => element("option", { value }, text))));
  const root = element("div", { class: "entry", "data-field": at }, element("label", { for: own }, label), input, element("p", { class: "wrong", role: "status" }));
  return { root, input };
}

/** @param {string} label @param {boolean} disabled */
export function check(label, disabled = false) {
  const input = /** @type {HTMLInputElement} */ (element("input", { type: "checkbox", disabled }));
  return { root: element("label", { class: "tick" }, input, ` ${label}`), input };
}
