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
    if (event.key === "Escape") return this.#escape(typing ? /** @type {HTMLInputElement} */ (event.target) : null, event.target);
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
    // A place that was clicked is taken back first; an edit that lies before it stays.
    if (key === "Ctrl+z" && store.shaping?.places.length) {
      event.preventDefault();
      return page.shaper.back();
    }
    const action = actionOf(page, key);
    if (!action) return;
    event.preventDefault();
    this.finish();
    action.run(page);
  }

  /** @param {HTMLInputElement | null} field @param {EventTarget | null} at */
  #escape(field, at) {
    const {page} = this, {store} = page;
    if (store.held) {
      clearTimeout(this.timer);
      this.burst = false;
      page.cancel();
    } else if (store.refusal || store.problem) {
      store.refusal = store.problem = null;
      store.changed("overlay", "panel");
    } else if (page.shaper.stop()) page.say("Nothing is re-shaped.");
    else if (store.inserting !== null) {
      store.inserting = null;
      page.say("No point is inserted.");
    } else if (store.ghost || page.shower) page.dropGhost();
    else if (field) page.leaveField(field);
    else if (store.marked) {
      store.marked = null;
      store.changed("overlay");
    }
    else if (at instanceof Element && at.closest("aside, .bar")) page.activeView().upper.focus({preventScroll: true});
    else if (store.maximised) page.maximise(/** @type {import("./view.js").Kind} */ (store.maximised));
    else store.select(null, null);
  }

  /** @param {[number, number]} way @param {number} times */
  #nudge(way, times) {
    const {store, hand} = this.page, view = this.page.activeView();
    if (view.kind === "wire") return this.page.say("The wire only shows: choose a point in another drawing.");
    if (store.tools.how === "pull") return this.nudge((way[0] + way[1]) * times * STEP);
    const held = this.#hold("move");
    if (!held) return;
    const s = view.kind === "body" ? view.side(held.start[0]) : 1;
    this.sum[view.a] += s * way[0] * times * STEP;
    this.sum[view.b] += way[1] * times * STEP;
    hand.move(this.sum);
    this.#wait();
  }

  /** Pulls the hull at the chosen point by d (m) more. @param {number} d */
  nudge(d) {
    if (!this.#hold("pull")) return;
    this.sum[0] += d;
    this.page.hand.pull(this.sum[0]);
    this.#wait();
  }

  /** Takes hold of the chosen point, or keeps it in the same burst. @param {"pull" | "move"} how */
  #hold(how) {
    const {page} = this, {store, hand} = page, row = store.selection.row;
    if (row === null) return void page.say("Choose a point first: click it, or press / and type its name.");
    if (this.burst && store.held?.how !== how) this.finish();
    if (!this.burst) {
      if (!hand.begin(row, how)) return void page.say("That was not done: the last edit is still being made.");
      this.burst = true;
      this.sum = [0, 0, 0];
    }
    if (!store.held) this.burst = false; // it was refused
    return store.held;
  }

  #wait() {
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
