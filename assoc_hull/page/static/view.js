// One view: its two canvases, what it shows, where things lie on the screen, what is under the pointer.

import {make} from "./elements.js";
import {bezier} from "./hermite.js";

/** @typedef {"body" | "profile" | "half" | "wire"} Kind */
/** Lengths of the ship on the screen; profile and half-breadth plan share one. @typedef {{o: number, s: number}} Axis */
/** A name and the room that it takes: left, top, right, bottom. @typedef {{text: string, box: number[], colour: string, turned: boolean}} Name */
/** @typedef {{x0: number, x1: number, y1: number, z0: number, z1: number}} Box */

export const TITLES = {body: "Body plan", profile: "Profile", half: "Half-breadth plan", wire: "Wire"};
const OWN = {body: ["sections", "frames"], profile: ["buttocks"], half: ["waterlines", "diagonals"], wire: []};
const PLANE = {body: [1, 2], profile: [0, 2], half: [0, 1], wire: [0, 2]};
const MARGINS = {body: [46, 52, 16, 36], profile: [46, 38, 16, 34], half: [46, 38, 16, 34], wire: [20, 30, 20, 20]};
const FLAT = 1e-6, WIDE = 600; // m, px

export class View {
  /** @param {Kind} kind @param {Store} store @param {Axis} axis @param {HTMLElement} parent */
  constructor(kind, store, axis, parent) {
    this.kind = kind;
    this.store = store;
    this.axis = axis;
    /** @type {View | null} */
    this.partner = null;
    this.a = PLANE[kind][0];
    this.b = PLANE[kind][1];
    this.oy = 0;
    this.sy = 1;
    this.yaw = -0.62;
    this.pitch = 0.42;
    this.width = this.height = 0;
    /** The last size that was seen. */
    this.set = [0, 0];
    this.fitted = true;
    this.stale = {hull: true, overlay: true};
    this.element = make("section", {className: `view view-${kind}`, ariaLabel: TITLES[kind]});
    this.note = make("span", {className: "note"});
    this.head = make("header", {}, make("h2", {}, TITLES[kind]), this.note);
    this.lower = make("canvas");
    this.upper = make("canvas", {tabIndex: 0, ariaLabel: `${TITLES[kind]}: drawing`});
    this.upper.setAttribute("role", "application");
    this.tip = make("div", {className: "tip", hidden: true});
    this.element.append(this.lower, this.upper, this.head, this.tip);
    parent.append(this.element);
    /** @type {{id: number, path: Float32Array}[]} */
    this.paths = [];
    this.pathsStale = true;
    /** @type {number[] | null} */
    this.rowsShown = null;
    /** A picture to trace: its upper left corner and the size of its pixels, m. @type {{image: ImageBitmap, x: number, y: number, across: number, up: number} | null} */
    this.picture = null;
    /** Names on the drawing; the first is the title. @type {Name[]} */
    this.written = [];
    /** Boxes at the edge, of names of the grid alone. @type {number[][]} */
    this.frame = [];
    /** Where names of lines stand while nobody looks elsewhere: where each meets its line, and how it is led there. @type {{look: string, spots: Map<string, {x: number, y: number, led: boolean, up: boolean}>}} */
    this.standing = {look: "", spots: new Map()};
    /** Below it is the row of names of the grid, which no comb covers. */
    this.foot = Infinity;
    /** @type {Map<string, number>} */
    this.scales = new Map();
  }

  /** @param {HTMLCanvasElement} canvas */
  context(canvas) {
    const found = canvas.getContext("2d");
    if (!found) throw new Error("this browser draws no Canvas 2D");
    const d = devicePixelRatio || 1;
    found.setTransform(d, 0, 0, d, 0, 0);
    found.clearRect(0, 0, this.width, this.height);
    return found;
  }

  /** Takes the size that the page gives it; tells whether that is another. */
  measure() {
    const {clientWidth: w, clientHeight: h} = this.element, d = devicePixelRatio || 1;
    const same = w === this.width && h === this.height && this.lower.width === Math.round(w * d);
    if (same) return false;
    this.width = w;
    this.height = h;
    for (const canvas of [this.lower, this.upper]) {
      canvas.width = Math.round(w * d);
      canvas.height = Math.round(h * d);
    }
    this.touch();
    return true;
  }

  /** What was in the middle stays there. @param {boolean} across */
  settle(across) {
    if (!this.shown) return;
    const [w, h] = this.set;
    if (w && across) this.axis.o += (this.width - w) / 2;
    if (h) this.oy += (this.height - h) / 2;
    this.set = [this.width, this.height];
  }

  touch() {
    this.stale.hull = this.stale.overlay = this.pathsStale = true;
  }

  get shown() { return this.width > 0 && this.height > 0; }

