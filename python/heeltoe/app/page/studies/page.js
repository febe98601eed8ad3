/** The page "Studies": a form, the studies of this tab with how far they are, and what one of them says. */
import { headlineOf, NAMES } from "../card.js";
import { element } from "../dom.js";
import { save } from "../save.js";
import { documentOf } from "./document.js";
import { StudyForm } from "./form.js";

const TAKE = /** @type {[string, string][]} */ ([["study", "All of it (zip)"], ["csv", "Runs (CSV)"], ["pdf", "Report (PDF)"], ["html", "Report (HTML)"], ["file", "study.toml"]]);
const PATIENCE_MS = 250;

/** @param {import("../talk.js").Talk} talk */
export function studiesPage(talk) {
  /** @type {Map<number, {number: number, title: string, job: any, root: HTMLElement}>} */
  const studies = new Map();
  let looking = 0;
  let wanted = true;
  let visible = false;
  const outlook = element("p", { class: "outlook", role: "status" });
  const start = element("button", { type: "button", class: "main", disabled: true, onclick: () => run({ study: form.read() }) }, "Run the study");
  const refused = element("p", { class: "wrong", role: "alert" });
  const list = element("ul", { class: "studies" });
  const none = element("p", { class: "faint" }, "None yet. Studies stay while the app runs, also when the page is closed.");
  const answer = element("div", { class: "study-answers", tabindex: "-1" });
  const form = new StudyForm(
    () => {
      clearTimeout(looking);
      looking = setTimeout(look, PATIENCE_MS);
    },
    async (file) => {
      const { name } = await talk.upload(file);
      const message = await talk.answer("record", { file: name, called: file.name });
      if (message.error) throw new Error(message.error.text);
      return message.called;
    },
    ask,
  );

  function look() {
    outlook.textContent = "counting the runs";
    talk.ask("study look", { study: form.read() });
  }

  /** Show a field that is wrong. @param {HTMLElement} place */
  function go(place) {
    place.scrollIntoView({ block: "center" });
    place.focus({ preventScroll: true });
  }

  /** @param {object} what */
  function run(what) {
    refused.textContent = "";
    talk.ask("study run", what);
  }

  function ask() {
    wanted = false;
    talk.ask("study form");
  }

  /** @param {any[]} rows */
  function show(rows) {
    const kept = new Set(rows.map((study) => study.number));
    for (const [number, study] of studies) {
      if (kept.has(number)) continue;
      study.root.remove();
      studies.delete(number);
      if (answer.dataset.study === String(number)) answer.replaceChildren();
    }
    for (const study of rows) {
      const known = studies.get(study.number);
      if (known) known.job = study.job;
      else {
        const root = element("li", { "data-study": study.number });
        studies.set(study.number, { ...study, root });
        list.prepend(root);
      }
      line(study.number);
    }
    none.hidden = studies.size > 0;
  }

  /** Draw a study of the list. @param {number} number */
  function line(number) {
    const study = studies.get(number);
    if (!study) return;
    const { job, root, title } = study;
    const running = job.state === "running";
    const seconds = Math.round(job.seconds);
    const done = job.state === "done";
    const state = running ? `${job.status} (${seconds} s)` : done ? `done in ${seconds} s` : job.status;
    if (root.dataset.state === job.state && running) {
      /** @type {HTMLElement} */ (root.querySelector(".state")).textContent = state;
      progress(/** @type {HTMLProgressElement} */ (root.querySelector("progress")), job);
      return;
    }
    root.dataset.state = job.state;
    const act = (/** @type {string} */ label, /** @type {() => void} */ does) => element("button", { type: "button", "aria-label": `${label}: ${title}`, onclick: does }, label);
    const actions = running
      ? [act("Cancel", () => talk.ask("cancel", { number: study.job.number }))]
      : [act("Show", () => answers(number)), ...(done ? [] : [act("Go on", () => run({ number }))]), act("Remove", () => talk.ask("study remove", { number }))];
    const bar = /** @type {HTMLProgressElement} */ (element("progress", { "aria-label": `${title} runs`, hidden: !running }));
    progress(bar, job);
    root.replaceChildren(element("strong", {}, title), element("span", { class: "state", role: "status" }, state), bar, element("div", { class: "actions" }, ...actions));
  }

  /** @param {HTMLProgressElement} bar @param {any} job */
  function progress(bar, job) {
    if (job.share === null) bar.removeAttribute("value");
    else bar.value = job.share;
  }

  /** @param {number} number */
  function answers(number) {
    answer.dataset.study = String(number);
    answer.replaceChildren(element("p", { role: "status" }, "drawing what the study says"));
    talk.ask("study answers", { number });
  }

  talk.on("study answers", (message) => {
    if (answer.dataset.study !== String(message.number)) return;
    if (message.error) {
      answer.replaceChildren(element("p", { class: "wrong", role: "alert" }, message.error.text));
      return;
    }
    const take = TAKE.map(([what, label]) => element("button", { type: "button", onclick: () => fetchOf(message.number, what) }, label));
    answer.replaceChildren(element("div", { class: "actions", role: "group", "aria-label": "Export" }, ...take), ...message.headlines.map((/** @type {any} */ row) => element("section", { class: "card", "aria-label": `${NAMES[row.model]}: suite` }, element("h3", {}, NAMES[row.model]), headlineOf(row))), documentOf(message));
  });

  /** @param {number} number @param {string} what */
  async function fetchOf(number, what) {
    refused.textContent = "";
    const message = await talk.answer("study download", { number, what });
    if (message.of === "download") save(message);
  }

  talk.on("study form", (message) => {
    form.show(message.choices);
    show(message.studies);
  });
  talk.on("studies", ({ studies }) => show(studies));
  talk.on("study refused", ({ text }) => {
    refused.textContent = text;
  });
  talk.on("study look", (message) => {
    const wrong = form.fault(message.error || null);
    start.toggleAttribute("disabled", Boolean(message.error));
    if (wrong) outlook.replaceChildren(element("button", { type: "button", class: "link", onclick: () => go(wrong) }, "Something above cannot be used"), `: ${message.error.problem}`);
    else outlook.textContent = message.outlook || message.error.text;
    outlook.classList.toggle("wrong", Boolean(message.error) && !wrong);
  });
  talk.on("job", (job) => {
    const number = Number((/^study (\d+)$/.exec(job.what) || [])[1]);
    const study = studies.get(number);
    if (!study || job.number < study.job.number) return;
    const before = study.job.state;
    study.job = job;
    line(number);
    if (before === "running" && job.state === "done" && (!answer.hasChildNodes() || answer.dataset.study === String(number))) answers(number);
  });
  talk.on("state", () => {
    wanted = true;
    if (visible) ask();
    if (answer.hasChildNodes() && answer.dataset.study) answers(Number(answer.dataset.study));
  });

  return {
    name: "studies",
    label: "Studies",
    /** @param {HTMLElement} root */
    mount(root) {
      const made = element("section", { "aria-label": "Studies of this tab" }, element("h2", {}, "Studies"), none, list, answer);
      root.append(element("div", { class: "two" }, element("div", {}, element("h2", {}, "A new study of this case"), form.root, element("div", { class: "launch" }, outlook, refused, start)), made));
      new IntersectionObserver(([entry]) => {
        visible = entry.isIntersecting;
        if (visible && wanted) ask();
      }).observe(root);
    },
  };
}
