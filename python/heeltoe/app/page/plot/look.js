/** How plots look that are drawn as a whole: colours, letters and axes of the page. */
import { colour } from "../dom.js";

export function look() {
  return { paper_bgcolor: colour("page"), plot_bgcolor: colour("page"), font: { color: colour("text"), family: "system-ui, sans-serif", size: 12 } };
}

export function axis(/** @type {object} */ more) {
  return { gridcolor: colour("rule"), zerolinecolor: colour("line"), linecolor: colour("line"), nticks: 6, ...more };
}
