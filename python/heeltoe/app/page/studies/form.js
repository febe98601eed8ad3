/** The form of a study: what varies and how, which earthquakes, which limits. It only gathers; the server judges. */
import { element } from "../dom.js";
import { check, field, select } from "./fields.js";
import { RecordFolder } from "./folder.js";
import { VaryRows } from "./vary.js";

const METHODS = /** @type {Record<string, string>} */ ({
  suite: "suite: this dam in each record, judged by a number over all",
  grid: "grid: every combination of the values",
  "one at a time": "one at a time: each value by itself",
  "latin hypercube": "Latin hypercube: dams drawn evenly over each field",
  sobol: "Sobol’s sequence: the same, a power of two of them",
  sensitivity: "sensitivity: what Sobol’s indices need",
});
const MODELS = /** @type {Record<string, string>} */ ({ rigid: "rigid block", decoupled: "rigid block on an elastic part", flexible: "elastic dam" });
const LIMITS = /** @type {Record<string, string>} */ ({ residual_slip: "Residual slip", peak_slip: "Peak slip", opening: "Opening", rotation: "Rotation", cracked_length: "Cracked length" });
/** Slips that people ask for, in the units that are chosen. @type {Record<string, string>} */
const SLIPS = { si: "10 mm, 150 mm", us: "0.5 in, 6 in" };
/** How a suite is judged. @type {Record<string, string>} */
const JUDGES = { largest: "the largest of all records", mean: "their mean", median: "their median", "84%": "what 84 % stay below" };
const DRAWN = ["latin hypercube", "sobol", "sensitivity"];
/** What people begin with. @type {Record<string, Record<string, any>>} */
const BEGIN = {
  "Suite of records": { method: "suite", source: "records", "scale.measure": "", both_signs: true, vary: [] },
  Grid: { method: "grid", source: "case", "scale.measure": "", both_signs: true, vary: [{ path: "crack.friction", kind: "list", values: "0.8, 1.0, 1.2" }, { path: "reservoir.depth", kind: "uniform", from: "80 %", to: "100 %", count: "3" }] },
  "Stronger and stronger (IDA)": { method: "grid", source: "case", "scale.measure": "pga", "scale.kind": "list", "scale.values": "0.1 g, 0.2 g, 0.3 g, 0.4 g, 0.5 g, 0.6 g, 0.8 g, 1.0 g", both_signs: true, vary: [] },
  Fragility: { method: "latin hypercube", samples: "1000", source: "records", "scale.measure": "pga", "scale.kind": "drawn", "scale.from": "0.1 g", "scale.to": "1.2 g", both_signs: true, "fragility.measure": "pga", "limit.residual_slip": "slips", vary: [{ path: "crack.friction", kind: "lognormal", median: "now", dispersion: "0.15" }] },
};

export class StudyForm {
  /**
   * @param {() => void} changed Called whenever the study is another one.
   * @param {(file: File) => Promise<string>} send Sends a record and returns what it is called here.
   * @param {() => void} renew Called when there are other records.
   */
  constructor(changed, send, renew) {
    this.changed = changed;
    this.folder = new RecordFolder(send, renew);
    this.chosen = element("span", { class: "faint", role: "status" });
    /** @type {Record<string, HTMLInputElement | HTMLSelectElement>} */
    this.inputs = {};
    this.vary = new VaryRows(changed);
    this.root = element("form", { class: "study-form", "aria-label": "A study", onsubmit: (/** @type {Event} */ event) => event.preventDefault() });
    this.root.addEventListener("input", () => {
      this.arrange();
      changed();
    });
  }

  /** Draw it anew with what can be chosen, what was typed kept. @param {any} choices */
  show(choices) {
    const before = this.root.hasChildNodes() ? this.read() : null;
    if (before) before.records.push(...this.folder.taken());
    this.choices = choices;
    this.vary.fields = choices.fields;
    this.vary.root.querySelector("[data-field=correlation]")?.remove();
    this.vary.root.append(this._field("correlation", "Drawn together", "two fields and their rank correlation; several with ; between them", "crack.friction, reservoir.depth, 0.4"));
    this.root.replaceChildren(this._begin(), this._what(choices), this.vary.root, this._motions(choices), this._judged(choices), this._fragility(choices));
    this.write(before || (choices.suite ? this._beginning("Suite of records") : BEGIN.Grid));
  }

