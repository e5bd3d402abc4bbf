// Names of lines, as on a lines plan: in the line itself where they cover no other, else beside the drawing with a leader.

import {pathsOf} from "./view.js";
import {FLATS} from "./net.js";
import {HIGH, MANY, Places, UPRIGHT} from "./label_places.js";

/** A name that is to be written: of which line, at its end or where a leader ends. @typedef {{line: Line, name: string, key: string, x: number, y: number, gap: number, colour: string}} Spot */
/** Where a leader leaves the drawing, and what it costs that it does so there. @typedef {Spot & {knee: number, cost: number}} Knee */
/** Leaders side by side: the last of them, those before it, what all cost. @typedef {{cost: number, last: Knee | null, before: Row | null}} Row */

const LETTERS = "11px system-ui, sans-serif", EDGE = 10; // px
const COLUMN = 12, ROW = 24, WIDEST = 13, LEAST_GAP = 0.2, CLOSE = 0.7, NEAR_GAP = 5, FREE_GAP = 9, TOLD = 1.5, PLAIN = 4; // px
const SLANT = 0.4, APART = 7, BESIDE = 8, BEYOND = 20;
const NAMELESS = 600, AGAIN = 320, KEEP = 120; // what it costs that a line has no name, and none in this half; that a name leaves its place

/** @param {string} name */
const short = (name) => name.replace(/^(ST|WL|BTK|DIA|FR) /, "");
/** Whole stations go first, so that halves give way. @param {string} name */
const half = (name) => Number(!/^\d+$/.test(name));

/** @param {View} view @param {CanvasRenderingContext2D} g @param {Record<string, string>} ink */
export function drawLabels(view, g, ink) {
  const net = view.store.net;
  if (!net || view.kind === "wire") return;
  g.font = LETTERS;
  g.textBaseline = "middle";
  g.textAlign = "left";
  const {x0, x1, y1, z0, z1} = view.box(), ship = net.particulars, body = view.kind === "body";
  // Leaders of buttocks come out at the stern, where names of the grid would stand.
  const left = Math.max(view.at(body ? 0 : x0, y1, 0, -1)[0] - 8, 40), right = Math.min(view.at(x1, 0, 0, 1)[0] + 8, view.width - 38), foot = Math.min(view.at(0, 0, z0, 1)[1], view.height - 34);
  // Combs of the bottom stand below the base line of the body plan.
  if (!body) view.foot = foot + 4;
  frame(view, g, ink, left, right, foot);
  const places = new Places(g, view, ink);
  const of = (/** @type {string} */ family) => net.lines.filter((line) => line.family === family && line.offset !== null && line.axis !== null);
  const look = [view.axis.o, view.axis.s, view.oy, view.sy, view.width, view.height].join();
  if (view.standing.look !== look) view.standing = {look, spots: new Map()};
  places.left = left;
  places.foot = foot;
  if (view.steep) places.right = right;
  const [end, way] = /** @type {[number, CanvasTextAlign]} */ (view.steep ? [right, "left"] : [left, "right"]);
  /** One of the row below; none in the column. @param {string} text @param {number} x @param {number} y @param {string} colour */
  const below = (text, x, y, colour) => places.box(text, x, y, "center")[0] > (view.frame.length ? left + 4 : 0) && places.edge(text, x, y, "center", colour);
  places.edge(body ? "BTK" : net.caption("ST"), left, foot + 12, "right", ink.soft); // first, or a label has its place
  if (body) above(places, "sections");
  if (view.kind !== "half") {
    for (const [text, z, colour] of /** @type {[string, number, string][]} */ ([["DWL", ship.draught, ink.water], ["BL", 0, ink.soft]])) {
      const y = view.at(0, 0, z, 1)[1];
      if (y <= foot + 4) places.edge(text, end, y, way, colour);
    }
    column(places, "WL", of("waterlines"), end, way, (z) => view.at(0, 0, z, 1)[1]);
  }
  if (body) {
    const names = [...of("buttocks")].reverse();
    for (const side of [-1, 1]) for (const line of names) below(short(line.name), view.at(0, line.offset ?? 0, 0, side)[0], foot + 12, ink.soft);
    if (view.at(0, 0, z0, 1)[1] < view.height) for (const [text, side] of /** @type {[string, number][]} */ ([["aft", -1], ["fore", 1]])) places.put(text, view.at(0, y1 / 2, 0, side)[0], foot + 26, "center", ink.soft);
  } else {
    places.put("AP", view.at(0, 0, 0, 1)[0], foot + 26, "center", ink.soft);
    places.put("FP", view.at(ship.length, 0, 0, 1)[0], foot + 26, "center", ink.soft);
    const all = of("sections").map((line) => ({name: short(line.name), x: view.at(line.offset ?? 0, 0, 0, 1)[0]})).sort((p, q) => half(p.name) - half(q.name));
    // Where lengths are compressed every other name stands in a second row.
    const rows = view.store.squeeze > 2 && !view.frame.length ? [12, 25] : [12];
    for (const {name, x} of all) rows.some((down) => below(name, x, foot + down, ink.soft));
    if (view.kind === "half") {
      if (view.at(0, 0, 0, 1)[1] <= foot + 4) places.edge("CL", left, view.at(0, 0, 0, 1)[1], "right", ink.soft);
      column(places, "BTK", of("buttocks"), left, "right", (y) => view.at(0, y, 0, 1)[1]);
    }
    if (view.steep) above(places, "buttocks");
    else beside(places);
  }
  borders(places);
  places.captionInline();
  places.write();
  view.standing.spots = places.standing;
}

