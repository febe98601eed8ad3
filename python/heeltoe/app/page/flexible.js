/** The elastic dam on a button: it takes seconds to minutes, says how far it is, and can be cancelled. */
import { Card } from "./card.js";
import { element } from "./dom.js";

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
    this.number = 0;
    this.position = 0;
    this.asked = 0;
    this.card = new Card("flexible");
    this.card.hide(true);
    this.start = element("button", { type: "button", class: "main", onclick: () => this.run() }, "Run the elastic dam");
    this.cancel = element("button", { type: "button", hidden: true, onclick: () => talk.ask("cancel", { number: this.number }) }, "Cancel");
    this.said = element("p", { class: "faint status", role: "status" });
    this.bar = element("progress", { hidden: true, "aria-label": "The elastic dam is computed" });
    this.root = element("div", { class: "slider" }, this.start, this.cancel, this.bar, this.said);
    talk.on("job", (job) => this.take(job));
    talk.on("job refused", ({ what, text }) => {
      if (what !== "flexible") return;
      this.said.textContent = text;
    });
  }

  /** @param {string} why The elastic dam cannot be run; empty where it can. */
  begin(why) {
    this.card.hide(true);
    this.start.toggleAttribute("disabled", why !== "");
    this.said.textContent = why;
  }

  run() {
    this.asked = this.position;
    this.talk.ask("flexible", { values: this.values() });
  }

  /** The sliders have moved: the result, if there is one, is of where they were. */
  moved() {
    this.position += 1;
    if (!this.card.root.hidden) this.card.mark("of the sliders as they were");
  }

  /** Whether its result is of the sliders as they stand. */
  isNew() {
    return this.asked === this.position;
  }

  /** @param {any} job */
  take(job) {
    if (job.what !== "flexible" || job.number < this.number) return;
    this.number = job.number;
    const running = job.state === "running";
    this.cancel.hidden = this.bar.hidden = !running;
    this.start.toggleAttribute("disabled", running);
    this.said.textContent = running ? `${job.said} (${Math.round(job.seconds)} s)` : job.said;
    if (job.state !== "done") return;
    this.card.show(job.result);
    this.card.mark(this.isNew() ? "" : "of the sliders as they were");
    this.done(job.result);
  }
}
