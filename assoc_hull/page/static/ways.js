// The ways to what is chosen, named, found, or next.

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
