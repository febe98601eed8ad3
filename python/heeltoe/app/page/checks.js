/** Beside the answer: the static checks of the same dam, and how much its result depends on the shaking. */
import { element } from "./dom.js";
import { LongRun } from "./job.js";
import { table } from "./table.js";

const MODELS = /** @type {Record<string, string>} */ ({ rigid: "rigid block", decoupled: "rigid block on an elastic part", flexible: "elastic dam" });

const SPECTRA = [["", "none"], ["motion", "that of the motion"], ["design", "a design spectrum"]];

/** @param {string[]} texts */
const items = (texts) => (texts.length ? [element("ul", { class: "warnings" }, ...texts.map((text) => element("li", {}, text)))] : []);

/** Static checks: while they are open they follow the sliders. */
export class StaticChecks {
  /** @param {import("./talk.js").Talk} talk @param {() => Record<string, number>} values */
  constructor(talk, values) {
    this.talk = talk;
    this.values = values;
    this.content = element("div", { class: "content" }, element("p", { class: "faint" }, "computing"));
    this.spectrum = /** @type {HTMLSelectElement} */ (element("select", { id: "statics-spectrum", onchange: () => this.choose() }, ...SPECTRA.map(([value, text]) => element("option", { value }, text))));
    this.design = /** @type {HTMLInputElement} */ (element("input", { type: "text", "aria-label": "Design spectrum", value: "en1998:0.3 g,B", onchange: () => this.follow(), hidden: true }));
    const choice = element("div", { class: "in-line" }, element("label", { for: "statics-spectrum" }, "An earthquake by its response spectrum, too:"), this.spectrum, this.design);
    this.root = /** @type {HTMLDetailsElement} */ (element("details", { class: "card more", "data-checks": "statics", ontoggle: () => this.follow() }, element("summary", {}, "Static checks of the same case"), choice, this.content));
    talk.on("statics", (answer) => this.show(answer));
  }

  /** @param {boolean} can Whether the dam has a modulus, and so a first mode. */
  begin(can) {
    if (!can) this.spectrum.value = "";
    this.spectrum.disabled = !can;
    this.choose();
  }

  choose() {
    this.design.hidden = this.spectrum.value !== "design";
    this.follow();
  }

  /** The sliders have moved, or it was opened. */
  follow() {
    if (!this.root.open) return;
    this.root.classList.add("stale");
    const spectrum = this.spectrum.value === "design" ? this.design.value : this.spectrum.value;
    this.asked = this.talk.ask("statics", { values: this.values(), spectrum });
  }

  /** @param {any} answer */
  show(answer) {
    this.root.classList.toggle("stale", answer.serial !== this.asked);
    if (answer.error) {
      this.content.replaceChildren(element("p", { class: "bad" }, answer.error.text));
      return;
    }
    const rows = answer.checks.map((/** @type {any} */ { cells, met }) => element("tr", {}, ...cells.map((/** @type {string} */ cell) => element("td", {}, cell)), element("td", { class: met ? "" : "bad" }, met ? "met" : "fails")));
    const basis = answer.basis.map((/** @type {[string, string]} */ [label, text]) => element("tr", {}, element("th", { scope: "row" }, label), element("td", {}, text)));
    const mark = answer.provisional ? [element("p", { class: "provisional", role: "status" }, answer.provisional)] : [];
    this.content.replaceChildren(
      ...mark,
      element("p", { class: answer.ok ? "" : "bad" }, answer.failed.length ? `${answer.verdict.replace(/\.$/, "")}: ${answer.failed.join("; ")}.` : answer.verdict),
      table("Checks", ["load case", "check", "is", "required", ""], rows),
      element("table", { class: "numbers facts", "aria-label": "Basis of the checks" }, element("tbody", {}, ...basis)),
      ...items(answer.warnings),
    );
  }
}

/** The same run with a little weaker and a little stronger shaking, on a button. */
export class Spread {
  /** @param {import("./talk.js").Talk} talk @param {() => Record<string, number>} values */
  constructor(talk, values) {
    this.model = /** @type {HTMLSelectElement} */ (element("select", { id: "spread-model" }));
    const labels = { start: "Run the spread", cancel: "Cancel the spread", bar: "The spread is computed" };
    const run = new LongRun(talk, "spread", labels, () => talk.ask("spread", { values: values(), model: this.model.value }), (job) => this.take(job));
    this.status = run.status;
    this.content = element("div", { class: "content" });
    this.root = element("details", { class: "card more", "data-checks": "spread" }, element("summary", {}, "Spread: the same run with slightly weaker and stronger shaking"), element("div", { class: "in-line" }, element("label", { for: "spread-model" }, "of the"), this.model, run.start, run.cancel), run.bar, run.status, this.content);
  }

  /** @param {string[]} models Those that the case has the data for. */
  begin(models) {
    this.content.replaceChildren();
    this.status.textContent = "";
    this.model.replaceChildren(...models.map((model) => element("option", { value: model }, MODELS[model])));
  }

  /** The sliders have moved: the result, if there is one, is of where they were. */
  moved() {
    if (this.content.hasChildNodes()) {
      this.root.classList.add("stale");
      this.status.textContent = "of the sliders as they were";
    }
  }

  /** @param {any} job */
  take(job) {
    if (job.state !== "done") return;
    const { rows, columns, sentence, warnings } = job.result;
    this.root.classList.remove("stale");
    this.status.textContent = `${MODELS[job.result.model]}: ${sentence}`;
    const lines = rows.map((/** @type {string[]} */ [label, ...cells]) => element("tr", {}, element("th", { scope: "row" }, label), ...cells.map((cell) => element("td", {}, cell))));
    this.content.replaceChildren(...(rows.length ? [table("Spread", ["", ...columns], lines)] : []), ...items(warnings));
  }
}
