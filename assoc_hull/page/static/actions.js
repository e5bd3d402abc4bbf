// All actions: words, keys, whether they can be done now. And the keys.

import {passes, pin, remove} from "./point_acts.js";
import {showChosen} from "./ways.js";

/** @typedef {{id: string, words: string, keys: string[], label?: (page: Page) => string, pressed?: (page: Page) => boolean, enabled?: (page: Page) => boolean, run: (page: Page) => void}} Action */

const SQUEEZES = [1, 2, 5, 10];
/** Whether a view is seen whose lengths can be compressed. @param {Page} page */
const compressible = ({views: {profile, half}}) => profile.shown || half.shown;

/** @param {"combs" | "allCombs" | "movement" | "labels" | "points"} what @param {string} words @param {string} key @returns {Action} */
const toggle = (what, words, key) => ({
  id: what, words, keys: [key], pressed: (page) => page.store.show[what],
  run: (page) => {
    page.store.show[what] = !page.store.show[what];
    if (what === "combs" && page.store.show.combs && page.store.selection.curve === null) page.say("Combs stand on the chosen line: click one, or choose it under Curve.");
    page.store.changed("hull", "overlay", "panel");
    page.keep();
  },
});

/** @param {Kind} kind @param {string} key @param {string} words @returns {Action} */
const enlarge = (kind, key, words) => ({
  id: `view-${kind}`, words, keys: [key], pressed: (page) => page.store.maximised === kind,
  run: (page) => page.maximise(kind),
});

/** @param {number} factor @param {string} words @param {string} key @returns {Action} */
const gain = (factor, words, key) => ({
  id: factor > 1 ? "combs-longer" : "combs-shorter", words, keys: [key],
  enabled: (page) => page.store.show.combs,
  run: (page) => {
    page.store.gain = Math.min(Math.max(page.store.gain * factor, 0.05), 20);
    page.store.changed("overlay");
    page.keep();
  },
});

