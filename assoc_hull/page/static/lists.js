// Lists of lines, points and faults; the ways to what is chosen, named or found; what is done to a chosen point.

import {ADOPTED, CROSSING, PLACED} from "./net.js";
import {Asker, button, link, paragraph, tableOf} from "./asker.js";
import {typedNumber} from "./units.js";

/** @typedef {import("./page.js").Page} Page */

/** @typedef {{kind: string, object: string, place: number[] | null, text: string}} Finding */

/** Points of a curve in their order along it. @param {import("./store.js").Store} store @param {number} id @returns {number[]} */
export function alongCurve(store, id) {
  const c = store.curves.get(id), rows = store.net?.rowsOf.get(id) ?? [];
  const where = (/** @type {number} */ row) => {
    const place = store.places.get(row);
    let best = 0, least = Infinity;
    if (c && place) for (let i = 0; i + 1 < c.n; i++) {
      const p = 3 * i, d = [0, 1, 2].map((j) => c.xyz[p + 3 + j] - c.xyz[p + j]), w = [0, 1, 2].map((j) => place[j] - c.xyz[p + j]);
      const t = Math.min(Math.max((d[0] * w[0] + d[1] * w[1] + d[2] * w[2]) / (d[0] ** 2 + d[1] ** 2 + d[2] ** 2 || 1), 0), 1);
      const far = Math.hypot(w[0] - t * d[0], w[1] - t * d[1], w[2] - t * d[2]);
      if (far < least) [least, best] = [far, i + t];
    }
    return best;
  };
  return rows.map((row) => ({row, at: where(row)})).sort((p, q) => p.at - q.at).map(({row}) => row);
}

/** The points of the chosen curve, as a table; it is made anew when another curve or state is shown. */
export class PointTable {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.box = box;
    this.shown = "";
  }

  render() {
    const {store} = this.page, id = store.selection.curve, key = `${id}/${store.state}/${store.selection.row}`;
    const open = this.box.closest("details")?.open;
    if (!open || key === this.shown) return;
    this.shown = key;
    if (id === null || !store.net) {
      return this.box.replaceChildren(paragraph("Click a line: its points are listed here."));
    }
    const table = tableOf(`Points of ${store.net.curveName(id)}, m`, ["point", "x", "y", "z"]), body = table.createTBody();
    for (const row of alongCurve(store, id)) this.#row(body.insertRow(), row, id);
    this.box.replaceChildren(table);
  }

  /** @param {HTMLTableRowElement} line @param {number} row @param {number} id */
  #row(line, row, id) {
    const {store} = this.page, point = store.net?.points.get(row), place = store.places.get(row);
    if (!point || !place || !store.net) return;
    const other = point.a === id ? point.b : point.a, name = link(other >= 0 ? store.net.curveName(other) : point.name, () => this.page.choose(row, id));
    name.title = `${point.name}: ${store.net.roleWords(point)}`;
    if (row === store.selection.row) line.setAttribute("aria-current", "true");
    line.insertCell().append(name);
    for (let i = 0; i < 3; i++) {
      const cell = line.insertCell();
      cell.textContent = place[i].toFixed(3);
      if (point.free.includes("xyz"[i])) cell.className = "free";
    }
  }
}

