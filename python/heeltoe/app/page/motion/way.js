/** One direction of the motion: where it comes from, its peak, its sign, and what a file does not state. */
import { element } from "../dom.js";

const PULSES = ["sine", "half-sine", "cosine"];
const TITLES = /** @type {Record<string, string>} */ ({ horizontal: "Horizontal, + downstream", vertical: "Vertical, + up" });
const PREFIXES = /** @type {Record<string, string>} */ ({ horizontal: "motion", vertical: "motion.vertical" });
const SEPARATOR = "\n";

export class Way {
  /**
   * @param {"horizontal" | "vertical"} name
   * @param {() => void} changed
   * @param {() => void} other Called when it is another motion.
   */
  constructor(name, changed, other) {
    this.name = name;
    /** @type {any} */
    this.offered = { records: [], catalogue: [] };
    this.own = "";
    this.asked = false;
    const field = PREFIXES[name];
    /** @type {Record<string, HTMLInputElement>} */
    this.inputs = {};
    this.wrong = ["file", "points", "unit", "time_step", "channel", "pga", "period", ""].map((key) => element("p", { class: "wrong", "data-of": key ? `${field}.${key}` : field, role: "status" }));
    const at = (/** @type {string} */ key) => this.wrong.filter((place) => place.dataset.of === `${field}.${key}`);
    /** @param {string} key @param {string} label @param {string} value */
    const line = (key, label, value = "") => {
      const id = `${name}-${key}`;
      const made = /** @type {HTMLInputElement} */ (element("input", { type: "text", id, value, size: 9, oninput: changed }));
      this.inputs[key] = made;
      return element("div", { class: "in-line" }, element("label", { for: id }, label), made);
    };
    this.source = /** @type {HTMLSelectElement} */ (element("select", { id: `${name}-source`, "aria-label": `${TITLES[name]}: source`, onchange: () => {
      this.clear();
      other();
    } }));
    this.stated = element("div", {}, element("p", { class: "faint" }, "The file does not state:"), ...at("unit"), line("unit", "unit of its numbers (g, cm/s^2, m/s^2)"), ...at("time_step"), line("time_step", "time between two of them [s]"));
    this.made = element("div", {}, line("magnitude", "magnitude", "6.5"), line("distance", "distance [km]", "20"), line("seed", "seed", "1"));
    this.pulse = element("div", {}, line("period", "period [s]", "0.5"), ...at("period"), ...at("points"));
    this.reverse = /** @type {HTMLInputElement} */ (element("input", { type: "checkbox", id: `${name}-reverse`, onchange: changed }));
    const peak = line("pga", "scaled to a peak of [g]");
    this.scale = element("div", {}, peak, ...at("pga"), element("label", {}, this.reverse, " other sign"), element("p", { class: "faint" }, name === "horizontal" ? "Empty: as it is." : "Empty: the scale of the horizontal motion."), ...(name === "horizontal" ? [element("p", { class: "faint", id: "motion-at" }, "The motion of the free surface (outcrop), as recorded: do not deconvolve it to the bottom of a mesh.")] : []));
    this.root = element("fieldset", { "data-way": name }, element("legend", {}, TITLES[name]), this.source, ...at("file"), ...at("channel"), this.made, this.pulse, this.stated, this.scale, ...this.wrong.filter((place) => place.dataset.of === field));
    this.fit();
  }

  /** @param {{records?: any[], catalogue?: string[]}} what */
  offer(what) {
    Object.assign(this.offered, what);
    const before = this.source.value;
    const { records, catalogue } = this.offered;
    const option = (/** @type {string} */ value, /** @type {string} */ label) => element("option", { value }, label);
    const group = (/** @type {string} */ label, /** @type {Node[]} */ options) => (options.length ? [element("optgroup", { label }, ...options)] : []);
    const sent = records.flatMap((/** @type {any} */ { name, channels }) => channels.map((/** @type {any} */ channel) => option(`record:${name}${SEPARATOR}${channel.channel}`, [name, channel.channel, channel.component].filter(Boolean).join(", "))));
    this.source.replaceChildren(
      option(SEPARATOR, this.name === "horizontal" ? "choose a motion" : "none"),
      ...(this.own ? [option(`case${SEPARATOR}`, `of the case: ${this.own}`)] : []),
      ...group("Sent", sent),
      ...group("Catalogue", catalogue.map((/** @type {string} */ name) => option(`name:${name}${SEPARATOR}`, name))),
      ...group("Made to order", [option(`synthetic:${SEPARATOR}`, "an earthquake by magnitude and distance"), ...PULSES.map((kind) => option(`pulse:${kind}${SEPARATOR}`, `a pulse: ${kind}`))]),
    );
    this.source.value = before || SEPARATOR;
    if (this.source.selectedIndex < 0) this.source.value = SEPARATOR;
  }

  /** @param {any} form What the case has. */
  fill(form) {
    this.own = form.title || "";
    this.offer({});
    this.source.value = `${form.source}${SEPARATOR}`;
    for (const key of ["pga", "unit", "time_step"]) this.inputs[key].value = form[key] || "";
    this.reverse.checked = Boolean(form.reverse);
    this.fit();
  }

  /** @param {string} source @param {string} channel */
  choose(source, channel = "") {
    this.source.value = `${source}${SEPARATOR}${channel}`;
    this.clear();
  }

  /** Another file: what was said of the one before does not hold. */
  clear() {
    this.asked = false;
    this.inputs.unit.value = this.inputs.time_step.value = "";
    this.fit();
  }

  chosen() {
    return this.source.value !== SEPARATOR;
  }

  isSent() {
    return this.source.value.startsWith("record:");
  }

  /** Show the fields that the source has. */
  fit() {
    const { value } = this.source;
    this.made.hidden = !value.startsWith("synthetic:");
    this.pulse.hidden = !value.startsWith("pulse:");
    this.stated.hidden = !this.asked && !this.inputs.unit.value && !this.inputs.time_step.value;
    this.scale.hidden = !value || value === SEPARATOR;
  }

  /** Ask for what the file does not state, where that is wrong. @param {string} field Of the error. */
  ask(field) {
    this.asked = this.asked || ["unit", "time_step"].some((key) => field === `${PREFIXES[this.name]}.${key}`);
    this.fit();
  }

  form() {
    const [source, channel] = this.source.value.split(SEPARATOR);
    const values = Object.fromEntries(Object.entries(this.inputs).map(([key, input]) => [key, input.value]));
    return { ...values, source, channel: channel || "", reverse: this.reverse.checked };
  }
}
