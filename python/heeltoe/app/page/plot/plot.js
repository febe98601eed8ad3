/** The answer over time: ground, slip, rotation and modes of every model, on one time axis that zooms. */
import { colour } from "../dom.js";
import { AXES, KINDS, flatRows, lines, spans, thickness } from "./lines.js";
import { drawQuickly, following, forget, roomy } from "./quick.js";

/** @typedef {import("./lines.js").Shown} Shown */
/** @typedef {{width: number, height: number}} Size */

/** From the top; parts of the height between the gaps. */
const HEIGHTS = /** @type {Record<string, number>} */ ({ ground: 0.13, slip: 0.35, rotation: 0.27, modes: 0.13 });
const GAP = 0.04;
/** Of a row where nothing happens. */
const FLAT = 0.05;
/** Narrower than this the plot has less around it [px]. */
const NARROW = 600;

/**
 * Where the rows are: what is flat leaves its room to the others.
 * @param {string[]} flat
 * @returns {[string, [number, number]][]}
 */
function domains(flat) {
  const rows = Object.entries(HEIGHTS).map(([row, height]) => /** @type {[string, number]} */ ([row, flat.includes(row) ? FLAT : height]));
  const scale = (1 - GAP * (rows.length - 1)) / rows.reduce((sum, [, height]) => sum + height, 0);
  let top = 1;
  return rows.map(([row, height]) => {
    const bottom = Math.max(0, top - height * scale);
    const domain = /** @type {[number, number]} */ ([bottom, top]);
    top = bottom - GAP;
    return [row, domain];
  });
}

/** @param {Shown[]} shown @param {boolean} narrow */
function traces(shown, narrow) {
  /** @type {object[]} */
  const traces = lines(shown).map(({ row, of, name, stale, width, dash, x, y }) => ({
    x, y, yaxis: AXES[row], type: "scatter", mode: "lines", name, opacity: stale ? 0.3 : 1, hovertemplate: `%{y:.4g} at %{x:.2f} s`,
    line: { color: colour(of), width, dash, simplify: false },
  }));
  for (const kind of KINDS) {
    /** @type {(number | null)[]} */
    const x = [];
    /** @type {string[]} */
    const y = [];
    for (const item of shown) {
      for (const { start, end } of spans(item, kind)) {
        x.push(start, end, null);
        y.push(item.model, item.model, item.model);
      }
    }
    if (x.length) {
      traces.push({ x, y, yaxis: AXES.modes, type: "scatter", mode: "lines", name: kind, line: { color: colour(kind), width: thickness(shown, narrow), simplify: false }, hovertemplate: `${kind}, %{x:.2f} s` });
    }
  }
  return traces;
}

/**
 * @param {Shown[]} shown
 * @param {Size} size Said, as a plot that finds it itself waits a tenth of a second for it.
 * @param {Record<string, [number, number]>} ranges Of the rows that do not follow what is drawn.
 */
function layout(shown, size, ranges) {
  const narrow = size.width < NARROW;
  const { slip, rotation } = shown[0].answer.curves;
  const titles = /** @type {Record<string, string>} */ ({ ground: narrow ? "[g]" : "ground [g]", slip: `slip [${slip.unit}]${narrow ? "" : "<br>+ downstream"}`, rotation: `rotation [${rotation.unit}]${narrow ? "" : "<br>+ about heel"}`, modes: "" });
  const end = Math.max(...shown.map(({ answer }) => answer.curves.end));
  const made = /** @type {Record<string, object>} */ ({
    xaxis: { range: [0, end], title: { text: "time [s]" }, anchor: "y4", gridcolor: colour("rule"), zerolinecolor: colour("rule"), linecolor: colour("line") },
  });
  const flat = flatRows(shown);
  for (const [row, domain] of domains(flat)) {
    made[AXES[row].replace("y", "yaxis")] = {
      domain, title: { text: titles[row], font: { size: 12 }, standoff: 4 }, gridcolor: colour("rule"), zerolinecolor: colour("line"), nticks: narrow && row === "ground" ? 3 : 5, fixedrange: row === "modes",
      ...(row === "modes" ? { type: "category", categoryarray: shown.map(({ model }) => model).reverse(), categoryorder: "array", showgrid: false, range: [-0.6, shown.length - 0.4] } : { automargin: false }),
      // Said both ways: an axis about which nothing is said keeps the range that a drag has given it.
      ...(flat.includes(row) ? { title: { text: "" }, showticklabels: false, showgrid: false, fixedrange: true, autorange: false, range: [-1, 1].map((side) => 2 * side * shown[0].answer.curves[row].least) } : row === "modes" ? {} : ranges[row] ? { range: ranges[row], autorange: false } : { autorange: true }),
    };
  }
  const annotations = flat.map((row) => ({ text: `no ${row}`, xref: "paper", yref: `${AXES[row]} domain`, x: 0.01, y: 0.5, yanchor: "bottom", showarrow: false, font: { size: 12 } }));
  return {
    ...made, ...size, annotations, uirevision: "kept", showlegend: false, dragmode: narrow ? false : "zoom", hovermode: "closest",
    margin: { l: narrow ? 66 : 84, r: 12, t: 8, b: 42 }, paper_bgcolor: colour("page"), plot_bgcolor: colour("page"),
    font: { color: colour("text"), family: "system-ui, sans-serif", size: narrow ? 11 : 13 },
  };
}