const STAY = 24; // px: so far a line may have moved under a name that stays

/** How a name stood in this look before, if this is the place: it does not leap where a line moves a little, or a point is chosen. @param {Places} places @param {Spot} spot */
function stood({view}, {key, x, y}) {
  const was = view.standing.spots.get(key);
  return was && Math.min(Math.abs(x - was.x), Math.abs(y - was.y)) < 1 && Math.abs(x - was.x) + Math.abs(y - was.y) < STAY ? was : undefined;
}

/** Whether a name stood in its line: it would make the others leap if it joined their row. @param {Places} places @param {Spot} spot */
const stoodIn = ({view}, {key}) => view.standing.spots.get(key)?.led === false;

/** @param {Places} places @param {Spot} spot @param {boolean} led @param {boolean} [up] */
const stands = (places, {key, x, y}, led, up = false) => places.standing.set(key, {x, y, led, up});

/** Where the drawing goes on beyond them, names of the grid have a column and a row of their own at the edge of the view, which covers it. @param {View} view @param {CanvasRenderingContext2D} g @param {Record<string, string>} ink @param {number} left @param {number} right @param {number} foot */
function frame(view, g, ink, left, right, foot) {
  const {x0, x1, y1, z0} = view.box(), {width, height} = view, body = view.kind === "body", aft = view.at(body ? 0 : x0, y1, 0, -1)[0], fore = view.at(x1, 0, 0, 1)[0];
  if (view.at(0, 0, z0, 1)[1] > foot + 4) view.frame.push([-BEYOND, foot + 4, width + BEYOND, height + BEYOND]);
  if (!view.steep && aft < left + 4) view.frame.push([-BEYOND, -BEYOND, left + 4, height + BEYOND]);
  if (view.steep && fore > right - 4) view.frame.push([right - 4, -BEYOND, width + BEYOND, height + BEYOND]);
  g.fillStyle = ink.paper;
  for (const [l, t, r, b] of view.frame) g.fillRect(l, t, r - l, b - t);
  g.fillStyle = ink.rule;
  for (const [l, t, r] of view.frame) t > 0 ? g.fillRect(view.steep || aft >= left + 4 ? 0 : left + 4, t, width, 1) : g.fillRect(l > 0 ? l : r - 1, 0, 1, foot + 4);
}

/** Lines that run along the ship are named in themselves, or by leaders from above. @param {Places} places */
function beside(places) {
  const {view} = places, {x1, y1, z1} = view.box(), written = new Set(), spots = spotsOf(places);
  const above = view.at(x1, y1, z1, 1)[1] > EDGE + 20;
  within(places, spots, written, 0, above);
  // Where the top of the drawing is out of the picture, names above it would lie on lines.
  if (above) {
    within(places, spots.filter((each) => stoodIn(places, each)), written, NEAR_GAP);
    led(places, spots, written);
    within(places, spots, written, 0);
  } else within(places, spots, written, NEAR_GAP);
  fanned(places, spots, written);
}

