// What is done to the chosen point by one key: how its line passes it, whose it is, that it goes.

import {ADOPTED, CROSSING, PLACED} from "./net.js";

/** @typedef {import("./page.js").Page} Page */

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
    else if (name) page.apply(`${kind} at ${name}`, [{op: "set_kind", point: name, kind}]);
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
    if (point) page.apply(`delete ${point.name}`, [{op: "delete", point: point.name}]);
  },
};

/** A choice of the roles of a crossing. @param {Page} page @param {import("./net.js").Point} point */
export function roleChoice(page, point) {
  const choice = document.createElement("select");
  choice.setAttribute("aria-label", "role of the point");
  choice.append(new Option("change it …", ""), ...ROLES.map(([, words], i) => new Option(words, String(i))));
  choice.onchange = () => {
    const [role, words] = ROLES[Number(choice.value)];
    page.apply(`${point.name}, ${words.split(":")[0]}`, [{op: "set_role", crossing: point.name, role}]);
    choice.value = "";
  };
  return choice;
}