/** What the library finds wrong; asked for, as it takes a moment on a large net. */
export class Problems extends Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    box.append(button("Check the hull", () => this.look()), this.words, this.list);
    this.state = -1;
    this.shown = "";
    /** @type {Finding[] | null} */
    this.found = null;
    /** What was refused last; its bubble goes with the next press, this stays until an edit is made. @type {import("./store.js").Refusal | null} */
    this.refusal = null;
    this.count = document.createElement("span");
    this.count.className = "count";
    box.closest("details")?.querySelector("summary")?.append(this.count);
  }

  look() { this.ask({t: "check"}, "Looking …"); }

  /** @param {{id: number, value: Finding[] | null}} message */
  answer(message) {
    if (message.id !== this.asked || !message.value) return;
    this.found = message.value;
    this.words.textContent = "";
    this.state = this.page.store.state;
    this.page.say(this.#words());
    this.render();
  }

  lost() {
    super.lost();
    this.state = -1;
  }

  /** @param {any} _message */
  done(_message) { this.refusal = null; }

  #words() {
    const n = this.found?.length ?? 0;
    return n ? `${n} ${n === 1 ? "problem" : "problems"}` : "Nothing is wrong.";
  }

  render() {
    const {store} = this.page, old = this.state !== store.state, found = /** @type {Finding[]} */ (this.found ?? []), refused = this.refusal = store.refusal ?? this.refusal;
    const n = found.length + (refused ? 1 : 0), key = `${n} ${old} ${this.state} ${refused?.text}`;
    if (key === this.shown) return; // what has the focus is not drawn anew under it
    this.shown = key;
    this.count.textContent = n ? ` ${n}` : "";
    const words = this.found ? [paragraph(`${this.#words()}${old ? " That was before the last edit." : ""}`)] : [];
    const rows = found.slice(0, 100).map((finding) => link(finding.text, () => this.page.goTo(finding.object, finding.place)));
    const name = refused?.row == null ? "" : store.net?.points.get(refused.row)?.name ?? "", first = refused?.text.split("\n")[0] ?? "";
    const last = refused ? [paragraph("Refused last:"), name ? link(first, () => this.page.goTo(name, refused.place)) : paragraph(first)] : [];
    this.list.replaceChildren(...words, ...rows, ...last);
  }
}

export class LineChoice {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.select = document.createElement("select");
    this.select.setAttribute("aria-label", "the chosen line");
    this.select.onchange = () => {
      if (this.select.value) page.choose(null, Number(this.select.value));
    };
    this.shown = /** @type {import("./net.js").Net | null} */ (null);
    box.append(this.select);
  }

  render() {
    const {net, selection} = this.page.store;
    if (!net) return;
    if (net !== this.shown) {
      this.shown = net;
      const families = new Map();
      for (const line of [...net.lines].sort((p, q) => (p.offset ?? 0) - (q.offset ?? 0))) {
        const group = families.get(line.family) ?? document.createElement("optgroup");
        group.label = line.family[0].toUpperCase() + line.family.slice(1);
        line.curves.forEach((id, i) => group.append(new Option(line.names[i], String(id))));
        families.set(line.family, group);
      }
      this.select.replaceChildren(new Option("choose a line …", ""), ...families.values());
    }
    const value = selection.curve === null ? "" : String(selection.curve);
    if (this.select.value !== value) this.select.value = value;
  }
}

const NEAR = 60; // pixels for a metre, at least, where a finding is looked at

/** Chooses, says what it is, and brings it into the picture. @param {Page} page @param {number | null} row @param {number | null} curve @param {boolean} [whole] of a line, from end to end */
export function choose(page, row, curve, whole = false) {
  const {store} = page, {net} = store, point = row === null ? undefined : net?.points.get(row);
  store.select(row, curve);
  store.marked = null;
  bring(page, whole);
  page.say(point && net ? `${point.name}, ${net.roleWords(point)}` : curve === null ? "" : net?.curveName(curve) ?? "");
}

/** Brings what is chosen into the picture, where it is not seen: a point to the middle, a line as large as it fits. @param {Page} page @param {boolean} whole */
function bring(page, whole) {
  const {store} = page, {selection} = store, view = page.activeView(), curve = selection.curve === null ? undefined : store.curveNow(selection.curve);
  const xyz = selection.row === null ? curve?.xyz : store.placeOf(selection.row);
  if (!xyz || view.kind === "wire") return;
  const seen = (/** @type {number} */ i) => {
    const [x, y] = view.atPlace([...xyz.subarray(3 * i, 3 * i + 3)]);
    return x >= 9 && y >= 9 && x <= view.width - 9 && y <= view.height - 9;
  }, ends = Array.from({length: xyz.length / 3}, (_, i) => seen(i)), [x, y] = view.atPlace(xyz);
  if (whole || selection.row !== null ? !ends.every(Boolean) : !ends.some(Boolean)) selection.row === null ? view.enclose(xyz) : view.pan(view.width / 2 - x, view.height / 2 - y);
  store.changed("overlay");
}

