/** Edits of the case on their way to the server, one at a time: what is newer takes the place of what still waits. */

export class Edits {
  /**
   * @param {import("../talk.js").Talk} talk
   * @param {(state: any, idle: boolean) => void} heard Called with what the server makes of them, and whether none waits.
   * @param {(idle: boolean) => void} waits Called when an edit goes out and when all are answered.
   */
  constructor(talk, heard, waits) {
    this.talk = talk;
    this.waits = waits;
    /** @type {{what: string, fields: any}[]} */
    this.waiting = [];
    /** @type {{what: string, fields: any} | null} */
    this.going = null;
    this.serial = 0;
    this.step = Date.now();
    this.here = false;
    talk.on("case", (state) => {
      const mine = state.serial === this.serial;
      if (mine) this.going = null;
      heard(state, !this.going && this.waiting.length === 0);
      this.send();
    });
    for (const kind of ["refused", "bad request"]) {
      talk.on(kind, ({ serial }) => {
        if (serial !== this.serial) return;
        this.going = null;
        this.add("case", {});
      });
    }
    talk.on("lost", () => {
      this.here = false;
      if (this.going) this.waiting.unshift(this.going);
      this.going = null;
    });
    talk.on("state", () => {
      this.here = true;
      this.send();
    });
  }

  /** Whether the server has heard all. */
  get idle() {
    return !this.going && this.waiting.length === 0;
  }

  /** What follows is another step than what was before: each is taken back by itself. */
  begin() {
    this.step += 1;
  }

  /** @param {Record<string, unknown>} changes By the paths of the fields, as they are typed. */
  edit(changes) {
    const last = this.waiting.at(-1);
    if (last && last.what === "edit case" && last.fields.step === this.step) Object.assign(last.fields.changes, changes);
    else this.add("edit case", { changes, step: this.step });
    this.send();
  }

  /**
   * @param {string} handle
   * @param {{to?: Record<string, number>, by?: Record<string, number>}} move To a place [m], or by so many steps.
   */
  drag(handle, move) {
    const last = this.waiting.at(-1);
    if (last && last.what === "drag" && last.fields.handle === handle && move.to) last.fields.to = move.to;
    else this.add("drag", { handle, step: this.step, ...move });
    this.send();
  }

  /**
   * @param {string} what
   * @param {object} fields
   */
  add(what, fields) {
    this.waiting.push({ what, fields });
    this.send();
  }

  send() {
    if (this.going || !this.here) return;
    this.going = this.waiting.shift() || null;
    if (this.going) this.serial = this.talk.ask(this.going.what, this.going.fields);
    this.waits(this.idle);
  }
}
