// Modules of the page that need no browser, against what the library has written beside them.

import assert from "node:assert/strict";
import {readFileSync} from "node:fs";
import {test} from "node:test";
import {ACTIONS, keyName, keyWords} from "./actions.js";
import {evaluate, middleMovement, normalMovement} from "./hermite.js";
import {Predictor} from "./hand.js";
import {Net, alike} from "./net.js";
import {NET, parseFrame} from "./wire.js";

const given = JSON.parse(readFileSync("given.json", "utf8")), raw = readFileSync("net.frame");
const frame = parseFrame(raw.buffer.slice(raw.byteOffset, raw.byteOffset + raw.byteLength));

test("a frame has what was packed", () => {
  assert.equal(frame.kind, NET);
  assert.deepEqual([...frame.curves.keys()], given.curves);
  assert.deepEqual([...frame.curves.values()].map(({n}) => n), given.counts);
  assert.deepEqual([...frame.places.keys()], given.rows);
});

test("a frame of another version is refused", () => {
  const other = raw.buffer.slice(raw.byteOffset, raw.byteOffset + raw.byteLength);
  new DataView(other).setUint8(0, 99);
  assert.throws(() => parseFrame(other), /reload the page/);
});

test("places along curves are those of the library", () => {
  const out = new Float64Array(9);
  for (const {id, segment, u, place} of given.places) {
    evaluate(frame.curves.get(id), segment, u, out);
    // End derivatives travel in single precision.
    for (let j = 0; j < 3; j++) assert.ok(Math.abs(out[j] - place[j]) < 2e-6, `${id} ${segment} ${u}`);
  }
});

/** The frame with all heights raised by a, and by b times its square. */
function raised(a, b) {
  const curves = new Map([...frame.curves].map(([id, c]) => [id, {...c, xyz: c.xyz.map((value, i) => i % 3 === 2 ? value + a + b * a * a : value)}]));
  return {...frame, curves, places: new Map()};
}

test("what grows in proportion is foreseen, on the same side only", () => {
  const predictor = new Predictor(), none = new Map();
  for (const a of [0.01, 0.02]) predictor.learn(raised(a, 0), a, frame.curves, none);
  const found = predictor.at(0.05, 100, frame.curves, none);
  const [[id, c]] = found.curves;
  assert.ok(Math.abs(c.xyz[2] - frame.curves.get(id).xyz[2] - 0.05) < 1e-12);
  assert.equal(predictor.at(-0.05, 100, frame.curves, none), null);
});

test("what bends is foreseen only while that is seen by less than half a pixel", () => {
  const predictor = new Predictor(), none = new Map();
  for (const a of [0.01, 0.02, 0.03]) predictor.learn(raised(a, 5), a, frame.curves, none);
  assert.notEqual(predictor.at(0.032, 100, frame.curves, none), null);
  assert.equal(predictor.at(0.2, 100, frame.curves, none), null);
});

test("another structure is not foreseen", () => {
  const predictor = new Predictor(), none = new Map();
  predictor.learn({...raised(0.01, 0), structural: true}, 0.01, frame.curves, none);
  assert.equal(predictor.at(0.011, 100, frame.curves, none), null);
});

test("each action has words, and each key one effect", () => {
  const keys = ACTIONS.flatMap((each) => each.keys);
  assert.equal(new Set(keys).size, keys.length);
  for (const {id, words, keys: own} of ACTIONS) assert.ok(id && words && own.length && own.every(keyWords), id);
  assert.equal(keyName({key: "Z", ctrlKey: true, shiftKey: true, altKey: false, metaKey: false}), "Ctrl+Shift+z");
});

test("names are compared as people write them", () => {
  for (const [one, other] of [["WL 0.5 x ST 7", "wl 0,50 X st07"], ["BTK 2", "btk2.0"], ["ST 10", "st 010"], ["WL 1 × ST 3", "WL 1 x ST 3"]]) assert.equal(alike(one), alike(other));
  for (const [one, other] of [["ST 1", "ST 10"], ["WL 0.5", "WL 5"], ["WL 0.05", "WL 0.5"], ["ST 100", "ST 1"], ["BTK 0.5 x WL 1 #2", "BTK 0.5 x WL 1"]]) assert.notEqual(alike(one), alike(other));
});

