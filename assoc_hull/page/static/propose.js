// What would be made, shown as a ghost before it is.

import {Asker} from "./asker.js";
import {button, form} from "./elements.js";
import {farthestDrawn} from "./paint.js";
import {millimetres, signed} from "./units.js";

/** @typedef {{normal: number | null, moved: number, volume_change: number | null, lcb_change: number | null, notes?: string[], refused: string[]}} Cost */

/** How far points move off the hull, and lines between them, where that is farther, m. @param {number | null} normal @param {number} drawn */
export function farWords(normal, drawn) {
  if (normal === null && drawn < 1e-4) return "";
  return `${millimetres(normal ?? 0)} off the hull${drawn > (normal ?? 0) + 1e-4 ? `, ${millimetres(drawn)} between points` : ""}`;
}

/** What the ghost that is shown would do. @param {Cost} cost @param {Store} store */
export function costWords({normal, volume_change: volume, lcb_change: lcb}, {ghost, curves}) {
  const far = farWords(normal, ghost ? farthestDrawn(ghost, curves) : 0);
  return [
    far ? `largest movement ${far}` : "nothing moves",
    volume === null || volume === undefined ? "" : `V ${signed(volume, 2, "m³")}`,
    lcb === null || lcb === undefined ? "" : `LCB ${signed(lcb, 4, "m")}`,
  ].filter(Boolean).join(", ");
}

/** What is shown as a ghost before it is made: dropped with the ghost, and with the state that it was asked of. */
export class Offer extends Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    /** @type {any} */
    this.what = null;
    this.ready = false;
    /** What is said once it is made. */
    this.made = "";
  }

  /** @param {{t: string, [name: string]: unknown}} message @param {string} words @param {object} what */
  offer(message, words, what) {
    this.askGhost(message, words);
    this.what = {...what, state: this.page.store.state};
    this.ready = false;
    this.page.store.changed("panel");
  }

  /** Tells what it would do; it can be made unless it is refused. @param {Cost} cost @param {string} words */
  tell({refused}, words) {
    this.ready = !refused.length;
    this.words.textContent = this.ready ? words : `${refused.join("\n")}\nNothing is changed.`;
    this.page.say(this.words.textContent);
    this.page.store.changed("panel");
  }

  /** @param {string} name @param {object[]} ops */
  make(name, ops) {
    this.asked = this.page.apply(name, ops);
    this.ready = false;
  }

  render() {
    // Somebody has edited the hull: it would be another answer.
    if (this.what && this.what.state !== this.page.store.state) this.#forget();
  }

  #forget() {
    if (!this.what) return;
    this.what = null;
    this.ready = false;
    this.page.store.changed("panel");
  }

  dropped() {
    super.dropped();
    this.#forget();
  }

  lost() {
    super.lost();
    this.#forget();
  }

  /** @param {{id: number}} message */
  done(message) {
    if (!message.id || message.id !== this.asked) return;
    this.#forget();
    this.words.textContent = this.made;
  }

  /** @param {{id: number, text: string}} message */
  problem(message) {
    const mine = super.problem(message);
    if (mine) this.#forget();
    return mine;
  }
}

/** Any edits, as the drawing, the point and the line ask for them. */
export class Proposal extends Offer {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    // Either way the hand is at the drawing again.
    const back = (/** @type {() => unknown} */ act) => () => {
      act();
      page.activeView().upper.focus({preventScroll: true});
    };
    this.go = button("Apply", back(() => this.apply()));
    this.give = button("Give up", back(() => page.dropGhost()));
    box.append(this.words, form(this.go, this.give));
  }

  /** One that is a draft is not made: it waits for more of what is asked. @param {string} name @param {object[]} ops @param {boolean} [draft] */
  show(name, ops, draft = false) {
    // Asked once more: it was seen, and is wanted.
    if (this.ready && !draft && !this.what.draft && this.what.state === this.page.store.state && JSON.stringify(this.what.ops) === JSON.stringify(ops)) return void this.apply();
    this.offer({t: "preview", ops}, `${name}: looking what follows …${/"fair":true/.test(JSON.stringify(ops)) ? " A fair answer takes some seconds; Esc gives up." : ""}`, {name, ops, draft});
  }

  render() {
    super.render();
    const box = this.box.closest("details");
    if (box) box.hidden = !this.what && !this.words.textContent;
    this.go.disabled = !this.ready;
    this.go.textContent = this.what?.draft ? "Done: show the answer" : "Apply";
    this.give.disabled = !this.what;
  }

  /** @param {{id: number, value: Cost}} message */
  answer({id, value}) {
    if (id !== this.asked || !this.what) return;
    const {name, draft} = this.what;
    this.tell(value, [`${name}: ${costWords(value, this.page.store)}.`, draft ? "Nothing is changed yet: click more places; Enter shows the answer, Esc gives up." : "Nothing is changed yet: Enter applies, Esc gives up.", ...(value.notes ?? []).slice(0, 3).map((note) => `– ${note}`)].join("\n"));
    if (this.ready && !draft) this.go.scrollIntoView({block: "nearest"});
  }

  /** Makes what is shown; tells whether there was anything. */
  apply() {
    const {what, page} = this;
    if (!what || !this.ready) return false;
    if (what.draft) page.shaper.finish();
    else this.make(what.name, what.ops);
    return true;
  }
}