/** @type {Action[]} */
export const ACTIONS = [
  {id: "pull", words: "Pull: the hull around follows", keys: ["u"], label: () => "Pull", pressed: (page) => page.store.tools.how === "pull", run: (page) => page.use("pull")},
  {id: "move", words: "Move: the point alone, along its freedom", keys: ["p"], label: () => "Move", pressed: (page) => page.store.tools.how === "move", run: (page) => page.use("move")},
  {id: "fine", words: "Fine: the point goes a tenth of the way of the hand", keys: ["e"], label: () => "Fine", pressed: (page) => page.store.tools.fine, run: (page) => page.toggleFine()},
  {id: "fair-pull", words: "Answer pulls fairly: shown before it is made", keys: ["j"], label: () => "Answer fairly", pressed: (page) => page.store.tools.fair, run: (page) => page.toggleTool("fair")},
  {id: "pinned", words: "Pinned: placed points move alone, their line is not led", keys: ["l"], label: () => "Pinned", pressed: (page) => page.store.tools.pinned, run: (page) => page.toggleTool("pinned")},
  {id: "insert", words: "Insert a point into the chosen line, by a click", keys: ["i"], label: () => "Insert a point", enabled: (page) => page.store.selection.curve !== null, run: (page) => page.insert()},
  {id: "knuckle", words: "Knuckle: the chosen line bends at the point", keys: ["n"], label: () => "Knuckle", ...passes("knuckle")},
  {id: "smooth", words: "Smooth: the chosen line passes the point without a bend", keys: ["Shift+n"], label: () => "Smooth", ...passes("smooth")},
  {id: "tangent", words: "Tangent: the chosen line keeps its direction at the point", keys: ["Shift+t"], label: () => "Tangent", ...passes("tangent")},
  {id: "pin", words: "Pin the chosen point, one placed by hand or of the lines as given: no edit of others moves it; or unpin it", keys: ["Shift+l"], label: () => "Pin", ...pin},
  {id: "delete", words: "Delete the chosen point, one placed by hand or of the lines as given", keys: ["Delete"], label: () => "Delete", ...remove},
  {id: "reshape", words: "Re-shape the chosen line through places that you click", keys: ["r"], label: () => "Re-shape", enabled: (page) => page.store.selection.curve !== null, run: (page) => page.shaper.start()},
  {id: "fair-shape", words: "Answer re-shapes fairly", keys: ["Shift+r"], label: () => "Fair re-shapes", enabled: (page) => page.store.selection.curve !== null, pressed: (page) => page.store.tools.fairShapes, run: (page) => page.toggleTool("fairShapes")},
  {id: "pull-by", words: "Pull the chosen point by a number of millimetres", keys: ["g"], enabled: (page) => page.store.selection.row !== null, run: (page) => page.panel.acts.focus()},
  {id: "undo", words: "Undo your last edit", keys: ["Ctrl+z"], label: () => "Undo", enabled: (page) => page.undoes, run: (page) => page.undo()},
  {id: "redo", words: "Redo what was taken back", keys: ["Ctrl+Shift+z", "Ctrl+y"], label: () => "Redo", enabled: (page) => page.hand.free && page.store.history.redo !== null, run: (page) => page.redo()},
  toggle("combs", "Curvature combs", "k"),
  toggle("allCombs", "Combs on all curves that follow", "Shift+k"),
  gain(1.25, "Longer combs", "+"),
  gain(0.8, "Shorter combs", "-"),
  toggle("movement", "Movement, magnified", "m"),
  toggle("labels", "Labels", "b"),
  toggle("points", "All points", "d"),
  {id: "compress", words: "Compress lengths by 1, 2, 5, 10", keys: ["c"], enabled: compressible, label: (page) => page.store.squeeze === 1 || !compressible(page) ? "Compress" : `Compressed × ${page.store.squeeze}`, pressed: (page) => page.store.squeeze !== 1 && compressible(page),
    run: (page) => page.compress(SQUEEZES[(SQUEEZES.indexOf(page.store.squeeze) + 1) % SQUEEZES.length])},
  {id: "fit", words: "Show all of the hull", keys: ["0"], label: () => "Fit", run: (page) => page.fit()},
  {id: "fit-selection", words: "Show what is chosen", keys: ["f"], enabled: (page) => page.store.selection.row !== null || page.store.selection.curve !== null, run: showChosen},
  {id: "zoom-in", words: "Nearer", keys: ["="], run: (page) => page.zoom(1.25)},
  {id: "zoom-out", words: "Farther", keys: ["_"], run: (page) => page.zoom(0.8)},
  enlarge("body", "1", "Body plan alone, and back"),
  enlarge("profile", "2", "Profile alone, and back"),
  enlarge("half", "3", "Half-breadth plan alone, and back"),
  enlarge("wire", "4", "Wire alone, and back"),
  {id: "next-point", words: "Next point of the curve", keys: ["]"], run: (page) => page.step(1)},
  {id: "previous-point", words: "Previous point of the curve", keys: ["["], run: (page) => page.step(-1)},
  {id: "next-curve", words: "Next curve of the view", keys: ["}"], run: (page) => page.stepCurve(1)},
  {id: "previous-curve", words: "Previous curve of the view", keys: ["{"], run: (page) => page.stepCurve(-1)},
  {id: "find", words: "Find a point or a line by its name", keys: ["/"], run: (page) => page.search()},
  {id: "point-table", words: "Table of the points of the line", keys: ["a"], run: (page) => page.panel.open("Points")},
  {id: "problems", words: "What is wrong with the hull", keys: ["Shift+p"], run: (page) => {
    page.panel.open("Problems");
    page.panel.problems.look();
  }},
  {id: "why", words: "Why the chosen point or line moved last", keys: ["w"], run: (page) => page.panel.open("Why")},
  {id: "history", words: "History: all steps, going back, comparing", keys: ["h"], run: (page) => page.panel.open("History")},
  {id: "hydrostatics", words: "Hydrostatics and sectional areas", keys: ["y"], run: (page) => page.panel.open("Hydrostatics")},
  {id: "fairing", words: "Fairing: the waviest lines, a window", keys: ["Shift+f"], run: (page) => page.panel.open("Fair")},
  {id: "vary", words: "Vary a named parameter of the whole hull", keys: ["v"], run: (page) => page.panel.open("Vary")},
  {id: "beside", words: "Show a file or a picture beside the hull", keys: ["o"], run: (page) => page.panel.open("Beside")},
  {id: "export", words: "Write a lines plan, offsets, a drawing", keys: ["x"], run: (page) => page.panel.open("Export")},
  {id: "print", words: "Lines plan to be printed, as PDF", keys: ["Shift+x"], run: (page) => {
    page.panel.open("Export");
    page.panel.files.write("pdf");
  }},
  {id: "theme", words: "Light, dark, or as the system", keys: ["t"], label: () => "Theme", run: (page) => page.nextTheme()},
  {id: "palette", words: "All that can be done, by its words", keys: ["Ctrl+k", ":"], run: (page) => page.palette()},
  {id: "keys", words: "All keys", keys: ["?"], label: () => "Keys", run: (page) => page.sheet()},
];