  _begin() {
    const buttons = Object.keys(BEGIN).map((name) => element("button", { type: "button", onclick: () => this.write(this._beginning(name), true) }, name));
    return element("fieldset", { class: "begin" }, element("legend", {}, "Begin with"), ...buttons);
  }

  /** What a form begins with; a suite with what the case says of its own. @param {string} name */
  _beginning(name) {
    if (BEGIN[name].method !== "suite") return BEGIN[name];
    const own = this.choices.suite ? { source: "case", ...this.choices.suite } : {};
    return { ...BEGIN[name], models: [this.choices.better], ...own };
  }

  /** @param {any} choices */
  _what(choices) {
    const models = choices.models.map((/** @type {string} */ name) => this._tick(`model.${name}`, MODELS[name] || name, name !== "rigid" && !choices.elastic));
    return element(
      "fieldset",
      {},
      element("legend", {}, "Study"),
      this._field("title", "Title", "that of the case where it is empty"),
      element("div", { role: "group", "aria-label": "Models", class: "ticks", "data-field": "model" }, ...models),
      ...(choices.elastic ? [] : [element("p", { class: "faint" }, "The case gives no concrete.modulus: the dam can only be a rigid block.")]),
      this._select("method", "Method", choices.methods.map((/** @type {string} */ name) => [name, METHODS[name] || name])),
      element("div", { class: "pair" }, this._field("samples", "Samples", "dams that are drawn", "1000"), this._field("seed", "Seed", "the same seed, the same runs", "1")),
    );
  }

  /** @param {any} choices */
  _motions(choices) {
    const groups = choices.records.map((/** @type {any} */ group) => element("div", { class: "ticks", role: "group", "aria-label": group.event }, ...group.records.map((/** @type {any} */ motion) => this._tick(`record.${motion.name}`, motion.vertical ? `${motion.name} (vertical)` : motion.name))));
    return element(
      "fieldset",
      { "data-field": "motions" },
      element("legend", {}, "Earthquakes"),
      this._select("source", "Which", [["case", ""], ["records", "records that are chosen here"]]),
      element(
        "div",
        { class: "of-records" },
        element("p", { class: "in-line" }, this.chosen, element("button", { type: "button", class: "link", onclick: () => this._choose(true) }, "all that are horizontal"), element("button", { type: "button", class: "link", onclick: () => this._choose(false) }, "none")),
        element("div", { class: "records", tabindex: "0", role: "group", "aria-label": "Records" }, ...groups),
        element("p", { class: "faint" }, "Components of one event follow from what the records say of station, time and direction, and where they say nothing from their names."),
        this.folder.root,
        element(
          "div",
          { role: "group", "aria-label": "Made to order", "data-field": "scenario" },
          element("div", { class: "pair" }, this._field("scenario.magnitude", "Magnitude", "of motions made to order", "6.5"), this._field("scenario.distance", "Distance [km]", "from the fault", "20"), this._field("scenario.count", "How many", "each drawn anew", "7")),
        ),
        this._field("ordered", "Other orders", "as synthetic:M6.5,20km,seed=1,fault=reverse; several with ; between them"),
        element("div", { class: "pair" }, this._field("motions.unit", "Unit", "of files that do not state it", "g"), this._field("motions.time_step", "Time step", "of files that do not state it", "0.01 s")),
        element(
          "div",
          { class: "pair" },
          this._select("motions.layout", "Values of plain tables", [["", "as their headers say"], ["rows", "along the rows"], ["columns", "down the columns"]]),
          this._select("motions.factor", "Factors in headers", [["", "none"], ["multiply", "multiply by them"], ["divide", "divide by them"], ["contain", "the values contain them"]]),
        ),
        element("div", { class: "pair" }, this._field("motions.low", "Band-pass from", "corrects records that are uncorrected", "0.1 Hz", "motions.processing"), this._field("motions.high", "Up to", "", "25 Hz")),
        element("div", { class: "ticks" }, this._tick("pairs", "horizontal components in pairs"), this._tick("vertical", "with vertical components"), this._tick("every", "every dam meets every motion")),
      ),
      element("div", { class: "ticks" }, this._tick("both_signs", "each motion both ways round")),
      this._select("scale.measure", "Strength", [["", "as it is"], ...choices.scales.map((/** @type {string} */ name) => [name, name === "factor" ? "a factor" : name])], "motions.scale.measure"),
      element(
        "div",
        { class: "of-scale" },
        this._select("scale.kind", "Its values", [["list", "a list"], ["drawn", "drawn evenly between two"]]),
        this._field("scale.values", "Strengths", "one after the other", "0.1 g, 0.2 g, 0.4 g", "motions.scale.values"),
        element("div", { class: "pair" }, this._field("scale.from", "From", "", "0.1 g", "motions.scale.values.from"), this._field("scale.to", "To", "", "1.2 g", "motions.scale.values.to")),
        this._field("scale.period", "Period", "of sa; T1 for the first of the dam", "0.3 s", "motions.scale.period"),
      ),
    );
  }

