// What can be done with the chosen point beside dragging it: pulled by typed millimetres, nudged,
// made a knuckle or smooth, deleted.

import {button, paragraph} from "./asker.js";
import {CROSSING} from "./net.js";

/** @typedef {import("./page.js").Page} Page */

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
    const {page} = this, {tools} = page.store, point = chosen(page)?.point, far = Number(this.field.value.replace(",", ".").replace("−", "-").trim() || NaN), d = far / 1e3;
    if (!point) return;
    if (!Number.isFinite(d) || d === 0 || Math.abs(d) > MOST) return page.say(`"${this.field.value}" is no pull: type millimetres, such as 5 or -2.5`);
    const name = `pull ${point.name} by ${far} mm`, ops = [{op: "pull", point: point.name, d, ...(tools.radius ? {radius: tools.radius} : {}), ...(tools.fair ? {fair: true} : {})}];
    this.field.value = "";
    // Outside the drawing Enter would pull once more.
    if (tools.fair) page.panel.proposal.show(`${name}, answered fairly`, ops);
    else page.apply(name, ops);
  }
}
