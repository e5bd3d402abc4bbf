// What would be made, shown as a ghost before it is: pulls that are answered fairly, lines that are led.

import {Asker, button} from "./asker.js";
import {farthestDrawn} from "./paint.js";
import {millimetres, signed} from "./units.js";

/** @typedef {{normal: number | null, moved: number, volume_change: number | null, lcb_change: number | null, notes?: string[], refused: string[]}} Cost */

/** Between its points a line may move more than they do: `drawn` is how far, m. @param {Cost} cost @param {number} [drawn] */
export function costWords({normal, volume_change: volume, lcb_change: lcb}, drawn = 0) {
  return [
    normal === null && drawn < 1e-4 ? "nothing moves" : `largest movement ${millimetres(Math.max(normal ?? 0, drawn))} off the hull`,
    volume === null || volume === undefined ? "" : `V ${signed(volume, 2, "m³")}`,
    lcb === null || lcb === undefined ? "" : `LCB ${signed(lcb, 4, "m")}`,
  ].filter(Boolean).join(", ");
}

export class Proposal extends Asker {
  /** @param {import("./page.js").Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    /** @type {{name: string, ops: object[], state: number, draft: boolean} | null} */
    this.what = null;
    this.ready = false;
    // Either way the hand is at the drawing again.
    const back = (/** @type {() => unknown} */ act) => () => {
      act();
      page.activeView().upper.focus({preventScroll: true});
    };
    this.make = button("Apply", back(() => this.apply()));
    this.give = button("Give up", back(() => page.dropGhost()));
    const form = document.createElement("div");
    form.className = "form";
    form.append(this.make, this.give);
    box.append(this.words, form);
  }

  /** One that is a draft is not made: it waits for more of what is asked. @param {string} name @param {object[]} ops @param {boolean} [draft] */
  show(name, ops, draft = false) {
    // Asked once more, as by Enter in the same field: it was seen, and is wanted.
    if (this.ready && !draft && this.what && !this.what.draft && this.what.state === this.page.store.state && JSON.stringify(this.what.ops) === JSON.stringify(ops)) return void this.apply();
    this.askGhost({t: "preview", ops}, `${name}: looking what follows …`);
    this.what = {name, ops, state: this.page.store.state, draft};
    this.ready = false;
    this.page.store.changed("panel");
  }

  render() {
    if (this.what && this.what.state !== this.page.store.state) {
      this.what = null; // somebody has edited the hull: it would be another answer
      this.ready = false;
    }
    const box = this.box.closest("details");
    if (box) box.hidden = !this.what && !this.words.textContent;
    this.make.disabled = !this.ready;
    this.make.textContent = this.what?.draft ? "Done: show the answer" : "Apply";
    this.give.disabled = !this.what;
  }

  dropped() {
    this.what = null;
    this.ready = false;
    this.words.textContent = "";
    this.page.store.changed("panel");
  }

  /** @param {{id: number, value: Cost}} message */
  answer(message) {
    if (message.id !== this.asked || !this.what) return;
    const {refused, notes} = message.value, {ghost, curves} = this.page.store;
    this.ready = !refused.length;
    if (this.ready && !this.what.draft) this.make.scrollIntoView({block: "nearest"});
    this.words.textContent = refused.length ? `${refused.join("\n")}\nNothing is changed.` : [`${this.what.name}: ${costWords(message.value, ghost ? farthestDrawn(ghost, curves) : 0)}.`, this.what.draft ? "Nothing is changed yet: click more places, or Enter for the answer; Esc gives up." : "Nothing is changed yet: Enter applies, Esc gives up.", ...(notes ?? []).slice(0, 3).map((note) => `– ${note}`)].join("\n");
    this.page.say(this.words.textContent);
    this.page.store.changed("panel");
  }

  /** Makes what is shown; tells whether there was anything. */
  apply() {
    const {what, page} = this;
    if (!what || !this.ready) return false;
    if (what.draft) {
      page.shaper.finish();
      return true;
    }
    this.asked = page.apply(what.name, what.ops);
    this.ready = false;
    return true;
  }

  /** @param {{id: number}} message */
  done(message) {
    if (!message.id || message.id !== this.asked) return;
    this.what = null;
    this.words.textContent = "";
  }

  /** @param {{id: number, text: string}} message */
  problem(message) {
    const mine = super.problem(message);
    if (mine) {
      this.what = null;
      this.page.store.changed("panel");
    }
    return mine;
  }
}