  /** Tick all horizontal records, or none. @param {boolean} all */
  _choose(all) {
    for (const { records } of this.choices.records) for (const { name, vertical } of records) /** @type {HTMLInputElement} */ (this.inputs[`record.${name}`]).checked = all && !vertical;
    this.arrange();
    this.changed();
  }

  /** How a suite is judged. @param {any} choices */
  _judged(choices) {
    return element(
      "fieldset",
      { class: "of-suite", "data-field": "suite" },
      element("legend", {}, "Judged"),
      this._select("suite.judge", "By", choices.judges.map((/** @type {string} */ name) => [name, JUDGES[name] || name]), "suite.judge"),
      element("p", { class: "faint" }, "against the limits of the case. EN 1998-1 takes the mean of seven or more records, the largest of fewer; ASCE/SEI 7 the mean of eleven."),
      this._field("suite.target", "Target spectrum", "drawn with those of the records", "en1998:0.3g,B"),
      this._field("motions.match", "Match each record to", "a spectrum, before it is scaled", "asce7:0.9g,0.4g,8s"),
    );
  }

  /** @param {any} choices */
  _fragility(choices) {
    const limits = choices.limits.map((/** @type {string} */ name) => this._field(`limit.${name}`, LIMITS[name] || name, "", name === "rotation" ? "0.001" : SLIPS[choices.units], `fragility.limits.${name}`));
    return element(
      "fieldset",
      { "data-field": "fragility" },
      element("legend", {}, "Fragility"),
      element("p", { class: "faint" }, "Each limit has a curve if motions have three strengths or more; without limits there are no curves."),
      element("div", { class: "pair limits" }, ...limits),
      this._select("fragility.measure", "Over", choices.measures.map((/** @type {string} */ name) => [name, name])),
      this._field("fragility.period", "Period", "of sa", "0.3 s"),
      this._field("fragility.confidence", "Confidence", "the probability of the intervals", "0.9"),
    );
  }

  /** @param {string} name @param {string} label @param {string} hint @param {string} example @param {string} at */
  _field(name, label, hint, example = "", at = name) {
    const made = field({ id: `study-${name.replaceAll(".", "-")}`, label, hint, example, at });
    this.inputs[name] = made.input;
    return made.root;
  }

  /** @param {string} name @param {string} label @param {[string, string][]} options @param {string} at */
  _select(name, label, options, at = name) {
    const made = select({ id: `study-${name.replaceAll(".", "-")}`, label, options, at });
    this.inputs[name] = made.input;
    return made.root;
  }

  /** @param {string} name @param {string} label */
  _tick(name, label, disabled = false) {
    const made = check(label, disabled);
    this.inputs[name] = made.input;
    return made.root;
  }

  /** @param {string} name */
  _row(name) {
    return /** @type {HTMLElement} */ (this.inputs[name].closest(".entry"));
  }

  /** Show what the choices make sense of. */
  arrange() {
    const at = (/** @type {string} */ name) => this.inputs[name].value;
    const drawn = DRAWN.includes(at("method"));
    const suite = at("method") === "suite";
    const own = suite && this.choices.suite ? `the ${this.choices.suite.of} of [[motions]] in the case` : this.choices.own ? `that of the case: ${this.choices.own}` : "that of the case, which has none";
    /** @type {HTMLSelectElement} */ (this.inputs.source).options[0].text = own;
    const ticked = Object.entries(this.inputs).filter(([name, input]) => name.startsWith("record.") && /** @type {HTMLInputElement} */ (input).checked).length;
    this.chosen.textContent = `${ticked} chosen`;
    this._row("samples").hidden = !drawn;
    this._row("seed").hidden = !drawn;
    this._row("correlation").hidden = !drawn || at("method") === "sensitivity";
    const find = (/** @type {string} */ name) => /** @type {HTMLElement} */ (this.root.querySelector(name));
    find(".of-suite").hidden = !suite;
    find("[data-field=fragility]").hidden = suite;
    this.vary.root.hidden = suite;
    /** @type {HTMLElement} */ (this.inputs.pairs.closest("label")).hidden = suite;
    this._row("scale.values").querySelector("label").textContent = suite ? "Strength of each record" : "Strengths";
    find(".of-records").hidden = at("source") !== "records";
    find(".of-scale").hidden = at("scale.measure") === "";
    if (!drawn) this.inputs["scale.kind"].value = "list";
    this._row("scale.kind").hidden = !drawn;
    const list = at("scale.kind") === "list";
    this._row("scale.values").hidden = !list;
    /** @type {HTMLElement} */ (this._row("scale.from").parentElement).hidden = list;
    this._row("scale.period").hidden = at("scale.measure") !== "sa";
    this._row("fragility.period").hidden = at("fragility.measure") !== "sa";
    /** @type {HTMLElement} */ (this.inputs.every.closest("label")).hidden = !drawn;
    this.vary.arrange(drawn);
  }

