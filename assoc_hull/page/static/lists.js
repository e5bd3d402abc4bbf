// What is chosen, and listed: all lines by family, to choose one without knowing where it lies; the points
// of the chosen line; what can be done with the chosen point beside dragging it; what is wrong with the hull.

import {Asker, button, link, paragraph} from "./asker.js";
import {CROSSING} from "./net.js";
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
    const table = document.createElement("table"), caption = table.createCaption(), head = table.createTHead().insertRow();
    caption.textContent = `Points of ${store.net.curveName(id)}, m`;
    for (const title of ["point", "x", "y", "z"]) {
      const cell = document.createElement("th");
      cell.scope = "col";
      cell.textContent = title;
      head.append(cell);
    }
    const body = table.createTBody();
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
    /** @type {Finding[] | null} */
    this.found = null;
  }

  look() { this.ask({t: "check"}, "Looking …"); }

  /** @param {{id: number, value: Finding[] | null}} message */
  answer(message) {
    if (message.id !== this.asked || !message.value) return;
    this.found = message.value;
    this.state = this.page.store.state;
    this.page.say(this.#words());
    this.render();
  }

  #words() {
    const n = this.found?.length ?? 0;
    return n ? `${n} ${n === 1 ? "problem" : "problems"}` : "Nothing is wrong.";
  }

  render() {
    if (!this.found) return;
    const old = this.state !== this.page.store.state;
    this.words.textContent = `${this.#words()}${old ? " That was before the last edit." : ""}`;
    this.list.replaceChildren(...this.found.slice(0, 100).map((finding) => link(finding.text, () => this.page.goTo(finding.object, finding.place))));
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

const MOST = 50; // m; no pull is as large

/** The address of a point as one of a line: "ST 7 x WL 2" is that of ST 7. @param {Page} page @param {import("./net.js").Point} point @param {number} curve */
function addressOn({store}, point, curve) {
  const [whole, one, other, rest] = /^(.+?) x (.+?)( #\d+)?$/.exec(point.name) ?? [point.name], line = store.net?.lineOf(curve)?.name;
  return whole === point.name && one !== undefined && other === line ? `${other} x ${one}${rest ?? ""}` : point.name;
}

/** The chosen point, and the curve that it is changed on. @param {Page} page */
function chosen({store}) {
  const {selection, net} = store, point = selection.row === null ? undefined : net?.points.get(selection.row);
  if (!point) return null;
  const curve = selection.curve !== null && [point.a, point.b].includes(selection.curve) ? selection.curve : point.a;
  return {point, curve, kind: point.kind[curve === point.a ? 0 : 1]};
}

/** Whether a point could be made a knuckle, or smooth. @param {Page} page @param {number} kind */
export const takesKind = (page, kind) => chosen(page) !== null && chosen(page)?.kind !== kind;

/** Whether a point is one that somebody placed. @param {Page} page */
export const isPlaced = (page) => (chosen(page)?.point.sort ?? CROSSING) !== CROSSING;

/** Shows what a knuckle, or its end, does. @param {Page} page @param {"knuckle" | "smooth"} kind */
export function proposeKind(page, kind) {
  const found = chosen(page);
  if (!found) return;
  const line = page.store.net?.curveName(found.curve) ?? "";
  page.panel.proposal.show(`${kind === "knuckle" ? "a knuckle of" : "no knuckle of"} ${line} at ${found.point.name}`, [{op: "set_kind", point: addressOn(page, found.point, found.curve), kind}]);
}

/** Shows what the line is without a point. @param {Page} page */
export function proposeDeletion(page) {
  const found = chosen(page);
  if (found) page.panel.proposal.show(`delete ${found.point.name}`, [{op: "delete", point: found.point.name}]);
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
    this.field.title = "Outward; a minus takes the hull in. Enter pulls by so much, over the radius below.";
    this.field.onkeydown = (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      this.#pull();
    };
    label.append("pull by, mm ", this.field);
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
    const point = chosen(this.page)?.point;
    this.element.hidden = !point;
    if (!point) return;
    const words = point.held ? this.page.store.net?.wayWords(point) ?? "" : "";
    if (this.way.textContent !== words) this.way.textContent = words;
    this.way.hidden = !words;
  }

  #pull() {
    const {page} = this, {tools} = page.store, point = chosen(page)?.point, far = typedNumber(this.field), d = far / 1e3;
    if (!point) return;
    if (!Number.isFinite(d) || d === 0 || Math.abs(d) > MOST) return page.say(`"${this.field.value}" is no pull: type millimetres, such as 5 or -2.5`);
    const name = `pull ${point.name} by ${far} mm`, ops = [{op: "pull", point: point.name, d, ...(tools.radius ? {radius: tools.radius} : {}), ...(tools.fair ? {fair: true} : {})}];
    this.field.value = "";
    // Outside the drawing Enter would pull once more.
    if (tools.fair) page.panel.proposal.show(`${name}, answered fairly`, ops);
    else page.apply(name, ops);
  }
}
