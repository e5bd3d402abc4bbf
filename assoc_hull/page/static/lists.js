// Lists of lines, points and faults.

import {Asker} from "./asker.js";
import {button, link, make, paragraph, tableOf} from "./elements.js";
import {alongCurve} from "./ways.js";

/** @typedef {{kind: string, object: string, place: number[] | null, text: string}} Finding */

/** The points of the chosen curve, as a table; it is made anew when another curve or state is shown. */
export class PointTable {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.box = box;
    this.shown = "";
    this.axes = [0, 1, 2];
  }

  render() {
    const {store} = this.page, id = store.selection.curve, key = `${id}/${store.state}/${store.selection.row}`;
    const open = this.box.closest("details")?.open;
    if (!open || key === this.shown) return;
    this.shown = key;
    if (id === null || !store.net) {
      return this.box.replaceChildren(paragraph("Click a line: its points are listed here."));
    }
    // What all have in common stands above them: the panel is narrow.
    const {axis, offset} = store.net.lineOf(id) ?? {axis: null, offset: null}, plane = axis === null || offset === null ? "" : `, all at ${"xyz"[axis]} = ${offset.toFixed(3)}`;
    this.axes = [0, 1, 2].filter((i) => !plane || i !== axis);
    const table = tableOf(`${store.net.rowsOf.get(id)?.length ?? 0} points lie on ${store.net.curveName(id)}, m${plane}; ${store.curves.get(id)?.n ?? 0} of them define it`, ["point", ...this.axes.map((i) => "xyz"[i])]), body = table.createTBody();
    for (const row of alongCurve(store, id)) this.#row(body.insertRow(), row, id);
    this.box.replaceChildren(table);
  }

  /** @param {HTMLTableRowElement} line @param {number} row @param {number} id */
  #row(line, row, id) {
    const {store} = this.page, point = store.net?.points.get(row), place = store.places.get(row);
    if (!point || !place || !store.net) return;
    const other = point.a === id ? point.b : point.a, name = link(other >= 0 ? store.net.curveName(other) : store.said(point.name).replace(/^(\w+) point (\d+) of .*$/, "$1 $2"), () => this.page.choose(row, id));
    name.title = `${store.said(point.name)}: ${store.net.roleWords(point)}`;
    if (row === store.selection.row) line.setAttribute("aria-current", "true");
    line.insertCell().append(name);
    for (const i of this.axes) {
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
    /** What was refused last; its bubble goes with the next press, this stays until an edit is made. @type {Refusal | null} */
    this.refusal = null;
    this.count = make("span", {className: "count"});
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
    const rows = found.slice(0, 100).map((finding) => link(store.said(finding.text), () => this.page.goTo(finding.object, finding.place)));
    const name = refused?.row == null ? "" : store.net?.points.get(refused.row)?.name ?? "", first = refused?.text.split("\n")[0] ?? "";
    const last = refused ? [paragraph("Refused last:"), name ? link(first, () => this.page.goTo(name, refused.place)) : paragraph(first)] : [];
    if (refused) last[1].title = refused.all;
    this.list.replaceChildren(...words, ...rows, ...last);
  }
}

export class LineChoice {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.select = make("select", {ariaLabel: "the chosen line"});
    this.select.onchange = () => {
      if (this.select.value) page.choose(null, Number(this.select.value));
    };
    this.shown = /** @type {Net | null} */ (null);
    box.append(this.select);
  }

  render() {
    const {net, selection} = this.page.store;
    if (!net) return;
    if (net !== this.shown) {
      this.shown = net;
      const families = new Map();
      for (const line of [...net.lines].sort((p, q) => (p.offset ?? 0) - (q.offset ?? 0))) {
        const group = families.get(line.family) ?? make("optgroup");
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
