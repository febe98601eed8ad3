/** The drawing of the section, with handles that are dragged by mouse and touch, or moved by keys. */
import { asideOf, boxOf, lineFor } from "./apart.js";
import { element, svg } from "../dom.js";

/** @typedef {{name: string, label: string, at: [number, number], axes: string[], text: string, value: number, least: number, most: number}} Handle */

const TALLEST = 640;
const FAR = 10;
const FONT = "13px system-ui, sans-serif";
const pen = document.createElement("canvas").getContext("2d");

export class CaseDrawing {
  /**
   * @param {import("./edits.js").Edits} edits
   * @param {(name: string, what: "insert" | "remove") => void} corner Adds a corner after one, or takes it away.
   */
  constructor(edits, corner) {
    this.edits = edits;
    this.corner = corner;
    this.back = svg("g", { "aria-hidden": "true" });
    this.front = svg("g", {});
    this.picture = svg("svg", { class: "section-drawing", role: "group", "aria-label": "Section of the dam with handles to drag" }, this.back, this.front);
    this.ofCorners = element("span", { hidden: true }, " At a corner, Insert adds one after it and Delete takes it away.");
    this.hint = element("p", { class: "faint" }, "Drag a handle, or go to one with Tab and move it with the arrow keys (Page Up and Page Down: ten steps).", this.ofCorners);
    this.caption = element("p", { class: "caption", "aria-hidden": "true" });
    this.root = element("div", { class: "drawing" }, this.picture, this.caption, this.hint);
    /** @type {Map<string, {handle: Handle, root: SVGElement}>} */
    this.handles = new Map();
    /** How far each stands from where it belongs; nothing changes while one is dragged. @type {Map<string, {x: number, y: number}>} */
    this.aside = new Map();
    /** @type {any} */
    this.drawn = null;
    this.dragged = "";
    this.scale = 1;
    /** What of the plane is seen; it stands still while a handle is dragged. @type {number[]} */
    this.view = [0, 0, 1, 1];
    new ResizeObserver(() => this.draw()).observe(this.root);
  }

  /** @param {any} drawing */
  show(drawing) {
    this.drawn = drawing;
    if (!this.dragged) this.view = drawing.view;
    this.ofCorners.hidden = !drawing.handles.some((/** @type {Handle} */ { name }) => name.startsWith("corner"));
    this.draw();
  }

  /** @param {[number, number] | number[]} point */
  at([x, z]) {
    return [(x - this.view[0]) * this.scale, (this.view[3] - z) * this.scale];
  }

  draw() {
    const width = this.root.clientWidth;
    if (!this.drawn || !width) return;
    const [left, low, right, high] = this.view;
    this.scale = Math.min(width / (right - left), TALLEST / (high - low));
    const wide = (right - left) * this.scale;
    const tall = (high - low) * this.scale;
    this.picture.setAttribute("width", String(wide));
    this.picture.setAttribute("height", String(tall));
    this.picture.setAttribute("viewBox", `0 0 ${wide} ${tall}`);
    const ring = (/** @type {number[][]} */ points) => `M${points.map((point) => this.at(point).map((value) => value.toFixed(1)).join(",")).join("L")}`;
    const shapes = this.drawn.shapes.map((/** @type {any} */ { kind, rings }) => svg("path", { class: `of-${kind}`, d: rings.map((/** @type {number[][]} */ corners) => `${ring(corners)}Z`).join("") }));
    const lines = this.drawn.lines.map((/** @type {any} */ { kind, points }) => svg("path", { class: `line of-${kind}`, d: ring(points) }));
    const knobs = this.placeHandles(wide);
    this.back.replaceChildren(...shapes, ...lines, ...this.notes(wide, knobs));
  }

  /** @param {number} wide @param {{x: number, y: number}[]} knobs What is written goes round them. */
  notes(wide, knobs) {
    const anchors = /** @type {Record<string, [string, number, number]>} */ ({ left: ["end", -FAR, 0], right: ["start", FAR, 0], middle: ["middle", 0, 24], heel: ["end", -FAR, 18], toe: ["start", FAR, 18] });
    const taken = knobs.map(boxOf);
    const shown = this.drawn.notes.filter((/** @type {any} */ note) => note.side !== "middle" || wide > 420);
    return shown.flatMap((/** @type {any} */ { at, text, side }) => {
      const [anchor, dx, dy] = anchors[side];
      const place = this.at(at);
      const [x, y] = [place[0] + dx, place[1] + dy];
      if (pen) pen.font = FONT;
      const long = pen ? pen.measureText(text).width : 7 * text.length;
      const left = x - long * { start: 0, middle: 0.5, end: 1 }[/** @type {"start" | "middle" | "end"} */ (anchor)];
      const line = lineFor({ left, right: left + long, top: y - 12, bottom: y + 4 }, taken);
      if (!line) return [];
      taken.push(line.box);
      return [svg("text", { x, y: y + line.by, "text-anchor": anchor, class: "note" }, text)];
    });
  }

