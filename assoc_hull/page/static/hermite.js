// Cubic segments: places, tangents, movement; teeth of combs, inflections. It knows no hull and no view.

/** Chord of the segment after knot i. @param {Curve} c @param {number} i */
export function chord(c, i) {
  const p = 3 * i, {xyz} = c;
  return Math.hypot(xyz[p + 3] - xyz[p], xyz[p + 4] - xyz[p + 1], xyz[p + 5] - xyz[p + 2]);
}

/**
 * The four Bezier points of segment i, (x, y, z) each, into `out`.
 * @param {Curve} c @param {number} i @param {Float64Array} out
 */
export function bezier(c, i, out) {
  const p = 3 * i, q = p + 3, {xyz, leave, arrive} = c, third = chord(c, i) / 3;
  for (let j = 0; j < 3; j++) {
    out[j] = xyz[p + j];
    out[3 + j] = xyz[p + j] + third * leave[p + j];
    out[6 + j] = xyz[q + j] - third * arrive[q + j];
    out[9 + j] = xyz[q + j];
  }
}

/**
 * Place, first and second derivative by u in 0..1 of segment i, nine numbers, into `out`.
 * @param {Curve} c @param {number} i @param {number} u @param {Float64Array} out
 */
export function evaluate(c, i, u, out) {
  const p = 3 * i, q = p + 3, {xyz, leave, arrive} = c, h = chord(c, i);
  for (let j = 0; j < 3; j++) {
    const step = xyz[q + j] - xyz[p + j], s = h * leave[p + j], e = h * arrive[q + j];
    const b = 3 * step - 2 * s - e, a = s + e - 2 * step;
    out[j] = xyz[p + j] + u * (s + u * (b + u * a));
    out[3 + j] = s + u * (2 * b + 3 * u * a);
    out[6 + j] = 2 * b + 6 * u * a;
  }
}

const TRIED = 4, STEPS = 6;

/** From the nearest place of a curve to this one. @param {Curve} c @param {ArrayLike<number>} place @returns {[number, number, number]} */
function off(c, place) {
  const at = new Float64Array(9), way = () => [place[0] - at[0], place[1] - at[1], place[2] - at[2]];
  let segment = 0, u = 0, least = Infinity;
  for (let i = 0; i + 1 < c.n; i++) for (let k = 0; k < TRIED; k++) {
    evaluate(c, i, (k + 0.5) / TRIED, at);
    const far = Math.hypot(...way());
    if (far < least) [segment, u, least] = [i, (k + 0.5) / TRIED, far];
  }
  for (let step = 0, turned = false; step < STEPS; step++) {
    evaluate(c, segment, u, at);
    const w = way(), slope = w[0] * at[3] + w[1] * at[4] + w[2] * at[5], speed = at[3] ** 2 + at[4] ** 2 + at[5] ** 2;
    const bend = speed - w[0] * at[6] - w[1] * at[7] - w[2] * at[8], next = u + slope / (bend > 0 ? bend : speed || 1), on = next < 0 ? segment - 1 : segment + 1;
    u = Math.min(Math.max(next, 0), 1);
    if (u === next || turned || on < 0 || on > c.n - 2) continue;
    turned = true; // the nearest place lies in the segment beside
    [segment, u] = [on, 1 - u];
  }
  evaluate(c, segment, u, at);
  const [x, y, z] = way();
  return [x, y, z];
}

/**
 * How far each knot of a curve has left its published shape, normal to that: nine numbers a knot
 * are too many, so (dx, dy, dz) of the normal part; null where there was none. Knots that are others
 * are compared with the nearest places of the published shape.
 * @param {Curve | undefined} old @param {Curve} now @returns {Float64Array | null}
 */
export function normalMovement(old, now) {
  if (!old) return null;
  const found = new Float64Array(3 * now.n);
  for (let p = 0; p < 3 * now.n; p += 3) {
    if (old.n !== now.n) {
      found.set(off(old, now.xyz.subarray(p, p + 3)), p);
      continue;
    }
    const from = p + 3 < 3 * now.n ? old.leave : old.arrive;
    const tx = from[p], ty = from[p + 1], tz = from[p + 2], size = tx * tx + ty * ty + tz * tz || 1;
    const dx = now.xyz[p] - old.xyz[p], dy = now.xyz[p + 1] - old.xyz[p + 1], dz = now.xyz[p + 2] - old.xyz[p + 2];
    const along = (dx * tx + dy * ty + dz * tz) / size;
    found[p] = dx - along * tx;
    found[p + 1] = dy - along * ty;
    found[p + 2] = dz - along * tz;
  }
  return found;
}

/**
 * How far the middle of each segment has left its published shape, m: a new knuckle moves no knot.
 * Null where there was none.
 * @param {Curve | undefined} old @param {Curve} now @returns {Float64Array | null}
 */
export function middleMovement(old, now) {
  if (!old) return null;
  const found = new Float64Array(Math.max(now.n - 1, 0)), then = new Float64Array(9), at = new Float64Array(9);
  for (let i = 0; i + 1 < now.n; i++) {
    evaluate(now, i, 0.5, at);
    if (old.n !== now.n) {
      found[i] = Math.hypot(...off(old, at));
      continue;
    }
    evaluate(old, i, 0.5, then);
    const [dx, dy, dz] = [0, 1, 2].map((j) => at[j] - then[j]), size = Math.hypot(then[3], then[4], then[5]) || 1;
    found[i] = Math.sqrt(Math.max(dx * dx + dy * dy + dz * dz - ((dx * then[3] + dy * then[4] + dz * then[5]) / size) ** 2, 0));
  }
  return found;
}

/** Length of a curve, m. @param {Curve} c */
export function arcLength(c) {
  const at = new Float64Array(9);
  const places = [-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640];
  const weights = [0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891];
  let total = 0;
  for (let i = 0; i + 1 < c.n; i++) {
    for (let k = 0; k < 5; k++) {
      evaluate(c, i, (1 + places[k]) / 2, at);
      total += weights[k] / 2 * Math.hypot(at[3], at[4], at[5]);
    }
  }
  return total;
}

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
