// One gesture: a point is taken hold of, asked to be elsewhere, and let go. One `to` is in flight at a time.
// Until the true answer comes, what follows is foreseen in proportion, while the error is less than half a pixel.

import {reasonWords} from "./reasons.js";

/** @typedef {Record<string, number>} Wish */

const SLOW = 250; // ms without an answer: the picture says that it is behind

export class Hand {
  /** @param {Store} store @param {(message: object) => void} send */
  constructor(store, send) {
    this.store = store;
    this.send = send;
    this.gesture = 0;
    /** The gesture that was ended before anything could be asked. */
    this.ended = 0;
    this.seq = 0;
    this.inFlight = 0;
    this.gripped = false;
    /** @type {Wish | null} */
    this.wish = null;
    /** @type {Wish | null} */
    this.last = null;
    /** @type {{gesture: number, row: number, seq: number, how: "pull" | "move"} | null} */
    this.committing = null;
    /** @type {(() => void) | null} */
    this.onGrip = null;
    /** Called when something is taken hold of. @type {(() => void) | null} */
    this.onBegin = null;
    /** May take over what was asked for, to be looked at before it is made. @type {((held: Held, wish: Wish) => boolean) | null} */
    this.onLet = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    /** What each step in flight asked for, and when. @type {Map<number, {amount: number | null, time: number}>} */
    this.asked = new Map();
    this.predictor = new Predictor();
    /** Pixels for a metre, of the view that is nearest. */
    this.scale = () => 1;
  }

  get free() { return this.store.held === null && this.committing === null && this.store.connection === "open"; }

  /** @param {number} row @param {"pull" | "move"} how */
  begin(row, how) {
    const start = this.store.places.get(row);
    if (!start || !this.free) return false;
    this.onBegin?.();
    this.gesture++;
    this.ended = 0;
    this.gripped = false;
    this.wish = this.last = null;
    this.inFlight = 0;
    this.predictor.reset();
    this.asked.clear();
    const place = [...start], free = this.store.net?.points.get(row)?.free ?? "";
    this.store.held = {row, how, place, start: place, free, normal: null, radius: null, way: null, amount: null, held: false, refused: false, waiting: false, fine: this.store.tools.fine};
    this.store.refusal = null;
    this.send({t: "begin", gesture: this.gesture, row, how, ...(how === "pull" && this.store.tools.radius ? {radius: this.store.tools.radius} : {})});
    this.store.changed("overlay", "panel");
    return true;
  }

  /** The same point with another radius; what was asked stays. @param {number[]} radius */
  widen(radius) {
    const held = this.store.held;
    if (!held || held.how !== "pull" || !this.gripped) return;
    this.gesture++;
    this.gripped = false;
    this.inFlight = 0;
    held.radius = radius;
    this.predictor.reset();
    this.wish = this.last;
    this.send({t: "begin", gesture: this.gesture, row: held.row, how: "pull", radius});
    this.store.changed("overlay", "panel");
  }

  /** Pulls by d, m. @param {number} d */
  pull(d) {
    const held = this.store.held;
    if (!held) return;
    held.amount = d;
    if (held.way) held.place = held.start.map((value, i) => value + d * (held.way?.[i] ?? 0));
    this.#ask({d});
  }

  /** Moves by so much along each axis that is free, m. @param {number[]} step */
  move(step) {
    const held = this.store.held;
    if (!held || !held.free) return;
    held.place = held.start.map((value, i) => held.free.includes("xyz"[i]) ? value + step[i] : value);
    const ways = [...held.free].map((name) => step["xyz".indexOf(name)]);
    held.amount = ways.length === 1 ? ways[0] : Math.hypot(...ways);
    this.#ask(Object.fromEntries([...held.free].map((name) => [name, held.place["xyz".indexOf(name)]])));
  }