/** Shows all of the chosen line, or the chosen point near enough for millimetres; a second time changes nothing. @param {Page} page */
export function showChosen(page) {
  const {store} = page, {selection} = store, view = page.activeView(), place = selection.row === null ? undefined : store.placeOf(selection.row);
  const curve = selection.curve === null ? undefined : store.curveNow(selection.curve);
  if (view.kind === "wire") return page.say("The wire shows all of the hull: click another drawing first.");
  if (place) view.centre(place, NEAR);
  else if (curve) view.enclose(curve.xyz);
  store.changed("hull", "overlay");
}

/** The curve of a name of a line or a curve. @param {Page} page @param {string} name */
export function curveOf(page, name) {
  return [...page.store.net?.curves ?? []].find(([, each]) => each.name === name || each.line.name === name)?.[0] ?? null;
}

/** Leads to what a finding names: all views come near to the place, which is marked. @param {Page} page @param {string} object @param {number[] | null} place @param {number | null} curve */
export function goTo(page, object, place, curve) {
  const {store, root} = page, {net} = store, row = net?.find(object) ?? null, point = row === null ? undefined : net?.points.get(row);
  const at = place ?? (row === null ? undefined : store.placeOf(row)), on = curve ?? point?.a ?? curveOf(page, object);
  if (!at) return find(page, object);
  store.select(row, on);
  store.marked = [...at];
  for (const view of Object.values(page.views)) if (view.shown && view.kind !== "wire") view.centre(at, NEAR);
  store.changed("hull", "overlay");
  // On a narrow screen the drawing lies above the list.
  root.querySelector(".views")?.scrollIntoView({block: "nearest"});
  page.say(`${object} at (${[...at].map((each) => each.toFixed(3)).join(", ")}) m`);
}

/** Chooses a point or a line by its name. @param {Page} page @param {string} name */
export function find(page, name) {
  const {net} = page.store;
  if (!net) return;
  const row = net.find(name), curve = net.findCurve(name);
  if (row === null && curve === null) return page.say(`There is no point and no line "${name}": type a name such as ${net.byName[0]?.[0] ?? "WL 1"}.`);
  const point = row === null ? undefined : net.points.get(row), view = page.activeView();
  const on = point ? [point.a, point.b].find((id) => { const line = net.lineOf(id); return line && view.shows(line) && line.family !== "boundary"; }) ?? point.a : curve;
  choose(page, row, on, true);
  view.upper.focus({preventScroll: true});
}

/** The next point of the chosen line. @param {Page} page @param {number} by */
export function stepPoint(page, by) {
  const {selection, curves} = page.store, id = selection.curve;
  if (id === null || !curves.has(id)) return page.say("Choose a line first.");
  const order = alongCurve(page.store, id), at = selection.row === null ? (by > 0 ? -1 : 0) : order.indexOf(selection.row);
  if (order.length) choose(page, order[(at + by + order.length) % order.length], id);
}

/** The next curve of the view. @param {Page} page @param {number} by */
export function stepCurve(page, by) {
  const {store} = page, view = page.activeView(), lines = (store.net?.lines ?? []).filter((line) => line.family !== "boundary" && view.shows(line));
  lines.sort((p, q) => (p.offset ?? 0) - (q.offset ?? 0));
  const ids = lines.flatMap((line) => line.curves), at = store.selection.curve === null ? (by > 0 ? -1 : 0) : ids.indexOf(store.selection.curve);
  if (ids.length) choose(page, null, ids[(at + by + ids.length) % ids.length]);
}

const FARTHEST = 50; // m; no pull is as large

/** Roles that a crossing may be given; of its two lines the first is a. @type {[string | null, string][]} */
const ROLES = [[null, "by the rule"], ["shared", "shared: both lines are made through it"], ["drives a", "driven by the second line"], ["drives b", "driven by the first line"], ["watched", "watched: it defines neither line"]];

/** @param {Page} page */
const chosen = ({store: {net, selection}}) => (selection.row === null ? undefined : net?.points.get(selection.row));

/** The name of a point as one of the chosen line: what is said of it is said of that line. @param {Page} page @param {import("./net.js").Point} point */
function onChosen({store: {net, selection}}, {a, b, name}) {
  if (b < 0 || !net || (selection.curve !== a && selection.curve !== b)) return name;
  const own = net.curveName(selection.curve), other = net.curveName(selection.curve === a ? b : a);
  if (name.startsWith(`${own} x `)) return name;
  // Where lines meet more than once, the number is that along the line that is named first.
  return name === `${other} x ${own}` ? `${own} x ${other}` : null;
}

