// What is drawn over the lines: points, what the hand holds, how far the hull follows; and names.

import {signed} from "./units.js";
import {ADOPTED, CROSSING, PLACED, SHARED, WATCHED} from "./net.js";

/** @typedef {Record<string, string>} Ink */

const CLOSE = 12; // px between the points of a view from which on all are drawn

/** @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink */
export function drawHandles(view, g, ink) {
  const {store} = view, {net, selection, hover, held, refusal} = store;
  if (!net) return;
  const shown = new Set(view.rows());
  for (const row of dotsOf(view)) if (!view.framed(...view.atPlace(store.placeOf(row) ?? [NaN, NaN, NaN]))) dot(view, g, ink, row, 3, false);
  if (refusal) for (const row of refusal.named) if (shown.has(row) && row !== refusal.row && !view.framed(...view.atPlace(store.placeOf(row) ?? [NaN, NaN, NaN]))) ring(view, g, ink, row, true);
  if (hover.row !== null && shown.has(hover.row)) dot(view, g, ink, hover.row, 4.5, true);
  if (store.theirs && shown.has(store.theirs.row)) {
    const {author, row, frame} = store.theirs, place = frame?.places.get(row) ?? store.places.get(row);
    if (place) named(view, g, ink, place, author);
  }
  if (store.marked) cross(view, g, ink, store.marked);
  if (store.shaping) drawShaping(view, g, ink, store.shaping);
  const chosen = held?.row ?? selection.row;
  if (chosen === null || !shown.has(chosen)) return;
  if (held) drawHeld(view, g, ink);
  else {
    dot(view, g, ink, chosen, 5.5, true);
    ring(view, g, ink, chosen);
  }
}

/** The point that somebody else holds, with the name. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {ArrayLike<number>} place @param {string} author */
function named(view, g, ink, place, author) {
  const [x, y] = view.atPlace(place);
  g.beginPath();
  g.arc(x, y, 6, 0, 7);
  g.fillStyle = ink.water;
  g.fill();
  beside(view, g, ink.paper, ink.water, author, x, y);
}

/** Words beside a point, within the picture. @param {View} view @param {CanvasRenderingContext2D} g @param {string} paper @param {string} colour @param {string} words @param {number} x @param {number} y */
function beside(view, g, paper, colour, words, x, y) {
  g.font = "600 12px system-ui, sans-serif";
  g.textBaseline = "middle";
  const w = g.measureText(words).width, left = x + 16 + w < view.width ? x + 16 : x - 16 - w, at = y < 46 ? y + 18 : y - 14;
  g.lineWidth = 4;
  g.strokeStyle = paper;
  g.strokeText(words, left, at);
  g.fillStyle = colour;
  g.fillText(words, left, at);
}

/** A place that a finding names. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {number[]} place */
function cross(view, g, ink, place) {
  const [x, y] = view.atPlace(place);
  g.beginPath();
  g.arc(x, y, 16, 0, 7);
  for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
    g.moveTo(x + 12 * dx, y + 12 * dy);
    g.lineTo(x + 24 * dx, y + 24 * dy);
  }
  g.strokeStyle = ink.hot;
  g.lineWidth = 2;
  g.stroke();
}

/** Where a line is to pass. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {{curve: number, places: number[][]}} shaping */
function drawShaping(view, g, ink, {curve, places}) {
  const line = view.store.net?.lineOf(curve);
  if (!line || !view.shows(line)) return;
  g.strokeStyle = g.fillStyle = ink.hot;
  g.lineWidth = 2;
  for (const each of places) {
    const [x, y] = view.atPlace(each);
    g.strokeRect(x - 5, y - 5, 10, 10);
    g.fillRect(x - 1, y - 1, 2, 2);
  }
}

/** Points that are drawn without being asked for. @param {View} view @returns {number[]} */
export function dotsOf(view) {
  const {show, selection, net} = view.store, shown = view.rows();
  if (show.points || dense(view)) return shown;
  const own = new Set(selection.curve === null ? [] : net?.rowsOf.get(selection.curve));
  return shown.filter((row) => own.has(row));
}

/** Whether points are so far apart on the screen that all can be drawn. @param {View} view */
function dense(view) {
  const area = [...view.rows()].filter((row) => {
    const place = view.store.placeOf(row);
    if (!place) return false;
    const [x, y] = view.atPlace(place);
    return x > 0 && y > 0 && x < view.width && y < view.height;
  }).length;
  return area > 0 && Math.sqrt(view.width * view.height / area) > 4 * CLOSE;
}

/** Focus is seen in the drawing; what a refusal names has a square. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {number} row @param {boolean} [square] */
function ring(view, g, ink, row, square) {
  const place = view.store.placeOf(row);
  if (!place) return;
  const [x, y] = view.atPlace(place);
  g.beginPath();
  if (square) g.rect(x - 7, y - 7, 14, 14);
  else g.arc(x, y, 10, 0, 7);
  g.strokeStyle = ink.hot;
  g.lineWidth = square ? 2 : 1.2;
  g.stroke();
}

