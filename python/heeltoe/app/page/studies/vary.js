/** What varies in a study: fields of the case, each with a list of values or a distribution. */
import { element } from "../dom.js";
import { field, select } from "./fields.js";

const KINDS = /** @type {Record<string, [string, string[]]>} */ ({
  list: ["list", ["values"]],
  uniform: ["uniform", ["from", "to"]],
  triangular: ["triangular", ["from", "mode", "to"]],
  normal: ["normal", ["mean", "std", "lower", "upper"]],
  lognormal: ["lognormal", ["median", "dispersion", "lower", "upper"]],
});
const LABELS = /** @type {Record<string, string>} */ ({ values: "Values", from: "From", to: "To", mode: "Most likely", mean: "Mean", std: "Standard deviation", median: "Median", dispersion: "Dispersion", lower: "Not below", upper: "Not above", count: "How many" });

export class VaryRows {
  /** @param {() => void} changed */
  constructor(changed) {
    this.changed = changed;
    /** @type {any[]} */
    this.fields = [];
    /** @type {VaryRow[]} */
    this.rows = [];
    this.list = element("div", { class: "varied" });
    this.none = element("p", { class: "faint" }, "No field of the case varies.");
    const add = element("button", { type: "button", onclick: () => this.add() }, "Add a field");
    this.root = element("fieldset", { "data-field": "vary" }, element("legend", {}, "Fields that vary"), this.none, this.list, add);
  }

  add() {
    const taken = new Set(this.rows.map((row) => row.path.value));
    const next = this.fields.find((field) => field.drawn && !taken.has(field.path) && ["crack.friction", "reservoir.depth", "uplift.intensity", "crack.restitution"].includes(field.path));
    const row = this._make({ path: (next || this.fields.find((field) => !taken.has(field.path))).path, kind: "list" });
    this.changed();
    row.path.focus();
  }

  /** @param {Record<string, string>} values */
  _make(values) {
    const row = new VaryRow(this.fields, values, () => {
      this.rows = this.rows.filter((other) => other !== row);
      row.root.remove();
      this.none.hidden = this.rows.length > 0;
      this.changed();
    });
    this.rows.push(row);
    this.list.append(row.root);
    this.none.hidden = true;
    row.arrange(this.drawn);
    return row;
  }

  /** @param {Record<string, string>[]} rows */
  write(rows) {
    this.rows = [];
    this.list.replaceChildren();
    this.none.hidden = false;
    for (const entry of rows) if (this.fields.some((known) => known.path === entry.path)) this._make(entry);
  }

  /** @param {boolean} drawn Whether dams are drawn: then no one counts values. */
  arrange(drawn) {
    this.drawn = drawn;
    for (const row of this.rows) row.arrange(drawn);
  }

  read() {
    return this.rows.map((row) => row.read());
  }
}

class VaryRow {
  /** @param {any[]} fields @param {Record<string, string>} values @param {() => void} remove */
  constructor(fields, values, remove) {
    this.fields = fields;
    const path = select({ label: "Field", options: [] });
    const kind = select({ label: "How", options: Object.entries(KINDS).map(([name, [label]]) => [name, label]) });
    this.path = path.input;
    this.kind = kind.input;
    /** @type {Record<string, HTMLOptGroupElement>} */
    const groups = {};
    for (const field of fields) {
      groups[field.block] ||= /** @type {HTMLOptGroupElement} */ (element("optgroup", { label: field.block }));
      groups[field.block].append(element("option", { value: field.path }, `${field.block}: ${field.label}`));
    }
    this.path.append(...Object.values(groups));
    this.path.value = values.path;
    this.kind.value = values.kind || "list";
    this.meaning = element("p", { class: "faint" });
    /** @type {Record<string, {root: HTMLElement, input: HTMLInputElement, hint: HTMLElement}>} */
    this.inputs = {};
    for (const name of Object.keys(LABELS)) {
      this.inputs[name] = field({ label: LABELS[name] });
      this.inputs[name].input.value = this._begin(values[name] || "");
    }
    const off = element("button", { type: "button", onclick: remove }, "Remove");
    const places = element("div", { class: "places" }, ...Object.values(this.inputs).map(({ root }) => root));
    this.off = off;
    this.root = element("div", { class: "row", role: "group" }, element("div", { class: "places" }, path.root, kind.root, off), this.meaning, places, element("p", { class: "wrong", role: "status" }));
    this.root.addEventListener("input", () => this.arrange(this.drawn));
  }

  get field() {
    return this.fields.find((field) => field.path === this.path.value);
  }

  /** A value to begin with: "now" is that of the case, a share is of that. @param {string} text */
  _begin(text) {
    const share = text === "now" ? 100 : text.endsWith(" %") ? parseFloat(text) : 0;
    if (!share) return text;
    const [number, ...unit] = this.field.now.split(" ");
    const value = Number(number) * (share / 100);
    return Number.isFinite(value) && number ? [String(Number(value.toPrecision(4))), ...unit].join(" ") : "";
  }

  /** @param {boolean | undefined} drawn */
  arrange(drawn) {
    this.drawn = drawn;
    const known = this.field;
    for (const option of this.kind.options) option.disabled = option.value !== "list" && !known.drawn;
    if (!known.drawn) this.kind.value = "list";
    const [, names] = KINDS[this.kind.value];
    for (const [name, { root }] of Object.entries(this.inputs)) root.hidden = !(names.includes(name) || (name === "count" && !drawn && this.kind.value !== "list"));
    this.meaning.textContent = `${known.meaning}${known.now ? ` Now ${known.now}.` : ""}`;
    const hint = known.choices.length ? `of ${known.choices.join(", ")}` : known.unit ? `in ${known.unit}, or with a unit` : "with commas between them";
    this.inputs.values.hint.textContent = hint;
    this.inputs.values.input.placeholder = known.choices.slice(0, 2).join(", ");
    const at = `vary.${known.path}`;
    this.root.dataset.field = at;
    const name = `${known.block}: ${known.label}`;
    this.root.setAttribute("aria-label", name);
    this.off.setAttribute("aria-label", `Remove ${name}`);
    for (const [name, { root }] of Object.entries(this.inputs)) root.dataset.field = name === "values" ? `${at}[` : `${at}.${name}`;
  }

  read() {
    const [, names] = KINDS[this.kind.value];
    /** @type {Record<string, string>} */
    const row = { path: this.path.value, kind: this.kind.value };
    for (const [name, { root, input }] of Object.entries(this.inputs)) row[name] = !root.hidden && (names.includes(name) || name === "count") ? input.value : "";
    return row;
  }
}
