/** What the plot of the answer draws, however it is drawn: curves in rows over one time axis, and the modes below them. */
import { unpacked } from "../../player/scene.js";

/** @typedef {{model: string, stale: boolean, answer: any}} Shown */
/** @typedef {{row: string, of: string, name: string, stale: boolean, width: number, dash: string, x: Float32Array, y: Float32Array}} Line */
/** @typedef {{name: string, slip: Float32Array, rotation: Float32Array}} Crack */
/** @typedef {{start: number, end: number}} Span */

export const KINDS = ["rest", "slide", "rock", "slide-rock", "drift"];
/** Rows of curves, as plotly calls their axes. */
export const AXES = /** @type {Record<string, string>} */ ({ ground: "y", slip: "y2", rotation: "y3", modes: "y4" });

/** How a curve is broken, as plotly and as drawings say it. @type {Record<string, string>} */
export const DASHES = { solid: "none", dash: "9 9", dot: "2 4" };

/** @type {WeakMap<object, {time: Float32Array, ground: Float32Array, cracks: Crack[]}>} */
const curvesOf = new WeakMap();

/** @param {any} answer */
function curves(answer) {
  const known = curvesOf.get(answer);
  if (known) return known;
  const { time, ground, cracks } = answer.curves;
  // That of the crack that leads first.
  const all = [{ name: "", ...answer.curves }, ...cracks].map(({ name, slip, rotation }) => ({ name, slip: unpacked(slip.values), rotation: unpacked(rotation.values) }));
  const made = { time: unpacked(time), ground: unpacked(ground.values), cracks: all };
  curvesOf.set(answer, made);
  return made;
}

/**
 * The curves; `of` is the name of the colour.
 * @param {Shown[]} shown
 * @returns {Line[]}
 */
export function lines(shown) {
  const better = shown[shown.length - 1]?.model;
  return shown.flatMap(({ model, stale, answer }, place) => {
    const { time, ground, cracks } = curves(answer);
    const first = place > 0 ? [] : [{ row: "ground", of: "ground", name: "ground", stale, width: 1.1, dash: "solid", x: time, y: ground }];
    return [...first, ...cracks.flatMap((crack) => (/** @type {const} */ (["slip", "rotation"])).map((row) => {
      const dash = crack.name ? "dot" : "solid";
      // The better model stands out.
      const width = (row === "slip" ? 2 : 1.1) * (model !== better ? 0.6 : 1);
      return { row, of: model, name: crack.name || model, stale, width, dash, x: time, y: crack[row] };
    }))];
  });
}

/**
 * The rows in which no curve leaves zero by what anybody could measure.
 * @param {Shown[]} shown
 */
export const flatRows = (shown) => ["slip", "rotation"].filter((row) => {
  const { least } = shown[0].answer.curves[row];
  return lines(shown).every((line) => line.row !== row || line.y.every((value) => Math.abs(value) < least));
});

/** @param {Shown} shown @param {string} kind @returns {Span[]} */
export const spans = ({ answer }, kind) => answer.ribbon.filter((/** @type {any} */ span) => span.kind === kind);

/** How thick the modes are drawn. @param {Shown[]} shown @param {boolean} narrow */
export const thickness = (shown, narrow) => (narrow ? 9 : shown.length > 2 ? 13 : 18);
