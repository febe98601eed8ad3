/** The player of the moving dam: its picture, the moment that is shown, and what it is played and looked at with. */
import { drawDam } from "./dam.js";
import { element } from "./element.js";
import { exaggerations, momentAt } from "./scene.js";

const SPEEDS = [0.1, 0.2, 0.5, 1, 2, 5];
/** Who wants less motion sees a picture now and then [ms]. */
const CALM_MS = 500;
const calm = matchMedia("(prefers-reduced-motion: reduce)");

export class DamPlayer {
  /**
   * A page places `view`, `now` and `controls` where it has room.
   * @param {(moment: ReturnType<typeof momentAt>) => void} drawn Called after each drawing.
   * @param {number} [speed] Seconds of the earthquake per second.
   */
  constructor(drawn, speed = 1) {
    this.drawn = drawn;
    /** @type {any} */
    this.scene = null;
    this.time = 0;
    this.playing = false;
    this.last = 0;
    // Until somebody has chosen a moment it is the end: what the earthquake leaves.
    this.chosen = false;
    this.waiting = false;
    this.later = 0;
    this.canvas = /** @type {HTMLCanvasElement} */ (element("canvas", { role: "img" }));
    this.legend = element("p", { class: "legend" });
    this.view = element("div", { class: "player-view" }, this.canvas, this.legend);
    this.moment = element("strong", {});
    this.mode = element("span", {});
    this.size = element("span", { class: "drawn-size" });
    this.now = element("p", { class: "player-now" }, this.moment, " ", this.mode, " ", this.size);
    const redraw = () => this.redraw();
    this.button = element("button", { type: "button", title: "Play or pause (space)", onclick: () => this.play(!this.playing) }, "Play");
    this.scrub = /** @type {HTMLInputElement} */ (element("input", { type: "range", min: 0, step: 0.01, value: 0, "aria-label": "Moment shown", oninput: () => this.goTo(Number(this.scrub.value)), onkeydown: (/** @type {KeyboardEvent} */ event) => this.key(event) }));
    this.speed = /** @type {HTMLSelectElement} */ (element("select", {}));
    this.speed.append(...sorted([...SPEEDS, speed]).map((each) => element("option", { value: each, selected: each === speed }, `${each} ×`)));
    this.exaggeration = /** @type {HTMLSelectElement} */ (element("select", { onchange: redraw }));
    const box = (/** @type {boolean} */ checked) => /** @type {HTMLInputElement} */ (element("input", { type: "checkbox", checked, onchange: redraw }));
    [this.forces, this.grid, this.repeat] = [box(true), box(true), box(false)];
    this.controls = element(
      "div",
      { class: "player-controls", role: "group", "aria-label": "Controls" },
      this.button,
      element("label", { class: "wide" }, "Time ", this.scrub),
      element("label", {}, "Speed ", this.speed),
      element("label", {}, "Displacements drawn ", this.exaggeration),
      element("label", {}, this.forces, " Forces"),
      element("label", {}, this.grid, " Elements"),
      element("label", {}, this.repeat, " Repeat"),
    );
    new ResizeObserver(redraw).observe(this.canvas);
  }

  /** Show a scene, at the moment that was chosen. @param {any} scene As `readScene` returns it. */
  show(scene) {
    if (scene !== this.scene) {
      this.scene = scene;
      this.scrub.min = String(scene.start);
      this.scrub.max = String(scene.end);
      this.offerExaggerations();
      this.explain();
    }
    if (!this.chosen || this.time > scene.end) this.time = scene.end;
    this.redraw();
  }

  /** Offer 1, 2, 5, ... times; until one is chosen, as many as the scene suggests. */
  offerExaggerations() {
    const { scene, exaggeration } = this;
    const chosen = exaggeration.value;
    const choices = sorted([...exaggerations(scene.exaggeration), ...(chosen ? [Number(chosen)] : [])]);
    const times = (/** @type {number} */ each) => (each === 1 ? "to scale" : `× ${each}`);
    exaggeration.replaceChildren(element("option", { value: "" }, `suggested (${times(scene.exaggeration)})`), ...choices.map((each) => element("option", { value: each }, times(each))));
    exaggeration.value = chosen;
  }

