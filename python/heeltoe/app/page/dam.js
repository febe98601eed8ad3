/** The dam in motion: its parts as a model moves them, with play, a time to drag, speed and magnification. */
import { element } from "./dom.js";
import { drawnPoints, momentAt, picked, readPart, unpacked, waterOutline } from "../scene.js";

const SVG = "http://www.w3.org/2000/svg";
const NAMES = /** @type {Record<string, string>} */ ({ rigid: "rigid block", decoupled: "rigid block on an elastic part", flexible: "elastic dam" });
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5];
const MAGNIFICATIONS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
/** Who wants less motion sees a picture now and then [ms]. */
const CALM_MS = 500;
const calm = matchMedia("(prefers-reduced-motion: reduce)");

/** @param {string} name @param {Record<string, unknown>} attributes */
function drawn(name, attributes = {}) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}

/** @param {number[][]} points */
const path = (points) => (points.length ? `M${points.map(([x, z]) => `${x.toFixed(3)} ${(-z).toFixed(3)}`).join("L")}Z` : "");

export class DamInMotion {
  /** @param {(time: number) => void} moved Called with the moment that is shown. */
  constructor(moved) {
    this.moved = moved;
    /** @type {any[]} */
    this.shown = [];
    this.time = 0;
    this.end = 0;
    this.playing = false;
    this.last = 0;
    this.touched = false;
    this.wanted = "";
    this.parts = Object.fromEntries(["water", "tailwater", "still", "lower", "upper"].map((name) => [name, drawn("path", { class: `dam-${name}` })]));
    this.svg = drawn("svg", { role: "img", "aria-label": "Section of the dam" });
    this.svg.append(...Object.values(this.parts));
    this.play = element("button", { type: "button", onclick: () => this.run(!this.playing) }, "Play");
    this.scrub = /** @type {HTMLInputElement} */ (element("input", { type: "range", min: 0, step: 0.01, value: 0, "aria-label": "Moment shown", oninput: () => this.goTo(Number(this.scrub.value)) }));
    this.model = this.choice("Shown", () => this.draw());
    this.speed = this.choice("Speed", () => {});
    this.speed.replaceChildren(...SPEEDS.map((speed) => element("option", { value: speed, selected: speed === 1 }, `${speed} ×`)));
    this.size = this.choice("Displacements drawn", () => this.draw());
    this.size.replaceChildren(element("option", { value: "" }, "as fits"), ...MAGNIFICATIONS.map((size) => element("option", { value: size }, size === 1 ? "to scale" : `× ${size}`)));
    this.says = element("p", { class: "faint", id: "dam-says" });
    const labelled = (/** @type {HTMLElement} */ select) => element("label", {}, `${select.getAttribute("data-label")} `, select);
    this.root = element("section", { class: "card moving", "aria-label": "The dam in motion" }, element("h3", {}, "The dam in motion"), this.svg, element("div", { class: "in-line" }, this.play, ...[this.model, this.speed, this.size].map(labelled)), this.scrub, this.says);
    this.root.hidden = true;
  }

  /** @param {string} label @param {() => void} changed */
  choice(label, changed) {
    return /** @type {HTMLSelectElement} */ (element("select", { "data-label": label, onchange: changed }));
  }

  /** @param {{model: string, answer: any}[]} shown Models with what they have said last, the better ones last. */
  show(shown) {
    const dams = shown.filter(({ answer }) => answer.dam);
    this.root.hidden = dams.length === 0;
    this.shown = dams;
    if (!dams.length) return;
    const names = dams.map(({ model }) => model);
    if (names.join() !== [...this.model.options].map((option) => option.value).join()) {
      const before = this.model.value;
      this.model.replaceChildren(...names.map((name) => element("option", { value: name }, NAMES[name])));
      this.model.value = names.includes(before) ? before : names[0];
    }
    if (this.wanted && names.includes(this.wanted)) {
      this.model.value = this.wanted;
      this.wanted = "";
    }
    this.end = Math.max(...dams.map(({ answer }) => answer.curves.end));
    this.scrub.max = String(this.end);
    // Until somebody has chosen a moment it is the end: what the earthquake leaves.
    if (!this.touched || this.time > this.end) this.time = this.end;
    this.draw();
  }

