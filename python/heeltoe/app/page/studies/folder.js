/** A folder of records, chosen at once: each file is sent and read, and what is no record is said. */
import { element } from "../dom.js";

export class RecordFolder {
  /**
   * @param {(file: File) => Promise<string>} send Sends a record and returns what it is called here.
   * @param {() => void} renew Called when all have been read.
   */
  constructor(send, renew) {
    this.send = send;
    this.renew = renew;
    /** Those that are new since they were asked for. @type {string[]} */
    this.records = [];
    this.input = /** @type {HTMLInputElement} */ (element("input", { type: "file", id: "study-folder", multiple: true, webkitdirectory: true, onchange: () => this._read([...(this.input.files || [])]), "aria-describedby": "study-folder-status" }));
    this.status = element("p", { class: "hint", id: "study-folder-status", role: "status" }, "each file in it is read as a record");
    this.root = element("div", { class: "entry" }, element("label", { for: "study-folder" }, "A folder of yours"), this.input, this.status);
    // What is chosen here is no field of the study.
    this.root.addEventListener("input", (event) => event.stopPropagation());
  }

  /** Return the records read since the last call. */
  taken() {
    const records = this.records;
    this.records = [];
    return records;
  }

  /** @param {File[]} files */
  async _read(files) {
    const wanted = files.filter((file) => !file.name.startsWith("."));
    /** @type {string[]} */
    const wrong = [];
    let read = 0;
    for (const file of wanted) {
      this.status.textContent = `reading ${file.name}`;
      try {
        if (!file.size) throw new Error("it is empty");
        this.records.push(await this.send(file));
        read += 1;
      } catch (error) {
        const text = /** @type {Error} */ (error).message;
        wrong.push(text.startsWith(file.name) ? text : `${file.name}: ${text}`);
      }
    }
    this.input.value = "";
    const left = wrong.length > 3 ? [`and ${wrong.length - 3} others`] : [];
    this.status.textContent = [`${read} of ${wanted.length} ${wanted.length === 1 ? "file" : "files"} read`, ...wrong.slice(0, 3), ...left].join("; ");
    this.renew();
  }
}
