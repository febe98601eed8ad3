/** The sliders of the answer, each with a field for the exact number. */
import { element } from "./dom.js";

/** @typedef {{path: string, label: string, least: number, most: number, step: number, value: number, unit: string, off: string, si: number}} Slider */

const DRAINS = "uplift.drain_efficiency";

/**
 * @param {HTMLElement} root
 * @param {Slider[]} sliders
 * @param {boolean} drained Whether the case has drains.
 * @param {Record<string, number>} values Of the sliders that were moved, by their paths; changed in place.
 * @param {(began: number, paths: string[]) => void} moved Called with the time of the event and the slider that it moved.
 */
export function showSliders(root, sliders, drained, values, moved) {
  // Who is about to press a key goes on where they are.
  const active = document.activeElement;
  const focused = root.contains(active) ? active?.id ? `#${active.id}` : `[aria-label="${active?.getAttribute("aria-label")}"]` : "";
  root.replaceChildren();
  for (const slider of sliders) {
    const id = `slider-${slider.path.replace(".", "-")}`;
    const digits = Math.max(0, Math.round(-Math.log10(slider.step)));
    const range = /** @type {HTMLInputElement} */ (element("input", { type: "range", id, min: slider.least, max: slider.most, step: slider.step }));
    const exact = /** @type {HTMLInputElement} */ (element("input", { type: "number", "aria-label": `${slider.label}, exactly`, min: slider.least, max: slider.most, step: slider.step }));
    range.value = exact.value = slider.value.toFixed(digits);
    range.setAttribute("aria-valuetext", `${range.value} ${slider.unit}`);
    const label = element("label", { for: id }, slider.label.replace(/(\d) (\S+)$/, "$1\u00a0$2"));
    const box = element("div", { class: "slider" }, label, element("span", { class: "exact" }, exact, slider.unit), range);
    const wrong = element("p", { class: "wrong", "data-wrong": slider.path, role: "status" });

    /** @param {HTMLInputElement} from @param {HTMLInputElement} to @param {Event} event */
    const take = (from, to, event) => {
      if (from.value === "" || !from.checkValidity()) return;
      to.value = from.value;
      values[slider.path] = Number(from.value);
      range.setAttribute("aria-valuetext", `${from.value} ${slider.unit}`);
      moved(event.timeStamp, [slider.path]);
    };
    range.addEventListener("input", (event) => take(range, exact, event));
    exact.addEventListener("input", (event) => take(exact, range, event));
    range.disabled = exact.disabled = slider.off !== "";
    if (slider.off) box.append(element("p", { class: "beside" }, slider.off));
    else if (slider.path === DRAINS && !drained) box.append(drains(range, exact, values, moved));
    box.append(wrong);
    root.append(box);
  }
  if (focused) /** @type {HTMLElement | null} */ (root.querySelector(focused))?.focus();
}

/**
 * Drains that the case does not have: they are put in by a tick.
 * @param {HTMLInputElement} range
 * @param {HTMLInputElement} exact
 * @param {Record<string, number>} values
 * @param {(began: number, paths: string[]) => void} moved
 */
function drains(range, exact, values, moved) {
  const tick = /** @type {HTMLInputElement} */ (element("input", { type: "checkbox", id: "drains" }));
  tick.checked = DRAINS in values;
  range.disabled = exact.disabled = !tick.checked;
  tick.addEventListener("change", (event) => {
    range.disabled = exact.disabled = !tick.checked;
    if (tick.checked) values[DRAINS] = Number(range.value);
    else delete values[DRAINS];
    moved(event.timeStamp, [DRAINS]);
  });
  return element("label", { class: "beside" }, tick, " drains, at a tenth of the width from the heel");
}
