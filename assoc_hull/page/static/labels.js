// Names of lines where they are looked for: stations above and below, waterlines at the left,
// and along the curves; none over another.

import {pathsOf} from "./hit.js";

/** @typedef {import("./view.js").View} View */
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

  /** Writes a label unless it would lie over another, or outside. @param {string} text @param {number} x @param {number} y @param {CanvasTextAlign} align @param {string} colour @param {boolean} [halo] */
  put(text, x, y, align, colour, halo = false) {
    const {g, view} = this, w = g.measureText(text).width;
    const left = align === "center" ? x - w / 2 : align === "right" ? x - w : x;
    if (left < 2 || left + w > view.width - 2 || y < 30 || y > view.height - 6) return false;
    for (const [l, r, t] of this.taken) if (left < r + 4 && left + w > l - 4 && Math.abs(y - t) < HIGH) return false;
    this.taken.push([left, left + w, y]);
    g.textAlign = "left";
    if (halo) {
      g.strokeStyle = this.ink.paper;
      g.lineWidth = 4;
      g.lineJoin = "round";
      g.strokeText(text, left, y);
    }
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
  const left = Math.max(view.at(view.kind === "body" ? 0 : x0, y1, 0, -1)[0] - 8, 40);
  places.left = left;
  const foot = Math.min(view.at(0, 0, z0, 1)[1], view.height - 34);
  if (view.kind === "body") {
    const names = [...of("buttocks")].reverse();
    for (const side of [-1, 1]) for (const line of names) places.put(short(line.name), view.at(0, line.offset ?? 0, 0, side)[0], foot + 12, "center", ink.soft, true);
    stationsAbove(view, places, ink);
    if (view.at(0, 0, z0, 1)[1] < view.height) for (const [text, side] of /** @type {[string, number][]} */ ([["aft", -1], ["fore", 1]])) places.put(text, view.at(0, y1 / 2, 0, side)[0], foot + 26, "center", ink.soft);
  } else {
    places.put("ST", left, foot + 12, "right", ink.soft);
    places.put("AP", view.at(0, 0, 0, 1)[0], foot + 26, "center", ink.soft);
    places.put("FP", view.at(ship.length, 0, 0, 1)[0], foot + 26, "center", ink.soft);
    // Whole stations first, so that halves give way.
    const stations = of("sections").sort((p, q) => Number(!/^\d+$/.test(short(p.name))) - Number(!/^\d+$/.test(short(q.name))));
    for (const line of stations) places.put(short(line.name), view.at(line.offset ?? 0, 0, 0, 1)[0], foot + 12, "center", ink.soft);
  }
  if (view.kind === "half") {
    places.put("CL", left, view.at(0, 0, 0, 1)[1], "right", ink.soft, true);
    column(view, places, "BTK", of("buttocks").map((line) => ({name: short(line.name), y: view.at(0, line.offset ?? 0, 0, 1)[1]})), ink);
    along(view, places, ink);
  } else {
    places.put("DWL", left, view.at(0, 0, ship.draught, 1)[1], "right", ink.water, true);
    places.put("BL", left, view.at(0, 0, 0, 1)[1], "right", ink.soft, true);
    column(view, places, "WL", of("waterlines").map((line) => ({name: short(line.name), y: view.at(0, 0, line.offset ?? 0, 1)[1]})), ink);
    if (view.kind === "profile") along(view, places, ink);
  }
}

/** Names at the left, with their family above the highest. @param {View} view @param {Places} places @param {string} family @param {{name: string, y: number}[]} rows @param {Record<string, string>} ink */
function column(view, places, family, rows, ink) {
  const written = rows.filter(({name, y}) => places.put(name, places.left, y, "right", ink.soft, true)).map(({y}) => y);
  if (written.length) places.put(family, places.left, Math.min(...written) - HIGH - 1, "right", ink.soft, true);
}

/** @param {View} view @param {Places} places @param {Record<string, string>} ink */
function stationsAbove(view, places, ink) {
  const {net, curves} = view.store;
  if (!net) return;
  const found = [];
  for (const line of net.lines) {
    const sides = line.family === "sections" ? view.sides(line) : null, c = curves.get(line.curves[line.curves.length - 1] ?? -1);
    if (!sides || !c) continue;
    const first = c.xyz[2] > c.xyz[3 * c.n - 1] ? 0 : 3 * (c.n - 1);
    for (const side of sides) found.push({full: line.name, name: short(line.name), at: view.at(c.xyz[first], c.xyz[first + 1], c.xyz[first + 2], side)});
  }
  // Whole stations first, so that halves give way.
  found.sort((p, q) => Number(!/^\d+$/.test(p.name)) - Number(!/^\d+$/.test(q.name)));
  const written = new Set();
  for (const {full, name, at: [x, y]} of found) {
    // One that ends outside the picture is named along itself.
    if (y < 20 || y > view.height) continue;
    if ([9, 21].some((above) => places.put(name, x, Math.max(y - above, 30), "center", ink.sections))) written.add(full);
  }
  // Those that have no room above, as where they end at one transom, are named along the lines.
  along(view, places, ink, written, 3 * written.size < found.length ? LEAST_GAP : FREE_GAP);
}

/**
 * Labels on the curves of the view's own family, each where its neighbours are farthest away; none
 * where they are so near that one could not tell whose it is.
 * @param {View} view @param {Places} places @param {Record<string, string>} ink @param {Set<string>} [written] @param {number} [least]
 */
function along(view, places, ink, written = new Set(), least = LEAST_GAP) {
  const {net} = view.store, paths = pathsOf(view);
  if (!net) return;
  /** @type {{name: string, colour: string, x: number, y: number, gap: number}[]} */
  const spots = [];
  const from = Math.max(places.left, 0), to = view.width;
  for (let k = 1; k < COLUMNS; k++) {
    const x = from + (to - from) * k / COLUMNS;
    const met = paths.flatMap(({id, path}) => crossings(path, x).map((y) => ({id, y}))).sort((p, q) => p.y - q.y);
    met.forEach(({id, y}, i) => {
      const line = net.lineOf(id), gap = Math.min(y - (met[i - 1]?.y ?? -Infinity), (met[i + 1]?.y ?? Infinity) - y);
      if (line && line.family !== "boundary" && gap > least) spots.push({name: line.name, colour: ink[line.family] || ink.ink, x, y, gap: Math.min(gap, 40)});
    });
  }
  for (const {name, colour, x, y} of spots.sort((p, q) => q.gap - p.gap)) {
    if (!written.has(name) && places.put(short(name), x, y, "center", colour, true)) written.add(name);
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
