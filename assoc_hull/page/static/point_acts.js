// What is done to the chosen point: it is pulled by a number, bends its line, is pinned, deleted, given a role.

import {button, make, paragraph} from "./elements.js";
import {ADOPTED, CROSSING, PLACED} from "./net.js";
import {typedNumber} from "./units.js";

const FARTHEST = 50; // m; no pull is as large

/** Roles that a crossing may be given; of its two lines the first is a. @type {[string | null, string][]} */
const ROLES = [[null, "by the rule"], ["shared", "shared: both lines are made through it"], ["drives a", "driven by the second line"], ["drives b", "driven by the first line"], ["watched", "watched: it defines neither line"]];

/** @param {Page} page */
const chosen = ({store: {net, selection}}) => (selection.row === null ? undefined : net?.points.get(selection.row));

/** The name of a point as one of the chosen line: what is said of it is said of that line. @param {Page} page @param {Point} point */
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

/** A choice of the roles of a crossing. @param {Page} page @param {Point} point */
export function roleChoice(page, point) {
  const choice = make("select", {ariaLabel: "role of the point"});
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
    this.element = make("div");
    const label = make("label");
    this.steps = [-1, 1].map((sign) => button(`${sign < 0 ? "−" : "+"}1 mm`, () => page.keys.nudge(sign * 1e-3)));
    this.field = make("input", {inputMode: "decimal", title: "Outward; a minus goes inward. Enter pulls, over the radius below."});
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
    if (tools.fair) page.panel.proposal.show(`${name}, answered fairly`, ops);
    else page.apply(name, ops);
    page.leaveField(this.field); // in the drawing letters and Ctrl+Z act, and Enter applies a ghost
  }
}
