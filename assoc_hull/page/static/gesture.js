// Pointers on a view: hover, choose, drag a point, pan, zoom, turn the wire.

import {make} from "./elements.js";
import {curveThrough, nearestCurve, nearestPoint} from "./view.js";

const REACH = {mouse: 12, pen: 12, touch: 22};
const STILL = 3; // px: a press that moves less chooses and does not edit
const FINE = 0.1;
const PALM = 500; // ms after a pen: what touches then is the hand that holds it
let penTime = -Infinity;

export class Pointers {
  /** @param {View} view @param {Hand} hand */
  constructor(view, hand) {
    this.view = view;
    this.hand = hand;
    this.store = view.store;
    /** @type {{mode: "point" | "pan" | "turn" | "curve" | "mark", x: number, y: number, row: number | null, moved: boolean, id: number, fine: boolean, lock: boolean, at: [number, number]} | null} */
    this.press = null;
    /** @type {Map<number, [number, number]>} */
    this.fingers = new Map();
    const {upper} = view;
    upper.addEventListener("pointerdown", (event) => this.#down(event));
    upper.addEventListener("pointermove", (event) => this.#move(event));
    // Where the browser gives it: what was asked need not wait for the next frame.
    upper.addEventListener("pointerrawupdate", (event) => {
      if (this.press?.mode === "point") this.#move(/** @type {PointerEvent} */ (event));
    });
    upper.addEventListener("pointerup", (event) => this.#up(event));
    upper.addEventListener("pointercancel", () => this.cancel());
    upper.addEventListener("pointerleave", () => {
      if (!this.press) this.#hover(null, null, 0, 0);
    });
    upper.addEventListener("wheel", (event) => this.#wheel(event), {passive: false});
    upper.addEventListener("contextmenu", (event) => event.preventDefault());
    this.hand.onGrip = null;
    /** Told where a point is to be inserted. @type {((place: number[] | null) => void) | null} */
    this.onInsert = null;
    /** May take a click to place a picture. @type {((x: number, y: number) => boolean) | null} */
    this.onPlace = null;
    /** Takes places while a line is re-shaped. @type {Shaper | null} */
    this.shaper = null;
  }

  /** @param {MouseEvent} event @returns {[number, number]} */
  #place(event) {
    const box = this.view.upper.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** @param {PointerEvent} event */
  #down(event) {
    if (event.pointerType === "pen") penTime = event.timeStamp;
    if (event.pointerType === "touch" && event.timeStamp - penTime < PALM) return;
    const [x, y] = this.#place(event), {view, store, hand} = this;
    view.upper.focus({preventScroll: true});
    view.upper.setPointerCapture(event.pointerId);
    this.fingers.set(event.pointerId, [x, y]);
    if (this.fingers.size === 2) {
      if (this.press?.mode === "point") hand.cancel();
      this.press = null;
      return;
    }
    if (this.press) return;
    if (event.button === 0 && this.onPlace?.(x, y)) return;
    if (store.inserting !== null && event.button === 0 && view.kind !== "wire") return this.onInsert?.(this.#placeOn(store.inserting, x, y));
    store.marked = null;
    if (store.refusal || store.problem) {
      store.refusal = store.problem = null;
      store.changed("overlay", "panel");
    }
    const reach = REACH[/** @type {"mouse"} */ (event.pointerType)] ?? 12, base = {x, y, moved: false, id: event.pointerId, fine: event.altKey !== store.tools.fine, lock: event.shiftKey, at: /** @type {[number, number]} */ ([x, y])};
    if (store.shaping && event.button === 0 && view.kind !== "wire") {
      const mark = this.shaper?.press(view, this.#placeOn(store.shaping.curve, x, y), x, y) ?? null;
      if (mark !== null) this.press = {...base, mode: "mark", row: mark};
      return;
    }
    const row = event.button === 0 ? nearestPoint(view, x, y, reach) : null;
    if (row !== null) {
      const point = store.net?.points.get(row), chosen = store.selection.curve;
      const keeps = point && chosen !== null && (point.a === chosen || point.b === chosen);
      store.select(row, keeps ? chosen : curveThrough(view, row));
      this.press = {...base, mode: "point", row};
      view.tip.hidden = true;
      hand.begin(row, event.ctrlKey || event.metaKey ? "move" : store.tools.how);
      return;
    }
    const curve = event.button === 0 ? nearestCurve(view, x, y, reach / 2) : null;
    this.press = {...base, row: null, mode: view.kind === "wire" && event.button === 0 ? "turn" : curve === null ? "pan" : "curve"};
    if (curve !== null) store.select(null, curve);
  }

  /** The place in the plane of a line at a pixel; null where the plane is seen as a line. @param {number} curve @param {number} x @param {number} y */
  #placeOn(curve, x, y) {
    const {view, store} = this, line = store.net?.lineOf(curve);
    if (!line || line.axis === null || line.offset === null || line.axis === view.a || line.axis === view.b) return null;
    const place = [0, 0, 0], s = view.kind === "body" ? view.side(line.offset) : 1;
    place[line.axis] = line.offset;
    place[view.a] = s * (x - view.axis.o) / view.axis.s;
    place[view.b] = (view.oy - y) / view.sy;
    return place;
  }

  /** @param {PointerEvent} event */
  #move(event) {
    if (event.pointerType === "pen") penTime = event.timeStamp;
    const [x, y] = this.#place(event), {view, press} = this;
    if (this.fingers.has(event.pointerId) && this.fingers.size === 2) return this.#pinch(event.pointerId, x, y);
    if (!press) {
      const reach = REACH[/** @type {"mouse"} */ (event.pointerType)] ?? 12, row = nearestPoint(view, x, y, reach);
      this.#hover(row, row === null ? nearestCurve(view, x, y, reach / 2) : curveThrough(view, row), x, y);
      return;
    }
    if (event.pointerId !== press.id) return;
    this.fingers.set(event.pointerId, [x, y]);
    if (!press.moved) {
      if (Math.hypot(x - press.x, y - press.y) < STILL) return;
      // It begins here, so that the point does not leap by the way of the hand so far.
      press.moved = true;
      press.x = x;
      press.y = y;
      press.at = [x, y];
      view.tip.hidden = true;
    }
    const dx = x - press.at[0], dy = y - press.at[1];
    press.at = [x, y];
    press.fine = event.altKey !== this.store.tools.fine;
    press.lock = event.shiftKey;
    if (press.mode === "point") this.track();
    else if (press.mode === "mark") {
      if (this.store.shaping && press.row !== null) this.shaper?.to(view, press.row, this.#placeOn(this.store.shaping.curve, x, y));
    } else {
      if (press.mode === "turn") view.turn(dx, dy);
      else view.pan(dx, dy);
      this.store.changed("overlay");
    }
  }

  /** Asks for the place under the pointer, along the ways that the point has. */
  track() {
    const {press, view, hand} = this, held = this.store.held;
    if (!press || press.mode !== "point" || !press.moved || !held || !hand.gripped) return;
    held.fine = press.fine;
    const part = press.fine ? FINE : 1, dx = (press.at[0] - press.x) * part, dy = (press.at[1] - press.y) * part;
    const side = view.side(held.start[0]);
    if (held.how === "pull") {
      const way = held.way ?? held.normal;
      if (!way) return hand.pull(0.001); // the library says why there is no way
      const [ux, uy] = view.seen(way, side), full = (way[0] ** 2 + way[1] ** 2 + way[2] ** 2) * Math.min(view.axis.s, view.sy) ** 2;
      // Where the way runs out of the picture, a little of the hand must not be a leap of the hull.
      hand.pull((dx * ux + dy * uy) / Math.max(ux * ux + uy * uy, 0.1 * full));
      return;
    }
    const step = [0, 0, 0], s = view.kind === "body" ? side : 1;
    step[view.a] = s * dx / view.axis.s;
    step[view.b] = -dy / view.sy;
    const ways = [view.a, view.b].filter((axis) => held.free.includes("xyz"[axis]));
    if (press.lock && ways.length === 2) step[Math.abs(dx) > Math.abs(dy) ? view.b : view.a] = 0;
    if (ways.length) hand.move(step);
  }

  /** @param {PointerEvent} event */
  #up(event) {
    this.fingers.delete(event.pointerId);
    const {press, hand} = this;
    if (!press || event.pointerId !== press.id) return;
    this.press = null;
    if (press.mode === "mark") this.shaper?.look();
    else if (press.mode === "point") {
      if (press.moved) hand.finish();
      else hand.cancel();
    } else if (!press.moved && press.mode === "pan") this.store.select(null, null);
  }

  /** A gesture ends with its pointer, its window, its connection, or Esc. */
  cancel() {
    this.fingers.clear();
    if (this.press?.mode === "point") this.hand.cancel();
    this.press = null;
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    event.preventDefault();
    const [x, y] = this.#place(event), held = this.store.held, lines = event.deltaMode === 1 ? 30 : 1;
    const factor = Math.exp(-Math.min(Math.max(event.deltaY * lines, -120), 120) * 0.0018);
    if (held) {
      if (held.how === "pull" && held.radius) {
        const radius = held.radius.map((value) => Math.min(Math.max(value * factor, 0.05), 500));
        this.store.tools.radius = radius;
        this.hand.widen(radius);
      }
      return;
    }
    this.view.zoom(x, y, factor);
    this.store.changed("overlay");
  }

  /** @param {number} id @param {number} x @param {number} y */
  #pinch(id, x, y) {
    const before = [...this.fingers.values()];
    this.fingers.set(id, [x, y]);
    const after = [...this.fingers.values()], {view} = this;
    const span = (/** @type {[number, number][]} */ p) => Math.hypot(p[0][0] - p[1][0], p[0][1] - p[1][1]) || 1;
    const middle = (/** @type {[number, number][]} */ p) => [(p[0][0] + p[1][0]) / 2, (p[0][1] + p[1][1]) / 2];
    const [mx, my] = middle(after), [ox, oy] = middle(before);
    view.pan(mx - ox, my - oy);
    view.zoom(mx, my, span(after) / span(before));
    this.store.changed("overlay");
  }

  /** @param {number | null} row @param {number | null} curve @param {number} x @param {number} y */
  #hover(row, curve, x, y) {
    const {view, store} = this, {tip} = view, net = store.net;
    store.point(row, curve);
    const point = row === null ? undefined : net?.points.get(row);
    tip.hidden = !net || (!point && curve === null);
    if (tip.hidden || !net) return;
    const name = make("b", {}, point ? point.label || net.said(point.name) : curve === null ? "" : net.curveName(curve));
    tip.replaceChildren(name, ...point ? [net.roleWords(point), net.wayWords(point)].map((words) => make("span", {}, words)) : []);
    // Beside the pointer, on the side that has room for all of it: the view would cut the rest.
    tip.style.left = tip.style.top = "0";
    const {offsetWidth: w, offsetHeight: h} = tip, within = (/** @type {number} */ at, /** @type {number} */ most) => `${Math.max(Math.min(at, most), 2)}px`;
    const below = y + 16 + h <= view.height - 2, above = y - 16 - h >= 2;
    tip.style.left = within(x + 16 + w <= view.width - 2 ? x + 16 : x - 16 - w, view.width - w - 2);
    tip.style.top = within(below || !above ? y + 16 : y - 16 - h, view.height - h - 2);
    view.upper.style.cursor = point ? "grab" : curve !== null ? "pointer" : "";
  }
}