  /** Show the elastic dam as soon as it is there, and no longer than it is of the sliders as they stand. @param {string} model */
  prefer(model) {
    this.wanted = model;
    if (!model && this.model.value === "flexible") this.model.selectedIndex = 0;
  }

  /** @param {number} time */
  goTo(time) {
    this.touched = true;
    this.time = Math.min(this.end, Math.max(0, time));
    this.draw();
  }

  /** @param {boolean} wanted */
  run(wanted) {
    if (wanted && this.time >= this.end) this.time = 0;
    this.touched = true;
    this.playing = wanted;
    this.last = performance.now();
    this.play.textContent = wanted ? "Pause" : "Play";
    if (wanted) this.next();
  }

  next() {
    if (!this.playing) return;
    const now = performance.now();
    this.time += ((now - this.last) / 1000) * Number(this.speed.value);
    this.last = now;
    if (this.time >= this.end) {
      this.time = this.end;
      this.run(false);
    }
    this.draw();
    if (calm.matches) setTimeout(() => this.next(), CALM_MS);
    else requestAnimationFrame(() => this.next());
  }

  draw() {
    const { answer, model } = this.shown.find((item) => item.model === this.model.value) || {};
    if (!answer) return;
    const dam = read(answer.dam);
    const times = Number(this.size.value) || dam.exaggeration;
    const moment = momentAt(dam.times, this.time);
    const positions = dam.parts.map((/** @type {any} */ part) => drawnPoints(part, moment, times));
    /** @param {boolean} moving @param {(place: number) => any} points */
    const outlines = (moving, points) => dam.parts.map((/** @type {any} */ part, /** @type {number} */ place) => (part.shapeCount > 0 === moving ? path(picked(points(place), part.outline)) : "")).join("");
    this.view(dam, positions);
    this.parts.upper.setAttribute("d", outlines(true, (place) => positions[place]));
    this.parts.still.setAttribute("d", outlines(true, (place) => dam.parts[place].points));
    this.parts.lower.setAttribute("d", outlines(false, (place) => positions[place]));
    const blocks = dam.parts.filter((/** @type {any} */ { shapeCount }) => shapeCount > 0).length;
    const kind = (answer.ribbon.find((/** @type {any} */ span) => span.start <= this.time && this.time <= span.end) || {}).kind || "rest";
    this.scrub.value = String(this.time);
    const now = `${this.time.toFixed(2)} s`;
    this.scrub.setAttribute("aria-valuetext", `${now}, ${kind}`);
    const size = times === 1 ? "displacements drawn to scale" : `displacements drawn × ${times}`;
    const text = `${now}: ${kind}; ${size}, relative to ${blocks > 1 ? "the ground" : "the part below the crack"}${model === "flexible" ? ", without what the concrete itself gives" : ""}`;
    if (this.says.textContent !== text) this.says.textContent = text;
    this.moved(this.time);
  }

  /** @param {any} dam @param {any[]} positions Where the points of its parts are. */
  view(dam, positions) {
    const all = /** @type {number[][]} */ (dam.parts.flatMap((/** @type {any} */ part) => picked(part.points, part.outline)));
    const xs = all.map(([x]) => x);
    const zs = all.map(([, z]) => z);
    const [left, right, base, top] = [Math.min(...xs), Math.max(...xs), Math.min(dam.base, ...zs), Math.max(...zs)];
    const size = Math.max(top - base, right - left);
    const margin = 0.14 * size;
    this.svg.setAttribute("viewBox", `${left - 2.4 * margin} ${-top - 0.6 * margin} ${right - left + 4.8 * margin} ${top - base + 1.2 * margin}`);
    this.svg.style.strokeWidth = String(size / 260);
    this.parts.still.setAttribute("stroke-dasharray", String(size / 100));
    for (const [name, edge] of /** @type {[string, number][]} */ ([["water", left - 2.4 * margin], ["tailwater", right + 2.4 * margin]])) {
      const level = dam[name];
      const wet = level !== null && level > base;
      this.parts[name].setAttribute("d", wet ? path(waterOutline(dam.parts, positions, level, name === "water", edge).outline) : "");
    }
  }
}

/** Parts with their arrays unpacked, which is done once. @type {WeakMap<object, any>} */
const known = new WeakMap();

/** @param {any} dam */
function read(dam) {
  if (!known.has(dam)) known.set(dam, { ...dam, times: unpacked(dam.times), parts: dam.parts.map(readPart) });
  return known.get(dam);
}
