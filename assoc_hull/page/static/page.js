// The page: its parts, what the server says, what actions do.

import {make} from "./elements.js";
import {ACTIONS, Keys, keyWords} from "./actions.js";
import {Hand} from "./hand.js";
import {CROSSING, Net} from "./net.js";
import {GHOST, LIVE, NET, PUBLISHED, THEIRS, VERSION, parseFrame} from "./wire.js";
import {LONG} from "./asker.js";
import {READ, Speaker, placeBubble, writeFoot} from "./notices.js";
import {keepLooks, layRows, readInk, restoreLooks, themeOf} from "./looks.js";
import {Panel} from "./panel.js";
import {Pointers} from "./gesture.js";
import {Shaper} from "./propose.js";
import {Store} from "./store.js";
import {View} from "./view.js";
import {count} from "./units.js";
import {farthestDrawn, magnify, paintHull, paintOverlay} from "./paint.js";
import {reasonWords} from "./reasons.js";
import {makeBar, openPalette} from "./bar.js";
import {choose, find, goTo, stepCurve, stepPoint} from "./ways.js";

/** @typedef {{open: () => void, text: (text: string) => void, bytes: (bytes: ArrayBuffer) => void, lost: () => void, over: (reason: string) => void}} Hands */
/** @typedef {{send: (message: object) => void}} Link */
/** @typedef {{token: string, author: string, connect: (hands: Hands) => Link, keep: (name: string, value: string) => void, kept: (name: string) => string | null, within?: AbortSignal, upload?: (file: File) => Promise<any>}} Options */

const KINDS = /** @type {Kind[]} */ (["body", "profile", "half", "wire"]);

/** @param {HTMLElement} root @param {Options} options */
export function mount(root, options) {
  return new Page(root, options);
}

