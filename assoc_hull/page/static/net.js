// The net in words, as the server tells it: lines, curves, points, and who lies on whom.

/** @typedef {{id: number, name: string, family: string, axis: number | null, offset: number | null, boundary: number, curves: number[], names: string[]}} Line */
/** @typedef {{row: number, name: string, label: string, a: number, b: number, sort: number, role: number, driver: number, kind: number[], free: string, held: number}} Point */
/** @typedef {{name: string, length: number, breadth: number, depth: number, draught: number}} Particulars */

export const CROSSING = 0, PLACED = 1, ADOPTED = 2;
export const SHARED = 0, WATCHED = 3;
/** Of a boundary: it encloses a flat. */
export const FLATS = 1;
const SORTS = ["crossing", "point placed by hand", "point of the lines as given"];
const KINDS = ["smooth", "tangent", "knuckle"];

/** A name as it is compared: spaces, capitals, a comma for the point and zeros at the ends do not matter. @param {string} name */
export function alike(name) {
  return name.toLowerCase().replace(/×/g, "x").replace(/(\d),(?=\d)/g, "$1.").replace(/\s+/g, "").replace(/(^|[^\d.])0+(?=\d)/g, "$1").replace(/(\.\d*?)0+(?!\d)/g, "$1").replace(/\.(?!\d)/g, "");
}

export class Net {
  /** @param {any} message */
  constructor(message) {
    /** @type {Particulars} */
    this.particulars = message.particulars;
    /** @type {Line[]} */
    this.lines = message.lines;
    /** @type {Map<number, {line: Line, name: string}>} */
    this.curves = new Map();
    for (const line of this.lines) line.curves.forEach((id, i) => this.curves.set(id, {line, name: line.names[i]}));
    /** Names of curves, the longest first. */
    this.longest = [...this.curves.values()].map(({name}) => name).sort((p, q) => q.length - p.length);
    /** @type {Map<number, Point>} */
    this.points = new Map();
    const table = message.points;
    table.row.forEach((/** @type {number} */ row, /** @type {number} */ i) => this.points.set(row, {
      row, name: table.name[i], label: table.label[i], a: table.a[i], b: table.b[i], sort: table.sort[i],
      role: table.role[i], driver: table.driver[i], kind: table.kind[i], free: table.free[i], held: table.held[i],
    }));
    /** @type {Map<number, number[]>} */
    this.rowsOf = new Map();
    for (const point of this.points.values()) {
      for (const id of [point.a, point.b]) {
        if (id < 0) continue;
        const rows = this.rowsOf.get(id);
        if (rows) rows.push(point.row);
        else this.rowsOf.set(id, [point.row]);
      }
    }
    /** @type {[string, number][]} */
    this.byName = [...this.points.values()].map((point) => [point.name, point.row]);
    this.byName.sort((p, q) => q[0].length - p[0].length);
  }

  /** Whether stations are named by their distance from AP, m, as those of a hull that was read from a surface are. */
  get inMetres() {
    const all = this.lines.filter(({family, offset}) => family === "sections" && offset !== null);
    return all.length > 0 && all.every(({name, offset}) => Math.abs(Number(name.replace(/^\w+ /, "")) - (offset ?? 0)) < 0.0051);
  }

  /** What stands above or beside names of a family. @param {string} family as in names */
  caption(family) { return family === "ST" && this.inMetres ? "x, m" : family; }

  /** @param {number} curve */
  lineOf(curve) { return this.curves.get(curve)?.line; }

  /** @param {number} curve */
  curveName(curve) { return this.curves.get(curve)?.name ?? ""; }

  /** The curve of a name; of a line of several, the first. @param {string} name @returns {number | null} */
  findCurve(name) {
    const wanted = alike(name), named = [...this.curves];
    return (named.find(([, each]) => alike(each.name) === wanted) ?? named.find(([, each]) => alike(each.line.name) === wanted))?.[0] ?? null;
  }

  /** The point of a name, as it is written or said, or of the two lines given in the other order. @param {string} name */
  find(name) {
    const [, sort, n, line] = /^(given|placed) point (\d+) of (.+)$/i.exec(name.trim()) ?? [], wanted = alike(line ? `${line} @ ${sort.toLowerCase() === "given" ? "adopted" : "placed"} ${n}` : name);
    for (const point of this.points.values()) if (alike(point.name) === wanted || (point.label && alike(point.label) === wanted)) return point.row;
    const [, one, other, rest] = /^(.+?)\s*[x×]\s+(.+?)(\s*#\d+)?$/i.exec(name.trim()) ?? [];
    if (!other) return null;
    const turned = alike(`${other} x ${one}${rest ?? ""}`);
    for (const point of this.points.values()) if (alike(point.name) === turned) return point.row;
    return null;
  }

  /** Points that a sentence of the library names. @param {string} text */
  named(text) {
    const found = [];
    let left = text;
    for (const [name, row] of this.byName) {
      if (!left.includes(name)) continue;
      found.push(row);
      left = left.split(name).join("\u0000");
      if (found.length === 12) break;
    }
    return found;
  }

  /** A sentence of the library as a person at this page says it: `BTK 0.92 @ adopted 5` is given point 5 of BTK 0.92. @param {string} text */
  said(text) {
    // Calls of the library are no buttons of this page.
    return text.replace(/ \((?:edit|hull)\.\w+[^)]*\)/g, "").replace("make it shared", "choose the role “shared”").replace("; lengths are in m, 50 mm is 0.05", "").replace(/^faired by a noise of (.+?), stated: (\d+ points could move).+/, "waviness of $1 is taken out: $2").replace(/(.+?) @ (adopted|placed) (\d+)/g, (whole, before, sort, n) => {
      const line = this.longest.find((name) => before.endsWith(name) && !/\w/.test(before[before.length - name.length - 1] ?? " "));
      return line === undefined ? whole : `${before.slice(0, before.length - line.length)}${sort === "placed" ? sort : "given"} point ${n} of ${line}`;
    });
  }

  /** @param {Point} point */
  sortWords(point) { return SORTS[point.sort] ?? ""; }

  /** What a point is to its curves, and who computes it. @param {Point} point */
  roleWords(point) {
    if (point.sort !== CROSSING) return `defines ${this.curveName(point.a)}`;
    if (point.role === SHARED) return "shared: both lines are made through it";
    if (point.role === WATCHED) return "watched: it has no value of its own";
    return `driven by ${this.curveName(point.driver)}`;
  }

  /** What the hand can do with it. @param {Point} point */
  wayWords(point) {
    if (point.free && point.held === 1) return `on a flat: it moves along ${[...point.free].join(", ")}, and is not pulled`;
    if (point.free && point.held === 2) return `on the profile: it moves along ${[...point.free].join(", ")}, and is not pulled`;
    if (point.free) return `move along ${[...point.free].join(", ")}, or pull the hull`;
    if (point.held) return `computed, on ${point.held === 1 ? "a flat" : "the profile"}: move a point of ${this.curveName(point.driver) || "that line"}`;
    return "computed: pull the hull here";
  }

  /** @param {Point} point */
  kindWords(point) {
    const on = [point.a, point.b].map((id, side) => id < 0 ? "" : `${KINDS[point.kind[side]]} on ${this.curveName(id)}`).filter(Boolean);
    const plain = on.every((words) => words.startsWith("smooth"));
    return plain ? "smooth" : on.join(", ");
  }
}