/** What was pressed, as the table writes it. @param {KeyboardEvent} event */
export function keyName(event) {
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key, parts = [];
  if (event.ctrlKey || event.metaKey) parts.push("Ctrl");
  // Shift is part of a sign, and a key of its own beside a letter.
  if (event.shiftKey && (/^[a-z]$/.test(key) || key.length > 1)) parts.push("Shift");
  if (event.altKey && key.length > 1) parts.push("Alt");
  return [...parts, key].join("+");
}

/** @param {Page} page @param {string} key */
export function actionOf(page, key) {
  const found = ACTIONS.find(({keys}) => keys.includes(key));
  return found && (found.enabled?.(page) ?? true) ? found : undefined;
}

/** @param {string} key */
export function keyWords(key) {
  if (key === "+") return key;
  return key.split("+").map((part) => /^[a-z]$/.test(part) ? part.toUpperCase() : part).join(" + ");
}

const STEP = 0.001; // m
const BURST = 600; // ms
/** @type {Record<string, [number, number]>} */
const ARROWS = {ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowRight: [1, 0], ArrowLeft: [-1, 0]};

export class Keys {
  /** @param {Page} page */
  constructor(page) {
    this.page = page;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    this.burst = false;
    this.sum = [0, 0, 0];
    /** Steps that were asked for while an edit was being made. @type {(() => void)[]} */
    this.queue = [];
    /** A burst that is shown, not made: more of it is added to it. @type {{what: object, row: number, how: string, sum: number[]} | null} */
    this.shown = null;
    // Also where a button that had the focus is no longer there to have it; not within a notebook.
    const signal = page.options.within;
    page.root.ownerDocument.addEventListener("keydown", (event) => {
      const at = event.target, own = at instanceof Node && page.root.contains(at);
      if (own || (!signal && at === page.root.ownerDocument.body)) this.#down(event);
    }, {signal});
  }