  /** Whether its lines stand upright, as stations do. */
  get steep() { return this.kind === "profile" && this.store.squeeze > 2; }

  /** Left, above, right, below, px; names that stand upright need more. @returns {number[]} */
  get margins() {
    const usual = this.steep ? [46, 54, 46, 34] : MARGINS[this.kind];
    // Names of the lines next to the stem stand above and before it.
    return this.width > WIDE && usual[2] === 16 && this.partner ? [usual[0], usual[1], 46, usual[3]] : usual;
  }

  /** Whether the frame of names covers a place of the screen. @param {number} x @param {number} y */
  framed(x, y) { return this.frame.some(([l, t, r, b]) => x >= l && y >= t && x <= r && y <= b); }

  get midship() { return (this.store.net?.particulars.length ?? 0) / 2; }

  /** On which side of the middle a place is drawn; of the body plan only. @param {number} x */
  side(x) { return this.kind === "body" && x < this.midship - FLAT ? -1 : 1; }

  /** On which sides a curve is drawn; null: each segment on its own. @param {Line} line */
  sides(line) {
    if (this.kind === "wire") return [1, -1];
    if (this.kind !== "body") return [1];
    if (line.axis !== 0 || line.offset === null) return null;
    if (Math.abs(line.offset - this.midship) <= FLAT) return [-1, 1];
    return [this.side(line.offset)];
  }

  /** Horizontal and vertical place in metres, before the scale. @param {number} x @param {number} y @param {number} z @param {number} side @returns {[number, number]} */
  flat(x, y, z, side) {
    if (this.kind === "body") return [side * y, z];
    if (this.kind === "half") return [x, y];
    if (this.kind === "profile") return [x, z];
    const along = x - this.midship, across = side * y, c = Math.cos(this.yaw), s = Math.sin(this.yaw);
    const depth = across * c - along * s;
    return [along * c + across * s, z * Math.cos(this.pitch) + depth * Math.sin(this.pitch)];
  }

  /** @param {number} x @param {number} y @param {number} z @param {number} side @returns {[number, number]} */
  at(x, y, z, side) {
    const [u, v] = this.flat(x, y, z, side);
    return [this.axis.o + this.axis.s * u, this.oy - this.sy * v];
  }

  /** @param {ArrayLike<number>} place @returns {[number, number]} */
  atPlace(place) { return this.at(place[0], place[1], place[2], this.side(place[0])); }

  /** A direction in space as seen here, in pixels for a metre. @param {ArrayLike<number>} way @param {number} side @returns {[number, number]} */
  seen(way, side) {
    if (this.kind === "wire") {
      const from = this.at(0, 0, 0, side), to = this.at(way[0], way[1], way[2], side);
      return [to[0] - from[0], to[1] - from[1]];
    }
    const s = this.kind === "body" ? side : 1;
    return [s * this.axis.s * way[this.a], -this.sy * way[this.b]];
  }

  /** Whether lines of this one are drawn in full here. @param {Line} line */
  shows(line) {
    if (this.kind === "wire") return true;
    if (line.family !== "boundary") return OWN[this.kind].includes(line.family);
    if (this.kind === "profile") return true;
    return line.curves.some((id) => {
      const c = this.store.curves.get(id);
      if (!c) return false;
      for (let i = 1; i < 3 * c.n; i += 3) if (Math.abs(c.xyz[i]) > 1e-3) return true;
      return false;
    });
  }

  /** @returns {Box} */
  box() {
    const found = {x0: Infinity, x1: -Infinity, y1: 0, z0: Infinity, z1: -Infinity};
    for (const {n, xyz} of this.store.curves.values()) {
      for (let i = 0; i < 3 * n; i += 3) {
        found.x0 = Math.min(found.x0, xyz[i]);
        found.x1 = Math.max(found.x1, xyz[i]);
        found.y1 = Math.max(found.y1, xyz[i + 1]);
        found.z0 = Math.min(found.z0, xyz[i + 2]);
        found.z1 = Math.max(found.z1, xyz[i + 2]);
      }
    }
    return found;
  }

  /** Least and greatest horizontal and vertical place of the whole hull. */
  extent() {
    const {x0, x1, y1, z0, z1} = this.box();
    if (this.kind === "body") return [-y1, y1, z0, z1];
    if (this.kind === "profile") return [x0, x1, z0, z1];
    if (this.kind === "half") return [x0, x1, 0, y1];
    const found = [Infinity, -Infinity, Infinity, -Infinity];
    for (const x of [x0, x1]) for (const y of [-y1, y1]) for (const z of [z0, z1]) {
      const [u, v] = this.flat(x, y, z, 1);
      found[0] = Math.min(found[0], u);
      found[1] = Math.max(found[1], u);
      found[2] = Math.min(found[2], v);
      found[3] = Math.max(found[3], v);
    }
    return found;
  }