/** Names of the grid at a side, with their family above the highest. @param {Places} places @param {string} family @param {Line[]} lines @param {number} x @param {CanvasTextAlign} align @param {(offset: number) => number} at */
function column(places, family, lines, x, align, at) {
  const {ink} = places, rows = lines.map(({name, offset}) => ({name: short(name), y: at(offset ?? 0)}));
  // One at the edge leaves no room for the family.
  const written = rows.filter(({name, y}) => y >= EDGE + HIGH + 1 && y <= places.foot + 4 && places.edge(name, x, y, align, ink.soft)).map(({y}) => y);
  if (written.length) places.put(family, x, Math.min(...written) - HIGH - 1, align, ink.soft);
}

/** Lines that run upward stand above their ends, as on paper; those that end where others do along themselves, if there is room. @param {Places} places @param {string} family */
function above(places, family) {
  const {view, ink} = places, {net, curves} = view.store, body = view.kind === "body", middle = body ? 0 : view.midship;
  /** @type {Spot[]} */
  const ends = [];
  for (const line of net?.lines ?? []) {
    if (line.family !== family) continue;
    const sides = view.sides(line) ?? [];
    // A line of several curves is named where it ends highest; in the profile so in either half.
    const tops = line.curves.flatMap((id) => { const c = curves.get(id); return c ? [c.xyz.subarray(0, 3), c.xyz.subarray(-3)] : []; }).sort((p, q) => q[2] - p[2]);
    const named = body ? sides.map((side) => ({end: tops[0], side})) : [-1, 1].map((half) => ({end: tops.find(([x]) => half * (x - middle) > 0), side: 1}));
    for (const {end, side} of named) {
      if (!end) continue;
      const [x, y] = view.at(end[0], end[1], end[2], side);
      // One that ends outside the picture is named along itself.
      if (y >= 20 && y < view.height && x > 0 && x < view.width && !view.framed(x, y)) ends.push({line, name: short(line.name), key: line.name + (body || end[0] > middle), x, y, gap: 0, colour: ink[family]});
    }
  }
  // Of those that end in one place the order is that of the ship.
  const order = (/** @type {Spot} */ p, /** @type {Spot} */ q) => Math.round(p.x) - Math.round(q.x) || (body ? (q.line.offset ?? 0) - (p.line.offset ?? 0) : (p.x > view.width / 2 ? -1 : 1) * ((p.line.offset ?? 0) - (q.line.offset ?? 0)));
  ends.sort(order);
  ends.forEach((each, i) => each.gap = Math.min(each.x - (ends[i - 1]?.x ?? -Infinity), (ends[i + 1]?.x ?? Infinity) - each.x));
  const written = new Set(), spots = spotsOf(places), alone = ends.filter(({gap}) => gap > TOLD);
  const long = Math.max(...ends.map(({name}) => places.wide(name)), 0), top = Math.max(view.at(0, 0, view.box().z1, 1)[1] - 14, long + 6);
  const room = Math.floor((view.width - 8) / UPRIGHT[0]);
  for (const {key} of alone) written.add(key);
  within(places, spots, written, 0);
  within(places, spots.filter((each) => stoodIn(places, each)), written, FREE_GAP);
  // Those that are named nowhere share the end of others, as on paper.
  const fan = [...alone, ...ends.filter(({key}) => !written.has(key))].sort((p, q) => half(p.name) - half(q.name)).slice(0, room).sort(order);
  for (const {key} of alone) if (!fan.some((each) => each.key === key)) written.delete(key);
  for (const {key} of fan) written.add(key);
  // Names side by side are told apart better than they stand, where there is room.
  const pitch = Math.max(Math.min((view.width - 8) / fan.length, WIDEST), UPRIGHT[0]), xs = spread(fan.map(({x}) => x), fan.map(() => pitch), 4, view.width - 4);
  fan.forEach(({name, x, y, colour}, i) => {
    leader(places, [[x, y - 1], [xs[i], top]], colour, false);
    places.upright(name, xs[i], top - 2, colour);
  });
  // The family stands at the left, or in the widest gap.
  const gap = xs.slice(1).map((x, i) => ({x: (x + xs[i]) / 2, wide: x - xs[i]})).reduce((p, q) => q.wide > p.wide ? q : p, {x: 0, wide: 0});
  const title = net?.caption(fan[0]?.line.name.split(" ")[0] ?? "") ?? "";
  if (fan.length) places.caption(title, xs[0] - 10, top - 8, "right", ink[family]) || places.caption(title, gap.x, top - 8, "center", ink[family]);
  within(places, spots, written, FREE_GAP);
  fanned(places, spots, written);
}

