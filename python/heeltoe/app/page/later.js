/** Pages that say by which command the same is done. */
import { element } from "./dom.js";

/**
 * @param {string} name
 * @param {string} label
 * @param {string} text
 * @param {string} command
 */
export function laterPage(name, label, text, command) {
  return {
    name,
    label,
    /** @param {HTMLElement} root */
    mount(root) {
      root.append(element("div", { class: "page" }, element("h2", {}, label), element("p", {}, text, " ", element("code", {}, command))));
    },
  };
}
