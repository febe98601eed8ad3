/** What the plot of the answer draws, however it is drawn: curves in rows over one time axis, and the modes below them. */
import { unpack } from "../unpack.js";

/** @typedef {{model: string, stale: boolean, answer: any}} Shown */
/** @typedef {{row: string, of: string, model: string, stale: boolean, width: number, dash: boolean, x: Float32Array, y: Float32Array}} Line */
/** @typedef {{start: number, end: number}} Span */

export const KINDS = ["rest", "slide", "rock", "slide-rock", "drift"];
/** Rows of curves, as plotly calls their axes. */
export const AXES = /** @type {Record<string, string>} */ ({ ground: "y", slip: "y2", rotation: "y3", modes: "y4" });

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

/**
 * The curves; `of` is the name of the colour.
 * @param {Shown[]} shown
 * @returns {Line[]}
 */
export function lines(shown) {
  return shown.flatMap(({ model, stale, answer }, place) => {
    const data = curves(answer);
    const rows = place > 0 ? ["slip", "rotation"] : ["ground", "slip", "rotation"];
    return rows.map((row) => {
      const of = row === "ground" ? row : model;
      return { row, of, model, stale, width: row === "slip" ? 2 : 1.1, dash: of === "flexible", x: data.time, y: data[row] };
    });
  });
}

/** @param {Shown} shown @param {string} kind @returns {Span[]} */
export const spans = ({ answer }, kind) => answer.ribbon.filter((/** @type {any} */ each) => each.kind === kind);

/** How thick the modes are drawn. @param {Shown[]} shown @param {boolean} narrow */
export const thickness = (shown, narrow) => (narrow ? 9 : shown.length > 2 ? 13 : 18);
