// What lies under the pointer: the nearest point, else the nearest curve.

import {bezier} from "./hermite.js";

/** @typedef {import("./view.js").View} View */

const PARTS = 6;

/** @param {View} view */
export function pathsOf(view) {
  if (!view.pathsStale) return view.paths;
  const {net, curves} = view.store;
  view.paths = [];
  view.pathsStale = false;
  if (!net || view.kind === "wire") return view.paths;
  const at = new Float64Array(12);
  for (const line of net.lines) {
    if (!view.shows(line)) continue;
    for (const id of line.curves) {
      const c = curves.get(id);
      if (!c) continue;
      for (const given of view.sides(line) ?? [0]) {
        const path = new Float32Array(2 * (PARTS * (c.n - 1) + 1));
        let to = 0;
        for (let i = 0; i + 1 < c.n; i++) {
          bezier(c, i, at);
          const side = given || view.side((at[0] + at[9]) / 2);
          for (let k = i ? 1 : 0; k <= PARTS; k++) {
            const u = k / PARTS, w = 1 - u, b0 = w * w * w, b1 = 3 * w * w * u, b2 = 3 * w * u * u, b3 = u * u * u;
            const mix = (/** @type {number} */ j) => b0 * at[j] + b1 * at[3 + j] + b2 * at[6 + j] + b3 * at[9 + j];
            const [x, y] = view.at(mix(0), mix(1), mix(2), side);
            path[to++] = x;
            path[to++] = y;
          }
        }
        view.paths.push({id, path});
      }
    }
  }
  return view.paths;
}

/** @param {View} view @param {number} x @param {number} y @param {number} reach @returns {number | null} */
export function nearestPoint(view, x, y, reach) {
  let best = null, least = reach * reach;
  const chosen = view.store.selection.curve;
  for (const row of view.rows()) {
    const place = view.store.placeOf(row);
    if (!place) continue;
    const [u, v] = view.atPlace(place);
    const far = (u - x) ** 2 + (v - y) ** 2;
    // Of points that lie over one another, the one on the chosen curve.
    const point = chosen === null ? undefined : view.store.net?.points.get(row);
    const mine = point && (point.a === chosen || point.b === chosen) ? 4 : 0;
    if (far - mine < least) {
      least = far - mine;
      best = row;
    }
  }
  return best;
}

/** @param {View} view @param {number} x @param {number} y @param {number} reach @returns {number | null} */
export function nearestCurve(view, x, y, reach) {
  let best = null, least = reach * reach;
  for (const {id, path} of pathsOf(view)) {
    for (let i = 0; i + 3 < path.length; i += 2) {
      const x0 = path[i], y0 = path[i + 1], dx = path[i + 2] - x0, dy = path[i + 3] - y0;
      const t = Math.min(Math.max(((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1), 0), 1);
      const far = (x0 + t * dx - x) ** 2 + (y0 + t * dy - y) ** 2;
      if (far < least) {
        least = far;
        best = id;
      }
    }
  }
  return best;
}

/** The curve through a point that this view draws in full. @param {View} view @param {number} row @returns {number | null} */
export function curveThrough(view, row) {
  const net = view.store.net, point = net?.points.get(row);
  if (!net || !point) return null;
  const shown = [point.a, point.b].filter((id) => {
    const line = net.lineOf(id);
    return line !== undefined && view.shows(line);
  });
  const own = shown.find((id) => net.lineOf(id)?.family !== "boundary");
  return own ?? shown[0] ?? null;
}