/** What sort of point it is, by its form; filled where the hand moves it, hollow where it is computed. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink @param {number} row @param {number} r @param {boolean} strong */
function dot(view, g, ink, row, r, strong) {
  const place = view.store.placeOf(row), point = view.store.net?.points.get(row);
  if (!place || !point) return;
  const [x, y] = view.atPlace(place);
  if (x < -9 || y < -9 || x > view.width + 9 || y > view.height + 9) return;
  shape(g, point, x, y, r);
  const own = point.sort !== CROSSING || point.role === SHARED;
  g.fillStyle = own ? ink[strong ? "hot" : "ink"] : ink.paper;
  g.fill();
  g.strokeStyle = ink[strong ? "hot" : "ink"];
  g.lineWidth = strong ? 1.8 : 1;
  g.stroke();
}

/** @param {CanvasRenderingContext2D} g @param {Point} point @param {number} x @param {number} y @param {number} r */
function shape(g, point, x, y, r) {
  if (point.sort === PLACED || point.sort === ADOPTED) {
    g.beginPath();
    g.rect(x - r, y - r, 2 * r, 2 * r);
  } else if (point.role === WATCHED) diamond(g, x, y, r + 1);
  else {
    g.beginPath();
    g.arc(x, y, r, 0, 7);
  }
}

/** The point in hand, its ways, the ring of a pull, and how far it is. @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink */
function drawHeld(view, g, ink) {
  const {held, net} = view.store;
  if (!held) return;
  const side = view.side(held.start[0]), [x0, y0] = view.at(held.start[0], held.start[1], held.start[2], side);
  const [x, y] = view.at(held.place[0], held.place[1], held.place[2], side);
  g.strokeStyle = g.fillStyle = ink.hot;
  if (held.how === "pull" && held.radius) {
    const [rx, rg] = held.radius, flat = view.kind === "body";
    g.globalAlpha = 0.7;
    g.setLineDash([5, 4]);
    g.lineWidth = 1;
    g.beginPath();
    g.ellipse(x0, y0, (flat ? rg : rx) * view.axis.s, rg * view.sy, 0, 0, 7);
    g.stroke();
    g.setLineDash([]);
    g.globalAlpha = 1;
  }
  for (const way of waysOf(held)) arrows(view, g, way, side, x, y);
  if (Math.hypot(x - x0, y - y0) > 2) {
    g.lineWidth = 1;
    g.beginPath();
    g.moveTo(x0, y0);
    g.lineTo(x, y);
    g.stroke();
  }
  const point = net?.points.get(held.row);
  if (point) shape(g, point, x, y, 6);
  g.fillStyle = held.refused ? ink.paper : ink.hot;
  g.lineWidth = 2;
  g.fill();
  g.stroke();
  if (held.amount === null) return;
  beside(view, g, ink.paper, ink.hot, `${held.how === "pull" ? "hull" : "point"} ${signed(1e3 * held.amount, 1, "mm")}`, x, y);
}

/** @param {Held} held @returns {number[][]} */
function waysOf(held) {
  if (held.how === "pull") return held.way ? [held.way] : [];
  return [...held.free].map((name) => ["x", "y", "z"].map((each) => each === name ? 1 : 0));
}

/** @param {View} view @param {CanvasRenderingContext2D} g @param {number[]} way @param {number} side @param {number} x @param {number} y */
function arrows(view, g, way, side, x, y) {
  let [dx, dy] = view.seen(way, side);
  const size = Math.hypot(dx, dy), whole = Math.hypot(way[0], way[1], way[2]);
  if (size < 0.15 * whole * Math.min(view.axis.s, view.sy)) return;
  dx /= size;
  dy /= size;
  g.lineWidth = 1.8;
  for (const sign of [1, -1]) {
    const ex = x + sign * 26 * dx, ey = y + sign * 26 * dy;
    g.beginPath();
    g.moveTo(x + sign * 10 * dx, y + sign * 10 * dy);
    g.lineTo(ex, ey);
    g.stroke();
    g.beginPath();
    g.moveTo(ex + sign * 7 * dx, ey + sign * 7 * dy);
    g.lineTo(ex - 4 * dy, ey + 4 * dx);
    g.lineTo(ex + 4 * dy, ey - 4 * dx);
    g.closePath();
    g.fill();
  }
}

/** @param {CanvasRenderingContext2D} g @param {number} x @param {number} y @param {number} r */
export function diamond(g, x, y, r) {
  g.beginPath();
  g.moveTo(x, y - r);
  g.lineTo(x + r, y);
  g.lineTo(x, y + r);
  g.lineTo(x - r, y);
  g.closePath();
}
