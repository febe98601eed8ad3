/** The page "Case": a form of all that a case can say, and a drawing that can be dragged; both are the same case. */
import { CaseDrawing } from "./drawing.js";
import { Edits } from "./edits.js";
import { CaseForm } from "./form.js";
import { element } from "../dom.js";
import { save } from "../save.js";

/** @param {import("../talk.js").Talk} talk */
export function casePage(talk) {
  let units = "";
  let stale = true;
  let visible = false;
  const edits = new Edits(talk, show, (idle) => drawing.root.setAttribute("aria-busy", String(!idle)));
  const form = new CaseForm(edits);
  const drawing = new CaseDrawing(edits, (name, what) => {
    const place = Number(name.split(" ")[1]) - 1;
    edits.begin();
    form.corners?.[what](place);
  });

  /** @param {string} text @param {() => void} click */
  const button = (text, click) => /** @type {HTMLButtonElement} */ (element("button", { type: "button", onclick: () => { edits.begin(); click(); } }, text));
  const undo = button("Undo", () => edits.add("step case", {}));
  const redo = button("Redo", () => edits.add("step case", { forward: true }));
  const corners = button("Edit the section by its corners", () => edits.add("corners", {}));
  const file = /** @type {HTMLInputElement} */ (element("input", { type: "file", id: "case-file", multiple: true, class: "unseen", onchange: open }));
  const fileLabel = element("label", { for: "case-file", class: "button" }, "Open a case file");
  const problem = element("p", { class: "wrong", role: "alert" });
  const problems = element("div", { class: "problems", role: "status" });
  const verdict = element("p", { class: "verdict-line", "aria-live": "off" });

  async function open() {
    const files = [...(file.files || [])];
    file.value = "";
    const main = files.find(({ name }) => /\.(toml|json)$/i.test(name)) || files[0];
    if (!main) return;
    problem.textContent = "";
    try {
      const sent = await Promise.all(files.map((file) => talk.upload(file).catch((error) => Promise.reject(new Error(`${file.name}: ${error.message}`)))));
      const beside = Object.fromEntries(files.map((file, place) => [file.name, sent[place].name]).filter(([name]) => name !== main.name));
      edits.begin();
      edits.add("open case", { file: sent[files.indexOf(main)].name, called: main.name, beside });
    } catch (error) {
      problem.textContent = error instanceof Error ? error.message : String(error);
    }
  }

  /** @param {any} state @param {boolean} idle */
  function show(state, idle) {
    stale = false;
    problem.textContent = state.file || "";
    form.show(state, idle);
    if (state.drawing) drawing.show(state.drawing);
    drawing.root.classList.toggle("old", state.errors.length > 0);
    undo.disabled = !state.undo;
    redo.disabled = !state.redo;
    corners.hidden = state.corners;
    list(state.errors);
  }

  /** @param {any[]} errors */
  function list(errors) {
    const count = errors.length;
    const items = errors.slice(0, 20).map(({ field, problem, code }) => {
      const go = element("button", { type: "button", class: "link", onclick: () => form.go(field) }, field);
      const away = code === "unknown-field" && !field.includes("[") ? [" ", button("Remove it", () => edits.edit({ [field]: null }))] : [];
      return element("li", {}, go, `: ${problem}`, ...away);
    });
    const head = `${count === 1 ? "One thing is" : `${count} things are`} wrong. The last sound case stays in force: the drawing and all other pages show that.`;
    const text = errors.map(({ field, problem }) => field + problem).join();
    // What has not changed keeps its place under the finger.
    if (problems.dataset.of === text) return;
    problems.dataset.of = text;
    problems.replaceChildren(...(count ? [element("p", {}, head), element("ul", {}, ...items)] : []));
  }

  talk.on("case fields", ({ blocks }) => form.build(blocks));
  talk.on("case file", ({ text, name }) => {
    const address = URL.createObjectURL(new Blob([text], { type: "application/toml" }));
    save({ address, name });
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
  });
  talk.on("state", (state) => {
    if (units !== state.units) talk.ask("case fields");
    units = state.units;
    stale = true;
    refresh();
  });
  talk.on("rigid", (answer) => {
    verdict.textContent = answer.absent || (answer.error && answer.error.text) || answer.verdict || "";
    // A slider may have moved the case after the page was shown: the server hears of the last place of a hand later.
    stale = true;
    refresh();
  });

  /** Ask for the case where it may have changed elsewhere, and is seen. */
  function refresh() {
    if (visible && stale && edits.idle) edits.add("case", {});
  }

  return {
    name: "case",
    label: "Case",
    /** @param {HTMLElement} root */
    mount(root) {
      const keep = button("Save the case file", () => talk.ask("save case"));
      const tools = element("div", { class: "tools" }, file, fileLabel, keep, undo, redo, corners);
      const seen = element("div", { class: "seen" }, tools, problem, problems, drawing.root, element("p", { class: "faint" }, "The rigid block:"), verdict);
      root.append(element("h2", { class: "unseen" }, "Case"), element("div", { class: "case" }, seen, form.root));
      new IntersectionObserver((entries) => { visible = entries.some((entry) => entry.isIntersecting); refresh(); }).observe(root);
      return () => {
        visible = true;
        stale = true;
        refresh();
      };
    },
  };
}
