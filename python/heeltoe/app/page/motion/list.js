/** The motions of the case, a mainshock and its aftershocks: which one is looked at, in what order, with what pauses. */
import { element } from "../dom.js";

/**
 * Where the motion stands that is looked at, once the list has changed.
 * @param {"up" | "down" | "remove" | "pause"} what
 * @param {number} place Of the motion that it is done to.
 * @param {number} chosen
 * @param {number} count
 */
export function placeAfter(what, place, chosen, count) {
  if (what === "pause") return chosen;
  if (what === "remove") return chosen > place ? chosen - 1 : Math.min(chosen, count - 2);
  const to = what === "up" ? place - 1 : place + 1;
  if (chosen === place) return to;
  return chosen === to ? place : chosen;
}

export class MotionList {
  /**
   * @param {(place: number) => void} choose
   * @param {(what: "up" | "down" | "remove" | "pause", place: number, pause?: string) => void} change
   */
  constructor(choose, change) {
    this.choose = choose;
    this.change = change;
    this.place = 0;
    this.count = 0;
    this.most = 1;
    /** What has the focus once the list has changed: what it does, and at which place. */
    this.next = "";
    this.list = element("ol", { class: "motions" });
    this.root = element("fieldset", { hidden: true }, element("legend", {}, "Motions of the case"), this.list, element("p", { class: "faint" }, "The motions shake the dam one after the other, without repair between them. The chosen motion is shown below."));
  }

  /** @param {{title: string, pause: string, wrong: string}[]} motions @param {number} place @param {number} most */
  show(motions, place, most) {
    this.place = place;
    this.count = motions.length;
    this.most = most;
    this.root.hidden = this.count < 2;
    const focus = this.next || (this.list.contains(document.activeElement) ? /** @type {HTMLElement} */ (document.activeElement).dataset.does || "" : "");
    this.next = "";
    this.list.replaceChildren(...motions.map((motion, at) => this.item(motion, at)));
    if (!focus) return;
    const button = /** @type {HTMLButtonElement | null} */ (this.list.querySelector(`[data-does="${focus}"]`));
    (button && !button.disabled ? button : /** @type {HTMLElement | null} */ (this.list.querySelector(`[data-does="choose ${this.place}"]`)))?.focus();
  }

  /** @param {{title: string, pause: string, wrong: string}} motion @param {number} at */
  item({ title, pause, wrong }, at) {
    const number = at + 1;
    const choose = element("button", { type: "button", class: "link", "data-does": `choose ${at}`, "aria-pressed": String(at === this.place), onclick: () => this.choose(at) }, title);
    const buttons = element(
      "span", { class: "buttons" },
      this.button("↑", `Move motion ${number} up`, "up", at, at === 0),
      this.button("↓", `Move motion ${number} down`, "down", at, at === this.count - 1),
      this.button("×", `Remove motion ${number}`, "remove", at, false),
    );
    return element("li", { class: at === this.place ? "chosen" : "" }, ...(at ? [this.pause(pause, at)] : []), element("div", { class: "in-line" }, choose, buttons), element("p", { class: "wrong" }, wrong));
  }

  /** @param {string} pause @param {number} at */
  pause(pause, at) {
    const input = /** @type {HTMLInputElement} */ (element("input", { type: "text", size: 6, value: pause, placeholder: "10 s", maxlength: 100, "data-does": `pause ${at}`, "aria-label": `Pause before motion ${at + 1}`, onchange: () => this.change("pause", at, input.value) }));
    return element("div", { class: "in-line pause faint" }, "after a pause of", input);
  }

  /** @param {string} label @param {string} title @param {"up" | "down" | "remove"} what @param {number} at @param {boolean} disabled */
  button(label, title, what, at, disabled) {
    const does = (/** @type {number} */ place) => `${what} ${place}`;
    const to = { up: at - 1, down: at + 1, remove: Math.min(at, this.count - 2) }[what];
    return element("button", { type: "button", class: "small", "aria-label": title, title, "data-does": does(at), disabled, onclick: () => {
      this.next = does(to);
      this.change(what, at);
    } }, label);
  }
}
