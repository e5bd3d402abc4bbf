// What would be made, shown as a ghost before it is; a line is re-shaped so through places that are clicked.

import {Asker} from "./asker.js";
import {button, form} from "./elements.js";
import {farthestDrawn} from "./paint.js";
import {reasonWords} from "./reasons.js";
import {VOLUME, millimetres, signed} from "./units.js";

/** @typedef {{normal: number | null, moved: number, volume_change: number | null, lcb_change: number | null, notes?: string[], refused: string[]}} Cost */

/** How far the hull moves at its points, along its normal, and its lines in their planes, where that is more: where it is nearly along a plane, much more, m. @param {number | null} normal @param {number} drawn */
export function farWords(normal, drawn) {
  if ((normal ?? 0) < 1e-9) return drawn < 1e-4 ? "" : `${millimetres(drawn)} at most, between points, which stay`;
  return `${millimetres(normal ?? 0)} along its normal at most${drawn > (normal ?? 0) + 1e-4 ? `, lines up to ${millimetres(drawn)} in their planes` : ""}`;
}

/** What the ghost that is shown would do. @param {Cost} cost @param {Store} store */
export function costWords({normal, volume_change: volume, lcb_change: lcb}, {ghost, curves}) {
  const far = farWords(normal, ghost ? farthestDrawn(ghost, curves) : 0);
  return [
    far ? `hull moves ${far}` : "nothing moves",
    volume === null || volume === undefined ? "" : `${VOLUME} ${signed(volume, 2, "m³")}`,
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
    /** What is said once it is made, and the edit that this is said of. */
    this.made = "";
    this.edit = {name: "", state: -1};
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
    this.words.textContent = this.page.store.said(this.ready ? words : `${reasonWords(refused)}\nNothing is changed.`);
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
    this.#tellEdit();
  }

  /** What is said of an edit holds while it is the last one; taken back, it can be made again. */
  #tellEdit() {
    const {edit: {name, state}, words, made, page: {store}} = this;
    if (state < 0 || state === store.state) return;
    const {undo, redo} = store.history, back = `Taken back: ${store.said(name)}. Redo makes it again.`;
    if (words.textContent === made || words.textContent === back) words.textContent = undo === name ? made : redo === name ? back : "";
    if (!words.textContent) this.edit.state = -1;
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

  /** @param {{id: number, name: string}} message */
  done(message) {
    if (!message.id || message.id !== this.asked) return;
    this.#forget();
    this.words.textContent = this.made;
    this.edit = {name: message.name, state: this.made ? this.page.store.state : -1};
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
    this.offer({t: "preview", ops}, `${this.page.store.said(name)}: looking what follows …${/"fair":true/.test(JSON.stringify(ops)) ? " A fair answer takes some seconds; Esc gives up." : ""}`, {name, ops, draft});
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

const AGAIN = 12; // px: a press so near a place takes hold of it
const SNAP = 2; // px
const PAUSE = 400; // ms without an arrow: what follows is looked at

export class Shaper {
  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
  }

  start() {
    const {page} = this, {store} = page, id = store.selection.curve;
    if (id === null) return page.say("Choose a line first: click it.");
    const line = store.net?.lineOf(id);
    if (!line || line.axis === null) return page.say("It lies in no plane of the drawing: choose a section, a waterline or a buttock.");
    page.dropGhost();
    store.inserting = null;
    store.shaping = {curve: id, places: []};
    store.changed("overlay", "panel");
    page.say("Click where the line is to pass, drag a place to change it, Backspace removes the last. Enter asks for the answer, Esc gives up.");
  }

  /** Takes hold of a place, or makes one; gives its number. @param {View} view @param {number[] | null} place @param {number} x @param {number} y @returns {number | null} */
  press(view, place, x, y) {
    const {store} = this.page, shaping = store.shaping;
    if (!shaping) return null;
    if (!place) {
      this.page.say(`Click in the view that shows ${store.net?.curveName(shaping.curve)} in its plane. Esc gives up.`);
      return null;
    }
    this.#snap(view, place);
    const near = shaping.places.findIndex((each) => {
      const [u, v] = view.atPlace(each);
      return Math.hypot(u - x, v - y) < AGAIN;
    });
    if (near < 0) shaping.places.push(place);
    store.changed("overlay");
    return near < 0 ? shaping.places.length - 1 : near;
  }

  /** On a line that crosses, where so near: beside it would be two points in one place. @param {View} view @param {number[]} place */
  #snap(view, place) {
    const {store} = this.page, curve = store.shaping?.curve ?? -1, axis = this.#along(curve), reach = SNAP / (axis === view.b ? view.sy : view.axis.s);
    let best = null, least = reach;
    for (const row of store.net?.rowsOf.get(curve) ?? []) {
      const far = Math.abs((store.places.get(row)?.[axis] ?? Infinity) - place[axis]);
      if (far < least) [best, least] = [row, far];
    }
    if (best !== null) place[axis] = store.places.get(best)?.[axis] ?? place[axis];
  }

  /** The coordinate that grows along a line: heights of sections, lengths of all others. @param {number} curve */
  #along(curve) { return this.page.store.net?.lineOf(curve)?.axis === 0 ? 2 : 0; }

  /** Arrows move the last place by so much (m); without one, the chosen point is the first. @param {View} view @param {[number, number]} way @param {number} far */
  nudge(view, way, far) {
    const {store} = this.page, {shaping, selection} = store, line = store.net?.lineOf(shaping?.curve ?? -1);
    if (!shaping || !line) return;
    const at = shaping.places.at(-1) ?? (selection.row === null ? undefined : store.places.get(selection.row));
    if (!at || line.axis === view.a || line.axis === view.b || view.kind === "wire") return this.page.say(`Choose a point of ${line.name}, in the drawing that shows it in its plane.`);
    const place = [...at];
    place[view.a] += way[0] * far * (view.kind === "body" ? view.side(at[0]) : 1);
    place[view.b] += way[1] * far;
    shaping.places.splice(-1, 1, place);
    store.changed("overlay");
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.look(), PAUSE);
  }

  /** @param {View} view @param {number} which @param {number[] | null} place */
  to(view, which, place) {
    const {store} = this.page;
    if (place) this.#snap(view, place);
    if (store.shaping && place) store.shaping.places[which] = place;
    store.changed("overlay");
  }

  /** The pointer is up: the plain answer is shown, which comes at once. */
  look() {
    const shaping = this.page.store.shaping;
    if (shaping?.places.length) this.page.panel.proposal.show(this.#name(), this.#ops(false), true);
  }

  back() {
    const {store} = this.page;
    if (!store.shaping?.places.pop()) return;
    if (store.shaping.places.length) this.look();
    else this.page.dropGhost();
    store.changed("overlay");
  }

  /** The places are given: the answer is shown before it is made. */
  finish() {
    const {page} = this, {store} = page;
    if (!store.shaping?.places.length) return;
    const name = this.#name(), ops = this.#ops(store.tools.fairShapes);
    store.shaping = null;
    page.panel.proposal.show(name, ops);
  }

  /** Gives it up; tells whether there was anything. */
  stop() {
    const {page} = this, was = page.store.shaping !== null;
    page.store.shaping = null;
    if (was) page.dropGhost();
    return was;
  }

  #name() {
    const shaping = this.page.store.shaping, n = shaping?.places.length ?? 0;
    return `re-shape ${this.page.store.net?.curveName(shaping?.curve ?? -1)} through ${n} ${n === 1 ? "place" : "places"}`;
  }

  /** It may change as far beyond the places as a pull is felt. @param {boolean} fair */
  #ops(fair) {
    const {store} = this.page, {curve, places} = /** @type {NonNullable<typeof store.shaping>} */ (store.shaping);
    const axis = this.#along(curve), upright = axis === 2, c = store.curves.get(curve), reach = store.tools.radius?.[upright ? 1 : 0] ?? 1;
    const all = c ? Array.from({length: c.n}, (_, i) => c.xyz[3 * i + axis]) : [], given = places.map((each) => each[axis]);
    const span = [Math.max(Math.min(...given) - reach, Math.min(...all)), Math.min(Math.max(...given) + reach, Math.max(...all))];
    return [{op: "reshape", curve: store.net?.curveName(curve) ?? "", points: [...places].sort((p, q) => p[axis] - q[axis]), span, ...(fair ? {fair} : {})}];
  }
}
