// What is drawn over the lines: points, what the hand holds, how far the hull follows; and names.

import {pathsOf} from "./view.js";
import {signed} from "./units.js";
import {ADOPTED, CROSSING, PLACED, SHARED, WATCHED} from "./net.js";

/** @typedef {import("./view.js").View} View */
/** @typedef {import("./net.js").Point} Point */
/** @typedef {Record<string, string>} Ink */

const CLOSE = 12; // px between the points of a view from which on all are drawn

/** @param {View} view @param {CanvasRenderingContext2D} g @param {Ink} ink */
export function drawHandles(view, g, ink) {
  const {store} = view, {net, selection, hover, held, show, refusal} = store;
  if (!net) return;
  const shown = new Set(view.rows());
  const drawn = new Set(show.points || dense(view) ? shown : selection.curve === null ? [] : net.rowsOf.get(selection.curve) ?? []);
  for (const row of drawn) if (shown.has(row)) dot(view, g, ink, row, 3, false);
  if (refusal) for (const row of refusal.named) if (shown.has(row) && row !== refusal.row) ring(view, g, ink, row, true);
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
  beside(view, g, ink.paper, ink.hot, signed(1e3 * held.amount, 1, "mm"), x, y);
}

/** @param {import("./store.js").Held} held @returns {number[][]} */
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

/** @typedef {import("./net.js").Line} Line */

const LETTERS = "11px system-ui, sans-serif", HIGH = 12;
const COLUMNS = 48, LEAST_GAP = 5, FREE_GAP = 9; // px

class Places {
  /** @param {CanvasRenderingContext2D} g @param {View} view @param {Record<string, string>} ink */
  constructor(g, view, ink) {
    this.g = g;
    this.view = view;
    this.ink = ink;
    /** @type {number[][]} */
    this.taken = [];
    this.left = 0;
  }

  /** Writes a label unless it would lie over another, or outside. @param {string} text @param {number} x @param {number} y @param {CanvasTextAlign} align @param {string} colour */
  put(text, x, y, align, colour) {
    const {g, view} = this, w = g.measureText(text).width;
    const left = align === "center" ? x - w / 2 : align === "right" ? x - w : x;
    if (left < 2 || left + w > view.width - 2 || y < 30 || y > view.height - 6) return false;
    for (const [l, r, t] of this.taken) if (left < r + 4 && left + w > l - 4 && Math.abs(y - t) < HIGH) return false;
    this.taken.push([left, left + w, y]);
    g.textAlign = "left";
    // A line that shows through a point reads as a colon.
    g.fillStyle = this.ink.paper;
    g.fillRect(left - 1, y - 6, w + 2, HIGH);
    g.fillStyle = colour;
    g.fillText(text, left, y);
    return true;
  }
}

/** @param {string} name */
const short = (name) => name.replace(/^(ST|WL|BTK|DIA|FR) /, "");

/** @param {View} view @param {CanvasRenderingContext2D} g @param {Record<string, string>} ink */
export function drawLabels(view, g, ink) {
  const net = view.store.net;
  if (!net || view.kind === "wire") return;
  g.font = LETTERS;
  g.textBaseline = "middle";
  const places = new Places(g, view, ink), {x0, y1, z0} = view.box(), ship = net.particulars;
  const of = (/** @type {string} */ family) => net.lines.filter((line) => line.family === family && line.offset !== null && line.axis !== null);
  const left = places.left = Math.max(view.at(view.kind === "body" ? 0 : x0, y1, 0, -1)[0] - 8, 40);
  const foot = Math.min(view.at(0, 0, z0, 1)[1], view.height - 34);
  places.put(view.kind === "body" ? "BTK" : "ST", left, foot + 12, "right", ink.soft); // first, or a label has its place
  if (view.kind !== "half") {
    places.put("DWL", left, view.at(0, 0, ship.draught, 1)[1], "right", ink.water);
    places.put("BL", left, view.at(0, 0, 0, 1)[1], "right", ink.soft);
    column(places, "WL", of("waterlines").map((line) => ({name: short(line.name), y: view.at(0, 0, line.offset ?? 0, 1)[1]})));
  }
  if (view.kind === "body") {
    const names = [...of("buttocks")].reverse();
    for (const side of [-1, 1]) for (const line of names) places.put(short(line.name), view.at(0, line.offset ?? 0, 0, side)[0], foot + 12, "center", ink.soft);
    stationsAbove(view, places, ink);
    if (view.at(0, 0, z0, 1)[1] < view.height) for (const [text, side] of /** @type {[string, number][]} */ ([["aft", -1], ["fore", 1]])) places.put(text, view.at(0, y1 / 2, 0, side)[0], foot + 26, "center", ink.soft);
  } else {
    places.put("AP", view.at(0, 0, 0, 1)[0], foot + 26, "center", ink.soft);
    places.put("FP", view.at(ship.length, 0, 0, 1)[0], foot + 26, "center", ink.soft);
    // Whole stations first, so that halves give way.
    const stations = of("sections").sort((p, q) => Number(!/^\d+$/.test(short(p.name))) - Number(!/^\d+$/.test(short(q.name))));
    for (const line of stations) places.put(short(line.name), view.at(line.offset ?? 0, 0, 0, 1)[0], foot + 12, "center", ink.soft);
  }
  if (view.kind === "half") {
    places.put("CL", left, view.at(0, 0, 0, 1)[1], "right", ink.soft);
    column(places, "BTK", of("buttocks").map((line) => ({name: short(line.name), y: view.at(0, line.offset ?? 0, 0, 1)[1]})));
    along(view, places, ink);
  } else if (view.kind === "profile") along(view, places, ink);
}

