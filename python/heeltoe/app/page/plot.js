/** The answer over time: ground, slip, rotation and modes of every model, on one time axis that zooms. */
import { colour } from "./dom.js";
import { unpack } from "./unpack.js";

/** @typedef {{model: string, stale: boolean, answer: any}} Shown */

const KINDS = ["rest", "slide", "rock", "slide-rock", "drift"];
const DASHES = /** @type {Record<string, string>} */ ({ rigid: "solid", decoupled: "solid", flexible: "dash" });
/** From the top; parts of the height. */
const ROWS = /** @type {Record<string, [number, number]>} */ ({ ground: [0.87, 1], slip: [0.48, 0.83], rotation: [0.17, 0.44], modes: [0, 0.13] });
const AXES = /** @type {Record<string, string>} */ ({ ground: "y", slip: "y2", rotation: "y3", modes: "y4" });

/** @type {WeakMap<object, Record<string, Float32Array>>} */
const unpacked = new WeakMap();

/** @param {any} answer */
function curves(answer) {
  const known = unpacked.get(answer);
  if (known) return known;
  const { time, ground, slip, rotation } = answer.curves;
  const made = { time: unpack(time), ground: unpack(ground.values), slip: unpack(slip.values), rotation: unpack(rotation.values) };
  unpacked.set(answer, made);
  return made;
}

/** @param {Shown[]} shown @param {boolean} narrow */
function traces(shown, narrow) {
  /** @type {object[]} */
  const found = [];
  shown.forEach(({ model, stale, answer }, place) => {
    const data = curves(answer);
    for (const row of ["ground", "slip", "rotation"]) {
      if (row === "ground" && place > 0) continue;
      found.push({
        x: data.time, y: data[row], yaxis: AXES[row], type: "scatter", mode: "lines", name: row === "ground" ? row : model,
        opacity: stale ? 0.3 : 1, hovertemplate: `%{y:.4g} at %{x:.2f} s`,
        line: { color: colour(row === "ground" ? row : model), width: row === "slip" ? 2 : 1.1, dash: row === "ground" ? "solid" : DASHES[model] },
      });
    }
  });
  for (const kind of KINDS) {
    /** @type {(number | null)[]} */
    const x = [];
    /** @type {string[]} */
    const y = [];
    for (const { model, answer } of shown) {
      for (const span of answer.ribbon) {
        if (span.kind !== kind) continue;
        x.push(span.start, span.end, null);
        y.push(model, model, model);
      }
    }
    if (x.length) {
      found.push({ x, y, yaxis: AXES.modes, type: "scatter", mode: "lines", name: kind, line: { color: colour(kind), width: narrow ? 9 : shown.length > 2 ? 13 : 18 }, hovertemplate: `${kind}, %{x:.2f} s` });
    }
  }
  return found;
}

/**
 * @param {Shown[]} shown
 * @param {boolean} narrow
 */
function layout(shown, narrow) {
  const { slip, rotation } = shown[0].answer.curves;
  const titles = /** @type {Record<string, string>} */ ({ ground: narrow ? "[g]" : "ground [g]", slip: `slip [${slip.unit}]${narrow ? "" : "<br>+ downstream"}`, rotation: `rotation [${rotation.unit}]${narrow ? "" : "<br>+ about heel"}`, modes: "" });
  const end = Math.max(...shown.map(({ answer }) => answer.curves.end));
  const made = /** @type {Record<string, object>} */ ({
    xaxis: { range: [0, end], title: { text: "time [s]" }, anchor: "y4", gridcolor: colour("rule"), zerolinecolor: colour("rule"), linecolor: colour("line") },
  });
  for (const [row, domain] of Object.entries(ROWS)) {
    made[AXES[row].replace("y", "yaxis")] = {
      domain, title: { text: titles[row], font: { size: 12 }, standoff: 4 }, gridcolor: colour("rule"), zerolinecolor: colour("line"), nticks: narrow && row === "ground" ? 3 : 5, fixedrange: row === "modes",
      ...(row === "modes" ? { type: "category", categoryarray: shown.map(({ model }) => model).reverse(), categoryorder: "array", showgrid: false, range: [-0.6, shown.length - 0.4] } : { automargin: false }),
    };
  }
  return {
    ...made, uirevision: "kept", showlegend: false, dragmode: narrow ? false : "zoom", hovermode: "closest",
    margin: { l: narrow ? 66 : 84, r: 12, t: 8, b: 42 }, paper_bgcolor: colour("page"), plot_bgcolor: colour("page"),
    font: { color: colour("text"), family: "system-ui, sans-serif", size: narrow ? 11 : 13 },
  };
}

/**
 * @param {HTMLElement} place
 * @param {Shown[]} shown Those with curves; at least one.
 */
export async function draw(place, shown) {
  const plotly = /** @type {any} */ (window).Plotly;
  const narrow = place.clientWidth < 600;
  const before = /** @type {any} */ (place)._fullLayout;
  if (before && before.width !== place.clientWidth) await plotly.Plots.resize(place);
  await plotly.react(place, traces(shown, narrow), layout(shown, narrow), { responsive: true, displaylogo: false, displayModeBar: narrow ? false : "hover", modeBarButtonsToRemove: ["select2d", "lasso2d", "toImage"] });
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