  /** Say what arrows and marks mean. */
  explain() {
    const { scene } = this;
    const entry = (/** @type {string} */ kind, /** @type {string} */ name, /** @type {string} */ colour = "") => {
      const sign = element("i", { class: kind });
      if (colour) sign.style.background = `var(--${colour})`;
      return element("span", {}, sign, name);
    };
    this.legend.replaceChildren(
      entry("arrow", scene.forceText),
      ...scene.statusNames.map((/** @type {string} */ name, /** @type {number} */ k) => entry("dot", name, `status-${k}`)),
      entry("dashed", "before the earthquake"),
      ...((scene.anchors || []).length ? [entry("dashed anchor", "anchor")] : []),
    );
    // A rigid part has no elements.
    const label = /** @type {HTMLElement} */ (this.grid.parentElement);
    label.hidden = scene.parts.every((/** @type {any} */ part) => part.grid.length === 0);
    const moving = scene.parts.filter((/** @type {any} */ part) => part.shapeCount > 0).length;
    this.canvas.setAttribute("aria-label", `Section of the dam, ${moving} moving ${moving === 1 ? "part" : "parts"}`);
  }

  /** @param {number} time */
  goTo(time) {
    this.chosen = true;
    this.time = Math.min(this.scene.end, Math.max(this.scene.start, time));
    this.last = performance.now();
    this.redraw();
  }

  /** @param {boolean} wanted */
  play(wanted) {
    if (wanted && this.time >= this.scene.end) this.time = this.scene.start;
    this.chosen = true;
    this.playing = wanted;
    this.last = performance.now();
    this.button.textContent = wanted ? "Pause" : "Play";
    this.redraw();
  }

  /** Play and pause with space, step with the arrow keys. @param {KeyboardEvent} event */
  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const step = event.shiftKey ? 1 : 0.1;
    const deeds = /** @type {Record<string, () => void>} */ ({
      " ": () => this.play(!this.playing),
      ArrowLeft: () => this.goTo(this.time - step),
      ArrowDown: () => this.goTo(this.time - step),
      ArrowRight: () => this.goTo(this.time + step),
      ArrowUp: () => this.goTo(this.time + step),
      Home: () => this.goTo(this.scene.start),
      End: () => this.goTo(this.scene.end),
    });
    if (!(event.key in deeds)) return;
    event.preventDefault();
    deeds[event.key]();
  }

  /** Draw once in the next picture of the screen, however many things ask for it. */
  redraw() {
    if (this.waiting || !this.scene) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      if (this.playing) this.advance();
      this.draw();
      if (!this.playing) return;
      clearTimeout(this.later);
      if (calm.matches) this.later = setTimeout(() => this.redraw(), CALM_MS);
      else this.redraw();
    });
  }

  advance() {
    const now = performance.now();
    this.time += ((now - this.last) / 1000) * Number(this.speed.value);
    this.last = now;
    const { start, end } = this.scene;
    if (this.time < end) return;
    this.time = this.repeat.checked ? start : end;
    if (!this.repeat.checked) this.play(false);
  }

  draw() {
    const { scene, time } = this;
    const moment = momentAt(scene.times, time);
    const { name } = scene.modes[scene.mode[moment.nearest]];
    const exaggeration = Number(this.exaggeration.value) || scene.exaggeration;
    if (this.canvas.clientWidth) {
      const long = drawDam(this.canvas, scene, moment, { exaggeration, forces: this.forces.checked, grid: this.grid.checked });
      /** @type {HTMLElement} */ (this.legend.querySelector(".arrow")).style.width = `${long}px`;
    }
    const now = `${time.toFixed(2)} s`;
    const size = exaggeration === 1 ? "displacements drawn to scale" : `displacements drawn × ${exaggeration}`;
    this.scrub.value = String(time);
    this.scrub.setAttribute("aria-valuetext", `${now}, ${name}`);
    write(this.moment, now);
    write(this.mode, name);
    write(this.size, `${size}, relative to ${scene.relativeTo}`);
    this.drawn(moment);
  }
}

/** @param {HTMLElement} place @param {string} text */
function write(place, text) {
  if (place.textContent !== text) place.textContent = text;
}

/** @param {number[]} values */
function sorted(values) {
  return [...new Set(values)].sort((a, b) => a - b);
}
