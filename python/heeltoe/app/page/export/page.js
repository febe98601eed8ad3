/** The page "Export": files of the case and of its results, and the commands that make them elsewhere. */
import { element } from "../dom.js";
import { LongRun } from "../job.js";
import { save } from "../save.js";
import { check, select } from "../studies/fields.js";

const MODELS = /** @type {Record<string, string>} */ ({ auto: "what fits the case", rigid: "rigid block", decoupled: "rigid block on an elastic part", flexible: "elastic dam" });
const WHAT = /** @type {Record<string, string>} */ ({
  "report.pdf": "report, to be printed",
  "report.html": "report as a page, all in one file",
  "result.json": "all numbers, in SI units",
  histories: "what moves over time",
  events: "slips, stops, impacts",
  crack: "what each place of the crack does over time",
  "animation.html": "the dam in motion, a page that plays without a network",
});

/** @param {string} name */
function meaning(name) {
  const own = name.split("/").pop() || "";
  const beside = name.includes("/") ? `${name.split("/")[0]} model beside it: ` : "";
  return beside + (WHAT[own] || WHAT[own.split(".")[0]] || (/\.(png|svg)$/.test(own) ? "figure" : ""));
}

/** @param {number} bytes */
const size = (bytes) => (bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

/** Lines with a button that copies them. @param {string} label @param {HTMLElement} lines */
function copied(label, lines) {
  const status = element("span", { class: "faint", role: "status" });
  const copy = element("button", { type: "button", "aria-label": `Copy: ${label}`, onclick: async () => {
    const text = lines.textContent || "";
    const range = document.createRange();
    range.selectNodeContents(lines);
    getSelection()?.removeAllRanges();
    getSelection()?.addRange(range);
    try {
      await navigator.clipboard.writeText(text);
      status.textContent = "copied";
    } catch {
      // A page that came over plain HTTP from another machine may not: then it is marked.
      status.textContent = document.execCommand("copy") ? "copied" : "marked: copy it with Ctrl-C";
    }
  } }, "Copy");
  return element("div", { class: "lines" }, element("h3", {}, label), lines, element("div", { class: "actions" }, copy, status));
}

/** @param {import("../talk.js").Talk} talk */
export function exportPage(talk) {
  let visible = false;
  const model = select({ id: "export-model", label: "Model", options: Object.entries(MODELS) });
  const report = check("report, PDF and HTML");
  const csv = check("histories as CSV, not Parquet");
  const animation = check("animation");
  report.input.checked = true;
  const labels = { start: "Make the files", cancel: "Cancel", bar: "The files are made" };
  const run = new LongRun(talk, "export", labels, () => talk.ask("make", wanted()), take);
  run.start.classList.add("main");
  const old = element("p", { class: "caveat", role: "status", hidden: true }, "The case has changed since these files were made: make them again.");
  const files = element("div", { class: "files" });
  const command = element("pre", { tabindex: "0" });
  const program = element("pre", { tabindex: "0" });

  function wanted() {
    return { model: model.input.value, report: report.input.checked, csv: csv.input.checked, animation: animation.input.checked };
  }

  function ask() {
    if (visible) talk.ask("export", wanted());
  }

  /** @param {string} what @param {object} fields */
  async function fetchOf(what, fields) {
    const message = await talk.answer(what, fields);
    if (message.of === "download") save(message);
  }

  /** @param {any} result */
  function show(result) {
    const row = (/** @type {any} */ file) => element("tr", {}, element("th", { scope: "row" }, file.name), element("td", {}, meaning(file.name)), element("td", { class: "right" }, size(file.bytes)), element("td", {}, element("button", { type: "button", "aria-label": `Download ${file.name}`, onclick: () => fetchOf("fetch", { name: file.name }) }, "Download")));
    const table = element("table", { class: "answers", "aria-label": "Files" }, element("tbody", {}, ...result.files.map(row)));
    const all = element("button", { type: "button", class: "main", onclick: () => fetchOf("fetch", { name: "" }) }, "Download all (zip)");
    files.replaceChildren(element("p", { class: "verdict" }, result.verdict), all, element("div", { class: "wide" }, table));
  }

  /** @param {any} job */
  function take(job) {
    run.status.classList.toggle("wrong", !["running", "done", "cancelled"].includes(job.state));
    if (job.state === "done") show(job.result);
    else files.replaceChildren();
    if (!run.running) ask();
  }

  talk.on("export", (message) => {
    command.textContent = message.command;
    program.textContent = message.program;
    for (const option of model.input.options) option.disabled = message.cannot.includes(option.value);
    run.start.toggleAttribute("disabled", !message.ready || run.running);
    if (!message.ready) run.status.textContent = "The case has no motion: choose one in the tab Motion.";
    old.hidden = message.same || !files.hasChildNodes();
  });
  for (const of of ["state", "rigid"]) talk.on(of, ask);

  return {
    name: "export",
    label: "Export",
    /** @param {HTMLElement} root */
    mount(root) {
      const options = element("div", { class: "export-options" }, model.root, element("div", { class: "ticks" }, report.root, csv.root, animation.root), element("div", { class: "actions" }, run.start, run.cancel), run.bar, run.status);
      options.addEventListener("input", ask);
      const file = element("button", { type: "button", onclick: () => fetchOf("case file", {}) }, "Download the case file");
      root.append(
        element(
          "div",
          { class: "two" },
          element("div", { class: "export" }, element("h2", {}, "Files"), options, element("h3", {}, "The case"), element("p", { class: "faint" }, "With the present values of the sliders; a record of yours is packed beside it in a zip file."), file),
          element("div", { class: "export" }, old, files, element("h2", {}, "The same without the app"), element("p", { class: "faint" }, "In a directory with the case file:"), copied("Command line", command), copied("Python", program)),
        ),
      );
      new IntersectionObserver(([entry]) => {
        visible = entry.isIntersecting;
        ask();
      }).observe(root);
    },
  };
}