/** A curve with a knot more in the middle of each segment, which lies where the curve lay, and all of it raised by a. */
function finer(c, a) {
  const out = new Float64Array(9), xyz = [], leave = [], arrive = [];
  const chords = Array.from({length: c.n - 1}, (_, i) => Math.hypot(...[0, 1, 2].map((j) => c.xyz[3 * i + 3 + j] - c.xyz[3 * i + j])));
  for (let i = 0; i + 1 < c.n; i++) for (const u of [0, 0.5]) {
    evaluate(c, i, u, out);
    xyz.push(out[0], out[1], out[2] + a);
    const rate = [out[3], out[4], out[5]];
    leave.push(...rate.map((each) => each / chords[i]));
    arrive.push(...(u || !i ? rate.map((each) => each / chords[i]) : [...c.arrive.subarray(3 * i, 3 * i + 3)]));
  }
  xyz.push(...c.xyz.subarray(-3, -1), c.xyz.at(-1) + a);
  leave.push(...c.leave.subarray(-3));
  arrive.push(...c.arrive.subarray(-3));
  // Derivatives are by chord: those of halves are longer or shorter than half the whole.
  const n = 2 * c.n - 1, half = (i) => Math.hypot(...[0, 1, 2].map((j) => xyz[3 * i + 3 + j] - xyz[3 * i + j]));
  for (let i = 0; i + 1 < n; i++) {
    const times = chords[i >> 1] / 2 / half(i);
    for (let j = 0; j < 3; j++) {
      leave[3 * i + j] *= times;
      arrive[3 * i + 3 + j] *= times;
    }
  }
  return {id: c.id, n, xyz: Float64Array.from(xyz), leave: Float32Array.from(leave), arrive: Float32Array.from(arrive)};
}

test("a curve of other knots has moved as far as it lies from where it lay", () => {
  for (const c of frame.curves.values()) {
    const same = finer(c, 0);
    for (const far of [...normalMovement(c, same), ...middleMovement(c, same)]) assert.ok(Math.abs(far) < 1e-5, `${c.id}: ${far}`);
    const up = finer(c, 0.01), moved = normalMovement(c, up);
    for (let p = 0; p < moved.length; p += 3) assert.ok(Math.hypot(moved[p], moved[p + 1], moved[p + 2]) < 0.01 + 1e-5);
  }
  const flat = [...frame.curves.values()].find((c) => c.xyz.every((value, i) => i % 3 !== 2 || value === c.xyz[2])), up = finer(flat, 0.01);
  for (const far of middleMovement(flat, up)) assert.ok(Math.abs(far - 0.01) < 1e-5, String(far));
});

test("names in a row stand apart, within the row, each as near as can be", async () => {
  const {spread} = await import("./labels.js");
  assert.deepEqual(spread([5, 50], [10, 10], 0, 100), [5, 50]);
  assert.deepEqual(spread([50, 50, 50], [10, 10, 10], 0, 100), [40, 50, 60]);
  assert.deepEqual(spread([1, 2, 99], [10, 20, 10], 0, 100).map((x) => Math.round(x)), [5, 20, 95]);
  assert.deepEqual(spread([], [], 0, 100), []);
});

test("a sentence names single points as a person says them", () => {
  const column = (...each) => each, points = {row: column(7), name: column("BTK 0.92 @ adopted 5"), label: column(""), a: column(3), b: column(-1), sort: column(2), role: column(-1), driver: column(-1), kind: column([0, 0]), free: column("x"), held: column(0)};
  const line = {id: 0, name: "BTK 0.92", family: "buttocks", axis: 1, offset: 1, boundary: 0, curves: [3], names: ["BTK 0.92"]}, net = new Net({particulars: {}, lines: [line], points});
  assert.equal(net.said("lead BTK 0.92 by BTK 0.92 @ adopted 5, 3.0 mm"), "lead BTK 0.92 by given point 5 of BTK 0.92, 3.0 mm");
  assert.equal(net.said("BTK 0.92 @ placed 1 and BTK 0.92 @ placed 2"), "placed point 1 of BTK 0.92 and placed point 2 of BTK 0.92");
  assert.equal(net.said("faired by a noise of 2 mm, stated: 185 points could move, rms 0.20 mm, largest 1.42 mm"), "waviness of 2 mm is taken out: 185 points could move");
  assert.equal(net.said("of another hull: ST 9 @ adopted 5"), "of another hull: ST 9 @ adopted 5");
  assert.equal(net.find("given point 5 of btk 0,92"), 7);
  assert.equal(net.find("BTK 0.92 @ adopted 5"), 7);
});

test("teeth of a comb stand at one distance, however long the segments are", async () => {
  const {evenly} = await import("./paint.js");
  const tips = [0, 1, 2, 3, 4, 4, 40, 100].map((x) => ({x, y: 0, X: x, Y: x}));
  const found = evenly(tips, 5);
  assert.deepEqual(found.map(([x]) => x), Array.from({length: 20}, (_, i) => 5 * i));
  for (const [x, y, X, Y] of found) assert.ok(y === 0 && Math.abs(X - x) < 1e-9 && Math.abs(Y - x) < 1e-9);
});
