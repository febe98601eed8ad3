/** Light or dark: as the system has it, or as chosen. */
import { byId } from "./dom.js";

const KEY = "heeltoe-theme";
const dark = matchMedia("(prefers-color-scheme: dark)");

/** @param {() => void} changed Is called after each change. */
export function followTheme(changed) {
  const choice = /** @type {HTMLSelectElement} */ (byId("theme"));
  choice.value = localStorage.getItem(KEY) || "";

  function apply() {
    document.documentElement.dataset.theme = choice.value || (dark.matches ? "dark" : "light");
    changed();
  }

  choice.addEventListener("change", () => {
    localStorage.setItem(KEY, choice.value);
    apply();
  });
  dark.addEventListener("change", apply);
  apply();
}
