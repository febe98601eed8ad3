/** The curves while a slider moves: plain paths on the axes that stand, which are there sooner than a plot with axes of
 * its own. That is drawn (plot.js) where a curve would leave the axes, and as soon as the slider rests. */
import { AXES, DASHES, KINDS, lines, spans, thickness } from "./lines.js";

/** @typedef {import("./lines.js").Shown} Shown */
/** @typedef {{frames: Record<string, Element>, paths: Map<string, Element>}} Picture */

const SVG = "http://www.w3.org/2000/svg";
const ROWS = Object.keys(AXES);
/** How much farther than what is to be drawn now the axes reach that are made while a slider moves. */
const ROOM = 1.6;

/** @type {WeakMap<HTMLElement, Picture>} */
const pictures = new WeakMap();

/** Of plotly: an axis of a row as it stands. @param {HTMLElement} place @param {string} row */
const axis = (place, row) => /** @type {any} */ (place)._fullLayout[AXES[row].replace("y", "yaxis")];

/** @param {string} tag @param {Record<string, string | number>} attributes */
function made(tag, attributes) {
  const node = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  return node;
}

/**
 * From where to where the curves of a row reach; zero is always there.
 * @param {Shown[]} shown @param {string} row @returns {[number, number]}
 */
function extent(shown, row) {
  let [least, most] = [0, 0];
  for (const { y } of lines(shown).filter((line) => line.row === row)) {
    for (let k = 0; k < y.length; k += 1) {
      if (y[k] < least) least = y[k];
      else if (y[k] > most) most = y[k];
    }
  }
  return [least, most];
}

/**
 * The rows of a plot at rest whose axes follow what is drawn: no one has zoomed in there.
 * @param {HTMLElement} place
 */
export const following = (place) => ROWS.filter((row) => row !== "modes" && axis(place, row).autorange);

/**
 * Ranges with room for what is to come.
 * @param {Shown[]} shown
 * @param {string[]} rows
 * @returns {Record<string, [number, number]>}
 */
export function roomy(shown, rows) {
  return Object.fromEntries(rows.map((row) => {
    const [least, most] = extent(shown, row);
    const edge = 0.05 * (most - least) || 1e-3;
    return [row, [ROOM * least - edge, ROOM * most + edge]];
  }));
}

/**
 * Frames that show the rows of the plot, as it stands.
 * @param {HTMLElement} place
 * @returns {Picture}
 */
function framed(place) {
  const root = made("svg", { class: "quick-curves", "aria-hidden": "true" });
  const { xaxis } = /** @type {any} */ (place)._fullLayout;
  const frames = Object.fromEntries(ROWS.map((row) => {
    const { _offset, _length } = axis(place, row);
    return [row, made("svg", { x: xaxis._offset, y: _offset, width: xaxis._length, height: _length })];
  }));
  root.append(...Object.values(frames));
  for (const old of place.querySelectorAll(".quick-curves")) old.remove();
  place.append(root);
  return { frames, paths: new Map() };
}

/** The plot has axes of its own again. @param {HTMLElement} place */
export function forget(place) {
  place.classList.remove("quick");
  pictures.delete(place);
}

/**
 * Draw on the axes that stand.
 * @param {HTMLElement} place
 * @param {Shown[]} shown
 * @param {string[]} rows Those whose axes have to show all of their curves.
 * @param {boolean} narrow
 * @returns {boolean} Whether they do; where not, nothing is drawn.
 */
export function drawQuickly(place, shown, rows, narrow) {
  for (const row of rows) {
    const [low, high] = axis(place, row).range;
    const [least, most] = extent(shown, row);
    if (least < low || most > high) return false;
  }
  const picture = pictures.get(place) || framed(place);
  pictures.set(place, picture);
  const { xaxis } = /** @type {any} */ (place)._fullLayout;
  const across = (/** @type {number} */ time) => xaxis.l2p(time).toFixed(2);
  const wanted = new Set();

  /** @param {string} row @param {string} of @param {string} model @param {string} d @param {Record<string, string | number>} look */
  const put = (row, of, model, d, look) => {
    const key = `${row} ${of} ${model}`;
    let path = picture.paths.get(key);
    if (!path) {
      path = made("path", { stroke: `var(--${of})` });
      picture.frames[row].append(path);
      picture.paths.set(key, path);
    }
    for (const [name, value] of Object.entries({ d, ...look })) path.setAttribute(name, String(value));
    wanted.add(key);
  };

  for (const { row, of, name, stale, width, dash, x, y } of lines(shown)) {
    const { l2p } = axis(place, row);
    const points = new Array(x.length);
    for (let k = 0; k < x.length; k += 1) points[k] = `${across(x[k])} ${l2p(y[k]).toFixed(2)}`;
    put(row, of, name, `M${points.join("L")}`, { "stroke-width": width, "stroke-opacity": stale ? 0.3 : 1, "stroke-dasharray": DASHES[dash] });
  }
  shown.forEach((item, at) => {
    const level = axis(place, "modes").l2p(shown.length - 1 - at);
    for (const kind of KINDS) {
      const d = spans(item, kind).map(({ start, end }) => `M${across(start)} ${level}H${across(end)}`).join("");
      if (d) put("modes", kind, item.model, d, { "stroke-width": thickness(shown, narrow) });
    }
  });
  for (const [key, path] of picture.paths) if (!wanted.has(key)) path.setAttribute("d", "");
  place.classList.add("quick");
  return true;
}