export class Page {
  /** @param {HTMLElement} root @param {Options} options */
  constructor(root, options) {
    this.root = root;
    this.options = options;
    this.store = new Store();
    this.store.author = options.author;
    root.dataset.tab = this.store.tab;
    this.speaker = new Speaker(root);
    this.bar = makeBar(this);
    const views = make("main", {className: "views"}), aside = make("aside", {ariaLabel: "Point, curve, edit"});
    this.banner = make("div", {className: "banner"});
    this.banner.setAttribute("role", "status");
    this.status = make("span");
    this.figures = make("span");
    root.append(this.bar.element, this.banner, views, aside, make("footer", {}, this.status, this.figures));
    const length = {o: 0, s: 1};
    this.views = Object.fromEntries(KINDS.map((kind) => [kind, new View(kind, this.store, kind === "profile" || kind === "half" ? length : {o: 0, s: 1}, views)]));
    this.views.profile.partner = this.views.half;
    this.views.half.partner = this.views.profile;
    this.hand = new Hand(this.store, (message) => this.link.send(message));
    this.pointers = Object.fromEntries(KINDS.map((kind) => [kind, new Pointers(this.views[kind], this.hand)]));
    this.hand.scale = () => Math.max(...["body", "profile", "half"].map((kind) => this.views[kind].shown ? Math.max(this.views[kind].axis.s, this.views[kind].sy) : 0));
    this.hand.onGrip = () => Object.values(this.pointers).forEach((each) => each.track());
    this.hand.onBegin = () => this.dropGhost();
    this.hand.onLet = (held, wish) => this.#proposed(held, wish);
    for (const kind of KINDS) this.pointers[kind].onInsert = (place) => this.#insertAt(place);
    for (const kind of KINDS) this.views[kind].upper.addEventListener("focus", () => this.#look(kind));
    this.shaper = new Shaper(this);
    for (const kind of KINDS) this.pointers[kind].shaper = this.shaper;
    this.active = /** @type {Kind} */ ("body");
    this.panel = new Panel(this, aside);
    for (const kind of KINDS) this.pointers[kind].onPlace = (x, y) => this.panel.beside.click(this.views[kind], x, y);
    this.keys = new Keys(this);
    this.panelStale = true;
    this.pending = 0;
    this.number = 0;
    this.said = {words: "", at: -Infinity};
    /** Numbers of an edit that is being made, and of an undo or redo, 0 if none. */
    this.applying = this.turning = 0;
    this.back = false;
    /** Whether the edit that is being made is a pull, which has a radius. */
    this.pulls = false;
    /** The number of the ghost that is waited for or shown, and who asked for it. */
    this.wanted = 0;
    this.shower = /** @type {{dropped: () => void} | null} */ (null);
    /** @type {any} */
    this.message = null;
    this.ink = readInk(root);
    /** Counts and times for who measures. */
    this.stats = {frames: 0, steps: /** @type {number[]} */ ([]), drawn: /** @type {number[]} */ ([]), bytes: 0};
    this.store.listeners.add((what) => this.#stale(what));
    restoreLooks(this);
    this.dress();
    const sizes = new ResizeObserver(() => this.#stale("hull")), signal = options.within;
    sizes.observe(views);
    signal?.addEventListener("abort", () => sizes.disconnect());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.dress(), {signal});
    addEventListener("blur", () => this.letGo(), {signal});
    // Paper is light, whatever the screen is, and does not wait for a frame.
    for (const when of ["beforeprint", "afterprint"]) addEventListener(when, () => { this.dress(); this.#frame(); }, {signal});
    this.link = options.connect({
      open: () => this.link.send({t: "hello", version: VERSION, token: options.token, author: this.store.author}),
      text: (text) => this.#told(JSON.parse(text)),
      bytes: (bytes) => this.#drawn(bytes),
      lost: () => this.#lost("lost", "The server has gone. What was committed is kept; trying again."),
      over: (reason) => this.#lost("over", reason),
    });
    Object.assign(root, {fairing: this});
    this.#stale("panel");
  }

  // ---- what the server says

  /** @param {any} message */
  #told(message) {
    const {store, hand} = this;
    if (message.id) for (const each of this.panel.askers) each.arrived(message.id);
    if (message.id === this.applying) this.applying = 0; // made, or not
    if (message.t === "session") {
      store.file = message.file;
      store.changed("panel");
    } else if (message.t === "net") this.message = message;
    else if (message.t === "state") {
      store.history = message;
      store.changed("panel");
    } else if (message.t === "grip") hand.grip(message);
    else if (message.t === "refused") {
      if (!hand.refused(message) && message.id) {
        const told = this.panel.askers.some((each) => each.refused(message));
        if (!told) this.#refusedHere(message);
      }
    } else if (message.t === "done") {
      hand.done(message);
      for (const each of this.panel.askers) each.done(message);
      store.last = {...message, drawn: store.drawn, state: store.state};
      this.say(`${store.said(message.name)}: ${count(message.relofted, "curve")} followed.`);
      store.changed("panel");
      if (!this.making) this.keys.resume();
    } else if (message.t === "hold") {
      store.theirs = message.row === null ? null : {author: message.author, row: message.row, frame: null};
      if (store.theirs) this.speaker.say(`${message.author} holds ${store.said(store.net?.points.get(message.row)?.name ?? "a point")}`);
      store.changed("overlay", "panel");
    } else if (message.t === "theirs") {
      store.last = {...message, drawn: store.drawn, state: store.state};
      store.changed("panel");
      this.speaker.say(`${message.author} has made: ${store.said(message.name)}`);
    } else if (message.t === "answer") {
      if (message.id === this.turning) this.say(store.said(this.back ? `Taken back: ${store.history.redo}.` : `Made again: ${store.history.undo}.`));
      this.panel.answer(message);
    }
    else if (message.t === "problem") {
      if (!this.panel.askers.some((each) => each.problem(message))) {
        hand.problem(message);
        store.problem = store.said(message.text);
        store.changed("panel", "overlay");
      }
    }
    if ((message.t === "refused" || message.t === "problem") && !this.making) this.keys.forget();
  }

  /** An edit that was typed is refused: said at the point. @param {any} message */
  #refusedHere(message) {
    const {store} = this, row = store.selection.row, all = message.reasons.join("\n"), text = store.said(reasonWords(message.reasons, this.pulls));
    this.said.words = ""; // it is not being made any more
    store.refusal = {text, all, row, place: row === null ? null : [...(store.places.get(row) ?? [])], named: store.net?.named(all) ?? []};
    store.changed("overlay", "panel");
  }

  /** @param {ArrayBuffer} bytes */
  #drawn(bytes) {
    const frame = parseFrame(bytes), {store, hand} = this;
    this.stats.bytes = frame.bytes;
    if (store.net && (frame.kind === NET || frame.kind === PUBLISHED)) store.drawn = farthestDrawn(frame, store.curves);
    if (frame.kind === NET) {
      const first = store.net === null, net = new Net(this.message);
      hand.renew(() => {
        store.connection = "open"; // what was held before is dropped
        store.adopt(net, frame);
        this.dropGhost();
      });
      if (!this.options.within) this.root.ownerDocument.title = `${net.particulars.name} – fairing page`;
      this.bar.name(net.particulars, net.lines.length, net.points.size);
      if (first) this.fit();
    } else if (frame.kind === LIVE) {
      const asked = hand.asked.get(frame.seq);
      if (asked !== undefined) this.stats.steps.push(performance.now() - asked.time);
      if (hand.live(frame)) this.speaker.listen(store);
      hand.asked.delete(frame.seq);
    } else if (frame.kind === THEIRS) {
      if (store.theirs && frame.state === store.state) {
        store.theirs.frame = frame;
        store.changed("overlay");
      }
    } else if (frame.kind === GHOST) {
      // One of a state that has passed would be compared with another hull.
      if (frame.state === store.state && frame.seq === this.wanted) {
        store.ghost = frame;
        store.changed("overlay");
      }
    } else {
      store.publish(frame);
      this.dropGhost();
    }
  }

  /** @param {"lost" | "over"} how @param {string} reason */
  #lost(how, reason) {
    this.letGo();
    this.hand.drop();
    this.dropGhost();
    this.applying = this.turning = 0;
    this.keys.forget();
    for (const each of this.panel.askers) each.lost();
    this.store.theirs = null;
    this.store.connection = how;
    this.store.reason = reason;
    this.store.changed("overlay", "panel");
  }

