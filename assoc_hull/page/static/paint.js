// What is drawn, in order: the hull below, what lives above.

import {combScale, evaluate, inflections, middleMovement, normalMovement, teeth} from "./hermite.js";
import {diamond, drawHandles} from "./marks.js";
import {drawLabels} from "./labels.js";
import {FLATS} from "./net.js";
import {drawBeside, drawPicture} from "./files.js";

/** @typedef {Record<string, string>} Ink */

const LEAST_MOVED = 1e-4; // m
const SLIGHT = 8; // times less than the most is drawn faintly

/** @param {View} view @param {Ink} ink */
export function paintHull(view, ink) {
  const g = view.context(view.lower), {net, curves} = view.store;
  view.stale.hull = false;
  view.rowsShown = null;
  if (!net) return;
  drawPicture(view, g);
  if (view.kind !== "wire") drawGrid(view, g, ink);
  g.lineJoin = "round";
  const families = new Map();
  for (const line of net.lines) {
    if (!view.shows(line)) continue;
    const key = line.family === "boundary" && line.boundary === FLATS ? "flat" : line.family;
    families.set(key, [...(families.get(key) ?? []), line]);
  }
  for (const [key, lines] of families) {
    g.beginPath();
    for (const line of lines) for (const id of line.curves) {
      const c = curves.get(id);
      if (c) view.trace(g, c, line);
    }
    const border = key === "boundary", wire = view.kind === "wire", heavy = border || key === "flat";
    g.strokeStyle = ink[key === "flat" ? "boundary" : key] || ink.ink;
    g.lineWidth = border && !wire ? 1.7 : heavy ? 1.2 : wire ? 0.6 : 1;
    g.globalAlpha = wire && !heavy ? 0.7 : 1;
    g.setLineDash(key === "flat" ? [8, 3, 2, 3] : key === "diagonals" ? [6, 2] : []);
    g.stroke();
  }
  g.setLineDash([]);
  g.globalAlpha = 1;
  view.written = [];
  view.frame = [];
  view.foot = Infinity;
  if (view.store.show.labels) drawLabels(view, g, ink);
}

/** Straight lines of the other families, base line, water line, perpendiculars. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink */
function drawGrid(view, g, ink) {
  const net = view.store.net, {x0, x1, y1, z0, z1} = view.box();
  if (!net) return;
  const body = view.kind === "body", half = view.kind === "half";
  const low = body ? view.at(0, y1, z0, -1) : view.at(x0, 0, z0, 1);
  const high = body ? view.at(0, y1, z1, 1) : view.at(x1, y1, z1, 1);
  const upright = (/** @type {number} */ x) => {
    const at = Math.round(x) + 0.5;
    g.moveTo(at, low[1] + 3);
    g.lineTo(at, high[1] - 3);
  };
  const level = (/** @type {number} */ y) => {
    const at = Math.round(y) + 0.5;
    g.moveTo(low[0] - 3, at);
    g.lineTo(high[0] + 3, at);
  };
  g.strokeStyle = ink.grid;
  g.lineWidth = 1;
  g.beginPath();
  for (const {axis, offset} of net.lines) {
    if (axis === null || offset === null) continue;
    if (axis === 0 && !body) upright(view.at(offset, 0, 0, 1)[0]);
    if (axis === 2 && !half) level(view.at(0, 0, offset, 1)[1]);
    if (axis === 1 && body) for (const side of [-1, 1]) upright(view.at(0, offset, 0, side)[0]);
    if (axis === 1 && half) level(view.at(0, offset, 0, 1)[1]);
  }
  g.stroke();
  g.strokeStyle = ink.soft;
  g.setLineDash([12, 3, 2, 3]);
  g.beginPath();
  level(view.at(0, 0, 0, 1)[1]);
  if (body) upright(view.at(0, 0, 0, 1)[0]);
  else for (const x of [0, net.particulars.length]) upright(view.at(x, 0, 0, 1)[0]);
  g.stroke();
  if (!half) {
    g.strokeStyle = ink.water;
    g.setLineDash([8, 4]);
    g.beginPath();
    level(view.at(0, 0, net.particulars.draught, 1)[1]);
    g.stroke();
  }
  g.setLineDash([]);
}

