/** Places in the drawing of the section, so that handles and words do not lie on each other. */

/** @typedef {{x: number, y: number}} Point */
/** @typedef {{left: number, right: number, top: number, bottom: number}} Box */

/** How near to each other two handles may be, and how far one goes aside at once [px]. */
const NEAR = 36;
const ASIDE = 42;
const LINE = 17;
/** A word is dropped where so many lines off no place is free either. */
const LINES_OFF = 4;

/** @param {Box} one @param {Box} other */
const meet = (one, other) => one.left < other.right && other.left < one.right && one.top < other.bottom && other.top < one.bottom;

/**
 * How far handles go aside from where they belong: those that move up and down sideways, the others upwards.
 * @param {(Point & {axes: string[]})[]} handles Where they belong; the first ones stay.
 * @param {number} wide
 * @returns {Point[]}
 */
export function asideOf(handles, wide) {
  /** @type {Point[]} */
  const taken = [];
  return handles.map(({ x, y, axes }) => {
    const upright = axes.length === 1 && axes[0] === "x";
    for (const step of [0, 1, -1, 2, -2, 3, -3, 4, -4]) {
      const place = { x: x + (upright ? 0 : step * ASIDE), y: y - (upright ? step * ASIDE : 0) };
      const inside = step === 0 || (place.x > NEAR / 2 && place.x < wide - NEAR / 2);
      if (!inside || taken.some((spot) => Math.hypot(spot.x - place.x, spot.y - place.y) < NEAR)) continue;
      taken.push(place);
      return { x: place.x - x, y: place.y - y };
    }
    taken.push({ x, y });
    return { x: 0, y: 0 };
  });
}

/** @param {Point} knob @returns {Box} */
export const boxOf = ({ x, y }) => ({ left: x - NEAR / 2, right: x + NEAR / 2, top: y - NEAR / 2, bottom: y + NEAR / 2 });

/**
 * Where a word is written: where it belongs, or a few lines above or below; null where nothing is free.
 * @param {Box} word
 * @param {Box[]} taken
 */
export function lineFor(word, taken) {
  for (let off = 0; off <= LINES_OFF; off += 1) {
    for (const by of off ? [off * LINE, -off * LINE] : [0]) {
      const box = { ...word, top: word.top + by, bottom: word.bottom + by };
      if (!taken.some((other) => meet(box, other))) return { box, by };
    }
  }
  return null;
}