  /** @param {Wish} wish */
  #ask(wish) {
    if (this.store.held) this.store.held.held = true;
    this.wish = this.last = wish;
    this.#pump();
    this.#foresee();
    this.store.changed("overlay", "panel");
  }

  #pump() {
    if (this.inFlight || !this.wish || !this.gripped) return;
    this.inFlight = ++this.seq;
    this.asked.set(this.seq, {amount: this.store.held?.amount ?? null, time: performance.now()});
    this.send({t: "to", gesture: this.gesture, seq: this.seq, ...this.wish});
    this.wish = null;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.#late(true), SLOW);
  }

  /** Draws what will follow, where that is known well enough; else the last true picture stays. */
  #foresee() {
    const {held, overlay, curves, places} = this.store, truth = this.predictor.truth;
    if (!held || held.amount === null || !truth || !overlay || (held.how === "move" && held.free.length !== 1)) return;
    const frame = held.amount === truth.amount ? null : this.predictor.at(held.amount, this.scale(), curves, places);
    this.store.overlay = frame ? {frame, amount: held.amount, predicted: true} : {frame: truth.frame, amount: truth.amount, predicted: false};
  }

  /** @param {boolean} late */
  #late(late) {
    clearTimeout(this.timer);
    if (this.store.held && this.store.held.waiting !== late) {
      this.store.held.waiting = late;
      this.store.changed("overlay", "panel");
    }
  }

  /** Lets go: the edit is made, if anything was asked. */
  finish() {
    const held = this.store.held;
    if (!held) return;
    if (!held.held || !this.last || !held.amount) {
      if (!this.gripped) this.ended = this.gesture;
      return this.cancel();
    }
    if (!held.refused && this.onLet?.(held, this.last)) return this.cancel();
    const name = this.store.net?.points.get(held.row)?.name ?? "a point", far = (1e3 * held.amount).toFixed(1);
    this.committing = {gesture: this.gesture, row: held.row, seq: ++this.seq, how: held.how};
    this.send({t: "commit", gesture: this.gesture, seq: this.seq, ...this.last, name: `${held.how} ${name} by ${far} mm`});
    this.#let(false);
  }

  /** Lets go: nothing is made. */
  cancel() {
    if (!this.store.held) return;
    this.send({t: "cancel", gesture: this.gesture});
    this.#let(true);
  }

  /** Whatever was in hand is gone: the connection is. */
  drop() {
    this.committing = null;
    if (this.store.held) this.#let(true);
    else this.store.overlay = null;
  }

  /** The hull comes anew: who has just pressed a point takes hold of it there, and what was asked stays. @param {() => void} adopt */
  renew(adopt) {
    const old = this.gripped ? null : this.store.held, {wish, last} = this;
    this.cancel(); // or the server keeps it from others
    this.drop();
    adopt();
    if (!old || !this.begin(old.row, old.how) || !this.store.held) return;
    Object.assign(this.store.held, {amount: old.amount, held: old.held});
    Object.assign(this, {wish, last});
  }

  /** @param {boolean} forget */
  #let(forget) {
    clearTimeout(this.timer);
    this.store.held = null;
    this.wish = null;
    this.inFlight = 0;
    if (forget) this.store.overlay = null;
    this.store.changed("overlay", "panel");
  }

  /** @param {any} message */
  grip(message) {
    const held = this.store.held;
    if (!held || message.gesture !== this.gesture) return;
    held.start = message.start;
    if (!held.held) held.place = [...message.start];
    held.free = message.free;
    held.normal = message.normal;
    held.radius = message.radius;
    held.way = this.#way(held);
    this.gripped = true;
    if (held.how === "pull" && held.amount !== null) this.pull(held.amount);
    else this.onGrip?.();
    this.#pump();
    this.store.changed("overlay", "panel");
  }

  /** Where a point goes for each metre that the hull is pulled: along the planes of its lines. @param {Held} held */
  #way(held) {
    const net = this.store.net, point = net?.points.get(held.row);
    if (!held.normal || !net || !point) return null;
    const fixed = new Set([point.a, point.b].map((id) => net.lineOf(id)?.axis ?? null));
    const along = held.normal.map((value, i) => fixed.has(i) ? 0 : value), size = along.reduce((sum, value) => sum + value * value, 0);
    return size < 1e-6 ? held.normal : along.map((value) => value / size);
  }

  /** A live frame has come; tells whether it is of this gesture. @param {Frame} frame */
  live(frame) {
    const held = this.store.held;
    if (!held || frame.gesture !== this.gesture || frame.state !== this.store.state) return false;
    if (frame.seq === this.inFlight) this.inFlight = 0;
    held.refused = false;
    this.store.refusal = null;
    this.#late(false);
    const amount = this.asked.get(frame.seq)?.amount ?? null;
    if (amount !== null) this.predictor.learn(frame, amount, this.store.curves, this.store.places);
    this.store.overlay = {frame, amount, predicted: false};
    this.#foresee();
    this.#pump();
    this.store.changed("overlay", "panel");
    return true;
  }

  /** What was asked is refused: the curves stay at the last accepted place. @param {any} message */
  refused(message) {
    const mine = message.gesture === this.gesture && this.store.held !== null;
    const made = this.committing?.gesture === message.gesture && message.gesture !== 0;
    // Let go before it was said that it cannot be taken hold of: who asked is told.
    const late = this.ended > 0 && message.gesture === this.ended;
    if (!mine && !made && !late) return false;
    this.asked.delete(message.seq);
    const held = this.store.held, row = held?.row ?? this.committing?.row ?? message.row ?? null;
    const text = this.store.said(reasonWords(message.reasons, (held ?? this.committing)?.how === "pull")), place = held ? held.place : row === null ? null : [...(this.store.places.get(row) ?? [])];
    const all = message.reasons.join("\n");
    this.store.refusal = {text, all, row, place, named: this.store.net?.named(all) ?? []};
    if (made) {
      this.committing = null;
      this.store.overlay = null;
    } else if (held) {
      if (message.seq === this.inFlight) this.inFlight = 0;
      held.refused = true;
      this.#late(false);
      if (!this.gripped) this.#let(true); // it could not even be taken hold of
      else this.#pump();
    }
    this.store.changed("overlay", "panel");
    return true;
  }

  /** An edit was made. @param {any} message */
  done(message) {
    if (this.committing?.gesture === message.gesture) this.committing = null;
  }

  /** Something failed. @param {any} message */
  problem(message) {
    if (message.gesture && message.gesture === this.gesture) {
      this.committing = null;
      if (this.store.held) this.#let(true);
      this.store.overlay = null;
      this.store.changed("overlay", "panel");
    }
  }
}