  // ---- drawing: at most one frame waits

  /** @param {Stale} what */
  #stale(what) {
    if (what === "panel") this.panelStale = true;
    else for (const view of Object.values(this.views)) {
      view.stale.overlay = true;
      if (what === "hull") view.touch();
    }
    if (!this.pending) this.pending = requestAnimationFrame(() => this.#frame());
  }

  #frame() {
    this.pending = 0;
    const begin = performance.now(), {store} = this;
    layRows(this);
    // One that is measured anew is fitted anew, if nobody has looked elsewhere.
    const other = Object.values(this.views).filter((view) => view.measure());
    for (const view of other) if (view.fitted) view.fit();
    // The two low views share their lengths.
    else view.settle(view.kind !== "half" || !this.views.profile.shown);
    if (other.length) this.panelStale = true; // what is not seen cannot be compressed
    const moved = store.overlay?.frame ?? store.ghost ?? store.theirs?.frame;
    if (moved) magnify(store, moved, this.hand.scale());
    else store.magnified = 0;
    for (const view of Object.values(this.views)) {
      if (!view.shown) continue;
      if (view.stale.hull) paintHull(view, this.ink);
      if (view.stale.overlay) paintOverlay(view, this.ink);
    }
    placeBubble(this);
    if (this.panelStale && !this.panel.pressed) {
      this.panelStale = false;
      this.panel.render();
      this.bar.render();
      writeFoot(this);
      this.speaker.listen(store);
    }
    this.stats.frames++;
    this.stats.drawn.push(performance.now() - begin);
    for (const kept of [this.stats.drawn, this.stats.steps]) if (kept.length > 2000) kept.shift();
    const {dataset} = this.root;
    dataset.state = String(store.state);
    dataset.connection = store.connection;
    dataset.seq = String(store.overlay?.frame.seq ?? 0);
    if (store.net) dataset.ready = "yes";
  }

  // ---- what the actions do

  /** @param {string} words */
  say(words) {
    this.speaker.say(words);
    this.said = {words, at: performance.now()};
    this.status.textContent = words;
    setTimeout(() => writeFoot(this), READ);
  }

  /** A fair answer and a lead are looked at before they are made. @param {Held} held @param {Record<string, number>} wish */
  #proposed(held, wish) {
    const {tools, net} = this.store, point = net?.points.get(held.row), far = (1e3 * (held.amount ?? 0)).toFixed(1);
    if (!point) return false;
    if (held.how === "pull" && tools.fair) this.panel.proposal.show(`pull ${point.name} by ${far} mm, answered fairly`, [{op: "pull", point: point.name, d: wish.d, radius: held.radius, fair: true}]);
    else if (held.how === "move" && point.sort !== CROSSING && !tools.pinned) this.panel.proposal.show(`lead ${net?.curveName(point.a)} by ${point.name}, ${far} mm`, [{op: "move", point: point.name, ...wish, lead: true}]);
    else return false;
    return true;
  }

  /** The next click inserts a point into the chosen line. */
  insert() {
    const {selection} = this.store;
    if (selection.curve === null) return this.say("Choose a line first: click it.");
    this.shaper.stop();
    this.store.inserting = selection.curve;
    this.dropGhost();
    this.say("Click where the line is to go through: beside it, the line is led there. Esc cancels.");
  }

  /** @param {number[] | null} place */
  #insertAt(place) {
    const {store} = this, id = store.inserting, name = id === null ? "" : store.net?.curveName(id) ?? "";
    if (!place) return this.say(`Click in the view that shows ${name} in its plane. Esc cancels.`);
    store.inserting = null;
    this.panel.proposal.show(`insert a point into ${name} at (${place.map((each) => each.toFixed(3)).join(", ")}) m`, [{op: "insert", curve: name, place, lead: !store.tools.pinned}]);
  }

  /** @param {"fair" | "fairShapes" | "pinned"} what */
  toggleTool(what) {
    this.store.tools[what] = !this.store.tools[what];
    this.store.changed("panel");
    this.keep();
  }

  activeView() { return this.views[this.store.maximised ?? this.active]; }

  /** @param {Kind} kind */
  #look(kind) {
    this.active = kind;
  }

  /** @param {"pull" | "move"} how */
  use(how) {
    this.store.tools.how = how;
    this.store.changed("panel");
    this.keep();
  }

  toggleFine() {
    this.store.tools.fine = !this.store.tools.fine;
    this.store.changed("panel");
    this.keep();
  }

  /** Asks for something; gives the number that the answer will have. @param {object} message */
  request(message) {
    this.link.send({...message, id: ++this.number});
    return this.number;
  }

  /** Tells the server that an answer is not wanted any more. @param {number} id */
  giveUp(id) { this.link.send({t: "stop", id}); }

  /** Removes the ghost; one that is still to come is not shown. */
  dropGhost() {
    const {store, shower, wanted} = this;
    if (wanted && !store.ghost) this.giveUp(wanted);
    this.wanted = 0;
    this.shower = store.ghost = null;
    shower?.dropped();
    store.changed("overlay");
  }

  /** Whether an edit is on its way. */
  get making() { return this.hand.committing !== null || this.applying > 0; }

  /** Whether there is anything to take back: a ghost, an edit on its way, or the last one. */
  get undoes() {
    const {store, hand, keys} = this;
    return store.connection === "open" && (this.making || keys.burst || (store.held === null && (this.shower !== null || store.history.undo !== null)));
  }

  undo() { this.#turn("undo"); }

  redo() { this.#turn("redo"); }

  /** What is only shown goes first. @param {"undo" | "redo"} way */
  #turn(way) {
    this.keys.finish();
    this.keys.forget();
    this.back = way === "undo";
    this.panel.problems.refusal = null; // who goes back has done with it
    if (this.back && this.shower && !this.applying) {
      this.dropGhost();
      return this.say("The ghost is gone; nothing was made. Undo takes back the last edit.");
    }
    this.store.refusal = this.store.problem = null;
    this.turning = this.request({t: way});
  }

  /** @param {string} name @param {object[]} ops */
  apply(name, ops) {
    this.keys.finish();
    this.store.refusal = this.store.problem = null;
    this.pulls = /** @type {{op?: string}[]} */ (ops).some(({op}) => op === "pull");
    const id = this.applying = this.request({t: "apply", name: name.slice(0, 190), ops});
    setTimeout(() => {
      if (this.applying === id) this.say(`${this.store.said(name)}: it is being made …`);
    }, LONG);
    return id;
  }

  /** @param {string} name */
  sign(name) {
    if (!name.trim()) return this.say("Type a name.");
    this.store.author = name.trim();
    this.options.keep("author", this.store.author);
    this.link.send({t: "sign", author: this.store.author});
  }

  cancel() {
    if (!this.store.held) return;
    for (const each of Object.values(this.pointers)) each.cancel();
    this.hand.cancel();
    this.store.refusal = null; // with what was refused
    this.store.changed("overlay", "panel");
  }

  /** The window loses the focus, or the connection breaks: what is in hand is let go. */
  letGo() {
    this.keys.finish();
    for (const each of Object.values(this.pointers)) each.cancel();
  }

  fit() {
    for (const view of [this.views.body, this.views.wire, this.views.profile]) view.shown ? view.fit() : view.partner?.fit();
    this.store.changed("hull", "overlay");
  }

  /** @param {number} squeeze */
  compress(squeeze) {
    this.store.squeeze = squeeze;
    for (const view of [this.views.profile, this.views.half]) view.fit();
    this.store.changed("hull", "overlay", "panel");
    this.keep();
  }

  /** @param {number} factor */
  zoom(factor) {
    const view = this.activeView();
    view.zoom(view.width / 2, view.height / 2, factor);
    this.store.changed("overlay");
  }

  /** @param {number} dx @param {number} dy */
  pan(dx, dy) {
    this.activeView().pan(dx, dy);
    this.store.changed("overlay");
  }

  /** @param {Kind} kind */
  maximise(kind) {
    const at = this.root.ownerDocument.activeElement, drawing = at instanceof HTMLCanvasElement;
    const back = this.store.maximised === kind;
    this.store.maximised = back ? null : kind;
    this.store.tab = kind;
    this.root.dataset.maximised = this.store.maximised ?? "";
    this.root.dataset.tab = kind;
    this.store.changed("hull", "overlay", "panel");
    if (!back) this.active = kind;
    // A drawing that is hidden cannot keep the focus, and the keys act where it is.
    if (drawing) this.activeView().upper.focus({preventScroll: true});
  }

  /** @param {number} by */
  step(by) { stepPoint(this, by); }

  /** @param {number} by */
  stepCurve(by) { stepCurve(this, by); }

  /** @param {number | null} row @param {number | null} curve */
  choose(row, curve) { choose(this, row, curve); }

  /** Leads to what a finding names. @param {string} object @param {number[] | null} place @param {number | null} [curve] */
  goTo(object, place, curve = null) { goTo(this, object, place, curve); }

  search() { this.bar.look(); }

  /** @param {string} name */
  find(name) { find(this, name); }

  /** @param {HTMLInputElement} field */
  leaveField(field) {
    field.blur();
    delete field.dataset.typed;
    this.panel.shownState = -1;
    this.store.changed("panel");
    this.activeView().upper.focus({preventScroll: true});
  }

  nextTheme() {
    const all = ["auto", "light", "dark"];
    this.store.theme = all[(all.indexOf(this.store.theme) + 1) % all.length];
    this.dress();
    this.keep();
  }

  dress() {
    this.root.dataset.theme = themeOf(this.store.theme);
    this.ink = readInk(this.root);
    this.store.changed("hull", "overlay", "panel");
  }

  palette() {
    const able = ACTIONS.filter((each) => each.id !== "palette" && (each.enabled?.(this) ?? true));
    openPalette(this, able.map(({words, keys, run}) => ({words, keys: keys.map(keyWords).join(", "), run: () => run(this)})));
  }

  sheet() {
    this.bar.sheet(ACTIONS.map(({words, keys}) => [words, keys.map(keyWords).join(" or ")]));
  }

  keep() { keepLooks(this); }
}