/** Of each curve of a frame how its knots and the middles between them have moved, found once. @type {[WeakMap<Frame, Map<number, Float64Array | null>>, WeakMap<Frame, Map<number, Float64Array | null>>]} */
const movements = [new WeakMap(), new WeakMap()];

/** @param {Frame} frame @param {Map<number, Curve>} published @param {boolean} [between] of the middles */
function movementOf(frame, published, between = false) {
  const known = movements[Number(between)], find = between ? middleMovement : normalMovement;
  const found = known.get(frame) ?? new Map([...frame.curves].map(([id, curve]) => [id, find(published.get(id), curve)]));
  known.set(frame, found);
  return found;
}

/** The farthest that curves of a frame lie off their published shape, m. @param {Frame} frame @param {Map<number, Curve>} published @param {(id: number) => boolean} [counts] */
export function farthest(frame, published, counts = () => true) {
  let most = 0;
  for (const [id, moved] of movementOf(frame, published)) {
    if (moved && counts(id)) for (let p = 0; p < moved.length; p += 3) most = Math.max(most, Math.hypot(moved[p], moved[p + 1], moved[p + 2]));
  }
  return most;
}

/** The farthest that curves of a frame are drawn off their published shape, m, also between knots. @param {Frame} frame @param {Map<number, Curve>} published */
export function farthestDrawn(frame, published) {
  let most = farthest(frame, published);
  for (const moved of movementOf(frame, published, true).values()) for (const far of moved ?? []) most = Math.max(most, far);
  return most;
}

/** @param {View} view @param {Ink} ink */
export function paintOverlay(view, ink) {
  const g = view.context(view.upper), {store} = view, {net, overlay, selection, hover} = store;
  view.stale.overlay = false;
  if (!net) return;
  g.lineJoin = g.lineCap = "round";
  drawBeside(view, g, ink.soft);
  if (store.ghost) drawGhost(view, g, ink, store.ghost);
  if (store.theirs?.frame) drawGhost(view, g, {...ink, live: ink.water, spike: ink.water}, store.theirs.frame);
  if (overlay) drawMoved(view, g, ink, overlay.frame, overlay.predicted);
  const chosen = selection.curve;
  if (hover.curve !== null && hover.curve !== chosen) stroke(view, g, hover.curve, ink.ink, 1.6);
  if (chosen !== null) stroke(view, g, chosen, ink.ink, view.kind === "wire" ? 1.4 : 2);
  view.note.textContent = noteOf(view); // the factor is known only now
  if (view.kind === "wire") return;
  const carry = store.show.combs ? combed(view) : [];
  for (const id of carry) drawComb(view, g, ink, id, id === chosen);
  // A name is read through what moves: below is the line that it names.
  for (const {box: [l, t, r, b]} of view.written.slice(1)) g.clearRect(l - 1, t, r - l + 2, b - t);
  for (const [l, t, r, b] of view.frame) g.clearRect(l, t, r - l, b - t);
  drawHandles(view, g, ink);
  for (const id of carry) drawInflections(view, g, ink, id);
}

/** @param {View} view */
function noteOf(view) {
  const words = [];
  if (view.kind === "wire") return "";
  const tall = view.sy / view.axis.s;
  if (tall > 1.01) words.push(`compressed × ${tall.toFixed()}`);
  return words.join(" · ");
}

/** @param {View} view @param {CanvasRenderingContext2D} g @param {number} id @param {string} colour @param {number} width */
function stroke(view, g, id, colour, width) {
  const line = view.store.net?.lineOf(id), c = view.store.curveNow(id);
  if (!line || !c) return;
  g.beginPath();
  // A waterline is a straight one in the body plan, and is looked for there, too.
  view.trace(g, c, line);
  g.strokeStyle = colour;
  g.lineWidth = width;
  g.stroke();
}

