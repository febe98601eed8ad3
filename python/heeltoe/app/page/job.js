/** A long run of this tab on a button: how far it is, how it ends, and a way to cancel it. */
import { element } from "./dom.js";

export class LongRun {
  /**
   * @param {import("./talk.js").Talk} talk
   * @param {string} what The server's word for the run.
   * @param {{start: string, cancel: string, bar: string}} labels Of the two buttons, and of the bar for screen readers.
   * @param {() => void} ask Asks the server to begin.
   * @param {(job: any) => void} heard Called with whatever the server says of the run.
   */
  constructor(talk, what, labels, ask, heard) {
    this.number = 0;
    this.running = false;
    this.start = element("button", { type: "button", onclick: ask }, labels.start);
    this.cancel = element("button", { type: "button", hidden: true, onclick: () => talk.ask("cancel", { number: this.number }) }, labels.cancel);
    this.bar = element("progress", { hidden: true, "aria-label": labels.bar });
    this.status = element("p", { class: "faint", role: "status" });
    talk.on("job", (job) => {
      if (job.what !== what || job.number < this.number) return;
      this.number = job.number;
      this.running = job.state === "running";
      this.cancel.hidden = this.bar.hidden = !this.running;
      this.start.toggleAttribute("disabled", this.running);
      this.status.textContent = this.running ? `${job.status} (${Math.round(job.seconds)} s)` : job.status;
      heard(job);
    });
    talk.on("job refused", (refusal) => {
      if (refusal.what === what) this.status.textContent = refusal.text;
    });
  }
}
