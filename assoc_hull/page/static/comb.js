// Curvature in the plane of a view: teeth, their scale, and where the bend changes its side.

import {evaluate} from "./hermite.js";

/** @typedef {import("./wire.js").Curve} Curve */
/** @typedef {{x: number, y: number, tx: number, ty: number, bend: number, segment: number, u: number}} Tooth */

const PARTS = 8;

/**
 * Places along a curve in the axes a and b, unit tangents there, and signed curvature, 1/m.
 * @param {Curve} c @param {number} a @param {number} b @returns {Tooth[]}
 */
export function teeth(c, a, b) {
  const at = new Float64Array(9);
  /** @type {Tooth[]} */
  const found = [];
  for (let i = 0; i + 1 < c.n; i++) {
    for (let k = 0; k <= PARTS; k++) {
      const u = k / PARTS;
      evaluate(c, i, u, at);
      const tx = at[3 + a], ty = at[3 + b], speed = Math.hypot(tx, ty);
      if (speed < 1e-9) continue;
      const bend = (tx * at[6 + b] - ty * at[6 + a]) / (speed * speed * speed);
      found.push({x: at[a], y: at[b], tx: tx / speed, ty: ty / speed, bend, segment: i, u});
    }
  }
  return found;
}

/** Pixels for a curvature of 1/m so that most teeth are `high` at most. @param {Tooth[]} all @param {number} high */
export function combScale(all, high) {
  const sizes = all.map((tooth) => Math.abs(tooth.bend)).sort((p, q) => p - q);
  const usual = sizes[Math.floor(0.9 * sizes.length)] || 0;
  return high / Math.max(usual, 1e-5);
}

const STRAIGHT = 1e-9, LEAST = 0.2 * Math.PI / 180;

/**
 * Inflections of a curve in the axes a and b, by the rule of the library: a lobe counts where it
 * turns by a fifth of a degree. Each is told by segment and u.
 * @param {Curve} c @param {number} a @param {number} b @returns {{segment: number, u: number}[]}
 */
export function inflections(c, a, b) {
  /** @type {{turn: number, begin: number, end: number}[]} */
  const lobes = [];
  for (let i = 0; i + 1 < c.n; i++) {
    for (const part of partsOf(c, i, a, b)) {
      const last = lobes[lobes.length - 1];
      if (last && Math.sign(last.turn) === Math.sign(part.turn)) {
        last.turn += part.turn;
        last.end = part.end;
      } else lobes.push(part);
    }
  }
  return changes(lobes).map((at) => {
    const middle = (lobes[at].end + lobes[at + 1].begin) / 2, segment = Math.min(Math.floor(middle), c.n - 2);
    return {segment, u: middle - segment};
  });
}

/** Stretches of segment i that bend to one side. @param {Curve} c @param {number} i @param {number} a @param {number} b */
function partsOf(c, i, a, b) {
  const at = new Float64Array(9);
  evaluate(c, i, 0, at);
  const p0 = at[3 + a], q0 = at[3 + b], p1 = at[6 + a], q1 = at[6 + b];
  evaluate(c, i, 1, at);
  const p2 = at[3 + a] - p0 - p1, q2 = at[3 + b] - q0 - q1;
  const zero = p0 * q1 - q0 * p1, one = 2 * (p0 * q2 - q0 * p2), two = p1 * q2 - q1 * p2;
  const edges = [0];
  for (const u of cuts(zero, one, two)) if (u > 0 && u < 1) edges.push(u);
  edges.push(1);
  edges.sort((x, y) => x - y);
  const slope = (/** @type {number} */ u) => [p0 + u * (p1 + u * p2), q0 + u * (q1 + u * q2)];
  const found = [];
  for (let k = 0; k + 1 < edges.length; k++) {
    const [px, py] = slope(edges[k]), [qx, qy] = slope(edges[k + 1]);
    const turn = Math.atan2(px * qy - py * qx, px * qx + py * qy);
    if (Math.abs(turn) > STRAIGHT) found.push({turn, begin: i + edges[k], end: i + edges[k + 1]});
  }
  return found;
}

/** Where zero + one u + two u^2 vanishes, and its vertex. @param {number} zero @param {number} one @param {number} two */
function cuts(zero, one, two) {
  if (two === 0) return one === 0 ? [] : [-zero / one];
  const vertex = -one / (2 * two), inside = one * one - 4 * two * zero;
  if (inside < 0) return [vertex];
  const half = -(one + Math.sign(one || 1) * Math.sqrt(inside)) / 2;
  return half === 0 ? [vertex] : [vertex, half / two, zero / half];
}

/** After which lobes the bend changes its side, small ones taken into their neighbours. @param {{turn: number}[]} lobes */
function changes(lobes) {
  /** @type {number[]} */
  const found = [];
  let side = 0, at = -1, heading = 0, high = 0, low = 0, peak = 0;
  lobes.forEach(({turn}, index) => {
    heading += turn;
    if (side === 0) {
      high = Math.max(high, heading);
      low = Math.min(low, heading);
      if (Math.max(heading - low, high - heading) >= LEAST) [side, peak, at] = [turn > 0 ? 1 : -1, heading, index];
    } else if (side * (heading - peak) > 0) [peak, at] = [heading, index];
    else if (side * (peak - heading) >= LEAST) {
      found.push(at);
      [side, peak, at] = [-side, heading, index];
    }
  });
  return found;
}
