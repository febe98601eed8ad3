/** What one model says: the verdict above the plot, numbers, slip by mode and warnings below it; both are marked where
 * they are not of the sliders as they stand. */
import { element } from "./dom.js";
import { row, table } from "./table.js";

export const NAMES = /** @type {Record<string, string>} */ ({ rigid: "Rigid block", decoupled: "Rigid block on an elastic part", flexible: "Elastic dam" });

/** @param {any} answer */
function numbers(answer) {
  const rows = answer.numbers.map((/** @type {any} */ number) => element("tr", { "data-key": number.key }, element("th", { scope: "row" }, number.label), element("td", {}, number.text)));
  return element("table", { class: "numbers", "aria-label": "Results" }, element("tbody", {}, ...rows));
}

/** @param {any} answer */
function slips(answer) {
  const rows = answer.slips.map((/** @type {any} */ share) => {
    const bar = element("div", {});
    bar.style.width = `${Math.round(100 * share.share)}%`;
    return element("tr", {}, element("th", { scope: "row" }, `slip in ${share.kind}`), element("td", {}, share.text), element("td", { class: "bar", "aria-hidden": "true" }, bar));
  });
  return element("table", { class: "numbers", "aria-label": "Slip by mode of motion" }, element("tbody", {}, ...rows));
}

/** What a response says beside its numbers: of a friction law, of each crack, of each motion. @param {any} answer */
function further(answer) {
  const facts = answer.facts.map((/** @type {[string, string]} */ [label, text]) => element("p", {}, element("strong", {}, `${label}: `), text));
  const tables = answer.tables.flatMap((/** @type {any} */ { label, columns, rows }) => [element("h4", { class: "plain" }, label), table(label, columns, rows.map(row))]);
  return [...facts, ...tables];
}

/** @param {any} answer */
function warnings(answer) {
  if (!answer.warnings.length) return [];
  const items = answer.warnings.map((/** @type {any} */ warning) => element("li", { class: warning.severity }, warning.text));
  return [element("h4", {}, "Before you use these numbers"), element("ul", { class: "warnings" }, ...items)];
}

const BADGES = /** @type {Record<string, string>} */ ({ met: "✓ ", doubted: "? ", failed: "✗ ", free: "" });

/** Number, limit and colour, which no one has to read a sentence for. @param {any} headline */
export function headlineOf({ value, label, limit, state, limits }) {
  const badge = (/** @type {string} */ of) => element("span", { "aria-hidden": "true" }, BADGES[of]);
  const free = state === "free" ? [" (", element("a", { href: "#case" }, "page Case"), ")"] : [];
  const judged = limit ? [element("p", { class: "judged" }, badge(state), limit, ...free)] : [];
  const others = limits.map((/** @type {any} */ other) => element("li", { class: other.state }, badge(other.state), other.text));
  return element("div", { class: `headline ${state}` }, element("p", {}, element("strong", {}, value), ` ${label}`), ...judged, ...(others.length ? [element("ul", {}, ...others)] : []));
}

export class Card {
  /** @param {string} model */
  constructor(model) {
    this.states = [element("span", { class: "state" }), element("span", { class: "state" })];
    this.verdict = element("div", { class: "content" }, element("p", { class: "faint" }, "computing"));
    this.content = element("div", { class: "content" });
    this.root = element("section", { class: "card", "data-model": model, "aria-label": `${NAMES[model]}: verdict` }, element("h3", {}, NAMES[model], this.states[0]), this.verdict);
    this.details = element("section", { class: "card", "data-details": model, "aria-label": `${NAMES[model]}: numbers` }, element("h3", {}, NAMES[model], this.states[1]), this.content);
    for (const part of [this.root, this.details]) part.style.setProperty("--of", `var(--${model})`);
    this.details.hidden = true;
  }

  /** @param {boolean} hidden */
  hide(hidden) {
    this.root.hidden = hidden;
    this.details.hidden = hidden || !this.content.hasChildNodes();
  }

  /** Of another dam nothing is known yet. */
  wait() {
    this.verdict.replaceChildren(element("p", { class: "faint" }, "computing"));
    this.content.replaceChildren();
    this.mark("");
  }

  /** @param {any} answer */
  show(answer) {
    const sentence = answer.absent || (answer.error && answer.error.text) || answer.verdict;
    const kind = answer.absent ? "faint" : answer.ok ? "verdict" : "verdict bad";
    const count = answer.warnings ? answer.warnings.length : 0;
    const caveat = count ? [element("p", { class: "caveat" }, `${count} warning${count > 1 ? "s" : ""} below`)] : [];
    const headline = answer.headline && !answer.absent && !answer.error ? [headlineOf(answer.headline)] : [];
    this.verdict.replaceChildren(...headline, element("p", { class: kind }, sentence), ...caveat);
    this.content.replaceChildren(...(answer.numbers ? [numbers(answer), slips(answer), ...further(answer)] : []), ...(answer.beside ? [element("p", {}, answer.beside)] : []), ...(answer.warnings ? warnings(answer) : []));
    this.hide(false);
  }

  /** Say what stands in the way of a result, with the button that makes it. @param {string} why @param {HTMLElement} button */
  offer(why, button) {
    this.verdict.replaceChildren(element("p", {}, why), element("p", {}, button));
    this.content.replaceChildren();
    this.hide(false);
  }

  /** @param {string} why Why it is not of the sliders as they stand; empty where it is. */
  mark(why) {
    for (const part of [this.root, this.details]) part.classList.toggle("stale", why !== "");
    for (const state of this.states) state.textContent = why;
  }
}