/** How a plot was drawn last, and while a slider moves which of its rows have to show all. @type {WeakMap<HTMLElement, {like: string, rows: string[] | null}>} */
const last = new WeakMap();

/**
 * @param {HTMLElement} place
 * @param {Shown[]} shown Those with curves; at least one.
 * @param {Size} size
 * @param {boolean} moving Whether more is to come at once: then it is drawn on the axes that stand.
 * @returns {Promise<boolean>} Whether it has to be drawn anew once it rests.
 */
export async function draw(place, shown, size, moving) {
  const plotly = /** @type {any} */ (window).Plotly;
  const like = JSON.stringify([size, flatRows(shown), shown.map(({ model, answer: { curves: { end, slip, rotation } } }) => [model, end, slip.unit, rotation.unit])]);
  const before = last.get(place);
  const quick = moving && before !== undefined && before.like === like;
  const rows = quick ? before.rows || following(place) : null;
  last.set(place, { like, rows });
  if (rows && drawQuickly(place, shown, rows, size.width < NARROW)) return true;
  const narrow = size.width < NARROW;
  await plotly.react(place, traces(shown, narrow), layout(shown, size, roomy(shown, rows || [])), { displaylogo: false, displayModeBar: narrow ? false : "hover", modeBarButtonsToRemove: ["select2d", "lasso2d", "toImage"] });
  forget(place);
  return rows !== null;
}

/**
 * Mark a moment in the plot.
 * @param {HTMLElement} place
 * @param {number} time
 */
export function cursor(place, time) {
  const made = /** @type {any} */ (place)._fullLayout;
  if (!made || !made.xaxis) return;
  let line = /** @type {HTMLElement | null} */ (place.querySelector(".cursor"));
  if (!line) {
    line = document.createElement("div");
    line.className = "cursor";
    place.append(line);
  }
  const { xaxis, _size: size } = made;
  const x = xaxis.l2p(time);
  line.hidden = x < 0 || x > xaxis._length;
  line.style.left = `${xaxis._offset + x}px`;
  line.style.top = `${size.t}px`;
  line.style.height = `${size.h}px`;
}

/**
 * Hear of a click on a curve, and of a change of the axes.
 * @param {HTMLElement} place
 * @param {(time: number) => void} clicked
 */
export function onMoment(place, clicked) {
  const plot = /** @type {any} */ (place);
  if (plot.dataset.heard) return;
  plot.dataset.heard = "yes";
  plot.on("plotly_click", (/** @type {any} */ event) => clicked(event.points[0].x));
}

/** @type {Promise<undefined> | null} */
let loading = null;

/** Load the library that draws, once; the page is there before. */
export function loadPlotly() {
  loading = loading || new Promise((done, failed) => {
    const script = document.createElement("script");
    script.src = "/plotly.js";
    script.addEventListener("load", () => done(undefined));
    script.addEventListener("error", failed);
    document.head.append(script);
  });
  return loading;
}