/** A variant, or what follows the hand of another, dashed. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {Frame} frame */
function drawGhost(view, g, ink, frame) {
  const {net, curves, show, overlay} = view.store, moved = movementOf(frame, curves), between = movementOf(frame, curves, true);
  const top = Math.max(farthestDrawn(frame, curves), 1e-3), wire = view.kind === "wire";
  g.strokeStyle = ink.live;
  g.lineWidth = wire ? 0.7 : 1;
  g.setLineDash([5, 3]);
  // What lies where it is published would only hide it, and what moves far less than the most is no more than touched.
  for (const [low, high, alpha] of [[LEAST_MOVED, top / SLIGHT, 0.2], [Math.max(top / SLIGHT, LEAST_MOVED), Infinity, 0.85]]) {
    g.beginPath();
    for (const [id, c] of frame.curves) {
      const line = net?.lineOf(id), by = moved.get(id);
      if (!line || !view.shows(line)) continue;
      const far = (/** @type {number} */ i) => by ? Math.hypot(by[3 * i], by[3 * i + 1], by[3 * i + 2]) : Infinity, middle = between.get(id);
      view.trace(g, c, line, (i) => {
        const most = Math.max(far(i), far(i + 1), middle?.[i] ?? 0);
        return most >= low && (most < high || high === Infinity);
      });
    }
    g.globalAlpha = wire ? alpha / 2 : alpha;
    g.stroke();
  }
  g.globalAlpha = 1;
  g.setLineDash([]);
  if (show.movement && !overlay && view.kind !== "wire") drawSpikes(view, g, ink, frame, moved);
}

/** Stretches that moved, in three strengths by how far, and the movement itself, magnified. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {Frame} frame @param {boolean} predicted */
function drawMoved(view, g, ink, frame, predicted) {
  const {net, curves, show} = view.store, moved = movementOf(frame, curves);
  if (!net) return;
  const top = Math.max(farthest(frame, curves, (id) => {
    const line = net.lineOf(id);
    return line !== undefined && view.shows(line);
  }), 1e-3);
  g.strokeStyle = ink.live;
  const strengths = /** @type {[number, number, number, number][]} */ ([[LEAST_MOVED, top / 8, 0.35, 0.9], [top / 8, top / 2, 0.75, 1.3], [top / 2, Infinity, 1, 1.9]]);
  for (const [low, high, alpha, width] of strengths) {
    g.beginPath();
    for (const [id, c] of frame.curves) {
      const line = net.lineOf(id), by = moved.get(id);
      if (!line || !view.shows(line)) continue;
      if (!by) {
        if (high === Infinity) view.trace(g, c, line);
        continue;
      }
      const far = (/** @type {number} */ i) => Math.hypot(by[3 * i], by[3 * i + 1], by[3 * i + 2]);
      view.trace(g, c, line, (i) => {
        const most = Math.max(far(i), far(i + 1));
        return most >= low && most < high;
      });
    }
    g.globalAlpha = alpha;
    g.lineWidth = view.kind === "wire" ? width * 0.7 : width;
    g.setLineDash(predicted && view.store.held?.waiting ? [4, 3] : []);
    g.stroke();
  }
  g.setLineDash([]);
  g.globalAlpha = 1;
  if (show.movement && view.kind !== "wire") drawSpikes(view, g, ink, frame, moved);
}

/** The factor by which movements are drawn, one for all views. @param {Store} store @param {Frame} frame @param {number} scale px for 1 m, of the view that is seen largest */
export function magnify(store, frame, scale) {
  store.magnified = magnification(store.magnified, Math.max(farthest(frame, store.curves), 1e-3) * scale);
}

