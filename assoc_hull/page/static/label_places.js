// Names that stand on a drawing, and what lines and marks cover of it: where there is room for another name.

import {pathsOf} from "./view.js";
import {dotsOf} from "./marks.js";

export const HIGH = 12, UPRIGHT = [10, 12]; // px
const CELL = 3; // px
export const MANY = 0xffff; // what a cell holds beside numbers of lines
const DOT = 0xfffe;

/** Names that stand already, and the cells of the picture that lines and marks cover. */
export class Places {
  /** @param {CanvasRenderingContext2D} g @param {View} view @param {Record<string, string>} ink */
  constructor(g, view, ink) {
    this.g = g;
    this.view = view;
    this.ink = ink;
    const {offsetLeft: l, offsetTop: t, offsetWidth: w, offsetHeight: h} = view.head, from = getComputedStyle(view.head).transform === "none" ? l : l - w / 2;
    /** The first is the title. @type {Name[]} */
    this.written = [{text: "", box: [from, t, from + w, t + h], colour: "", turned: false}];
    /** Names of lines stand to the right of one, to the left of the other, above the third: beyond are those of the grid. */
    this.left = 0;
    this.right = Infinity;
    this.foot = Infinity;
    /** Where names of lines stand now. @type {View["standing"]["spots"]} */
    this.standing = new Map();
    /** Whether the family of the view's lines is told, and names that stand in such lines. */
    this.captioned = false;
    /** @type {{name: Name, line: Line}[]} */
    this.inline = [];
    /** @type {Map<string, number>} */
    this.widths = new Map();
    this.across = Math.ceil(view.width / CELL) + 1;
    this.cells = new Uint16Array(this.across * (Math.ceil(view.height / CELL) + 1));
    /** @type {Map<Line, number>} */
    this.numbers = new Map();
    for (const {id, path} of pathsOf(view)) {
      const line = view.store.net?.lineOf(id);
      if (line) this.cover(path, this.number(line));
    }
    for (const row of dotsOf(view)) this.#dot(view.store.placeOf(row), 4);
    const {marked, selection} = view.store;
    if (marked) this.#dot(marked, 24);
    if (selection.row !== null && view.rows().includes(selection.row)) this.#dot(view.store.placeOf(selection.row), 10);
  }

  /** @param {Line} line */
  number(line) {
    const known = this.numbers.get(line) ?? this.numbers.size + 1;
    this.numbers.set(line, known);
    return known;
  }

  /** Marks what a line covers; of long segments only what is seen. @param {Float32Array} path @param {number} number */
  cover(path, number) {
    const {across, cells, view} = this, room = [view.width - 1, view.height - 1];
    for (let i = 0; i + 3 < path.length; i += 2) {
      const from = [path[i], path[i + 1]], by = [path[i + 2] - from[0], path[i + 3] - from[1]];
      let low = 0, high = 1;
      for (const j of [0, 1]) {
        const ends = [-from[j] / by[j], (room[j] - from[j]) / by[j]].sort((p, q) => p - q);
        if (by[j]) [low, high] = [Math.max(low, ends[0]), Math.min(high, ends[1])];
        else if (from[j] < 0 || from[j] > room[j]) high = -1;
      }
      const n = Math.ceil((high - low) * Math.max(Math.abs(by[0]), Math.abs(by[1])) / CELL) + 1;
      for (let k = 0; high >= low && k <= n; k++) {
        const u = low + (high - low) * k / n, at = across * Math.floor((from[1] + u * by[1]) / CELL) + Math.floor((from[0] + u * by[0]) / CELL);
        cells[at] = cells[at] && cells[at] !== number ? MANY : number;
      }
    }
  }

