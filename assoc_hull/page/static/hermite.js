// Cubic segments between knots, with derivatives by chord length; knows no hull and no view.

/** @typedef {import("./wire.js").Curve} Curve */

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

/**
 * How far each knot of a curve has left its published shape, normal to that: nine numbers a knot
 * are too many, so (dx, dy, dz) of the normal part; null where the knots are others.
 * @param {Curve | undefined} old @param {Curve} now @returns {Float64Array | null}
 */
export function normalMovement(old, now) {
  if (!old || old.n !== now.n) return null;
  const found = new Float64Array(3 * now.n);
  for (let p = 0; p < 3 * now.n; p += 3) {
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
 * Null where the knots are others.
 * @param {Curve | undefined} old @param {Curve} now @returns {Float64Array | null}
 */
export function middleMovement(old, now) {
  if (!old || old.n !== now.n) return null;
  const found = new Float64Array(Math.max(now.n - 1, 0)), then = new Float64Array(9), at = new Float64Array(9);
  for (let i = 0; i + 1 < now.n; i++) {
    evaluate(old, i, 0.5, then);
    evaluate(now, i, 0.5, at);
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
