/** The page "Motion": records that are sent, what is in them, and the motion that shakes the dam. */
import { element } from "../dom.js";
import { MotionList, placeAfter } from "./list.js";
import { drawMotions, shownMotion } from "./plot.js";
import { Way } from "./way.js";

const WAIT_MS = 200;

/** @param {import("../talk.js").Talk} talk */
export function motionPage(talk) {
  /** What the page was filled with last. */
  let filled = "";
  let waiting = 0;
  /** @type {any} */
  let seen = null;
  /** Horizontal records that were sent together are one for each way. @type {number} */
  let sending = 0;
  const ways = [new Way("horizontal", changed, whole), new Way("vertical", changed, changed)];
  const files = /** @type {HTMLInputElement} */ (element("input", { type: "file", multiple: true, id: "record-files", onchange: () => send([...(files.files || [])]) }));
  const status = element("ul", { class: "sent", role: "status" });
  const drop = element("div", { class: "drop" }, element("label", { for: "record-files" }, "Drop records here, or choose files"), files, element("p", { class: "faint" }, "PEER AT2, COSMOS and CSMIP V2, USGS SMC, K-NET, columns of numbers; one for each direction, up to 20 MB."), status);
  const start = input("motion-start", "from");
  const end = input("motion-end", "to");
  const wrong = [
    element("p", { class: "wrong", "data-of": "motion.processing", role: "status" }),
    element("p", { class: "wrong", "data-of": "motion.duration", role: "status" }),
    element("p", { class: "wrong", "data-of": "", role: "status" }),
  ];
  const cut = element("fieldset", {}, element("legend", {}, "Part of it"), element("div", { class: "in-line" }, element("label", { for: "motion-start" }, "from"), start, element("label", { for: "motion-end" }, "to"), end), element("p", { class: "faint" }, "Seconds; empty for the whole record."), wrong[0], wrong[1]);
  const list = new MotionList(
    (place) => {
      list.place = place;
      talk.ask("motion", { place });
    },
    (what, place, pause = "") => {
      list.place = placeAfter(what, place, list.place, list.count);
      talk.ask("change motions", { what, place, pause });
    },
  );
  const take = (/** @type {number} */ to) => talk.ask("use motion", { form: form(), place: list.place, to });
  const use = element("button", { type: "button", class: "main", onclick: () => take(list.place) }, "Use in this case");
  const more = element("button", { type: "button", onclick: () => take(list.count) }, "Add as an aftershock");
  const used = element("p", { class: "faint", role: "status", id: "motion-used" });
  const shown = element("div", { class: "cards" });
  const curves = element("div", { class: "plot", role: "figure", "aria-label": "Acceleration, velocity, displacement and Husid plot of the motion over time" });
  const spectrum = element("div", { class: "plot spectrum", role: "figure", "aria-label": "Response spectrum of the motion, 5 % damping" });

  /** @param {string} id @param {string} label */
  function input(id, label) {
    return /** @type {HTMLInputElement} */ (element("input", { type: "text", id, "aria-label": `Part of the motion, ${label}`, size: 5, oninput: changed }));
  }

  function form() {
    return { horizontal: ways[0].form(), vertical: ways[1].form(), start: start.value, end: end.value };
  }

  function changed() {
    used.textContent = "";
    clearTimeout(waiting);
    waiting = setTimeout(look, WAIT_MS);
  }

  /** Another motion is taken as a whole: the part was one of that before. */
  function whole() {
    start.value = end.value = "";
    changed();
  }

  function look() {
    if (ways[0].chosen()) talk.ask("motion look", { form: form(), place: list.place });
    else show({ motions: [], usable: false });
  }

  /** @param {any} answer */
  function show(answer) {
    seen = answer;
    use.toggleAttribute("disabled", !answer.usable);
    more.toggleAttribute("disabled", !answer.usable || list.count === 0 || list.count >= list.most);
    tell(answer.error);
    shown.replaceChildren(...answer.motions.map(shownMotion));
    redraw();
  }

  /** Say an error at its field: the one whose name is the longest part of the error's. @param {any} error */
  function tell(error) {
    if (error) for (const way of ways) way.ask(error.field || "");
    const places = [...wrong, ...ways.flatMap((way) => way.wrong)];
    const fits = (/** @type {HTMLElement} */ place) => error && (error.field || "").startsWith(place.dataset.of || "");
    const best = places.filter(fits).sort((one, other) => (other.dataset.of || "").length - (one.dataset.of || "").length)[0];
    for (const place of places) {
      const text = place !== best ? "" : place.dataset.of ? [error.problem, error.remedy].filter(Boolean).join("; ") : error.text;
      if (place.textContent !== text) place.textContent = text;
    }
  }

  function redraw() {
    const drawable = Boolean(seen && seen.motions.length);
    curves.hidden = spectrum.hidden = !drawable;
    if (drawable && curves.clientWidth) drawMotions(curves, spectrum, seen.motions);
  }

  /** @param {File[]} chosen */
  async function send(chosen) {
    status.replaceChildren();
    for (const file of chosen) {
      const line = element("li", {}, `${file.name}: being read`);
      status.append(line);
      try {
        if (!file.size) throw new Error("it is empty");
        const { name } = await talk.upload(file);
        const answer = await new Promise((done) => heard.set(talk.ask("record", { file: name, called: file.name }), done));
        taken(answer, line);
      } catch (error) {
        line.className = "bad";
        line.textContent = `${file.name}: ${/** @type {Error} */ (error).message}`;
      }
    }
    sending = 0;
    files.value = "";
  }

  /** @type {Map<number, (answer: any) => void>} */
  const heard = new Map();

  /** @param {any} answer @param {HTMLElement} line */
  function taken(answer, line) {
    if (answer.error) {
      line.className = "bad";
      line.textContent = answer.error.text;
      return;
    }
    const [first] = answer.channels;
    const count = answer.channels.length;
    line.textContent = `${answer.called}: ${first.format}${count > 1 ? `, ${count} channels` : `, PGA ${first.pga}, ${first.duration}`}`;
    for (const way of ways) way.offer({ records: answer.records });
    for (const channel of answer.channels.slice(0, 3)) {
      const way = channel.vertical ? ways[1] : ways[0];
      if (way === ways[0] && sending++ > 0) continue;
      // Another earthquake's vertical motion does not go with it.
      if (way === ways[0] && !ways[1].isSent()) ways[1].choose("");
      way.choose(`record:${answer.called}`, channel.channel);
      if (way === ways[0]) whole();
    }
    changed();
  }

  talk.on("record", (answer) => {
    const done = heard.get(answer.serial);
    heard.delete(answer.serial);
    if (done) done(answer);
  });
  talk.on("state", () => talk.ask("motion", { place: list.place }));
  talk.on("motion", ({ form, motions, place, most, records, catalogue }) => {
    list.show(motions, place, most);
    use.textContent = list.count > 1 ? `Use as motion ${place + 1}` : "Use in this case";
    for (const way of ways) way.offer({ records, catalogue });
    if (JSON.stringify([form, place]) !== filled) {
      filled = JSON.stringify([form, place]);
      for (const way of ways) way.fill(form[way.name]);
      [start.value, end.value] = [form.start, form.end];
    }
    look();
  });
  talk.on("motion look", show);
  talk.on("motion used", ({ error, place }) => {
    tell(error);
    if (place !== undefined && place !== list.place && !error) {
      list.place = place;
      talk.ask("motion", { place });
    }
    used.textContent = error || place === undefined ? "" : "The dam of this case is now shaken by this motion.";
  });

  return {
    name: "motion",
    label: "Motion",
    redraw,
    /** @param {HTMLElement} root */
    mount(root) {
      root.addEventListener("dragover", (event) => {
        event.preventDefault();
        drop.classList.add("over");
      });
      root.addEventListener("dragleave", () => drop.classList.remove("over"));
      root.addEventListener("drop", (event) => {
        event.preventDefault();
        drop.classList.remove("over");
        send([...(event.dataTransfer ? event.dataTransfer.files : [])]);
      });
      const controls = element("div", { class: "motion-form" }, drop, list.root, ...ways.map((way) => way.root), cut, wrong[2], use, more, used);
      root.append(element("h2", { class: "unseen" }, "Motion"), element("div", { class: "answer" }, controls, element("div", {}, shown, curves, spectrum)));
      return redraw;
    },
  };
}