/** Where lines meet upright lines, and steep ones level lines, and how far their neighbours are there, px. @param {Places} places @returns {Spot[]} */
function spotsOf(places) {
  const {view, ink} = places, {net} = view.store, body = view.kind === "body", from = Math.max(places.left, 0), n = Math.floor((view.width - from) / COLUMN);
  const middle = view.at(body ? 0 : view.midship, 0, 0, 1)[0], high = Math.floor(view.height / ROW);
  /** @typedef {{id: number, at: number, own: boolean}} Met */
  const met = Array.from({length: Math.max(n, 0)}, () => /** @type {Met[]} */ ([])), level = Array.from({length: Math.max(high, 0)}, () => /** @type {Met[]} */ ([]));
  for (const {id, path} of pathsOf(view)) for (let i = 0; i + 3 < path.length; i += 2) {
    const [a, p, b, q] = path.subarray(i, i + 4), steep = Math.abs(q - p) > Math.abs(b - a);
    const last = Math.min((Math.max(a, b) - from) / COLUMN - 1, n - 1), lowest = Math.min(Math.max(p, q) / ROW - 1, high - 1);
    for (let k = Math.max(Math.ceil((Math.min(a, b) - from) / COLUMN - 1), 0); k <= last; k++) {
      const x = from + COLUMN * (k + 1);
      if (a <= x !== b <= x) met[k].push({id, at: p + (q - p) * (x - a) / (b - a), own: true});
    }
    for (let k = Math.max(Math.ceil(Math.min(p, q) / ROW - 1), 0); k <= lowest; k++) {
      const y = ROW * (k + 1);
      if (p <= y !== q <= y) level[k].push({id, at: a + (b - a) * (y - p) / (q - p), own: steep});
    }
  }
  /** @type {Spot[]} */
  const found = [];
  const add = (/** @type {number} */ id, /** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ gap) => {
    const line = net?.lineOf(id);
    // Over the centre plane it would name aft and fore body.
    if (!line || x < from || x > view.width || y < 0 || y > view.height || view.framed(x, y) || body && Math.abs(x - middle) < 4) return;
    found.push({line, name: short(line.name), key: line.name + (body || x > middle), x, y, gap: Math.min(gap, 40), colour: ink[line.family] || ink.ink});
  };
  const gaps = (/** @type {Met[]} */ row, /** @type {(each: Met, gap: number) => void} */ give) => row.sort((p, q) => p.at - q.at).forEach((each, i) => give(each, Math.min(each.at - (row[i - 1]?.at ?? -Infinity), (row[i + 1]?.at ?? Infinity) - each.at)));
  met.forEach((row, k) => gaps(row, ({id, at}, gap) => add(id, from + COLUMN * (k + 1), at, gap)));
  // A name is wider than it is high.
  level.forEach((row, k) => gaps(row, ({id, at, own}, gap) => { if (own) add(id, at, ROW * (k + 1), gap / 2); }));
  const first = new Map(found.map((each) => [each, Number(stood(places, each)?.led === false)]));
  return found.sort((p, q) => (first.get(q) ?? 0) - (first.get(p) ?? 0) || q.gap - p.gap);
}

