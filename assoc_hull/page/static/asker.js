// What panels that ask the server have in common.

import {button, make, paragraph} from "./elements.js";
import {reasonWords} from "./reasons.js";

const PAUSE = 250; // ms: not at every step of a burst of edits
export const LONG = 700; // ms: an answer that takes longer can be stopped
const ANSWERS = ["compare", "export", "fairness", "hydrostatics", "parameters", "preview", "vary", "window"];

export class Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.box = box;
    this.asked = this.ghost = 0;
    this.key = "";
    /** Whether the next answer is to be brought into view: what is renewed must not jump. */
    this.led = false;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    this.words = paragraph("");
    this.words.setAttribute("role", "status");
    this.list = make("div");
    /** The question that is not answered yet. */
    this.waits = 0;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.late = undefined;
    this.halt = button("Stop", () => this.stop());
  }

  get open() { return this.box.closest("details")?.open ?? false; }

  /** @param {{t: string, apply?: boolean, [name: string]: unknown}} message @param {string} words */
  ask(message, words) {
    this.page.keys.finish(); // or the server would let go of what is in hand
    this.arrived(this.waits);
    this.asked = this.page.request(message);
    this.words.textContent = words;
    if (!ANSWERS.includes(message.t)) return;
    this.waits = this.asked;
    this.late = setTimeout(() => this.words.after(this.halt), LONG);
  }

  /** What is asked is answered, or not waited for any more. @param {number} id */
  arrived(id) {
    if (id !== this.waits) return;
    this.waits = 0;
    clearTimeout(this.late);
    this.halt.remove();
  }

  /** Gives up the answer that is waited for; the server ends its work. */
  stop() {
    const {page, waits} = this;
    if (waits && waits === page.applying) {
      // It may be made by now: what comes of it is told.
      page.giveUp(waits);
      this.words.textContent = "Stopping …";
      return this.arrived(waits);
    }
    if (waits && page.shower === this) page.dropGhost();
    else if (waits) page.giveUp(waits);
    this.arrived(waits);
    this.asked = 0;
    this.words.textContent = "Stopped. Nothing is changed.";
  }

  /** Asks for a ghost: one that comes later for somebody else is not shown. @param {{t: string, [name: string]: unknown}} message @param {string} words */
  askGhost(message, words) {
    this.page.dropGhost();
    this.page.store.refusal = null; // what was refused before is not what is looked at now
    this.ask(message, words);
    this.page.wanted = this.ghost = this.asked;
    this.page.shower = this;
  }

  /** Asks anew when what is shown is of another state, while it can be seen. @param {string} key @param {() => void} load */
  fresh(key, load) {
    const {store} = this.page;
    if (!this.open || store.connection !== "open" || store.held || !store.net || key === this.key) return;
    this.key = key;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => store.held ? this.key = "" : load(), PAUSE);
  }

  /** Brings the first answer into view. */
  bring() {
    if (this.led) this.box.closest("details")?.scrollIntoView({block: "nearest"});
    this.led = false;
  }

  /** The server has gone: nothing is answered any more, and another may not be at the same state. */
  lost() {
    this.arrived(this.waits);
    this.asked = 0;
    this.key = this.words.textContent = "";
  }

  /** The ghost was taken away, by Esc or by another: no answer is waited for. */
  dropped() {
    if (this.waits === this.ghost) this.arrived(this.waits);
    if (this.asked === this.ghost) this.asked = 0;
    this.words.textContent = "";
  }

  /** @param {any} _message */
  done(_message) {}

  /** A refusal stands where it was asked; that of a ghost that was taken away nowhere. @param {{id: number, text: string}} message */
  problem(message) {
    if (!message.id || message.id !== this.asked) return message.id > 0 && message.id === this.ghost;
    this.words.textContent = this.page.store.said(message.text);
    return true;
  }

  /** @param {{id: number, reasons: string[]}} message */
  refused(message) { return this.problem({id: message.id, text: reasonWords(message.reasons)}); }
}
