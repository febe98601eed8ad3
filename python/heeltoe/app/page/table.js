/** A table of results, which is moved sideways where it is too wide. */
import { element } from "./dom.js";

/** @param {string} label @param {string[]} columns @param {Node[]} rows */
export function table(label, columns, rows) {
  const heads = columns.map((column) => element("th", { scope: "col" }, column));
  return element("div", { class: "table", tabindex: 0, role: "region", "aria-label": label }, element("table", { class: "numbers wide", "aria-label": label }, element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...rows)));
}

/** @param {string[]} cells */
export const row = (cells) => element("tr", {}, ...cells.map((cell) => element("td", {}, cell)));