  /** @returns {Record<string, any>} What the server takes; what is hidden says nothing. */
  read() {
    /** @type {Record<string, any>} */
    const form = { models: [], records: [], vary: this.vary.read() };
    for (const [name, input] of Object.entries(this.inputs)) {
      const row = input.closest(".entry, label");
      const [kind, ...rest] = name.split(".");
      const hidden = row && /** @type {HTMLElement} */ (row).hidden;
      const ticked = input instanceof HTMLInputElement && input.type === "checkbox" ? input.checked : null;
      if (kind === "model" || kind === "record") {
        if (ticked) form[`${kind}s`].push(rest.join("."));
      } else if (ticked !== null) form[name] = ticked && !hidden;
      else form[name] = hidden ? "" : input.value;
    }
    return form;
  }

  /** @param {Record<string, any>} form @param {boolean} anew Whether what it does not name is emptied. */
  write(form, anew = false) {
    const models = form.models || [this.choices.usual];
    for (const [name, input] of Object.entries(this.inputs)) {
      const [kind, ...rest] = name.split(".");
      if (input instanceof HTMLInputElement && input.type === "checkbox") {
        if (kind === "model") input.checked = models.includes(rest.join(".")) && !input.disabled;
        else if (kind === "record") input.checked = (form.records || this._some()).includes(rest.join("."));
        else input.checked = Boolean(form[name]);
      } else if (name in form) input.value = form[name] === "slips" ? SLIPS[this.choices.units] : form[name];
      else if (anew && name !== "title") input.value = input instanceof HTMLSelectElement ? input.options[0].value : "";
    }
    this.vary.write(form.vary || []);
    this.arrange();
    this.changed();
  }

  /** Records to begin with: the horizontal ones of the first events that have two. */
  _some() {
    const pairs = this.choices.records.map((/** @type {any} */ group) => group.records.filter((/** @type {any} */ record) => !record.vertical)).filter((/** @type {any[]} */ group) => group.length === 2);
    return pairs.slice(0, 4).flat().map((/** @type {any} */ record) => record.name);
  }

  /** Say what is wrong at its field; return that, null where there is no such place. @param {{field: string, problem: string, remedy: string} | null} error @returns {HTMLElement | null} */
  fault(error) {
    for (const place of this.root.querySelectorAll(".wrong")) if (place.textContent) place.textContent = "";
    for (const input of this.root.querySelectorAll("[aria-invalid]")) input.removeAttribute("aria-invalid");
    if (!error) return null;
    const places = [.../** @type {NodeListOf<HTMLElement>} */ (this.root.querySelectorAll("[data-field]"))].filter((place) => error.field.startsWith(place.dataset.field || "?") && place.checkVisibility());
    const best = places.sort((a, b) => (b.dataset.field || "").length - (a.dataset.field || "").length)[0];
    if (!best) return null;
    let wrong = best.querySelector(":scope > .wrong");
    if (!wrong) {
      wrong = element("p", { class: "wrong", role: "status" });
      best.append(wrong);
    }
    wrong.textContent = `${error.problem}; ${error.remedy}`;
    const input = best.matches(".entry") ? best.querySelector("input, select") : null;
    if (input) input.setAttribute("aria-invalid", "true");
    const typed = [...best.querySelectorAll("input"), ...best.querySelectorAll("select")].find((other) => other.checkVisibility());
    return /** @type {HTMLElement} */ (input || typed || best);
  }
}
