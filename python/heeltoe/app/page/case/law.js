/** The curve of a friction law: apparent friction over the slip, its speed or the normal stress. */
import { element, svg } from "../dom.js";

const WIDE = 420;
const TALL = 210;
const MARGIN = { left: 52, right: 14, top: 12, bottom: 40 };

/** Round places from zero to an end, at most six. @param {number} end @param {number} [start] */
function ticks(end, start = 0) {
  const rough = (end - start) / 5 || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((factor) => factor >= rough * 0.999) || rough;
  return Array.from({ length: Math.floor((end / step) * 1.0001) + 1 }, (_, place) => Number((place * step).toPrecision(6)));
}

export class LawCurve {
  constructor() {
    this.picture = svg("svg", { class: "law", viewBox: `0 0 ${WIDE} ${TALL}`, role: "img", "aria-label": "Curve of the friction law" });
    this.caption = element("p", { class: "meaning" });
    this.root = element("div", { class: "law-curve", hidden: true }, this.picture, this.caption);
  }

  /** @param {any} law None where the case in force has no law. */
  show(law) {
    this.root.hidden = !law;
    if (!law) return;
    const { over, at, friction, dot, sentence } = law;
    const end = at.at(-1);
    const most = 1.08 * Math.max(...friction, dot[1], 1e-3);
    const x = (/** @type {number} */ value) => MARGIN.left + (value / end) * (WIDE - MARGIN.left - MARGIN.right);
    const y = (/** @type {number} */ value) => TALL - MARGIN.bottom - (value / most) * (TALL - MARGIN.top - MARGIN.bottom);
    const text = (/** @type {number} */ left, /** @type {number} */ top, /** @type {string} */ what, /** @type {object} */ more = {}) => svg("text", { x: left, y: top, "text-anchor": "middle", ...more }, what);
    const across = ticks(end).flatMap((tick) => [svg("path", { class: "rule", d: `M${x(tick)} ${y(0)}V${MARGIN.top}` }), text(x(tick), y(0) + 15, String(tick))]);
    const up = ticks(most).flatMap((tick) => [svg("path", { class: "rule", d: `M${x(0)} ${y(tick)}H${WIDE - MARGIN.right}` }), text(x(0) - 6, y(tick) + 4, String(tick), { "text-anchor": "end" })]);
    const curve = at.map((/** @type {number} */ value, /** @type {number} */ place) => `${x(value).toFixed(1)},${y(friction[place]).toFixed(1)}`);
    const middle = (MARGIN.top + TALL - MARGIN.bottom) / 2;
    this.picture.replaceChildren(
      ...across, ...up,
      svg("path", { class: "curve", d: `M${curve.join("L")}` }),
      svg("circle", { cx: x(dot[0]), cy: y(dot[1]), r: 4 }),
      text((x(0) + x(end)) / 2, TALL - 8, over),
      text(14, middle, "apparent friction", { transform: `rotate(-90 14 ${middle})` }),
    );
    this.caption.textContent = sentence;
  }
}