/** Names at the left, with their family above the highest. @param {Places} places @param {string} family @param {{name: string, y: number}[]} rows */
function column(places, family, rows) {
  const {ink} = places;
  // One at the edge leaves no room for the family.
  const written = rows.filter(({name, y}) => y >= 30 + HIGH + 1 && places.put(name, places.left, y, "right", ink.soft)).map(({y}) => y);
  if (written.length) places.put(family, places.left, Math.min(...written) - HIGH - 1, "right", ink.soft);
}

/** @param {View} view @param {Places} places @param {Record<string, string>} ink */
function stationsAbove(view, places, ink) {
  const {net, curves} = view.store;
  if (!net) return;
  const found = [];
  for (const line of net.lines) {
    const sides = line.family === "sections" ? view.sides(line) : null;
    // A line of several curves is named where it ends highest.
    const ends = line.curves.flatMap((id) => { const c = curves.get(id); return c ? [c.xyz.subarray(0, 3), c.xyz.subarray(-3)] : []; }).sort((p, q) => q[2] - p[2]);
    if (sides && ends.length) for (const side of sides) found.push({full: line.name + true, name: short(line.name), at: view.at(ends[0][0], ends[0][1], ends[0][2], side)});
  }
  // Whole stations first, so that halves give way.
  found.sort((p, q) => Number(!/^\d+$/.test(p.name)) - Number(!/^\d+$/.test(q.name)));
  const written = new Set(), top = view.at(0, 0, view.box().z1, 1)[1];
  if (top > 20) places.put("ST", Math.max(places.left - 38, 4), Math.max(top - 21, 30), "left", ink.sections);
  for (const {full, name, at: [x, y]} of found) {
    // One that ends outside the picture is named along itself.
    if (y < 20 || y > view.height) continue;
    if ([9, 21].some((above) => places.put(name, x, Math.max(y - above, 30), "center", ink.sections))) written.add(full);
  }
  // Those without room above, as at one transom, are named along the lines.
  along(view, places, ink, written, 3 * written.size < found.length ? LEAST_GAP : FREE_GAP);
}

/**
 * Labels on the curves of the view's own family, each where its neighbours are farthest away, along
 * the ship once in either half; none where one could not tell whose it is.
 * @param {View} view @param {Places} places @param {Record<string, string>} ink @param {Set<string>} [written] @param {number} [least]
 */
function along(view, places, ink, written = new Set(), least = LEAST_GAP) {
  const {net} = view.store, paths = pathsOf(view);
  if (!net) return;
  /** @type {{name: string, colour: string, x: number, y: number, gap: number, align: CanvasTextAlign}[]} */
  const spots = [], middle = view.at(net.particulars.length / 2, 0, 0, 1)[0];
  const from = Math.max(places.left, 0), to = view.width;
  for (let k = 1; k < COLUMNS; k++) {
    const x = from + (to - from) * k / COLUMNS, off = view.kind === "body" ? x - view.at(0, 0, 0, 1)[0] : Infinity;
    // Over the centre plane it would name aft and fore body.
    if (Math.abs(off) < 4) continue;
    const align = Math.abs(off) > 20 ? "center" : off < 0 ? "right" : "left";
    const met = paths.flatMap(({id, path}) => crossings(path, x).map((y) => ({id, y}))).sort((p, q) => p.y - q.y);
    met.forEach(({id, y}, i) => {
      const line = net.lineOf(id), gap = Math.min(y - (met[i - 1]?.y ?? -Infinity), (met[i + 1]?.y ?? Infinity) - y);
      if (line && line.family !== "boundary" && gap > least) spots.push({name: line.name, colour: ink[line.family] || ink.ink, x, y, align, gap: Math.min(gap, 40)});
    });
  }
  for (const {name, colour, x, y, align} of spots.sort((p, q) => q.gap - p.gap)) {
    const key = name + (view.kind === "body" || x > middle);
    if (!written.has(key) && places.put(short(name), x, y, align, colour)) written.add(key);
  }
}

/** Where a path meets an upright line. @param {Float32Array} path @param {number} x */
function crossings(path, x) {
  const found = [];
  for (let i = 0; i + 3 < path.length; i += 2) {
    const a = path[i], b = path[i + 2];
    if (a <= x !== b <= x) found.push(path[i + 1] + (path[i + 3] - path[i + 1]) * (x - a) / (b - a));
  }
  return found;
}