const LEAST = 5e-4; // m: less tells too little of the way
const TURN = 0.01; // m: so far it may reach beyond nil
const KEPT = 5;
const PIXELS = 0.5;
const FIRST = 4; // 1/m, before anything is known: 20 mm beside are wrong by 1.6 mm

export class Predictor {
  constructor() {
    /** @type {{frame: Frame, amount: number} | null} */
    this.truth = null;
    /** @type {number[]} */
    this.bends = [];
    this.tried = this.held = 0;
  }

  reset() {
    this.truth = null;
    this.bends = [];
  }

  /** @param {Frame} frame @param {number} amount @param {Map<number, Curve>} curves @param {Map<number, Float64Array>} places */
  learn(frame, amount, curves, places) {
    const step = this.truth ? amount - this.truth.amount : 0;
    if (this.truth && Math.abs(step) > LEAST) {
      const said = between(this.truth.frame, amount / this.truth.amount, curves, places);
      this.bends.push(said ? apart(said, frame) / (step * step) : Infinity);
      if (this.bends.length > KEPT) this.bends.shift();
    }
    this.truth = Math.abs(amount) >= LEAST && !frame.structural ? {frame, amount} : null;
  }

  /** What the hull would be, or null where that is not known well enough. @param {number} amount @param {number} scale px for 1 m @param {Map<number, Curve>} curves @param {Map<number, Float64Array>} places */
  at(amount, scale, curves, places) {
    if (!this.truth) return null;
    const step = amount - this.truth.amount, bend = this.bends.length ? Math.max(...this.bends) : FIRST;
    this.tried++;
    const sameSide = amount * this.truth.amount > 0 || Math.abs(step) < TURN;
    if (!sameSide || bend * step * step * scale > PIXELS) {
      this.held++;
      return null;
    }
    return between(this.truth.frame, amount / this.truth.amount, curves, places);
  }
}

/** A frame in proportion; null where the knots are others. @param {Frame} frame @param {number} part @param {Map<number, Curve>} curves @param {Map<number, Float64Array>} places @returns {Frame | null} */
function between(frame, part, curves, places) {
  const found = new Map(), at = new Map();
  for (const [id, curve] of frame.curves) {
    const old = curves.get(id);
    if (!old || old.n !== curve.n) return null;
    const xyz = new Float64Array(3 * curve.n), leave = new Float32Array(3 * curve.n), arrive = new Float32Array(3 * curve.n);
    for (let i = 0; i < 3 * curve.n; i++) {
      xyz[i] = old.xyz[i] + part * (curve.xyz[i] - old.xyz[i]);
      leave[i] = old.leave[i] + part * (curve.leave[i] - old.leave[i]);
      arrive[i] = old.arrive[i] + part * (curve.arrive[i] - old.arrive[i]);
    }
    found.set(id, {id, n: curve.n, xyz, leave, arrive});
  }
  for (const [row, place] of frame.places) {
    const old = places.get(row);
    at.set(row, old ? place.map((value, i) => old[i] + part * (value - old[i])) : place);
  }
  return {...frame, curves: found, places: at, volume: part * frame.volume, lcb: part * frame.lcb, normal: Math.abs(part) * frame.normal};
}

/** How far two frames lie apart at their knots, m. @param {Frame} one @param {Frame} other */
function apart(one, other) {
  let most = 0;
  for (const [id, {n, xyz}] of other.curves) {
    const said = one.curves.get(id);
    if (!said || said.n !== n) return Infinity;
    for (let p = 0; p < 3 * n; p += 3) {
      most = Math.max(most, Math.hypot(xyz[p] - said.xyz[p], xyz[p + 1] - said.xyz[p + 1], xyz[p + 2] - said.xyz[p + 2]));
    }
  }
  return most;
}