/** @param {"smooth" | "tangent" | "knuckle"} kind */
export const passes = (kind) => ({
  enabled: (/** @type {Page} */ page) => chosen(page) !== undefined && page.hand.free,
  run: (/** @type {Page} */ page) => {
    const point = chosen(page), name = point ? onChosen(page, point) : null;
    if (point && name === null) page.say(`${point.name}: choose the line that is named first, then the point.`);
    else if (name) page.panel.proposal.show(`${kind} at ${name}`, [{op: "set_kind", point: name, kind}]);
  },
});

export const pin = {
  enabled: (/** @type {Page} */ page) => page.hand.free && (chosen(page)?.sort ?? CROSSING) !== CROSSING,
  pressed: (/** @type {Page} */ page) => chosen(page)?.sort === PLACED,
  run: (/** @type {Page} */ page) => {
    const point = chosen(page);
    if (point) page.apply(`${point.sort === ADOPTED ? "pin" : "unpin"} ${point.name}`, [{op: point.sort === ADOPTED ? "pin" : "unpin", point: point.name}]);
  },
};

export const remove = {
  enabled: pin.enabled,
  run: (/** @type {Page} */ page) => {
    const point = chosen(page);
    if (point) page.panel.proposal.show(`delete ${point.name}`, [{op: "delete", point: point.name}]);
  },
};

/** A choice of the roles of a crossing. @param {Page} page @param {import("./net.js").Point} point */
export function roleChoice(page, point) {
  const choice = document.createElement("select");
  choice.setAttribute("aria-label", "role of the point");
  choice.append(new Option("role: change it …", ""), ...ROLES.map(([, words], i) => new Option(words, String(i))));
  choice.onchange = () => {
    const [role, words] = ROLES[Number(choice.value)];
    page.apply(`${point.name}, ${words.split(":")[0]}`, [{op: "set_role", crossing: point.name, role}]);
    choice.value = "";
  };
  return choice;
}

export class PointActs {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.element = document.createElement("div");
    const label = document.createElement("label");
    this.steps = [-1, 1].map((sign) => button(`${sign < 0 ? "−" : "+"}1 mm`, () => page.keys.nudge(sign * 1e-3)));
    this.field = document.createElement("input");
    this.field.inputMode = "decimal";
    this.field.title = "Outward; a minus goes inward. Enter pulls, over the radius below.";
    this.field.onkeydown = (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      this.#pull();
    };
    label.append("pull outward, mm ", this.field);
    label.className = "row";
    this.way = paragraph("");
    this.element.append(label, this.way);
    box.append(this.element);
  }

  /** A knuckle, its end and a deletion are buttons that the panel makes of its table. @param {HTMLElement} buttons */
  add(buttons) {
    buttons.prepend(...this.steps);
    this.element.append(buttons);
  }

  focus() {
    this.render();
    this.field.focus();
    this.field.select();
  }

  render() {
    const point = chosen(this.page);
    this.element.hidden = !point;
    if (!point) return;
    const words = point.held ? this.page.store.net?.wayWords(point) ?? "" : "";
    if (this.way.textContent !== words) this.way.textContent = words;
    this.way.hidden = !words;
  }

  #pull() {
    const {page} = this, {tools} = page.store, point = chosen(page), far = typedNumber(this.field), d = far / 1e3;
    if (!point) return;
    if (!Number.isFinite(d) || d === 0 || Math.abs(d) > FARTHEST) return page.say(`"${this.field.value}" is no pull: type millimetres, such as 5 or -2.5`);
    const name = `pull ${point.name} by ${far} mm`, ops = [{op: "pull", point: point.name, d, ...(tools.radius ? {radius: tools.radius} : {}), ...(tools.fair ? {fair: true} : {})}];
    this.field.value = "";
    // Outside the drawing Enter would pull once more.
    if (tools.fair) page.panel.proposal.show(`${name}, answered fairly`, ops);
    else page.apply(name, ops);
  }
}
