// The ways to what is chosen, named, found, or next.

import {evaluate} from "./hermite.js";

/** Points of a curve in their order along it. @param {Store} store @param {number} id @returns {number[]} */
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

const NEAR = 60; // pixels for a metre, at least, where a finding is looked at

/** Chooses, says what it is, and brings it into the picture. @param {Page} page @param {number | null} row @param {number | null} curve @param {boolean} [whole] of a line, from end to end */
export function choose(page, row, curve, whole = false) {
  const {store} = page, {net} = store, point = row === null ? undefined : net?.points.get(row);
  store.select(row, curve);
  store.marked = null;
  bring(page, whole);
  page.say(point && net ? `${net.said(point.name)}, ${net.roleWords(point)}` : curve === null ? "" : net?.curveName(curve) ?? "");
}

const INSET = [[48, 9, 9, 38], [0.3, 0.3, 0.3, 0.3]]; // px within which it is seen; parts of the view to which its nearest part comes
const PARTS = 6; // of a segment

/** Brings what is chosen into the picture, where it is not seen: a point to the middle; a line as large as it fits, or its nearest part, also in the view that draws it in its plane. @param {Page} page @param {boolean} whole */
function bring(page, whole) {
  const {store, root} = page, {selection} = store, {row, curve} = selection, c = curve === null ? undefined : store.curveNow(curve), place = row === null ? undefined : store.placeOf(row);
  const active = page.activeView(), line = curve === null ? undefined : store.net?.lineOf(curve), own = Object.values(page.views).filter((view) => view.kind !== "wire" && view.shown && line !== undefined && view.shows(line));
  if (place && active.kind !== "wire") {
    const [x, y] = active.atPlace(place);
    if (!inView(active, x, y)) active.pan(active.width / 2 - x, active.height / 2 - y);
  } else if (!place && c) for (const view of new Set([active, ...own])) if (view.kind !== "wire") bringLine(view, c, whole);
  // On a narrow screen the drawing lies above the list.
  root.querySelector(".views")?.scrollIntoView({block: "nearest"});
  store.changed("overlay");
}

/** @param {View} view @param {number} x @param {number} y */
const inView = (view, x, y) => x >= INSET[0][0] && y >= INSET[0][1] && x <= view.width - INSET[0][2] && y <= view.height - INSET[0][3];

/** @param {View} view @param {Curve} c @param {boolean} whole */
function bringLine(view, c, whole) {
  const at = new Float64Array(9), places = Array.from({length: PARTS * (c.n - 1) + 1}, (_, k) => {
    const segment = Math.min(Math.floor(k / PARTS), c.n - 2);
    evaluate(c, segment, k / PARTS - segment, at);
    return view.atPlace(at);
  });
  if (places.every(([x, y]) => inView(view, x, y)) || !whole && places.some(([x, y]) => inView(view, x, y))) return;
  if (whole) return view.enclose(c.xyz);
  const [l, t, r, b] = INSET[1], low = [l * view.width, t * view.height], high = [view.width - r * view.width, view.height - b * view.height];
  const ways = places.map((each) => each.map((value, i) => Math.min(Math.max(value, low[i]), high[i]) - value)).sort((p, q) => Math.hypot(...p) - Math.hypot(...q));
  view.pan(ways[0][0], ways[0][1]);
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
  page.say(`${store.said(object)} at (${[...at].map((each) => each.toFixed(3)).join(", ")}) m`);
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