/** Names in lines, once in either half; where `least` is 0, only where they cover nothing else. @param {Places} places @param {Spot[]} spots @param {Set<string>} written @param {number} least @param {boolean} [leads] whether leaders follow: a name that had one keeps it */
function within(places, spots, written, least, leads = false) {
  const {view} = places, middle = view.kind === "body" ? view.at(0, 0, 0, 1)[0] : -Infinity;
  for (const each of spots) {
    const {line, name, key, x, y, gap, colour} = each;
    if (line.family === "boundary" || written.has(key) || gap <= least || (leads && view.standing.spots.get(key)?.led)) continue;
    const off = x - middle, align = Math.abs(off) > 20 ? "center" : off < 0 ? "right" : "left";
    // Beside the line where its points leave no room in it.
    const ways = /** @type {[number, CanvasTextAlign][]} */ ([[x, align], ...least ? [[x + BESIDE, "left"], [x - BESIDE, "right"]] : []]);
    const found = ways.find(([u, way]) => {
      const box = places.box(name, u, y, way);
      if (!places.inside(box)) return false; // there names of the grid stand
      return (least && u === x ? !places.dotted(box) : places.clear(box, places.number(line))) && places.free(box);
    });
    if (!found || !places.put(name, found[0], y, found[1], colour)) continue;
    written.add(key);
    stands(places, each, false);
    places.inline.push({name: places.written[places.written.length - 1], line});
  }
}

/** Lines so near one another that no name fits in, as seen from near: their names stand in order where nothing is drawn. @param {Places} places @param {Spot[]} spots @param {Set<string>} written */
function fanned(places, spots, written) {
  const {view} = places, middle = view.kind === "body" ? view.at(0, 0, 0, 1)[0] : -Infinity, named = (/** @type {Spot} */ {line}) => written.has(`${line.name}true`) || written.has(`${line.name}false`);
  /** @type {Map<number, Spot[]>} */
  const cuts = new Map();
  for (const each of spots) if (each.line.family !== "boundary" && !named(each) && each.gap > LEAST_GAP) cuts.set(each.x, [...cuts.get(each.x) ?? [], each]);
  const worth = (/** @type {Spot[]} */ all) => all.length + Math.min(...all.map(({gap}) => gap), 9) / 10;
  const [cut] = [...cuts.values()].filter((all) => new Set(all.map(({line}) => line)).size === all.length).sort((p, q) => worth(q) - worth(p));
  if (!cut) return;
  cut.sort((p, q) => p.y - q.y);
  const wayTo = (/** @type {Spot} */ {name, x, y}, /** @type {number} */ u, /** @type {number} */ v) => [[x, y], [u + (x < u ? -1 : 1) * (places.wide(name) / 2 + 2), v]];
  const ys = spread(cut.map(({y}) => y), cut.map(() => HIGH), 4, view.height - 34), wide = Math.max(...cut.map(({name}) => places.wide(name)));
  const rooms = Array.from({length: Math.ceil(view.width / COLUMN)}, (_, k) => k * COLUMN + wide / 2).map((x) => {
    const free = cut.map((each, i) => {
      const box = places.box(each.name, x, ys[i], "center");
      return places.inside(box) && places.clear(box, 0) && places.free(box) && !places.under(wayTo(each, x, ys[i]));
    });
    return {x, free, cost: Math.abs(x - cut[0].x) - 200 * free.filter(Boolean).length};
  }).filter(({x, free}) => free.some(Boolean) && Math.abs(x - cut[0].x) > wide && Math.min((x - middle) * (cut[0].x - middle), Math.abs(x - middle) - wide / 2) > 0);
  const room = rooms.reduce((p, q) => q.cost < p.cost ? q : p, rooms[0]);
  if (room) cut.forEach(({name, key, x, y, colour}, i) => {
    if (!room.free[i] || !places.put(name, room.x, ys[i], "center", colour)) return;
    written.add(key);
    places.inline.push({name: places.written[places.written.length - 1], line: cut[i].line});
    leader(places, wayTo(cut[i], room.x, ys[i]), colour, true);
  });
}

/** Deck edge, transom and flats are named once, in themselves or at their side, where that covers nothing else. @param {Places} places */
function borders(places) {
  const {view} = places, named = new Set(["profile"]); // that is the title of its view
  for (const {line, name, x, y, colour} of spotsOf(places)) {
    if (line.family !== "boundary" || named.has(name)) continue;
    const sides = /** @type {[number, number, CanvasTextAlign][]} */ ([[x, y, "center"], [x, y - 9, "center"], [x, y + 9, "center"], [x + 6, y, "left"], [x - 6, y, "right"]]);
    const free = sides.find(([u, v, align]) => {
      const box = places.box(name, u, v, align);
      return places.inside(box) && places.clear(box, places.number(line)) && places.free(box);
    });
    // A flat that is seen from its edge is none.
    if (!free || line.boundary === FLATS && edgeOn(view, line)) named.add(free ? name : "");
    else if (places.put(name, ...free, colour)) named.add(name);
  }
}

