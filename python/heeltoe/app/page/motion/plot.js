/** What is in a motion: facts and warnings as a card, histories, Husid plot and response spectrum as plots. */
import { colour, element } from "../dom.js";
import { axis, look } from "../plot/look.js";
import { loadPlotly } from "../plot/plot.js";
import { unpacked } from "../../player/scene.js";

const TITLES = /** @type {Record<string, string>} */ ({ horizontal: "Horizontal", vertical: "Vertical" });
const COLOURS = /** @type {Record<string, string>} */ ({ horizontal: "rigid", vertical: "decoupled" });
/** From the top; parts of the height. */
const ROWS = /** @type {Record<string, [number, number]>} */ ({ acceleration: [0.74, 1], velocity: [0.5, 0.7], displacement: [0.26, 0.46], husid: [0, 0.22] });
const PERIODS = [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10];
const CONFIG = { responsive: true, displaylogo: false, displayModeBar: false };

/** @param {any} motion */
export function shownMotion(motion) {
  const rows = motion.facts.map((/** @type {[string, string]} */ [label, text]) => element("tr", {}, element("th", { scope: "row" }, label), element("td", {}, text)));
  const warnings = motion.warnings.map((/** @type {string} */ text) => element("li", {}, text));
  const card = element(
    "section", { class: "card", "data-motion": motion.way, "aria-label": `${TITLES[motion.way]} motion` },
    element("h3", {}, TITLES[motion.way]),
    element("table", { class: "numbers facts" }, element("tbody", {}, ...rows)),
    ...(warnings.length ? [element("h4", {}, "Before you use it"), element("ul", { class: "warnings" }, ...warnings)] : [element("p", { class: "faint" }, "The checks found nothing to warn of.")]),
  );
  card.style.setProperty("--of", `var(--${COLOURS[motion.way]})`);
  return card;
}

/**
 * @param {HTMLElement} place
 * @param {HTMLElement} spectrum
 * @param {any[]} motions
 */
export async function drawMotions(place, spectrum, motions) {
  await loadPlotly();
  const plotly = /** @type {any} */ (window).Plotly;
  const names = Object.keys(ROWS);
  const histories = [];
  const spectra = [];
  for (const { way, curves } of motions) {
    const line = { color: colour(COLOURS[way]), width: 1.1 };
    const time = unpacked(curves.time.values);
    names.forEach((name, row) => histories.push({ x: time, y: unpacked(curves[name].values), yaxis: row ? `y${row + 1}` : "y", type: "scatter", mode: "lines", name: way, line, hovertemplate: "%{y:.4g} at %{x:.2f} s" }));
    spectra.push({ x: unpacked(curves.period.values), y: unpacked(curves.spectrum.values), type: "scatter", mode: "lines", name: way, line: { ...line, width: 1.6 }, hovertemplate: "%{y:.3g} g at %{x:.3g} s" });
  }
  const units = motions[0].curves;
  const axes = Object.fromEntries(names.map((name, row) => [row ? `yaxis${row + 1}` : "yaxis", axis({ domain: ROWS[name], title: { text: `${name === "husid" ? "Husid" : name}<br>[${units[name].unit}]`, font: { size: 11 } } })]));
  const end = Math.max(...motions.map((motion) => motion.end));
  const narrow = place.clientWidth < 600;
  const margin = { l: narrow ? 62 : 76, r: 12, t: 8, b: 40 };
  const fixed = { showlegend: false, dragmode: narrow ? false : "zoom", margin, ...look() };
  await plotly.react(place, histories, { ...fixed, ...axes, xaxis: axis({ range: [0, end], anchor: "y4", title: { text: "time [s]" } }) }, CONFIG);
  await plotly.react(spectrum, spectra, { ...fixed, xaxis: axis({ type: "log", title: { text: "period [s]" }, tickvals: PERIODS }), yaxis: axis({ rangemode: "tozero", title: { text: "pseudo-acceleration [g], 5 %", font: { size: 11 } } }) }, CONFIG);
}
