/** What a report says, as elements of the page: sections, tables, notes and figures. */
import { element } from "../dom.js";

/** @param {any} block */
function made(block) {
  const make = /** @type {Record<string, (block: any) => HTMLElement>} */ (KINDS)[block.kind];
  return make(block);
}

/** @param {{as: string, text: string}[]} parts */
const inline = (parts) => parts.map((part) => (part.as ? element(part.as, {}, part.text) : part.text));

/** @param {any} block */
function table(block) {
  const align = (/** @type {number} */ place) => (block.align[place] === "r" ? "right" : "");
  const head = element("tr", {}, ...block.head.map((/** @type {string} */ text, /** @type {number} */ place) => (text ? element("th", { scope: "col", class: align(place) }, text) : element("td", {}))));
  const rows = block.rows.map((/** @type {any[]} */ row) => element("tr", {}, ...row.map((cell, place) => element(place ? "td" : "th", place ? { class: align(place) } : { scope: "row" }, ...inline(cell)))));
  const caption = block.caption ? [element("caption", {}, block.caption)] : [];
  // It scrolls by itself where it is wider than the page, with keys, too.
  return element("div", { class: "wide", tabindex: "0", role: "region", "aria-label": block.caption || "Table" }, element("table", { class: "answers" }, ...caption, element("thead", {}, head), element("tbody", {}, ...rows)));
}

/** @param {any} block */
function figure(block) {
  const image = element("img", { src: `data:image/svg+xml;base64,${block.svg}`, alt: block.caption });
  image.style.maxWidth = `${Math.round(100 * block.width)}px`;
  return element("figure", { "data-figure": block.name }, image, element("figcaption", {}, block.caption));
}

const KINDS = {
  section: (/** @type {any} */ block) => element("section", {}, element("h3", {}, block.title), ...block.blocks.map(made)),
  paragraph: (/** @type {any} */ block) => element("p", {}, ...inline(block.parts)),
  notes: (/** @type {any} */ block) => element("div", { class: `notes ${block.grave}` }, element("h4", {}, block.title), element("ul", {}, ...block.items.map((/** @type {any} */ item) => element("li", {}, ...inline(item))))),
  listing: (/** @type {any} */ block) => element("pre", { tabindex: "0" }, block.text),
  table,
  figure,
};

/** @param {{title: string, subtitle: string, blocks: any[]}} content */
export function documentOf(content) {
  return element("article", { class: "document" }, element("h2", {}, content.title), element("p", { class: "faint" }, content.subtitle), ...content.blocks.map(made));
}