  /** @param {KeyboardEvent} event */
  #down(event) {
    const {page} = this, {store} = page, typing = event.target instanceof HTMLInputElement, key = keyName(event);
    if (key === "Ctrl+s") {
      event.preventDefault();
      page.say(store.file ? `Every edit is kept in ${store.file} already.` : "This hull is in memory only: it was not opened from a hull file.");
      return;
    }
    if (event.key === "Escape") return this.#escape(typing ? /** @type {HTMLInputElement} */ (event.target) : null, event.target);
    if (typing && !key.startsWith("Ctrl")) return;
    if (typing && ["Ctrl+z", "Ctrl+y", "Ctrl+Shift+z"].includes(key)) return; // of the field
    // Where nothing has the focus, keys are of the drawing that was used last.
    const nowhere = event.target === page.root.ownerDocument.body, drawing = nowhere || event.target instanceof HTMLCanvasElement;
    if (drawing && event.key in ARROWS) {
      if (nowhere && store.selection.row === null) return;
      event.preventDefault();
      if (event.ctrlKey || event.metaKey) page.pan(-40 * ARROWS[event.key][0], 40 * ARROWS[event.key][1]);
      else if (store.shaping) page.shaper.nudge(page.activeView(), ARROWS[event.key], (event.shiftKey ? 10 : event.altKey ? 0.1 : 1) * STEP);
      else this.#nudge(ARROWS[event.key], event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
      return;
    }
    if (drawing && event.key === "Enter") return this.burst ? this.finish() : store.shaping ? page.shaper.finish() : void page.panel.proposal.apply();
    if (drawing && event.key === "Backspace" && store.shaping) return page.shaper.back();
    // A button of the bar is pressed by Enter and the space bar: letters are free there.
    const bar = event.target instanceof Element && event.target.closest(".bar button") !== null;
    if (!drawing && !bar && !/^Ctrl|^[/?:]$/.test(key)) {
      if (/\b[a-z]$/.test(key) && !(event.target instanceof HTMLSelectElement) && actionOf(page, key)) page.say("Letters act in the drawing: Esc leads there.");
      return;
    }
    // A clicked place is taken back first.
    if (key === "Ctrl+z" && store.shaping?.places.length) {
      event.preventDefault();
      return page.shaper.back();
    }
    const action = actionOf(page, key);
    if (!action) return;
    event.preventDefault();
    this.finish();
    if (nowhere) page.activeView().upper.focus({preventScroll: true});
    action.run(page);
  }

  /** @param {HTMLInputElement | null} field @param {EventTarget | null} at */
  #escape(field, at) {
    const {page} = this, {store} = page;
    if (store.held) {
      clearTimeout(this.timer);
      this.burst = false;
      page.cancel();
    } else if (store.refusal || store.problem) {
      store.refusal = store.problem = null;
      store.changed("overlay", "panel");
    } else if (page.shaper.stop()) page.say("Nothing is re-shaped.");
    else if (store.inserting !== null) {
      store.inserting = null;
      page.say("No point is inserted.");
    } else if (store.ghost || page.shower) page.dropGhost();
    else if (field) page.leaveField(field);
    else if (at instanceof Element && at.closest("aside, .bar")) page.activeView().upper.focus({preventScroll: true});
    else if (store.marked) {
      store.marked = null;
      store.changed("hull", "overlay");
    }
    else if (store.maximised) page.maximise(/** @type {Kind} */ (store.maximised));
    else store.select(null, null);
  }

  /** @param {[number, number]} way @param {number} times */
  #nudge(way, times, view = this.page.activeView(), row = this.page.store.selection.row) {
    const {store, hand} = this.page;
    if (view.kind === "wire") return this.page.say("The wire only shows: choose a point in another drawing.");
    if (store.tools.how === "pull") return this.nudge((way[0] + way[1]) * times * STEP);
    const held = this.#hold("move", row, () => this.#nudge(way, times, view, row));
    if (!held) return;
    const s = view.kind === "body" ? view.side(held.start[0]) : 1;
    this.sum[view.a] += s * way[0] * times * STEP;
    this.sum[view.b] += way[1] * times * STEP;
    hand.move(this.sum);
    this.#wait();
  }

  /** Pulls the hull at the chosen point by d (m) more. @param {number} d */
  nudge(d, row = this.page.store.selection.row) {
    if (!this.#hold("pull", row, () => this.nudge(d, row))) return;
    this.sum[0] += d;
    this.page.hand.pull(this.sum[0]);
    this.#wait();
  }

  /** Takes hold of a point, or keeps it in the same burst; while an edit is made, that is done later. @param {"pull" | "move"} how @param {number | null} row @param {() => void} again */
  #hold(how, row, again) {
    const {page} = this, {store, hand} = page, {what} = page.panel.proposal, {shown} = this;
    if (row === null) return void page.say("Choose a point first: click it, or press / and type its name.");
    if (this.burst && (store.held?.how !== how || store.held.row !== row)) this.finish();
    if (!this.burst) {
      if (page.making) return void this.queue.push(again);
      if (!hand.begin(row, how)) return void page.say("That was not done: let go of the point in hand first.");
      this.burst = true;
      this.sum = shown && shown.what === what && shown.row === row && shown.how === how ? shown.sum : [0, 0, 0];
    }
    if (!store.held) this.burst = false; // it was refused
    return store.held;
  }

  #wait() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.finish(), BURST);
  }

  /** Ends a burst: it is one edit. */
  finish() {
    clearTimeout(this.timer);
    if (!this.burst) return;
    this.burst = false;
    const {hand, panel, store: {held}} = this.page;
    hand.finish();
    const {what} = panel.proposal;
    this.shown = held && what && {what, row: held.row, how: held.how, sum: this.sum};
  }

  /** The edit is made: what was asked for meanwhile is done now. */
  resume() {
    for (const act of this.queue.splice(0)) act();
  }

  /** Nothing more is done of what was asked for meanwhile. */
  forget() {
    const n = this.queue.splice(0).length;
    if (n) this.page.say(`${n} more ${n === 1 ? "step was" : "steps were"} not made.`);
  }
}
