// The one store: what is published, what is in hand, what is chosen, how it is looked at.

/** @typedef {"hull" | "overlay" | "panel"} Stale */
/** @typedef {{frame: Frame, amount: number | null, predicted: boolean}} Overlay */
/** @typedef {{text: string, all: string, row: number | null, place: number[] | null, named: number[]}} Refusal */
/**
 * What the hand holds: `place` is where the pointer wants the point, `start` where it lay.
 * @typedef {{row: number, how: "pull" | "move", place: number[], start: number[], free: string, normal: number[] | null, radius: number[] | null, way: number[] | null, amount: number | null, held: boolean, refused: boolean, waiting: boolean, fine: boolean}} Held
 */

export class Store {
  constructor() {
    /** @type {Net | null} */
    this.net = null;
    /** @type {Map<number, Curve>} */
    this.curves = new Map();
    /** @type {Map<number, Float64Array>} */
    this.places = new Map();
    this.state = 0;
    /** How what the last step changed lay before it. @type {{curves: Map<number, Curve>, places: Map<number, Float64Array>}} */
    this.before = {curves: new Map(), places: new Map()};
    /** The farthest that the last step of the hull moved a line, m. */
    this.drawn = 0;
    /** @type {Overlay | null} */
    this.overlay = null;
    /** A variant that is shown, not made. @type {Frame | null} */
    this.ghost = null;
    /** What somebody else has in hand, and what follows it. @type {{author: string, row: number, frame: Frame | null} | null} */
    this.theirs = null;
    /** @type {Held | null} */
    this.held = null;
    /** @type {Refusal | null} */
    this.refusal = null;
    /** How many times larger movements are drawn than they are. */
    this.magnified = 0;
    this.selection = {curve: /** @type {number | null} */ (null), row: /** @type {number | null} */ (null)};
    this.hover = {curve: /** @type {number | null} */ (null), row: /** @type {number | null} */ (null)};
    this.tools = {how: /** @type {"pull" | "move"} */ ("pull"), radius: /** @type {number[] | null} */ (null), fine: false, fair: false, fairShapes: true, pinned: false};
    /** The curve that the next click inserts a point into. @type {number | null} */
    this.inserting = null;
    /** The line that is being re-shaped, and where it is to pass. @type {{curve: number, places: number[][]} | null} */
    this.shaping = null;
    /** A hull of a file, shown beside. @type {{lines: Line[], frame: Frame} | null} */
    this.beside = null;
    /** A place that somebody is led to. @type {number[] | null} */
    this.marked = null;
    this.show = {combs: true, allCombs: false, movement: true, labels: true, points: false};
    this.gain = 1;
    this.squeeze = 1;
    this.theme = "auto";
    /** @type {string | null} */
    this.maximised = null;
    this.tab = /** @type {Kind} */ ("body");
    this.connection = /** @type {"connecting" | "open" | "lost" | "over"} */ ("connecting");
    this.reason = "";
    this.history = {edits: 0, undo: /** @type {string | null} */ (null), redo: /** @type {string | null} */ (null), above: /** @type {string | null} */ (null)};
    this.author = "";
    this.file = /** @type {string | null} */ (null);
    /** @type {any} */
    this.last = null;
    /** @type {string | null} */
    this.problem = null;
    /** @type {Set<(what: Stale) => void>} */
    this.listeners = new Set();
  }

  /** A sentence of the library, as a person says it. @param {string} text */
  said(text) { return this.net?.said(text) ?? text; }

  /** @param {...Stale} what */
  changed(...what) { for (const each of what) for (const listener of this.listeners) listener(each); }

  /** Where a point is shown: in the hand, as it would follow, or as it is published. @param {number} row */
  placeOf(row) { return this.overlay?.frame.places.get(row) ?? this.places.get(row); }

  /** What moves in the hand, or has moved by the edit that was made last, and how it lay before; null of neither. */
  get movement() {
    const {overlay, curves, places, before, last, state} = this;
    if (overlay) return {now: overlay.frame, then: {curves, places}, words: ""};
    return last?.state === state ? {now: {curves, places}, then: before, words: ", last edit"} : null;
  }

  /** @param {number} id */
  curveNow(id) { return this.overlay?.frame.curves.get(id) ?? this.curves.get(id); }

  /** @param {number | null} row @param {number | null} curve */
  select(row, curve) {
    if (this.selection.row === row && this.selection.curve === curve) return;
    this.selection = {row, curve};
    this.changed("hull", "overlay", "panel"); // names give way to points that are drawn
  }

  /** @param {number | null} row @param {number | null} curve */
  point(row, curve) {
    if (this.hover.row === row && this.hover.curve === curve) return;
    this.hover = {row, curve};
    this.changed("overlay");
  }

  /** Takes over a whole net with its shapes. @param {Net} net @param {Frame} frame */
  adopt(net, frame) {
    const old = this.selection.row, known = old === null ? undefined : this.net?.points.get(old), kept = {
      on: known && this.net?.curveName(known.a),
      curve: this.selection.curve === null ? null : this.net?.curveName(this.selection.curve) ?? null};
    this.net = net;
    this.before = {curves: this.curves, places: this.places};
    this.curves = frame.curves;
    this.places = frame.places;
    this.state = frame.state;
    this.overlay = this.ghost = this.theirs = null;
    // A point that was pinned has another name, and is the same row.
    const same = old === null ? undefined : net.points.get(old);
    const row = !known ? null : net.find(known.name) ?? (same && net.curveName(same.a) === kept.on ? old : null);
    const curve = [...net.curves].find(([, {name}]) => name === kept.curve)?.[0] ?? null;
    this.inserting = this.shaping = null;
    this.selection = {row, curve};
    this.hover = {row: null, curve: null};
    // A pull that is to be fair is wide: an eighth of the length, and a third of the breadth.
    this.tools.radius ??= [0.125 * net.particulars.length, 0.35 * net.particulars.breadth].map((value) => Math.round(10 * value) / 10);
    this.changed("hull", "overlay", "panel");
  }

  /** Takes over what an edit has changed. @param {Frame} frame */
  publish(frame) {
    const {curves, places} = this, lay = /** @type {<T>(now: Map<number, T>, then: Map<number, T>) => Map<number, T>} */ ((now, then) => new Map([...then].filter(([id]) => now.has(id))));
    this.before = {curves: lay(frame.curves, curves), places: lay(frame.places, places)};
    for (const [id, curve] of frame.curves) this.curves.set(id, curve);
    for (const [row, place] of frame.places) this.places.set(row, place);
    this.state = frame.state;
    this.overlay = this.ghost = this.theirs = null;
    this.changed("hull", "overlay", "panel");
  }
}