/** @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {Frame} frame @param {Map<number, Float64Array | null>} moved */
function drawSpikes(view, g, ink, frame, moved) {
  const {net, curves, magnified} = view.store;
  g.beginPath();
  for (const [id, now] of frame.curves) {
    const line = net?.lineOf(id), by = moved.get(id), old = curves.get(id);
    if (!line || !by || !old || !view.shows(line)) continue;
    for (const given of view.sides(line) ?? [0]) {
      let last = [-99, -99];
      for (let p = 0; p < by.length; p += 3) {
        const way = by.subarray(p, p + 3);
        if (Math.hypot(way[0], way[1], way[2]) < LEAST_MOVED) continue;
        // From where it was; of another knot, from the nearest place there.
        const [px, py, pz] = old.n === now.n ? old.xyz.subarray(p, p + 3) : [0, 1, 2].map((j) => now.xyz[p + j] - way[j]), side = given || view.side(px);
        const [x, y] = view.at(px, py, pz, side), [dx, dy] = view.seen(way, side);
        if (Math.hypot(x - last[0], y - last[1]) < 7) continue; // a hedge shows nothing
        last = [x, y];
        g.moveTo(x, y);
        g.lineTo(x + magnified * dx, y + magnified * dy);
      }
    }
  }
  g.strokeStyle = ink.spike;
  g.lineWidth = 1.3;
  g.stroke();
}

/** A round factor that makes a movement of some pixels about 36 long; kept while it is legible. @param {number} held @param {number} pixels */
export function magnification(held, pixels) {
  if (held && held * pixels <= 60 && held * pixels >= 12) return held;
  const wanted = Math.min(36 / Math.max(pixels, 1e-9), 1e5), ten = 10 ** Math.floor(Math.log10(wanted));
  const round = [5, 2, 1].find((each) => each * ten <= wanted) ?? 1;
  return Math.max(1, Math.round(round * ten));
}

/** The curves that carry a comb: the chosen one, those through the point in hand, or all that moved. @param {View} view @returns {number[]} */
function combed(view) {
  const {net, overlay, selection, held, show} = view.store, found = new Set();
  if (selection.curve !== null) found.add(selection.curve);
  const row = held?.row ?? selection.row, point = row === null ? undefined : net?.points.get(row);
  if (held && point) for (const id of [point.a, point.b]) if (id >= 0) found.add(id);
  if (show.allCombs && overlay) for (const id of overlay.frame.curves.keys()) found.add(id);
  return [...found].filter((id) => {
    const line = net?.lineOf(id);
    return line !== undefined && view.shows(line) && line.family !== "boundary" || id === selection.curve && line !== undefined && view.shows(line);
  });
}

/** @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {number} id @param {boolean} strong */
function drawComb(view, g, ink, id, strong) {
  const {store} = view, c = store.curveNow(id), line = store.net?.lineOf(id);
  if (!c || !line) return;
  const all = teeth(c, view.a, view.b), scale = scaleOf(view, id) * store.gain, cap = 0.45 * view.height;
  g.strokeStyle = ink.comb;
  g.fillStyle = ink.comb;
  for (const given of view.sides(line) ?? [0]) {
    const tips = all.map((tooth) => {
      const p = 3 * tooth.segment, side = given || view.side((c.xyz[p] + c.xyz[p + 3]) / 2), s = view.kind === "body" ? side : 1;
      const x = view.axis.o + view.axis.s * s * tooth.x, y = view.oy - view.sy * tooth.y;
      // Away from the centre of curvature, square to the curve as it is seen.
      const nx = s * view.sy * tooth.ty, ny = view.axis.s * tooth.tx, size = Math.hypot(nx, ny) || 1;
      const want = scale * tooth.bend, long = Math.min(Math.max(want, -cap), cap) * within(x, y, nx / size * Math.sign(want), ny / size * Math.sign(want), Math.min(Math.abs(want), cap), view);
      return {x, y, X: x + nx / size * long, Y: y + ny / size * long, capped: Math.abs(want - long) > 0.5};
    });
    g.globalAlpha = strong ? 0.5 : 0.28;
    g.lineWidth = 0.8;
    g.beginPath();
    for (const [x, y, X, Y] of evenly(tips, PITCH)) {
      g.moveTo(x, y);
      g.lineTo(X, Y);
    }
    g.stroke();
    g.globalAlpha = strong ? 1 : 0.6;
    g.lineWidth = strong ? 1.3 : 1;
    g.beginPath();
    tips.forEach(({X, Y}, i) => i ? g.lineTo(X, Y) : g.moveTo(X, Y));
    g.stroke();
    for (const {X, Y, capped} of tips) if (capped) g.fillRect(X - 3, Y - 1, 6, 2);
    g.globalAlpha = 1;
  }
}

