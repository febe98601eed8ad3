/** The conversation with the server: questions with a number, answers by what they are of. */

const KEY = "heeltoe-session";
/** Of the tab of this browser that was there last; a new tab goes on with it where it is closed. */
const LAST = "heeltoe-last-session";
const LONGEST_WAIT_MS = 8000;

export class Talk {
  constructor() {
    /** @type {Map<string, ((message: any) => void)[]>} */
    this.listeners = new Map();
    this.serial = 0;
    /** Who waits for the answer to a question of this number. @type {Map<number, (message: any) => void>} */
    this.waiting = new Map();
    this.wait = 250;
    /** @type {WebSocket | null} */
    this.socket = null;
    this.session = sessionStorage.getItem(KEY) || "";
    const [entry] = /** @type {PerformanceNavigationTiming[]} */ (performance.getEntriesByType("navigation"));
    /** Whether the session is surely of this tab: a tab that was doubled has the same name. */
    this.again = Boolean(entry && entry.type === "reload");
    /** The largest file that can be sent [bytes], and what is said of a larger one. */
    this.uploads = { largest: Infinity, refusal: "" };
    this.on("hello", ({ session, upload }) => {
      this.uploads = upload;
      this.wait = 250;
      this.heard("connected");
      this.session = session;
      this.again = true;
      sessionStorage.setItem(KEY, session);
      localStorage.setItem(LAST, session);
    });
  }

  open() {
    const address = new URL("/talk", location.href);
    address.protocol = "ws:";
    address.searchParams.set("session", this.session);
    address.searchParams.set("closed", localStorage.getItem(LAST) || "");
    if (this.again) address.searchParams.set("again", "");
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.addEventListener("message", ({ data }) => {
      const message = JSON.parse(data);
      const waits = this.waiting.get(message.serial);
      this.waiting.delete(message.serial);
      if (waits) waits(message);
      for (const hear of this.listeners.get(message.of) || []) hear(message);
      if (message.serial) this.heard("answered", message);
    });
    socket.addEventListener("close", ({ reason }) => {
      this.heard("lost", { reason });
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST_WAIT_MS);
    });
  }

  /** @param {string} of @param {object} more */
  heard(of, more = {}) {
    for (const hear of this.listeners.get(of) || []) hear(more);
  }

  /**
   * Hear what the server says of something; "connected" and "lost" are of the connection itself, "answered" is of all
   * answers, which say what they are answers `to`.
   * @param {string} of
   * @param {(message: any) => void} hear
   */
  on(of, hear) {
    this.listeners.set(of, [...(this.listeners.get(of) || []), hear]);
  }

  /**
   * Ask for an action of the server (actions.py); its answer has the number that is returned.
   * @param {string} what
   * @param {object} fields
   */
  ask(what, fields = {}) {
    this.serial += 1;
    if (this.socket && this.socket.readyState === WebSocket.OPEN) {
      this.socket.send(JSON.stringify({ do: what, serial: this.serial, ...fields }));
    }
    return this.serial;
  }

  /**
   * Hear the answer to a question, and to no other.
   * @param {string} what
   * @param {object} fields
   * @returns {Promise<any>}
   */
  answer(what, fields = {}) {
    return new Promise((done) => {
      const serial = this.ask(what, fields);
      this.waiting.set(serial, done);
    });
  }

  /**
   * Send a file; it is kept under the name that is returned.
   * @param {File} file
   * @returns {Promise<{name: string, bytes: number}>}
   */
  async upload(file) {
    if (file.size > this.uploads.largest) throw new Error(this.uploads.refusal);
    const lost = { error: "The file has not arrived: the app has stopped or cannot be reached." };
    let content = lost;
    try {
      const answer = await fetch("/upload", { method: "POST", body: file, headers: { "x-session": this.session } });
      content = await answer.json();
    } catch {
      // Neither a connection that was cut nor an answer of another server has a sentence for people.
    }
    if (content.error) throw new Error(content.error);
    return content;
  }
}