/** Whether a line is seen as no more than a straight one along the picture. @param {View} view @param {Line} line */
function edgeOn(view, line) {
  // Of the body plan both halves are one: a flat has an edge in each.
  const middle = view.kind === "body" ? view.at(0, 0, 0, 1)[0] : -Infinity;
  const paths = pathsOf(view).filter(({id}) => line.curves.includes(id)).flatMap(({path}) => [...path].map((each, i) => i % 2 || middle < -1e9 ? each : Math.abs(each - middle)));
  return [0, 1].some((j) => {
    const along = paths.filter((_, i) => i % 2 === j);
    return Math.max(...along) - Math.min(...along) < 2 * HIGH;
  });
}

/** The others stand above the drawing in two rows, with leaders. @param {Places} places @param {Spot[]} spots @param {Set<string>} written */
function led(places, spots, written) {
  const {view} = places, {x1, y1, z1} = view.box(), top = Math.max(view.at(x1, y1, z1, 1)[1] - 6, EDGE + 24), far = view.width - 4;
  const wide = (/** @type {Spot} */ {name}) => places.wide(name), widest = Math.max(...spots.filter(({line}) => line.family !== "boundary").map(wide), 0), room = Math.ceil(widest / 2 + 5);
  const chosen = knees(places, spots, written, top, room), xs = spread(chosen.map(({knee}) => knee), chosen.map(() => room), places.left + room / 2, far - widest / 2 + room / 2);
  const ends = [-Infinity, -Infinity];
  chosen.forEach((each, i) => {
    const free = (/** @type {number} */ row) => xs[i] - wide(each) / 2 >= ends[row] + 6;
    const up = !free(0) || stood(places, each)?.up && free(1) ? 12 : 0;
    ends[Number(up > 0)] = xs[i] + wide(each) / 2;
    stands(places, each, true, up > 0);
    if (places.put(each.name, xs[i], top - 14 - up, "center", each.colour)) leader(places, [[each.x, each.y], [each.knee, top], ...up ? [[xs[i], top - 7]] : [], [xs[i], top - 8 - up]], each.colour, true); // between the names of the lower row
  });
  const [first] = chosen, last = chosen.at(-1);
  if (!first || !last) return;
  const family = first.line.name.split(" ")[0], sides = /** @type {[number, CanvasTextAlign][]} */ ([[xs[0] - wide(first) / 2 - 7, "right"], [(xs.at(-1) ?? 0) + wide(last) / 2 + 7, "left"]]);
  const gaps = xs.slice(1).map((x, i) => ({x: (x + xs[i]) / 2, wide: x - xs[i]})).sort((p, q) => q.wide - p.wide);
  for (const [x, align] of sides.concat(gaps.slice(0, 1).map((gap) => [gap.x, "center"]))) if (places.caption(family, x, top - 14, align, first.colour)) return;
}

/** Where leaders end on lines without a name, and where they leave the drawing: all of a half slant alike and stand in the order of the lines, so that none crosses another. @param {Places} places @param {Spot[]} spots @param {Set<string>} written @param {number} top @param {number} room @returns {Knee[]} */
function knees(places, spots, written, top, room) {
  const {view} = places, middle = view.at(view.midship, 0, 0, 1)[0], way = view.kind === "half" ? -1 : 1, far = view.width - 4;
  /** @type {Knee[]} */
  const chosen = [];
  for (const aft of [true, false]) {
    /** @type {Map<Line, Knee[]>} */
    const of = new Map();
    for (const each of spots) {
      const {line, key, x, y, gap} = each, knee = x + (aft ? -1 : 1) * SLANT * (y - top), twice = written.has(`${line.name}${aft}`);
      if (line.family === "boundary" || x < middle !== aft || y <= top || written.has(key) || gap <= (twice ? CLOSE : LEAST_GAP) || knee < places.left || knee > far || places.under([[x, y], [knee, top]])) continue;
      // Near, and told from its neighbours.
      const cost = 0.6 * (y - top) + 25 * Math.max(PLAIN - gap, 0) + 6 * Math.max(2 * PLAIN - gap, 0) - (twice ? AGAIN : NAMELESS) - (stood(places, each)?.led ? KEEP : 0), known = of.get(line);
      if (known) known.push({...each, knee, cost});
      else of.set(line, [{...each, knee, cost}]);
    }
    const lines = [...of].sort(([p], [q]) => (aft ? way : -way) * ((p.offset ?? 0) - (q.offset ?? 0))).map(([, all]) => all);
    const found = inOrder(lines, far, room, Math.floor((far - places.left) / room) - chosen.length);
    for (const {key} of found) written.add(key);
    chosen.push(...found);
  }
  return chosen;
}

