/** The page "Answer": sliders, and what the models make of them. */
import { Card } from "./card.js";
import { Spread, StaticChecks } from "./checks.js";
import { CrestResponse } from "./crest.js";
import { DamInMotion } from "./dam.js";
import { byId, element } from "./dom.js";
import { FlexibleRun } from "./flexible.js";
import { cursor, draw, loadPlotly, onMoment } from "./plot/plot.js";
import { KINDS } from "./plot/lines.js";
import { showSliders } from "./sliders.js";

const LIVE = ["rigid", "decoupled"];
const SPOKEN_AFTER_MS = 700;
/** How long no answer has come when the plot is drawn with axes of its own: a hand that stops for a moment drags on. */
const RESTS_AFTER_MS = 700;

/** @param {import("./talk.js").Talk} talk */
export function answerPage(talk) {
  /** Of the sliders that were moved, by their paths. @type {Record<string, number>} */
  let values = {};
  /** Numbers of the questions that have moved them, by their paths, until the server has heard of it. @type {Map<string, number>} */
  const unheard = new Map();
  /** Number of the state that the sliders stand on, the session that it is of, and its units. */
  const base = { state: 0, session: "", units: "" };
  /** What each model has said last. @type {Record<string, any>} */
  let answers = {};
  /** When the event was that asked for an answer, by the number of the rigid one [ms]. @type {Map<number, number>} */
  const began = new Map();
  /** Numbers of the questions of one position of the sliders, by model. @type {Record<string, number>} */
  let newest = {};
  let position = 0;
  /** @type {Map<number, number>} */
  const positions = new Map();
  let drawing = false;
  let wanted = false;
  let moving = false;
  let resting = 0;
  let speaking = 0;
  const size = { width: 0, height: 0 };
  const cards = /** @type {Record<string, Card>} */ ({ rigid: new Card("rigid"), decoupled: new Card("decoupled") });
  const controls = element("div", { class: "controls" });
  const key = element("p", { class: "key" }, "Modes of motion:");
  const dotted = element("span", {});
  const plot = element("div", { class: "plot", role: "figure", "aria-label": "Ground acceleration, slip, rotation and modes of motion over time" });
  const flexible = new FlexibleRun(talk, () => values, (answer) => {
    if (answer) answers.flexible = answer;
    else delete answers.flexible;
    if (answer && flexible.isNew()) {
      dam.prefer("flexible");
      statics.follow();
    }
    redraw();
    speak();
  });
  const dam = new DamInMotion((time) => cursor(plot, time));
  const spread = new Spread(talk, () => values);
  const statics = new StaticChecks(talk, () => values);
  const crest = new CrestResponse(talk, () => values);
  const ready = loadPlotly();
  new ResizeObserver(([{ contentRect }]) => {
    size.width = Math.floor(contentRect.width);
    size.height = Math.floor(contentRect.height);
    redraw();
  }).observe(plot);

  /** @param {number} time @param {string[]} moved The sliders that have just been moved, by their paths. */
  function ask(time, moved) {
    position += 1;
    for (const model of LIVE) {
      newest[model] = talk.ask(model, { values, state: base.state });
      positions.set(newest[model], position);
    }
    for (const path of moved) unheard.set(path, newest.rigid);
    began.set(newest.rigid, time);
    if (answers.flexible) answers.flexible.stale = true;
    flexible.moved();
    spread.moved();
    statics.follow();
    crest.follow();
    // The blocks follow the hand.
    dam.prefer("");
  }

  /** @param {any} answer */
  function take(answer) {
    const at = positions.get(answer.serial) || 0;
    if (answer.of === "rigid") for (const [path, serial] of unheard) if (serial <= answer.serial) unheard.delete(path);
    for (const [serial, place] of positions) if (place < at - 1) positions.delete(serial);
    const had = Boolean(answers[answer.of] && answers[answer.of].curves);
    answers[answer.of] = { ...answer, position: at };
    // A model that cannot be is no answer.
    if (answer.absent) cards[answer.of].hide(true);
    else cards[answer.of].show(answer);
    // What is older than the newest answer of any model stands beside a number that it does not belong to.
    const latest = Math.max(...LIVE.map((model) => (answers[model] ? answers[model].position : 0)));
    for (const model of LIVE) {
      const old = answers[model] ? answers[model].position < latest && !answers[model].absent : true;
      cards[model].mark(old ? "updating" : "");
      if (answers[model]) answers[model].stale = old;
    }
    if (answer.of === "rigid") faults(answer);
    // What has no curves, before and now, leaves the plot as it is.
    if (answer.of === "rigid" || answer.curves || had) redraw(true);
    speak();
  }

  /** Say an error at its slider. @param {any} answer */
  function faults(answer) {
    for (const place of controls.querySelectorAll("[data-wrong]")) {
      const mine = answer.error && answer.error.field === place.getAttribute("data-wrong");
      const text = mine ? `${answer.error.problem}; ${answer.error.remedy}` : "";
      if (place.textContent !== text) place.textContent = text;
    }
  }

  function speak() {
    clearTimeout(speaking);
    speaking = setTimeout(() => {
      const better = flexible.isNew() && answers.flexible ? ["flexible"] : [];
      const verdicts = [...better, ...LIVE].map((model) => answers[model] && answers[model].verdict).filter(Boolean);
      byId("spoken").textContent = verdicts.join(" ");
    }, SPOKEN_AFTER_MS);
  }

  /** @param {boolean} [more] Whether a slider moves, and more is to come. */
  function redraw(more = false) {
    wanted = true;
    moving = more;
    if (!drawing) requestAnimationFrame(drawNow);
    drawing = true;
  }

  async function drawNow() {
    await ready;
    wanted = false;
    const shown = [...LIVE, "flexible"]
      .filter((model) => answers[model] && answers[model].curves)
      .map((model) => ({ model, stale: Boolean(answers[model].stale), answer: answers[model] }));
    plot.hidden = key.hidden = shown.length === 0;
    const further = shown.flatMap(({ answer }) => answer.curves.cracks.map((/** @type {any} */ { name }) => name));
    const text = further.length ? `Dotted: ${[...new Set(further)].join(", ")}` : "";
    if (dotted.textContent !== text) dotted.textContent = text;
    clearTimeout(resting);
    if (shown.length && size.width) {
      if (await draw(plot, shown, size, moving)) resting = setTimeout(redraw, RESTS_AFTER_MS);
      cursor(plot, dam.time);
      onMoment(plot, (time) => dam.goTo(time));
    }
    dam.show(shown);
    measure();
    drawing = false;
    if (wanted) redraw(moving);
  }

  /** Note how long it took from the event of a slider to the plot, by the browser's clock. */
  function measure() {
    const serial = answers.rigid && answers.rigid.serial;
    const start = began.get(serial);
    if (start === undefined) return;
    for (const number of began.keys()) if (number <= serial) began.delete(number);
    requestAnimationFrame(() => setTimeout(() => performance.measure("slider to plot", { start, end: performance.now() })));
  }

  /**
   * Return which sliders were moved since the server made a state, and put them where they are now.
   * @param {any} state
   */
  function movedSince(state) {
    const moved = [];
    for (const slider of state.sliders) {
      const { path, unit, off } = slider;
      const isOfIt = state.to !== "open example" && (unit === "" || state.units === base.units) && off === "";
      if (!isOfIt || (unheard.get(path) || 0) <= state.heard) continue;
      moved.push(path);
      if (path in values) slider.value = values[path];
    }
    return moved;
  }

  talk.on("hello", ({ session }) => {
    // Another session has another case.
    if (session !== base.session) unheard.clear();
    base.session = session;
  });
  talk.on("state", (state) => {
    answers = {};
    const moved = state.case ? movedSince(state) : [];
    const before = values;
    values = state.moved || {};
    for (const path of moved) {
      if (path in before) values[path] = before[path];
      else delete values[path];
    }
    unheard.clear();
    base.state = state.state;
    base.units = state.units;
    if (state.case) {
      showSliders(controls, state.sliders, state.drained, values, ask);
      controls.append(flexible.root);
      flexible.begin(state.inelastic);
      for (const model of LIVE) cards[model].hide(!state.models.includes(model));
      spread.begin(state.models);
      const elastic = state.models.includes("flexible");
      statics.begin(elastic);
      crest.begin(elastic);
      ask(performance.now(), moved);
    }
  });
  for (const model of LIVE) talk.on(model, take);

  return {
    name: "answer",
    label: "Answer",
    redraw() {
      redraw();
      crest.draw();
    },
    /** @param {HTMLElement} root */
    mount(root) {
      for (const kind of KINDS) {
        const patch = element("i", {});
        patch.style.background = `var(--${kind})`;
        key.append(element("span", {}, patch, kind));
      }
      key.append(dotted);
      // The better model leads.
      const all = [flexible.card, cards.decoupled, cards.rigid];
      const verdicts = element("div", { class: "cards" }, ...all.map((card) => card.root));
      const details = element("div", { class: "cards" }, ...all.map((card) => card.details));
      const over = element("div", {}, plot, key);
      const more = element("div", { class: "cards" }, spread.root, statics.root, crest.root);
      root.append(element("h2", { class: "unseen" }, "Answer"), element("div", { class: "answer" }, controls, element("div", {}, verdicts, element("div", { class: "over-time" }, over, dam.root), details, more)));
      return () => redraw();
    },
  };
}
