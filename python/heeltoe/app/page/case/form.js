/** The form of a case, made from what the schema says: blocks of fields, each field with its meaning and its error. */
import { controlFor, isForeign } from "./blocks.js";
import { LawCurve } from "./law.js";
import { idOf, wrongLine } from "./field.js";
import { element } from "../dom.js";

/** @typedef {{path: string, label: string, meaning: string, optional: boolean, fields: import("./field.js").FieldOf[]}} BlockOf */

const OPEN = ["", "section", "crack", "reservoir"];
const ALWAYS = ["", "section", "crack"];

/** @param {any} fields @param {string} path */
export function valueAt(fields, path) {
  let here = fields;
  for (const name of path ? path.split(".") : []) here = here && typeof here === "object" && Object.hasOwn(here, name) ? here[name] : undefined;
  return here;
}

export class CaseForm {
  /** @param {import("./edits.js").Edits} edits */
  constructor(edits) {
    this.edits = edits;
    this.root = element("div", { class: "form" });
    /** @type {[import("./field.js").FieldOf, import("./field.js").Control][]} */
    this.controls = [];
    /** @type {{block: BlockOf, root: HTMLElement, body: HTMLElement, state: HTMLElement, toggle: HTMLElement}[]} */
    this.blocks = [];
    this.law = new LawCurve();
    /** What waits until all that was typed has been heard. @type {BlockOf[] | null} */
    this.next = null;
    /** The table of the section's corners. @type {ReturnType<typeof import("./lists.js").tableOf> | null} */
    this.corners = null;
    /** @type {any} */
    this.state = null;
    this.root.addEventListener("focusin", () => edits.begin());
    this.root.addEventListener("settle", () => this.state && edits.idle && this.values());
  }

  /** Make the form anew, as soon as nothing that is typed is on its way. @param {BlockOf[]} blocks */
  build(blocks) {
    this.next = blocks;
    if (this.edits.idle) this.make();
  }

  make() {
    if (!this.next) return;
    const blocks = this.next;
    this.next = null;
    const goOn = this.typing();
    const open = this.blocks.length ? this.blocks.filter(({ root }) => root.hasAttribute("open")).map(({ block }) => block.path) : OPEN;
    this.controls = [];
    this.blocks = blocks.map((block) => this.block(block, open.includes(block.path)));
    this.root.replaceChildren(...this.blocks.map(({ root }) => root));
    if (this.state) this.show(this.state, true);
    goOn();
  }

  /** Return what puts somebody who types back to where they are, in a form that was made anew. */
  typing() {
    const here = document.activeElement;
    if (!(here instanceof HTMLElement) || !here.id || !this.root.contains(here)) return () => {};
    const text = here instanceof HTMLInputElement ? { value: here.value, start: here.selectionStart, end: here.selectionEnd } : null;
    return () => {
      const field = document.getElementById(here.id);
      if (field && text && field instanceof HTMLInputElement) {
        field.value = text.value;
        field.setSelectionRange(text.start, text.end);
      }
      field?.focus({ preventScroll: true });
    };
  }

  /** @param {BlockOf} block @param {boolean} open */
  block(block, open) {
    const body = element("fieldset", {}, element("legend", { class: "unseen" }, block.label));
    for (const field of block.fields) body.append(this.field(field));
    if (block.path === "crack.law") body.append(this.law.root);
    const list = block.fields[0]?.path === block.path;
    // What the list is for stands in the summary.
    if (list) body.querySelector(".field > .meaning")?.remove();
    const state = element("span", { class: "state" });
    const toggle = element("button", { type: "button", onclick: () => this.toggle(block) });
    const root = element(
      "details", { class: "block", "data-block": block.path, open },
      element("summary", {}, element("strong", {}, block.label), " ", element("span", { class: "faint" }, block.meaning), " ", state),
      body, ...(list ? [] : [wrongLine(block.path || "case")]), ...(ALWAYS.includes(block.path) || list ? [] : [toggle]),
    );
    return { block, root, body, state, toggle };
  }

  /** @param {import("./field.js").FieldOf} field */
  field(field) {
    const edit = (/** @type {unknown} */ value) => this.edits.edit({ [field.path]: value });
    const add = (/** @type {string} */ path) => {
      this.edits.begin();
      this.edits.add("add item", { path });
    };
    const control = controlFor(field, field.path, edit, add);
    if (field.path === "section.polygon") this.corners = /** @type {NonNullable<typeof this.corners>} */ (control);
    this.controls.push([field, control]);
    return control.root;
  }

  /** @param {BlockOf} block */
  toggle(block) {
    const present = valueAt(this.state.fields, block.path) !== undefined;
    this.edits.begin();
    this.edits.add("put block", { path: block.path, present: !present });
  }

  /** @param {any} state @param {boolean} idle Whether nothing typed waits for an answer. */
  show(state, idle) {
    this.state = state;
    if (idle && this.next) {
      this.make();
      return;
    }
    if (idle) this.values();
    this.law.show(state.law);
    this.errors();
  }

  values() {
    for (const [field, control] of this.controls) {
      const value = valueAt(this.state.fields, field.path);
      control.update(value);
      control.root.hidden = (field.thesis && value === undefined) || isForeign(field, valueAt(this.state.fields, field.path.slice(0, Math.max(field.path.lastIndexOf("."), 0))), value);
    }
    for (const { block, body, toggle } of this.blocks) {
      const present = valueAt(this.state.fields, block.path) !== undefined;
      body.hidden = block.optional && !present;
      toggle.textContent = block.optional ? `${present ? "Remove" : "Add"} ${block.label.toLowerCase()}` : "Back to the defaults";
      toggle.hidden = !block.optional && !present;
    }
  }

  errors() {
    const places = /** @type {HTMLElement[]} */ ([...this.root.querySelectorAll("[data-wrong]")]);
    const texts = new Map(places.map((place) => [place, ""]));
    for (const error of this.state.errors) {
      const place = this.placeOf(error.field);
      if (place) texts.set(place, [texts.get(place), `${error.problem}; ${error.remedy}`].filter(Boolean).join(" "));
    }
    for (const [place, text] of texts) {
      if (place.textContent !== text) place.textContent = text;
      const control = document.getElementById(idOf(place.dataset.wrong || ""));
      if (control && control.matches("input, select")) control.toggleAttribute("aria-invalid", text !== "");
      if (control && text && control.matches("input, select")) control.setAttribute("aria-invalid", "true");
    }
    for (const { root, state } of this.blocks) {
      const count = [...root.querySelectorAll("[data-wrong]")].filter((line) => line.textContent).length;
      state.textContent = count ? `${count} wrong` : "";
    }
  }

  /** The line for an error: at its field, else at what that stands in. @param {string} path @returns {HTMLElement | null} */
  placeOf(path) {
    for (let here = path; here; here = here.replace(/(\.[^.[\]]*|\[\d+\]|^[^.[\]]*)$/, "")) {
      const place = /** @type {HTMLElement | null} */ (this.root.querySelector(`[data-wrong="${CSS.escape(here)}"]`));
      if (place) return place;
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
