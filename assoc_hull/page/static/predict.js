// What will follow the hand, foreseen in proportion to what followed last while the error is less than half a pixel.

/** @typedef {import("./wire.js").Curve} Curve */
/** @typedef {import("./wire.js").Frame} Frame */

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
