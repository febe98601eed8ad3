/** How the crest of the intact dam answers the ground, frequency by frequency, on each rock and with each water. */
import { colour, element } from "./dom.js";
import { look, axis } from "./plot/look.js";
import { loadPlotly } from "./plot/plot.js";
import { row, table } from "./table.js";
import { unpacked } from "../player/scene.js";

/** Colour and dash of each water. @type {Record<string, [string, string]>} */
const WATERS = { empty: ["faint", "dot"], incompressible: ["decoupled", "dash"], compressible: ["rigid", "solid"] };

/** While it is open it follows the sliders. */
export class CrestResponse {
  /** @param {import("./talk.js").Talk} talk @param {() => Record<string, number>} values */
  constructor(talk, values) {
    this.talk = talk;
    this.values = values;
    this.plot = element("div", { class: "plot crest", role: "figure", "aria-label": "Acceleration of the crest over that of the ground by frequency" });
    this.says = element("div", { class: "content" }, element("p", { class: "faint" }, "computing"));
    this.root = /** @type {HTMLDetailsElement} */ (element("details", { class: "card more", "data-checks": "crest", ontoggle: () => this.follow() }, element("summary", {}, "Response of the crest by frequency, on rigid and on elastic rock"), this.plot, this.says));
    this.plot.hidden = true;
    /** @type {any} */
    this.answer = null;
    new ResizeObserver(() => this.draw()).observe(this.plot);
    talk.on("crest", (answer) => this.show(answer));
  }

  /** Another case: what was shown is not its answer. @param {boolean} can Whether its dam has a modulus. */
  begin(can) {
    this.root.hidden = !can;
    this.follow();
  }

  /** The sliders have moved, or it was opened. */
  follow() {
    if (!this.root.open || this.root.hidden) return;
    this.root.classList.add("stale");
    this.asked = this.talk.ask("crest", { values: this.values() });
  }

  /** @param {any} answer */
  show(answer) {
    this.root.classList.toggle("stale", answer.serial !== this.asked);
    this.plot.hidden = Boolean(answer.error);
    if (answer.error) {
      this.answer = null;
      this.says.replaceChildren(element("p", { class: "bad" }, answer.error.text));
      return;
    }
    this.answer = answer;
    const notes = [`The dam is intact, with ${answer.damping} of damping in its concrete; the crest moves with the ground where the amplification is 1.`, ...answer.assumptions];
    this.says.replaceChildren(
      table("First peak of the crest", answer.columns, answer.rows.map(row)),
      ...notes.map((/** @type {string} */ text) => element("p", { class: "faint" }, text)),
    );
    this.draw();
  }

  async draw() {
    const { answer } = this;
    if (!answer || !this.plot.clientWidth) return;
    await loadPlotly();
    const plotly = /** @type {any} */ (window).Plotly;
    const rocks = [...new Set(answer.curves.map((/** @type {any} */ { rock }) => rock))];
    const { clientWidth: width, clientHeight: height } = this.plot;
    const narrow = width < 600;
    const x = unpacked(answer.frequency);
    const traces = answer.curves.map((/** @type {any} */ { rock, water, amplification }) => {
      const place = rocks.indexOf(rock);
      const [of, dash] = WATERS[water];
      return { x, y: unpacked(amplification), xaxis: place ? "x2" : "x", yaxis: place ? "y2" : "y", type: "scatter", mode: "lines", name: water, legendgroup: water, showlegend: !place, line: { color: colour(of), dash, width: 1.8 }, hovertemplate: "%{y:.3g} at %{x:.3g} Hz" };
    });
    // Beside each other, or one below the other; one height for both.
    const [left, right, above, below] = narrow ? [[0, 1], [0, 1], [0.56, 1], [0, 0.44]] : [[0, 0.48], [0.52, 1], [0, 1], [0, 1]];
    const top = 1.05 * Math.max(...traces.flatMap((/** @type {any} */ { y }) => Math.max(...y)));
    const range = { range: [0, x[x.length - 1]] };
    const layout = {
      xaxis: axis({ ...range, domain: left, title: { text: narrow ? "" : "frequency [Hz]" } }),
      xaxis2: axis({ ...range, domain: right, anchor: "y2", title: { text: "frequency [Hz]" } }),
      yaxis: axis({ range: [0, top], domain: above, title: { text: "crest over ground", font: { size: 11 } } }),
      yaxis2: axis({ range: [0, top], domain: below, anchor: "x2", title: { text: narrow ? "crest over ground" : "", font: { size: 11 } } }),
      annotations: rocks.map((rock, place) => ({ text: `${rock} rock`, xref: place ? "x2 domain" : "x domain", yref: place ? "y2 domain" : "y domain", x: 0.98, y: 0.98, showarrow: false })),
      legend: { orientation: "h", y: 1.02, yanchor: "bottom", title: { text: "reservoir: " } },
      margin: { l: narrow ? 46 : 56, r: 12, t: 8, b: 40 }, dragmode: narrow ? false : "zoom", width, height, ...look(),
    };
    await plotly.react(this.plot, traces, layout, { displaylogo: false, displayModeBar: false });
  }
}