  /** Return where the handles stand. @param {number} wide */
  placeHandles(wide) {
    const belong = this.drawn.handles.map((/** @type {Handle} */ { at, axes }) => ({ x: this.at(at)[0], y: this.at(at)[1], axes }));
    if (!this.dragged) {
      const shifts = asideOf(belong, wide);
      this.aside = new Map(this.drawn.handles.map((/** @type {Handle} */ { name }, /** @type {number} */ place) => [name, shifts[place]]));
    }
    const names = new Set(this.drawn.handles.map((/** @type {Handle} */ handle) => handle.name));
    for (const [name, { root }] of this.handles) {
      if (names.has(name)) continue;
      root.remove();
      this.handles.delete(name);
    }
    return /** @type {Handle[]} */ (this.drawn.handles).map((handle, place) => {
      let known = this.handles.get(handle.name);
      if (!known) {
        known = { handle, root: this.make(handle.name) };
        this.handles.set(handle.name, known);
        this.front.append(known.root);
      }
      known.handle = handle;
      const off = this.aside.get(handle.name) || { x: 0, y: 0 };
      const [x, y] = [belong[place].x + off.x, belong[place].y + off.y];
      const { root } = known;
      root.querySelector(".leader")?.setAttribute("d", `M0 0L${(-off.x).toFixed(1)} ${(-off.y).toFixed(1)}`);
      root.setAttribute("transform", `translate(${x.toFixed(1)} ${y.toFixed(1)})`);
      const both = handle.axes.length > 1;
      root.setAttribute("class", `handle ${both ? "both" : handle.axes[0]}`);
      root.setAttribute("aria-label", handle.label);
      root.setAttribute("aria-orientation", handle.axes.at(-1) === "z" ? "vertical" : "horizontal");
      root.setAttribute("aria-valuemin", String(handle.least));
      root.setAttribute("aria-valuemax", String(handle.most));
      root.setAttribute("aria-valuenow", String(handle.value));
      root.setAttribute("aria-valuetext", handle.text);
      if (this.dragged === handle.name || document.activeElement === /** @type {unknown} */ (root)) this.say(handle);
      return { x, y };
    });
  }

  /** @param {Handle} handle */
  say(handle) {
    this.caption.textContent = `${handle.label}: ${handle.text}`;
  }

  /** @param {string} name */
  make(name) {
    const marks = [svg("path", { class: "arrow z", d: "M0 -17l5 6h-10zM0 17l5 -6h-10z" }), svg("path", { class: "arrow x", d: "M-17 0l6 5v-10zM17 0l-6 5v-10z" })];
    const root = svg("g", { role: "slider", tabindex: 0, "data-handle": name }, svg("path", { class: "leader", d: "M0 0" }), svg("circle", { class: "reach", r: 22 }), ...marks, svg("circle", { class: "knob", r: 7 }));
    root.addEventListener("pointerdown", (event) => this.grab(root, name, /** @type {PointerEvent} */ (event)));
    root.addEventListener("keydown", (event) => this.press(name, /** @type {KeyboardEvent} */ (event)));
    root.addEventListener("focus", () => {
      this.edits.begin();
      const known = this.handles.get(name);
      if (known) this.say(known.handle);
    });
    return root;
  }

  /** @param {SVGElement} root @param {string} name @param {PointerEvent} event */
  grab(root, name, event) {
    const known = this.handles.get(name);
    if (!known || event.button !== 0) return;
    event.preventDefault();
    root.focus({ preventScroll: true });
    root.setPointerCapture(event.pointerId);
    this.edits.begin();
    this.dragged = name;
    const [x, y] = this.at(known.handle.at);
    // The handle keeps its distance from the finger.
    const off = [event.clientX - x, event.clientY - y];
    const axes = known.handle.axes;
    const move = (/** @type {Event} */ moved) => {
      const { clientX, clientY } = /** @type {PointerEvent} */ (moved);
      const to = { x: (clientX - off[0]) / this.scale + this.view[0], z: this.view[3] - (clientY - off[1]) / this.scale };
      this.edits.drag(name, { to: Object.fromEntries(Object.entries(to).filter(([axis]) => axes.includes(axis))) });
    };
    const end = () => {
      root.removeEventListener("pointermove", move);
      this.dragged = "";
      if (this.edits.idle && this.drawn) this.show(this.drawn);
    };
    root.addEventListener("pointermove", move);
    root.addEventListener("lostpointercapture", end, { once: true });
  }

  /** @param {string} name @param {KeyboardEvent} event */
  press(name, event) {
    const known = this.handles.get(name);
    if (!known || event.altKey || event.ctrlKey || event.metaKey) return;
    const { axes } = known.handle;
    if ((event.key === "Delete" || event.key === "Insert") && name.startsWith("corner")) {
      event.preventDefault();
      this.corner(name, event.key === "Delete" ? "remove" : "insert");
      return;
    }
    const steps = /** @type {Record<string, [string, number]>} */ ({ ArrowUp: ["z", 1], ArrowDown: ["z", -1], ArrowRight: ["x", 1], ArrowLeft: ["x", -1], PageUp: ["z", 10], PageDown: ["z", -10] });
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    const axis = axes.includes(step[0]) ? step[0] : axes[0];
    this.edits.drag(name, { by: { [axis]: step[1] } });
  }
}
