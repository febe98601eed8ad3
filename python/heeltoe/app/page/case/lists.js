/** Fields that hold rows of two numbers, as the corners of a section. */
import { controlOf, idOf, shown, wrongLine } from "./field.js";
import { element } from "../dom.js";

/** @typedef {import("./field.js").FieldOf} FieldOf */
/** @typedef {import("./field.js").Control} Control */

/**
 * @param {string} label
 * @param {string} title
 * @param {() => void} click
 */
const small = (label, title, click) => element("button", { type: "button", class: "small", "aria-label": title, title, onclick: click }, label);

/** Halfway between two texts with the same unit; the first one where they have not. @param {string} a @param {string} b */
function between(a, b) {
  const parts = [a, b].map((text) => /^\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*(.*?)\s*$/i.exec(text));
  if (!parts[0] || !parts[1] || parts[0][2] !== parts[1][2]) return a;
  return `${Number(((Number(parts[0][1]) + Number(parts[1][1])) / 2).toPrecision(8))} ${parts[0][2]}`.trim();
}

/** @param {any} value @returns {string[][]} */
const rowsOf = (value) => (Array.isArray(value) ? value.map((row) => (Array.isArray(row) ? [shown(row[0]), shown(row[1])] : [shown(row), ""])) : []);

/**
 * A table of rows of two cells.
 * @param {FieldOf} field
 * @param {string} path With places in lists.
 * @param {(rows: string[][]) => void} edit
 * @returns {Control & {insert: (after: number) => void, remove: (place: number) => void}}
 */
export function tableOf(field, path, edit) {
  /** @type {string[][]} */
  let rows = [];
  /** @type {{root: HTMLElement, cells: {control: HTMLElement, update: (value: any) => void}[]}[]} */
  const made = [];
  const body = element("tbody", {});
  const heads = field.inner.map((inner) => element("th", { scope: "col" }, inner.label + (inner.unit ? ` [${inner.unit}]` : "")));
  const table = element("table", { class: "rows", "aria-label": field.label }, element("thead", {}, element("tr", {}, element("th", { scope: "col" }, "No."), ...heads, element("td", {}))), body);
  const more = element("button", { type: "button", onclick: () => insert(rows.length - 1) }, `Add a row to ${field.label.toLowerCase()}`);
  const root = element(
    "div", { class: "field wide", id: idOf(path), "data-path": path, tabindex: "-1" },
    element("h3", {}, field.label), element("p", { class: "meaning" }, field.meaning), table, more, wrongLine(path),
  );

  function changed() {
    show();
    edit(rows.map((row) => [...row]));
  }

  /** @param {number} after */
  function insert(after) {
    const here = rows[after] || ["", ""];
    const next = rows[(after + 1) % rows.length] || here;
    rows.splice(after + 1, 0, [between(here[0], next[0]), between(here[1], next[1])]);
    changed();
    made[after + 1].cells[0].control.focus();
  }

  /** @param {number} place */
  function remove(place) {
    rows.splice(place, 1);
    changed();
    const next = made[Math.min(place, made.length - 1)];
    (next ? next.cells[0].control : more).focus();
  }

  /** @param {number} place @param {number} by */
  function move(place, by) {
    const to = place + by;
    if (to < 0 || to >= rows.length) return;
    [rows[place], rows[to]] = [rows[to], rows[place]];
    changed();
  }

  /** @param {number} place */
  function make(place) {
    const cells = field.inner.map((inner, column) => {
      return controlOf(inner, `${path}[${place}][${column}]`, (text) => {
        rows[place][column] = text;
        edit(rows.map((row) => [...row]));
      }, { "aria-label": `${inner.label}, row ${place + 1}` });
    });
    const buttons = [
      small("+", `Insert a row after row ${place + 1}`, () => insert(place)),
      small("↑", `Move row ${place + 1} up`, () => move(place, -1)),
      small("↓", `Move row ${place + 1} down`, () => move(place, 1)),
      small("×", `Remove row ${place + 1}`, () => remove(place)),
    ];
    const tr = element("tr", {}, element("th", { scope: "row" }, String(place + 1)), ...cells.map((cell, column) => element("td", {}, cell.control, wrongLine(`${path}[${place}][${column}]`))), element("td", { class: "buttons" }, ...buttons));
    // A cell has no meaning of its own.
    for (const { control } of cells) control.setAttribute("aria-describedby", `${control.id}-wrong`);
    return { root: tr, cells };
  }

  function show() {
    table.hidden = rows.length === 0;
    while (made.length > rows.length) made.pop()?.root.remove();
    while (made.length < rows.length) {
      const row = make(made.length);
      made.push(row);
      body.append(row.root);
    }
    rows.forEach((row, place) => made[place].cells.forEach((cell, column) => cell.update(row[column])));
  }

  return {
    root, insert, remove,
    update(value) {
      rows = rowsOf(value);
      show();
    },
  };
}