  /** @param {ArrayLike<number> | undefined} place @param {number} reach */
  #dot(place, reach) {
    if (!place) return;
    const [x, y] = this.view.atPlace(place);
    if (this.view.framed(x, y)) return; // the frame covers it
    this.#within([x - reach, y - reach, x + reach, y + reach], (at) => {
      this.cells[at] = DOT;
      return false;
    });
  }

  /** Whether a cell of a box is so. @param {number[]} box @param {(at: number) => boolean} so */
  #within([l, t, r, b], so) {
    const {width, height} = this.view;
    for (let y = Math.floor(Math.max(t, 0) / CELL); y <= Math.min(b, height - 1) / CELL; y++) {
      for (let x = Math.floor(Math.max(l, 0) / CELL); x <= Math.min(r, width - 1) / CELL; x++) if (so(this.across * y + x)) return true;
    }
    return false;
  }

  /** Whether a mark lies there. @param {number[]} box */
  dotted(box) { return this.#within(box, (at) => this.cells[at] === DOT); }

  /** Whether there is nothing but the line of this number. @param {number[]} box @param {number} number */
  clear(box, number) { return !this.#within(box, (at) => this.cells[at] > 0 && this.cells[at] !== number); }

  /** Whether a box lies within the picture, and on no name. @param {number[]} box */
  free([l, t, r, b]) {
    return l >= 2 && t >= 2 && r <= this.view.width - 2 && b <= this.view.height - 1 && !this.written.some(({box: [L, T, R, B]}) => l < R + 4 && r > L - 4 && t < B && b > T);
  }

  /** Whether a box lies where names of lines may stand. @param {number[]} box */
  inside([l, , r, b]) { return l >= this.left + 4 && r <= this.right - 4 && b <= this.foot + 2; }

  /** Whether a leader runs under a name. @param {number[][]} way */
  under(way) {
    return way.slice(1).some(([u, v], i) => this.written.some(({box: [l, t, r, b]}) => {
      const [x, y] = way[i];
      let low = 0, high = 1;
      for (const [from, by, least, most] of [[x, u - x, l - 2, r + 2], [y, v - y, t, b]]) {
        if (!by && (from <= least || from >= most)) high = -1;
        if (by) [low, high] = [Math.max(low, Math.min((least - from) / by, (most - from) / by)), Math.min(high, Math.max((least - from) / by, (most - from) / by))];
      }
      return low < high;
    }));
  }

  /** @param {string} text */
  wide(text) {
    const known = this.widths.get(text) ?? this.g.measureText(text).width;
    this.widths.set(text, known);
    return known;
  }

  /** The room that a name takes. @param {string} text @param {number} x @param {number} y @param {CanvasTextAlign} align */
  box(text, x, y, align) {
    const w = this.wide(text), left = align === "center" ? x - w / 2 : align === "right" ? x - w : x;
    return [left, y - HIGH / 2, left + w, y + HIGH / 2];
  }

  /** Finds room for a name, unless it would lie over another, or outside. @param {string} text @param {number} x @param {number} y @param {CanvasTextAlign} align @param {string} colour */
  put(text, x, y, align, colour) {
    const box = this.box(text, x, y, align), free = this.free(box);
    if (free) this.written.push({text, box, colour, turned: false});
    return free;
  }

  /** A name at the edge; where a mark lies on it, farther in along its grid line. @param {string} text @param {number} x @param {number} y @param {CanvasTextAlign} align @param {string} colour */
  edge(text, x, y, align, colour) {
    const away = align === "center" ? [[x, y], [x, y - 14], [x, y - 28], [x + 14, y], [x - 14, y]] : [0, 1, 2, 3].map((n) => [x + (align === "right" ? 16 : -16) * n, y]);
    // Letters are less high than their room: a point on the base line is no hindrance to names below it.
    const clear = (/** @type {number[]} */ [l, t, r, b]) => !this.dotted([l, t + 2, r, b - 2]);
    const [u, v] = away.find(([p, q]) => clear(this.box(text, p, q, align))) ?? [x, y];
    return this.put(text, u, v, align, colour);
  }

  /** A name that stands upright on its foot. @param {string} text @param {number} x @param {number} y @param {string} colour */
  upright(text, x, y, colour) { this.written.push({text, box: [x - UPRIGHT[0] / 2, y - this.wide(text), x + UPRIGHT[0] / 2, y], colour, turned: true}); }

  /** The family of the lines that the view shows, once. @param {string} text @param {number} x @param {number} y @param {CanvasTextAlign} align @param {string} colour */
  caption(text, x, y, align, colour) {
    this.captioned ||= this.put(text, x, y, align, colour);
    return this.captioned;
  }

  /** Where no row of names tells the family, a name in a line does. */
  captionInline() {
    for (const {name, line} of this.captioned ? [] : this.inline) {
      const caption = this.view.store.net?.caption(line.name.split(" ")[0]), words = caption === "x, m" ? `x ${name.text} m` : line.name;
      const [l, t, r, b] = name.box, wide = this.wide(words) / 2, box = [(l + r) / 2 - wide, t, (l + r) / 2 + wide, b];
      name.box = [-9, -9, -9, -9]; // it does not stand in its own way
      this.captioned = this.free(box) && !this.dotted(box) && this.inside(box);
      name.box = this.captioned ? box : [l, t, r, b];
      if (this.captioned) name.text = words;
      if (this.captioned) return;
    }
  }

  /** Writes all names, over lines and leaders. */
  write() {
    const {g, ink} = this;
    for (const {text, box: [l, t, r, b], colour, turned} of this.written.slice(1)) {
      // A line that shows through a point reads as a colon.
      g.fillStyle = ink.paper;
      if (!turned) g.fillRect(l - 1, t, r - l + 2, b - t);
      g.fillStyle = colour;
      g.save();
      g.translate(turned ? (l + r) / 2 : l, turned ? b : (t + b) / 2);
      if (turned) g.rotate(-Math.PI / 2);
      g.fillText(text, 0, 0);
      g.restore();
    }
    this.view.written = this.written;
  }
}
