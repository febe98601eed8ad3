/** The elastic dam: without evidence it runs by itself as soon as the sliders rest, and the next move ends that; with
 * evidence, which tells how far its numbers may be off, it runs on a button, says how far it is, and can be cancelled. */
import { Card } from "./card.js";
import { element } from "./dom.js";
import { LongRun } from "./job.js";

/** How long no slider has moved when the run begins: a hand that stops for a moment drags on. */
const RESTS_AFTER_MS = 300;
const EVIDENCE = "Evidence is the same run with another time step, another mesh and slightly different shaking: how far the numbers may be off.";

export class FlexibleRun {
  /**
   * @param {import("./talk.js").Talk} talk
   * @param {() => Record<string, number>} values Of the sliders that were moved.
   * @param {(answer: any) => void} done Called with the result.
   */
  constructor(talk, values, done) {
    this.talk = talk;
    this.values = values;
    this.done = done;
    this.position = 0;
    /** Position of the sliders of the run with evidence, and of what is shown. */
    this.asked = -1;
    this.shown = -1;
    /** Whether that has evidence. */
    this.sure = false;
    /** Number of the question of the run by itself; 0 where none is under way. */
    this.serial = 0;
    this.resting = 0;
    this.can = false;
    this.card = new Card("flexible");
    this.card.hide(true);
    const labels = { start: "Run the elastic dam with evidence", cancel: "Cancel", bar: "The elastic dam is computed" };
    const run = new LongRun(talk, "flexible", labels, () => this.run(), (job) => this.take(job));
    this.start = run.start;
    this.start.classList.add("main");
    this.status = run.status;
    this.status.classList.add("status");
    this.about = element("p", { class: "faint status" }, EVIDENCE);
    this.root = element("div", { class: "slider" }, run.start, run.cancel, run.bar, run.status, this.about);
    /** Runs a dam that takes too long to follow the sliders. */
    this.long = element("button", { type: "button", class: "main", onclick: () => this.runLong() }, "Run the elastic dam");
    talk.on("elastic", (answer) => this.hear(answer));
    // A failed run is answered, too: the card must not wait for ever.
    talk.on("answered", (answer) => {
      if (answer.serial === this.serial && answer.of !== "elastic") this.hear({ ...answer, waits: answer.text });
    });
  }

  runLong() {
    this.long.toggleAttribute("disabled", true);
    this.card.mark("computing");
    this.serial = this.talk.ask("elastic", { values: this.values(), long: true });
  }

  /** @param {string} why The elastic dam cannot be run; empty where it can. */
  begin(why) {
    this.can = why === "";
    this.shown = -1;
    this.card.wait();
    this.card.hide(!this.can);
    this.start.toggleAttribute("disabled", !this.can);
    this.start.hidden = this.about.hidden = !this.can;
    this.status.textContent = why;
  }

  run() {
    this.asked = this.position;
    this.talk.ask("flexible", { values: this.values() });
  }

  /** The sliders have moved: the result, if there is one, is of where they were. */
  moved() {
    this.position += 1;
    clearTimeout(this.resting);
    // No one waits for what runs.
    if (this.serial) this.talk.ask("elastic", { values: null });
    this.serial = 0;
    this.long.toggleAttribute("disabled", false);
    if (!this.can) return;
    if (this.shown >= 0) this.card.mark("updating");
    this.resting = setTimeout(() => {
      this.serial = this.talk.ask("elastic", { values: this.values() });
    }, RESTS_AFTER_MS);
  }

  /** What has run by itself. @param {any} answer */
  hear(answer) {
    if (answer.serial !== this.serial) return;
    this.serial = 0;
    this.long.toggleAttribute("disabled", false);
    // That with evidence was there sooner.
    if (this.sure && this.shown === this.position) return;
    this.status.textContent = answer.absent || "";
    if (answer.absent || answer.waits || answer.error) {
      this.shown = -1;
      // What cannot be has no card; what waits for its button says so where its number will be.
      if (answer.absent) this.card.hide(true);
      else if (answer.waits) this.card.offer(answer.waits, this.long);
      else this.card.show(answer);
      this.card.mark("");
      this.done(null);
      return;
    }
    this.show(answer, this.position, false);
  }

  /** @param {any} answer @param {number} position @param {boolean} sure */
  show(answer, position, sure) {
    this.shown = position;
    this.sure = sure;
    this.card.show(answer);
    this.card.mark(this.isNew() ? "" : "of the sliders as they were");
    this.done(answer);
  }

  /** Whether its result is of the sliders as they stand. */
  isNew() {
    return this.shown === this.position;
  }

  /** @param {any} job */
  take(job) {
    if (job.state !== "done") return;
    if (this.asked === this.position) this.show(job.result, this.asked, true);
    else this.status.textContent = "The sliders have moved since: the run with evidence was of where they were.";
  }
}