  /** Largest scales at which the whole hull is seen. */
  room() {
    const [u0, u1, v0, v1] = this.extent(), [left, top, right, bottom] = this.margins;
    return {across: Math.max(this.width - left - right, 20) / Math.max(u1 - u0, 1e-6),
      up: Math.max(this.height - top - bottom, 12) / Math.max(v1 - v0, 1e-6)};
  }

  /** Height at which the whole hull just fills so many pixels of width. @param {number} wide @param {number} squeeze */
  heightFor(wide, squeeze) {
    const [u0, u1, v0, v1] = this.extent(), [left, top, right, bottom] = this.margins;
    return (wide - left - right) / Math.max(u1 - u0, 1e-6) * (v1 - v0) * squeeze + top + bottom;
  }

  /** Brings places into the picture, as large as they fit. @param {ArrayLike<number>} xyz (3n) m */
  enclose(xyz) {
    let [x0, x1, y0, y1] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let i = 0; i + 2 < xyz.length; i += 3) {
      const [x, y] = this.at(xyz[i], xyz[i + 1], xyz[i + 2], this.side(xyz[i]));
      [x0, x1, y0, y1] = [Math.min(x0, x), Math.max(x1, x), Math.min(y0, y), Math.max(y1, y)];
    }
    if (!(x1 >= x0)) return;
    const [left, top, right, bottom] = this.margins, across = (this.width - left - right) / Math.max(x1 - x0, 1), up = (this.height - top - bottom) / Math.max(y1 - y0, 1);
    this.pan((left + this.width - right) / 2 - (x0 + x1) / 2, (top + this.height - bottom) / 2 - (y0 + y1) / 2);
    this.zoom((left + this.width - right) / 2, (top + this.height - bottom) / 2, Math.min(across, up));
  }

  /** Shows all of the hull; views that share an axis agree on it. */
  fit() {
    if (!this.shown || !this.store.curves.size) return;
    for (const view of this.partner ? [this, this.partner] : [this]) if (view.shown) view.set = [view.width, view.height];
    const both = (this.partner ? [this, this.partner] : [this]).filter((view) => view.shown);
    const rooms = both.map((view) => view.room()), squeeze = this.kind === "wire" || this.kind === "body" ? 1 : this.store.squeeze;
    // Lengths give way where heights have no room: a factor is what it says.
    this.axis.s = Math.min(...rooms.map((room) => Math.min(room.across, room.up / squeeze)));
    both.forEach((view) => {
      view.sy = this.axis.s * squeeze;
      const [, , v0, v1] = view.extent(), [, top, , bottom] = view.margins;
      view.oy = (top + view.height - bottom) / 2 + view.sy * (v0 + v1) / 2;
      view.fitted = true;
      view.touch();
    });
    const [u0, u1] = this.extent(), [left, right] = [0, 2].map((i) => Math.max(...both.map(({margins}) => margins[i])));
    this.axis.o = (left + this.width - right) / 2 - this.axis.s * (u0 + u1) / 2;
  }

  /** @param {number} x @param {number} y @param {number} factor */
  zoom(x, y, factor) {
    const most = 20000 / this.axis.s, least = 0.02 / this.axis.s, f = Math.min(Math.max(factor, least), most);
    this.axis.o = x - (x - this.axis.o) * f;
    this.axis.s *= f;
    this.oy = y - (y - this.oy) * f;
    this.sy *= f;
    if (this.partner) {
      const middle = this.partner.height / 2;
      this.partner.oy = middle - (middle - this.partner.oy) * f;
      this.partner.sy *= f;
    }
    this.#left();
  }

  /** @param {number} dx @param {number} dy */
  pan(dx, dy) {
    this.axis.o += dx;
    this.oy += dy;
    this.#left();
  }

  /** Brings a place to the middle, with so many pixels for a metre at least. @param {ArrayLike<number>} place @param {number} scale */
  centre(place, scale) {
    if (this.axis.s < scale) this.zoom(...this.atPlace(place), scale / this.axis.s);
    const [x, y] = this.atPlace(place);
    this.pan(this.width / 2 - x, this.height / 2 - y);
  }

  /** @param {number} dx @param {number} dy */
  turn(dx, dy) {
    this.yaw += dx * 0.008;
    this.pitch = Math.min(Math.max(this.pitch + dy * 0.008, -1.5), 1.5);
    this.touch();
  }

  #left() {
    this.fitted = false;
    this.touch();
    if (this.partner) {
      this.partner.fitted = false;
      this.partner.touch();
    }
  }

  /** Adds a curve to the path. @param {CanvasRenderingContext2D} g @param {Curve} c @param {Line} line @param {(i: number) => boolean} [keep] */
  trace(g, c, line, keep) {
    const sides = this.sides(line), at = new Float64Array(12);
    for (const given of sides ?? [0]) {
      let last = -2, lastSide = 0;
      for (let i = 0; i + 1 < c.n; i++) {
        if (keep && !keep(i)) continue;
        bezier(c, i, at);
        const side = given || this.side((at[0] + at[9]) / 2);
        if (last !== i - 1 || side !== lastSide) g.moveTo(...this.at(at[0], at[1], at[2], side));
        const [x1, y1] = this.at(at[3], at[4], at[5], side), [x2, y2] = this.at(at[6], at[7], at[8], side);
        const [x3, y3] = this.at(at[9], at[10], at[11], side);
        g.bezierCurveTo(x1, y1, x2, y2, x3, y3);
        last = i;
        lastSide = side;
      }
    }
  }

  /** Points that can be taken hold of here. @returns {number[]} */
  rows() {
    const net = this.store.net;
    if (!net || this.kind === "wire") return [];
    if (!this.rowsShown) {
      this.rowsShown = [];
      for (const {row, a, b} of net.points.values()) {
        const lines = [a, b].map((id) => net.lineOf(id));
        if (lines.some((line) => line && this.shows(line))) this.rowsShown.push(row);
      }
    }
    return this.rowsShown;
  }
}