const PITCH = 5; // px between the teeth of a comb

/** Teeth at one distance along the curve as it is seen, however long its segments are: foot and tip. @param {{x: number, y: number, X: number, Y: number}[]} tips @param {number} pitch px @returns {[number, number, number, number][]} */
export function evenly(tips, pitch) {
  /** @type {[number, number, number, number][]} */
  const found = [];
  let gone = 0, next = 0;
  tips.forEach((p, i) => {
    const q = tips[i + 1], far = q ? Math.hypot(q.x - p.x, q.y - p.y) : 0;
    for (; q && next < gone + far; next += pitch) {
      const t = (next - gone) / far, mix = (/** @type {"x" | "y" | "X" | "Y"} */ key) => p[key] + t * (q[key] - p[key]);
      found.push([mix("x"), mix("y"), mix("X"), mix("Y")]);
    }
    gone += far;
  });
  return found;
}

const MARK = 8; // px: more than a point, which is seen within it

/** Where a curve changes the side to which it bends, around the points that may lie there. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {number} id */
function drawInflections(view, g, ink, id) {
  const c = view.store.curveNow(id), line = view.store.net?.lineOf(id), at = new Float64Array(9);
  if (!c || !line) return;
  for (const given of view.sides(line) ?? [0]) for (const {segment, u} of inflections(c, view.a, view.b)) {
    evaluate(c, segment, u, at);
    const [x, y] = view.at(at[0], at[1], at[2], given || view.side(at[0]));
    if (view.framed(x, y)) continue;
    diamond(g, x, y, MARK);
    for (const [colour, width] of /** @type {[string, number][]} */ ([[ink.paper, 4], [ink.hot, 2]])) {
      g.strokeStyle = colour;
      g.lineWidth = width;
      g.stroke();
    }
  }
}

const EDGE = 3; // px: a tooth that is cut ends so far within the view

/** How much of a tooth lies within the view, above the row of names at its foot: all of it, if its own foot is out of sight. @param {number} x @param {number} y @param {number} dx @param {number} dy @param {number} long px @param {View} view */
function within(x, y, dx, dy, long, {width, height, foot}) {
  height = Math.min(height, foot + EDGE);
  if (x < EDGE || y < EDGE || x > width - EDGE || y > height - EDGE) return 1;
  const room = (/** @type {number} */ at, /** @type {number} */ by, /** @type {number} */ whole) => by > 0 ? (whole - EDGE - at) / by : by < 0 ? (EDGE - at) / by : Infinity;
  return Math.min(1, Math.min(room(x, dx, width), room(y, dy, height)) / Math.max(long, 1e-9));
}

/** One scale for each curve and view, of the published shape: a comb must not breathe with the drag. @param {View} view @param {number} id */
function scaleOf(view, id) {
  const key = `${id}/${view.store.state}/${view.height}`, held = view.scales.get(key);
  if (held !== undefined) return held;
  if (view.scales.size > 500) view.scales.clear();
  const c = view.store.curves.get(id), found = c ? combScale(teeth(c, view.a, view.b), Math.min(60, 0.22 * view.height)) : 0;
  view.scales.set(key, found);
  return found;
}
