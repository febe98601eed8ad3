/** The start of the page: connection, tabs, and what stands above all of them. */
import { answerPage } from "./answer.js";
import { casePage } from "./case/page.js";
import { exportPage } from "./export/page.js";
import { byId, element } from "./dom.js";
import { motionPage } from "./motion/page.js";
import { studiesPage } from "./studies/page.js";
import { showTabs } from "./tabs.js";
import { Talk } from "./talk.js";
import { followTheme } from "./theme.js";

const talk = new Talk();
const answer = answerPage(talk);
const motion = motionPage(talk);
const pages = [
  casePage(talk),
  motion,
  answer,
  studiesPage(talk),
  exportPage(talk),
];

/** @param {string} text Nothing hides it. */
function notice(text) {
  const place = byId("notice");
  place.textContent = text;
  place.hidden = text === "";
}

const example = /** @type {HTMLSelectElement} */ (byId("example"));
const units = /** @type {HTMLSelectElement} */ (byId("units"));
example.addEventListener("change", () => talk.ask("open example", { name: example.value }));
units.addEventListener("change", () => talk.ask("units", { units: units.value }));
talk.on("state", (state) => {
  byId("case-title").textContent = state.case ? state.case.title || "untitled case" : "";
  example.replaceChildren(...state.examples.map((/** @type {string} */ name) => element("option", { value: name }, name)));
  if (state.case && !state.case.example) example.prepend(element("option", { value: "" }, "changed"));
  example.value = state.case ? state.case.example : "";
  units.value = state.units;
});
talk.on("connected", () => notice(""));
talk.on("lost", ({ reason }) => notice(reason || "The app has stopped or cannot be reached. The page continues when the app is back."));
talk.on("bad request", ({ text }) => notice(`The app does not know a request of this page: ${text}. Reload the page.`));
/** Number of the question that was refused last; its notice goes with the first later one that is not. */
let refused = Infinity;
talk.on("refused", ({ text, serial }) => {
  refused = serial;
  notice(text);
});
talk.on("answered", ({ of, to, serial }) => {
  // The page asks for the case itself, to show it as it was before what was refused.
  if (serial <= refused || to === "case" || of === "refused" || of === "bad request") return;
  refused = Infinity;
  notice("");
});

followTheme(() => {
  answer.redraw();
  motion.redraw();
});
showTabs(pages, "answer");
talk.open();
