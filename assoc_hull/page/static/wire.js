// Shapes in binary frames, as the Python module `wire` writes them: little endian, sections on 8 bytes.

/** @typedef {{id: number, n: number, xyz: Float64Array, leave: Float32Array, arrive: Float32Array}} Curve */
/**
 * @typedef {object} Frame
 * @property {number} kind 1 all that is published, 2 what a drag would change, 3 what an edit changed, 4 a variant that is shown, 5 what the drag of another would change
 * @property {boolean} structural
 * @property {number} gesture
 * @property {number} seq
 * @property {number} state
 * @property {number} ms
 * @property {number} volume
 * @property {number} lcb
 * @property {number} normal how far the point moves that leaves the hull most, m
 * @property {Map<number, Curve>} curves
 * @property {Map<number, Float64Array>} places
 * @property {number} bytes
 */

export const VERSION = 1;
export const NET = 1, LIVE = 2, PUBLISHED = 3, GHOST = 4, THEIRS = 5;
const HEADER = 48;

/** @param {ArrayBuffer} buffer @returns {Frame} */
export function parseFrame(buffer) {
  const view = new DataView(buffer);
  const version = view.getUint8(0);
  if (version !== VERSION) throw new Error(`the server speaks version ${version}: reload the page`);
  const word = (/** @type {number} */ at) => view.getUint32(at, true);
  const real = (/** @type {number} */ at) => view.getFloat32(at, true);
  const count = word(16), knots = word(20), points = word(24);
  let at = HEADER;
  /** @template T @param {(buffer: ArrayBuffer, at: number, n: number) => T} make @param {number} n @param {number} size @returns {T} */
  const take = (make, n, size) => {
    const found = make(buffer, at, n);
    at += (n * size + 7) & ~7;
    return found;
  };
  const whole = (/** @type {ArrayBuffer} */ b, /** @type {number} */ o, /** @type {number} */ n) => new Uint32Array(b, o, n);
  const double = (/** @type {ArrayBuffer} */ b, /** @type {number} */ o, /** @type {number} */ n) => new Float64Array(b, o, n);
  const single = (/** @type {ArrayBuffer} */ b, /** @type {number} */ o, /** @type {number} */ n) => new Float32Array(b, o, n);
  const ids = take(whole, count, 4), counts = take(whole, count, 4);
  const xyz = take(double, 3 * knots, 8), leave = take(single, 3 * knots, 4), arrive = take(single, 3 * knots, 4);
  const rows = take(whole, points, 4), places = take(double, 3 * points, 8);
  /** @type {Map<number, Curve>} */
  const curves = new Map();
  let first = 0;
  for (let i = 0; i < count; i++) {
    const n = counts[i], last = first + 3 * n, id = ids[i];
    curves.set(id, {id, n, xyz: xyz.subarray(first, last), leave: leave.subarray(first, last), arrive: arrive.subarray(first, last)});
    first = last;
  }
  /** @type {Map<number, Float64Array>} */
  const at3 = new Map();
  for (let i = 0; i < points; i++) at3.set(rows[i], places.subarray(3 * i, 3 * i + 3));
  return {
    kind: view.getUint8(1), structural: (view.getUint16(2, true) & 1) === 1, gesture: word(4), seq: word(8),
    state: word(12), ms: real(28), volume: real(32), lcb: real(36), normal: real(40), curves, places: at3, bytes: buffer.byteLength,
  };
}
