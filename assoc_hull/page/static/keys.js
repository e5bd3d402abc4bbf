// Keys: the actions of the table, and arrows that nudge; a burst of arrows is one edit.

import {actionOf, keyName} from "./actions.js";

/** @typedef {import("./page.js").Page} Page */

const STEP = 0.001; // m
const BURST = 600; // ms
/** @type {Record<string, [number, number]>} */
const ARROWS = {ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowRight: [1, 0], ArrowLeft: [-1, 0]};

export class Keys {
  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    this.burst = false;
    this.sum = [0, 0, 0];
    // Also where a button that had the focus is no longer there to have it; not within a notebook.
    const signal = page.options.within;
    page.root.ownerDocument.addEventListener("keydown", (event) => {
      const at = event.target, own = at instanceof Node && page.root.contains(at);
      if (own || (!signal && at === page.root.ownerDocument.body)) this.#down(event);
    }, {signal});
  }

  /** @param {KeyboardEvent} event */
  #down(event) {
    const {page} = this, {store} = page, typing = event.target instanceof HTMLInputElement, key = keyName(event);
    if (key === "Ctrl+s") {
      event.preventDefault();
      page.say(store.file ? `Every edit is kept in ${store.file} already.` : "This hull is in memory only: it was not opened from a hull file.");
      return;
    }
    if (event.key === "Escape") return this.#escape(typing ? /** @type {HTMLInputElement} */ (event.target) : null);
    if (typing && !key.startsWith("Ctrl")) return;
    if (typing && ["Ctrl+z", "Ctrl+y", "Ctrl+Shift+z"].includes(key)) return; // of the field
    const drawing = event.target instanceof HTMLCanvasElement;
    if (drawing && event.key in ARROWS) {
      event.preventDefault();
      if (event.ctrlKey || event.metaKey) page.pan(-40 * ARROWS[event.key][0], 40 * ARROWS[event.key][1]);
      else this.#nudge(ARROWS[event.key], event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
      return;
    }
    if (drawing && event.key === "Enter") return this.burst ? this.finish() : store.shaping ? page.shaper.finish() : void page.panel.proposal.apply();
    if (drawing && event.key === "Backspace" && store.shaping) return page.shaper.back();
    if (!drawing && !key.startsWith("Ctrl") && key !== "/" && key !== "?" && key !== ":") return;
    const action = actionOf(page, key);
    if (!action) return;
    event.preventDefault();
    this.finish();
    action.run(page);
  }

  /** @param {HTMLInputElement | null} field */
  #escape(field) {
    const {page} = this, {store} = page;
    if (store.held) {
      clearTimeout(this.timer);
      this.burst = false;
      page.cancel();
    } else if (store.refusal || store.problem) {
      store.refusal = store.problem = null;
      store.changed("overlay", "panel");
    } else if (store.marked) {
      store.marked = null;
      store.changed("overlay");
    } else if (page.shaper.stop()) page.say("Nothing is re-shaped.");
    else if (store.inserting !== null) {
      store.inserting = null;
      page.say("No point is inserted.");
    } else if (store.ghost || page.shower) page.dropGhost();
    else if (field) page.leaveField(field);
    else if (store.maximised) page.maximise(/** @type {import("./view.js").Kind} */ (store.maximised));
    else store.select(null, null);
  }

  /** @param {[number, number]} way @param {number} times */
  #nudge(way, times) {
    const {page} = this, {store, hand} = page, row = store.selection.row, view = page.activeView();
    if (row === null || view.kind === "wire") return page.say("Choose a point first: click it, or press / and type its name.");
    if (!this.burst) {
      if (!hand.begin(row, store.tools.how)) return;
      this.burst = true;
      this.sum = [0, 0, 0];
    }
    if (!store.held) {
      this.burst = false; // it was refused
      return;
    }
    if (store.held.how === "pull") {
      this.sum[0] += (way[0] + way[1]) * times * STEP;
      hand.pull(this.sum[0]);
    } else {
      const side = view.side(store.held.start[0]), s = view.kind === "body" ? side : 1;
      this.sum[view.a] += s * way[0] * times * STEP;
      this.sum[view.b] += way[1] * times * STEP;
      hand.move(this.sum);
    }
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.finish(), BURST);
  }

  /** Ends a burst: it is one edit. */
  finish() {
    clearTimeout(this.timer);
    if (!this.burst) return;
    this.burst = false;
    this.page.hand.finish();
  }
}