/** Of each line one leader or none: knees grow in the order of the lines, at the least cost. @param {Knee[][]} lines from the left @param {number} far @param {number} room @param {number} most */
function inOrder(lines, far, room, most) {
  /** @type {Row} */
  const none = {cost: 0, last: null, before: null};
  /** The cheapest row whose last leader leaves at a pixel. @type {Row[]} */
  const best = [];
  for (const spots of lines) {
    let low = none;
    const least = Array.from({length: far + 1}, (_, k) => low = best[k] && best[k].cost < low.cost ? best[k] : low);
    const rows = spots.map((last) => {
      const at = Math.floor(last.knee);
      let before = least[at - room] ?? none, cost = before.cost;
      for (let k = Math.max(at - room + 1, 0); k <= at - APART; k++) {
        const near = (best[k]?.cost ?? Infinity) + 4 * (room - at + k);
        if (near < cost) [before, cost] = [best[k], near];
      }
      return {at, row: {cost: cost + last.cost, last, before}};
    });
    // A line has one leader: its own are no neighbours.
    for (const {at, row} of rows) if (!best[at] || row.cost < best[at].cost) best[at] = row;
  }
  /** @type {Knee[]} */
  const found = [];
  for (let row = best.reduce((p, q) => q.cost < p.cost ? q : p, none); row.last && row.before; row = row.before) found.unshift(row.last);
  while (found.length > Math.max(most, 0)) found.splice(found.reduce((worst, {cost}, i) => cost > found[worst].cost ? i : worst, 0), 1);
  return found;
}

/** @param {Places} places @param {number[][]} way @param {string} colour @param {boolean} dot */
function leader(places, way, colour, dot) {
  const {g} = places;
  places.cover(new Float32Array(way.flat()), MANY);
  g.strokeStyle = g.fillStyle = colour;
  g.lineWidth = 0.7;
  g.globalAlpha = 0.75;
  g.beginPath();
  way.forEach(([x, y], i) => i ? g.lineTo(x, y) : g.moveTo(x, y));
  g.stroke();
  g.globalAlpha = 1;
  if (!dot) return;
  g.beginPath();
  g.arc(way[0][0], way[0][1], 1.7, 0, 7);
  g.fill();
}

/** Places of names in a row, each as near to its own as the others let it. @param {number[]} wanted from the left @param {number[]} widths @param {number} low @param {number} high */
export function spread(wanted, widths, low, high) {
  let sum = 0;
  const offsets = widths.map((w, i) => sum += i ? (widths[i - 1] + w) / 2 : 0);
  /** @type {{mean: number, n: number}[]} */
  const blocks = [];
  for (const [i, x] of wanted.entries()) {
    let block = {mean: x - offsets[i], n: 1};
    while (blocks.length && blocks[blocks.length - 1].mean > block.mean) {
      const last = /** @type {{mean: number, n: number}} */ (blocks.pop());
      block = {mean: (last.mean * last.n + block.mean * block.n) / (last.n + block.n), n: last.n + block.n};
    }
    blocks.push(block);
  }
  const least = low + (widths[0] ?? 0) / 2, most = high - (widths.at(-1) ?? 0) / 2 - sum;
  return blocks.flatMap(({mean, n}) => Array.from({length: n}, () => Math.max(Math.min(mean, most), least))).map((at, i) => at + offsets[i]);
}
