/** One field of the form: its control, its meaning, and what is wrong with it. */
import { element } from "../dom.js";

/** @typedef {{path: string, label: string, meaning: string, kind: string, choices: string[], default: string, example: string, unit: string, needed: boolean, inner: FieldOf[], blocks: Record<string, FieldOf[]>, only: string[], thesis: boolean}} FieldOf */
/** @typedef {{root: HTMLElement, update: (value: any) => void}} Control */

const LONGEST = 500;

/**
 * What stands in a control where a case has a value.
 * @param {unknown} value
 */
export function shown(value) {
  if (value === undefined || value === null) return "";
  if (value === true) return "yes";
  if (value === false) return "no";
  return typeof value === "object" ? JSON.stringify(value) : String(value);
}

/** @param {string} path */
export const idOf = (path) => `field-${path.replace(/[^A-Za-z0-9]+/g, "-")}`;

/**
 * A line for what is wrong with a field.
 * @param {string} path
 */
export function wrongLine(path) {
  return element("p", { class: "wrong", id: `${idOf(path)}-wrong`, "data-wrong": path });
}

/**
 * A control for one value.
 * @param {FieldOf} field
 * @param {string} path With places in lists.
 * @param {(text: string) => void} edit
 * @param {Record<string, string>} more Attributes.
 * @returns {{control: HTMLInputElement | HTMLSelectElement, update: (value: any) => void}}
 */
export function controlOf(field, path, edit, more = {}) {
  const common = { id: idOf(path), "data-path": path, "aria-describedby": `${idOf(path)}-meaning ${idOf(path)}-wrong`, ...more };
  if (field.kind === "choice" || field.kind === "truth") {
    const choices = field.kind === "truth" ? ["yes", "no"] : field.choices;
    const none = element("option", { value: "" }, field.default ? `${field.default} (default)` : "not given");
    const select = /** @type {HTMLSelectElement} */ (element("select", common, ...(field.needed ? [] : [none]), ...choices.map((choice) => element("option", { value: choice }, choice))));
    select.addEventListener("change", () => edit(select.value));
    return {
      control: select,
      update(value) {
        const text = shown(value);
        // What a file says may be none of the choices; it is shown, and said to be wrong.
        if (![...select.options].some((option) => option.value === text)) select.append(element("option", { value: text }, text));
        select.value = text;
      },
    };
  }
  const hint = field.default || (field.example ? `such as ${field.example}` : field.unit ? `in ${field.unit}` : "");
  const input = /** @type {HTMLInputElement} */ (element("input", { type: "text", maxlength: LONGEST, autocomplete: "off", spellcheck: "false", placeholder: hint, ...common }));
  input.addEventListener("input", () => edit(input.value));
  input.addEventListener("blur", () => input.dispatchEvent(new CustomEvent("settle", { bubbles: true })));
  return {
    control: input,
    update(value) {
      const text = shown(value);
      if (document.activeElement !== input && input.value !== text) input.value = text;
    },
  };
}

/**
 * A field with its label, its meaning and its error.
 * @param {FieldOf} field
 * @param {string} path
 * @param {(text: string) => void} edit
 * @returns {Control}
 */
export function fieldOf(field, path, edit) {
  const { control, update } = controlOf(field, path, edit);
  const defaults = field.default && field.kind !== "choice" && field.kind !== "truth" ? ` Default: ${field.default}.` : "";
  const root = element(
    "div", { class: "field" },
    element("label", { for: control.id }, field.label), control,
    element("p", { class: "meaning", id: `${control.id}-meaning` }, field.meaning + defaults),
    wrongLine(path),
  );
  return { root, update };
}
