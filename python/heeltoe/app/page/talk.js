/** The conversation with the server: questions with a number, answers by what they are of. */

const KEY = "heeltoe-session";
const LONGEST_WAIT_MS = 8000;

export class Talk {
  constructor() {
    /** @type {Map<string, ((message: any) => void)[]>} */
    this.listeners = new Map();
    this.serial = 0;
    this.wait = 250;
    /** @type {WebSocket | null} */
    this.socket = null;
    this.session = sessionStorage.getItem(KEY) || "";
    this.on("hello", ({ session }) => {
      this.session = session;
      sessionStorage.setItem(KEY, session);
    });
  }

  open() {
    const address = new URL("/talk", location.href);
    address.protocol = "ws:";
    address.searchParams.set("session", this.session);
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.addEventListener("message", ({ data }) => {
      const message = JSON.parse(data);
      for (const hear of this.listeners.get(message.of) || []) hear(message);
    });
    socket.addEventListener("open", () => {
      this.wait = 250;
      this.heard("connected");
    });
    socket.addEventListener("close", () => {
      this.heard("lost");
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST_WAIT_MS);
    });
  }

  /** @param {string} of */
  heard(of) {
    for (const hear of this.listeners.get(of) || []) hear({ of });
  }

  /**
   * Hear what the server says of something; "connected" and "lost" are of the connection itself.
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
   * Send a file; it is kept under the name that is returned.
   * @param {File} file
   * @returns {Promise<{name: string, bytes: number}>}
   */
  async upload(file) {
    const answer = await fetch("/upload", { method: "POST", body: file, headers: { "x-session": this.session } });
    const said = await answer.json();
    if (!answer.ok) throw new Error(said.error);
    return said;
  }
}
