/** The dam in motion beside its curves: the player, with the model that is chosen. */
import { element } from "./dom.js";
import { DamPlayer } from "../player/player.js";
import { readScene } from "../player/scene.js";

const NAMES = /** @type {Record<string, string>} */ ({ rigid: "rigid block", decoupled: "rigid block on an elastic part", flexible: "elastic dam" });

export class DamInMotion {
  /** @param {(time: number) => void} moved Called with the moment that is shown. */
  constructor(moved) {
    /** @type {any[]} */
    this.shown = [];
    this.wanted = "";
    this.player = new DamPlayer(() => moved(this.time));
    this.model = /** @type {HTMLSelectElement} */ (element("select", { onchange: () => this.draw() }));
    const { view, now, controls } = this.player;
    controls.append(element("label", {}, "Shown ", this.model));
    this.root = element("section", { class: "card moving", "aria-label": "The dam in motion" }, element("h3", {}, "The dam in motion"), view, now, controls);
    this.root.hidden = true;
  }

  get time() {
    return this.player.time;
  }

  /** @param {{model: string, answer: any}[]} shown Models with what they have said last, the better ones last. */
  show(shown) {
    this.shown = shown.filter(({ answer }) => answer.dam);
    this.root.hidden = this.shown.length === 0;
    if (!this.shown.length) return;
    const names = this.shown.map(({ model }) => model);
    if (names.join() !== [...this.model.options].map((option) => option.value).join()) {
      const before = this.model.value;
      this.model.replaceChildren(...names.map((name) => element("option", { value: name }, NAMES[name])));
      this.model.value = names.includes(before) ? before : names[0];
    }
    if (this.wanted && names.includes(this.wanted)) {
      this.model.value = this.wanted;
      this.wanted = "";
    }
    this.draw();
  }

  /** Show the elastic dam as soon as it is there, and no longer than it is of the sliders as they stand. @param {string} model */
  prefer(model) {
    this.wanted = model;
    if (!model && this.model.value === "flexible") this.model.selectedIndex = 0;
  }

  /** @param {number} time */
  goTo(time) {
    this.player.goTo(time);
  }

  draw() {
    const shown = this.shown.find(({ model }) => model === this.model.value);
    if (shown) this.player.show(read(shown.answer.dam));
  }
}

/** Scenes with their arrays unpacked, which is done once. @type {WeakMap<object, any>} */
const known = new WeakMap();

/** @param {any} dam */
function read(dam) {
  if (!known.has(dam)) known.set(dam, readScene(dam));
  return known.get(dam);
}
