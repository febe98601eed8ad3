/** The form of a case, made from what the schema says: blocks of fields, each field with its meaning and its error. */
import { fieldOf, idOf, wrongLine } from "./case-field.js";
import { blocksOf, tableOf } from "./case-lists.js";
import { element } from "./dom.js";

/** @typedef {{path: string, label: string, meaning: string, optional: boolean, fields: import("./case-field.js").FieldOf[]}} BlockOf */

const OPEN = ["", "section", "crack", "reservoir"];
const ALWAYS = ["", "section", "crack"];

/** @param {any} fields @param {string} path */
export function valueAt(fields, path) {
  let here = fields;
  for (const name of path ? path.split(".") : []) here = here && typeof here === "object" && Object.hasOwn(here, name) ? here[name] : undefined;
  return here;
}

export class CaseForm {
  /** @param {import("./case-edits.js").Edits} edits */
  constructor(edits) {
    this.edits = edits;
    this.root = element("div", { class: "form" });
    /** @type {[string, import("./case-field.js").Control][]} */
    this.controls = [];
    /** @type {{block: BlockOf, root: HTMLElement, body: HTMLElement, state: HTMLElement, toggle: HTMLElement}[]} */
    this.blocks = [];
    /** The table of the section's corners. @type {ReturnType<typeof tableOf> | null} */
    this.corners = null;
    /** @type {any} */
    this.told = null;
    this.root.addEventListener("focusin", () => edits.begin());
    this.root.addEventListener("settle", () => this.told && edits.idle && this.values());
  }

  /** @param {BlockOf[]} blocks */
  build(blocks) {
    const open = this.blocks.length ? this.blocks.filter(({ root }) => root.hasAttribute("open")).map(({ block }) => block.path) : OPEN;
    this.controls = [];
    this.blocks = blocks.map((block) => this.block(block, open.includes(block.path)));
    this.root.replaceChildren(...this.blocks.map(({ root }) => root));
    if (this.told) this.show(this.told, true);
  }

  /** @param {BlockOf} block @param {boolean} open */
  block(block, open) {
    const body = element("fieldset", {}, element("legend", { class: "unseen" }, block.label));
    for (const field of block.fields) body.append(this.field(field));
    const list = block.fields[0]?.path === block.path;
    const state = element("span", { class: "state" });
    const toggle = element("button", { type: "button", onclick: () => this.toggle(block) });
    const root = element(
      "details", { class: "block", "data-block": block.path, open },
      element("summary", {}, element("strong", {}, block.label), " ", element("span", { class: "faint" }, block.meaning), " ", state),
      body, ...(list ? [] : [wrongLine(block.path || "case")]), ...(ALWAYS.includes(block.path) || list ? [] : [toggle]),
    );
    return { block, root, body, state, toggle };
  }

  /** @param {import("./case-field.js").FieldOf} field */
  field(field) {
    const edit = (/** @type {unknown} */ value) => this.edits.edit({ [field.path]: value });
    const control = field.kind === "pairs" ? tableOf(field, edit) : field.kind === "blocks" ? blocksOf(field, edit) : fieldOf(field, field.path, edit);
    if (field.path === "section.polygon") this.corners = /** @type {ReturnType<typeof tableOf>} */ (control);
    this.controls.push([field.path, control]);
    return control.root;
  }

  /** @param {BlockOf} block */
  toggle(block) {
    const there = valueAt(this.told.fields, block.path) !== undefined;
    this.edits.begin();
    this.edits.add("put block", { path: block.path, there: !there });
  }

  /** @param {any} told @param {boolean} idle Whether nothing typed waits for an answer. */
  show(told, idle) {
    this.told = told;
    if (idle) this.values();
    this.errors();
  }

  values() {
    for (const [path, control] of this.controls) control.update(valueAt(this.told.fields, path));
    for (const { block, body, toggle } of this.blocks) {
      const there = valueAt(this.told.fields, block.path) !== undefined;
      body.hidden = block.optional && !there;
      toggle.textContent = block.optional ? `${there ? "Remove" : "Add"} ${block.label.toLowerCase()}` : "Back to the defaults";
      toggle.hidden = !block.optional && !there;
    }
  }

  errors() {
    const places = /** @type {HTMLElement[]} */ ([...this.root.querySelectorAll("[data-wrong]")]);
    const texts = new Map(places.map((place) => [place, ""]));
    for (const each of this.told.errors) {
      const place = this.placeOf(each.field);
      if (place) texts.set(place, [texts.get(place), `${each.problem}; ${each.remedy}`].filter(Boolean).join(" "));
    }
    for (const [place, text] of texts) {
      if (place.textContent !== text) place.textContent = text;
      const control = document.getElementById(idOf(place.dataset.wrong || ""));
      if (control && control.matches("input, select")) control.toggleAttribute("aria-invalid", text !== "");
      if (control && text && control.matches("input, select")) control.setAttribute("aria-invalid", "true");
    }
    for (const { root, state } of this.blocks) {
      const count = [...root.querySelectorAll("[data-wrong]")].filter((each) => each.textContent).length;
      state.textContent = count ? `${count} wrong` : "";
    }
  }

  /** The line for an error: at its field, else at what that stands in. @param {string} path @returns {HTMLElement | null} */
  placeOf(path) {
    for (let here = path; here; here = here.replace(/(\.[^.[\]]*|\[\d+\]|^[^.[\]]*)$/, "")) {
      const found = /** @type {HTMLElement | null} */ (this.root.querySelector(`[data-wrong="${CSS.escape(here)}"]`));
      if (found) return found;
    }
    return null;
  }

  /** Show a field that is wrong. @param {string} path */
  go(path) {
    const place = this.placeOf(path);
    if (!place) return;
    place.closest("details")?.setAttribute("open", "");
    const control = document.getElementById(idOf(place.dataset.wrong || "")) || place;
    if (control === place) place.tabIndex = -1;
    control.focus();
    control.scrollIntoView({ block: "center" });
  }
}
