/** Fields that hold blocks of fields: lists of them, as anchors and further cracks, and one in an item of such a list. */
import { fieldOf, idOf, wrongLine } from "./field.js";
import { tableOf } from "./lists.js";
import { element } from "../dom.js";

/** @typedef {import("./field.js").FieldOf} FieldOf */
/** @typedef {import("./field.js").Control} Control */
/** @typedef {{name: string, field: FieldOf, control: Control}} Part */

/**
 * What a field is edited with, whatever it holds.
 * @param {FieldOf} field
 * @param {string} path With places in lists.
 * @param {(value: any) => void} edit
 * @param {((path: string) => void) | null} add Asks for one more item of a list; null where that is in a list itself.
 * @returns {Control}
 */
export function controlFor(field, path, edit, add = null) {
  if (field.kind === "pairs") return tableOf(field, path, edit);
  if (field.kind === "blocks") return blocksOf(field, path, edit, add);
  if (field.kind === "block") return blockOf(field, path, edit);
  return fieldOf(field, path, edit);
}

/**
 * Whether a field says nothing beside the name that its block has. One that is given is shown, and said to be wrong.
 * @param {FieldOf} field
 * @param {any} block
 * @param {any} value
 */
export function isForeign(field, block, value) {
  return field.only.length > 0 && value === undefined && !field.only.includes(block && block.name);
}

/** @param {FieldOf} field */
const nameOf = (field) => field.path.slice(field.path.lastIndexOf(".") + 1);

/** @param {any} value Of a field; empty ones are not given. */
const isEmpty = (value) => value === "" || (Array.isArray(value) && value.length === 0);

/** @param {any} value @returns {Record<string, any>} */
const blockIn = (value) => (value && typeof value === "object" && !Array.isArray(value) ? value : {});

/**
 * The controls of the fields of a block.
 * @param {FieldOf[]} fields
 * @param {string} path
 * @param {(name: string, value: any) => void} edit
 * @returns {Part[]}
 */
function partsOf(fields, path, edit) {
  return fields.map((field) => {
    const name = nameOf(field);
    return { name, field, control: controlFor(field, `${path}.${name}`, (value) => edit(name, value)) };
  });
}

/** @param {Part[]} parts @param {Record<string, any>} block */
function fill(parts, block) {
  for (const { name, field, control } of parts) {
    control.update(block[name]);
    control.root.hidden = isForeign(field, block, block[name]);
  }
}

/** @param {Record<string, any>} block @param {string} name @param {any} value */
function put(block, name, value) {
  if (isEmpty(value)) delete block[name];
  else block[name] = value;
}

/** @param {HTMLElement | undefined} root */
const focusFirst = (root) => /** @type {HTMLElement | null | undefined} */ (root?.querySelector("input, select"))?.focus();

/**
 * A block in an item of a list, which may be missing.
 * @param {FieldOf} field
 * @param {string} path
 * @param {(block: any) => void} edit
 * @returns {Control}
 */
function blockOf(field, path, edit) {
  /** @type {Record<string, any> | null} */
  let block = null;
  const send = () => edit(block === null ? "" : structuredClone(block));
  const parts = partsOf(field.inner, path, (name, value) => {
    put((block = block || {}), name, value);
    send();
  });
  const inside = element("div", { class: "fields" }, ...parts.map(({ control }) => control.root));
  const toggle = element("button", { type: "button", onclick: () => {
    block = block === null ? {} : null;
    show();
    send();
  } });
  const label = field.label.toLowerCase();
  const root = element("fieldset", { class: "item", id: idOf(path), tabindex: "-1" }, element("legend", {}, field.label), element("p", { class: "meaning" }, field.meaning), inside, wrongLine(path), toggle);

  function show() {
    inside.hidden = block === null;
    toggle.textContent = `${block === null ? "Add" : "Remove"} ${label}`;
    fill(parts, block || {});
  }

  return {
    root,
    update(value) {
      block = value && typeof value === "object" ? structuredClone(blockIn(value)) : null;
      show();
    },
  };
}

/**
 * A list of blocks of fields, of one kind or of several.
 * @param {FieldOf} field
 * @param {string} path
 * @param {(list: any[]) => void} edit
 * @param {((path: string) => void) | null} ask
 * @returns {Control}
 */
function blocksOf(field, path, edit, ask) {
  /** @type {any[]} */
  let list = [];
  /** @type {{kind: string, root: HTMLElement, parts: Part[]}[]} */
  const made = [];
  /** How long the list is with the item that was asked for. */
  let awaited = Infinity;
  const kinds = Object.keys(field.blocks);
  const one = field.label.replace(/s$/, "").toLowerCase();
  const places = element("div", { class: "items" });
  const add = (kinds.length ? kinds : [""]).map((kind) => element("button", { type: "button", onclick: () => insert(kind) }, kind ? `Add ${kind}` : `Add ${/^[aeiou]/.test(one) ? "an" : "a"} ${one}`));
  const root = element(
    "div", { class: "field wide", id: idOf(path), "data-path": path, tabindex: "-1" },
    element("p", { class: "meaning" }, field.meaning), places, wrongLine(path), element("div", { class: "tools" }, ...add),
  );

  /** @param {string} kind */
  const fieldsOf = (kind) => (kinds.length ? field.blocks[kind] || [] : field.inner);

  /** @param {string} kind */
  function insert(kind) {
    if (!kind && ask) {
      awaited = list.length + 1;
      ask(path);
      return;
    }
    const needed = fieldsOf(kind).filter((inner) => inner.needed && inner.kind === "quantity");
    const first = Object.fromEntries(needed.map((inner) => [nameOf(inner), inner.example]));
    list.push(kind ? { step: kind, ...first } : first);
    changed();
    focusFirst(made[list.length - 1]?.root);
  }

  /** @param {number} place */
  function remove(place) {
    list.splice(place, 1);
    changed();
    const next = made[Math.min(place, made.length - 1)];
    (next ? /** @type {HTMLElement} */ (next.root.lastElementChild) : add[0]).focus();
  }

  function changed() {
    show();
    edit(structuredClone(list));
  }

  /** @param {number} place @param {string} kind */
  function make(place, kind) {
    const fields = fieldsOf(kind).filter((inner) => nameOf(inner) !== "step");
    const parts = partsOf(fields, `${path}[${place}]`, (name, value) => {
      put(list[place], name, value);
      edit(structuredClone(list));
    });
    const called = `${kind || one} ${place + 1}`;
    const button = element("button", { type: "button", onclick: () => remove(place) }, `Remove ${called}`);
    const item = element("fieldset", { class: "item" }, element("legend", {}, called), ...parts.map(({ control }) => control.root), wrongLine(`${path}[${place}]`), button);
    return { kind, root: item, parts };
  }

  function show() {
    while (made.length > list.length) made.pop()?.root.remove();
    list.forEach((block, place) => {
      const kind = String((block && block.step) || "");
      if (!made[place] || made[place].kind !== kind) {
        const item = make(place, kind);
        if (made[place]) made[place].root.replaceWith(item.root);
        else places.append(item.root);
        made[place] = item;
      }
      fill(made[place].parts, block);
    });
  }

  return {
    root,
    update(value) {
      list = Array.isArray(value) ? structuredClone(value).map(blockIn) : [];
      show();
      if (list.length < awaited) return;
      awaited = Infinity;
      focusFirst(made[list.length - 1]?.root);
    },
  };
}