const PARTS = 6;

/** @param {View} view */
export function pathsOf(view) {
  if (!view.pathsStale) return view.paths;
  const {net, curves} = view.store;
  view.paths = [];
  view.pathsStale = false;
  if (!net || view.kind === "wire") return view.paths;
  const at = new Float64Array(12);
  for (const line of net.lines) {
    if (!view.shows(line)) continue;
    for (const id of line.curves) {
      const c = curves.get(id);
      if (!c) continue;
      for (const given of view.sides(line) ?? [0]) {
        const path = new Float32Array(2 * (PARTS * (c.n - 1) + 1));
        let to = 0;
        for (let i = 0; i + 1 < c.n; i++) {
          bezier(c, i, at);
          const side = given || view.side((at[0] + at[9]) / 2);
          for (let k = i ? 1 : 0; k <= PARTS; k++) {
            const u = k / PARTS, w = 1 - u, b0 = w * w * w, b1 = 3 * w * w * u, b2 = 3 * w * u * u, b3 = u * u * u;
            const mix = (/** @type {number} */ j) => b0 * at[j] + b1 * at[3 + j] + b2 * at[6 + j] + b3 * at[9 + j];
            const [x, y] = view.at(mix(0), mix(1), mix(2), side);
            path[to++] = x;
            path[to++] = y;
          }
        }
        view.paths.push({id, path});
      }
    }
  }
  return view.paths;
}

/** @param {View} view @param {number} x @param {number} y @param {number} reach @returns {number | null} */
export function nearestPoint(view, x, y, reach) {
  let best = null, least = reach * reach;
  if (view.framed(x, y)) return null;
  const chosen = view.store.selection.curve;
  for (const row of view.rows()) {
    const place = view.store.placeOf(row);
    if (!place) continue;
    const [u, v] = view.atPlace(place);
    const far = (u - x) ** 2 + (v - y) ** 2;
    // Of points that lie over one another, the one on the chosen curve.
    const point = chosen === null ? undefined : view.store.net?.points.get(row);
    const mine = point && (point.a === chosen || point.b === chosen) ? 4 : 0;
    if (far - mine < least) {
      least = far - mine;
      best = row;
    }
  }
  return best;
}

/** @param {View} view @param {number} x @param {number} y @param {number} reach @returns {number | null} */
export function nearestCurve(view, x, y, reach) {
  let best = null, least = reach * reach;
  if (view.framed(x, y)) return null;
  for (const {id, path} of pathsOf(view)) {
    for (let i = 0; i + 3 < path.length; i += 2) {
      const x0 = path[i], y0 = path[i + 1], dx = path[i + 2] - x0, dy = path[i + 3] - y0;
      const t = Math.min(Math.max(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1), 0), 1);
      const far = (x0 + t * dx - x) ** 2 + (y0 + t * dy - y) ** 2;
      if (far < least) {
        least = far;
        best = id;
      }
    }
  }
  return best;
}

/** The curve through a point that this view draws in full. @param {View} view @param {number} row @returns {number | null} */
export function curveThrough(view, row) {
  const net = view.store.net, point = net?.points.get(row);
  if (!net || !point) return null;
  const shown = [point.a, point.b].filter((id) => {
    const line = net.lineOf(id);
    return line !== undefined && view.shows(line);
  });
  const own = shown.find((id) => net.lineOf(id)?.family !== "boundary");
  return own ?? shown[0] ?? null;
}
