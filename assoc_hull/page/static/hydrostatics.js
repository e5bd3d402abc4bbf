// Hydrostatics and sectional areas, now and when the session began.

import {Asker} from "./asker.js";
import {make, paragraph} from "./elements.js";
import {signed} from "./units.js";

const SVG = "http://www.w3.org/2000/svg", WIDE = 480, HIGH = 190, BAR = 6;
/** @type {Record<string, string>} */
const POWERS = {m2: "m²", m3: "m³", m4: "m⁴", "-": ""};
/** @typedef {{name: string, unit: string, meaning: string, digits: number, value: number | null, change: number | null, error: number | null}} Value */

/** @param {string} name @param {Record<string, string | number>} given */
function draw(name, given) {
  const found = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(given)) found.setAttribute(key, String(value));
  return found;
}

/** Areas at any x, in proportion between stations. @param {[number[], number[]]} curve @param {number} at */
function between([x, area], at) {
  const i = x.findIndex((each) => each >= at);
  if (i < 0 || (i === 0 && x[0] > at)) return 0;
  return i === 0 ? area[0] : area[i - 1] + (area[i] - area[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
}

export class Numbers extends Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    this.cursor = paragraph("");
    box.append(this.words, this.list, this.cursor);
  }

  render() { this.fresh(String(this.page.store.state), () => this.ask({t: "hydrostatics"}, "Measuring …")); }

  /** @param {{id: number, value: any}} message */
  answer(message) {
    if (message.id !== this.asked || !message.value) return;
    const {draught, values, notes, areas, areas_before: before} = message.value;
    this.words.textContent = [`At the design draught, ${draught.toFixed(3)} m; changes since the session began.`, ...notes.slice(0, 3)].join(" ");
    const table = make("table"), body = table.createTBody();
    for (const each of /** @type {Value[]} */ (values)) {
      const row = body.insertRow(), unit = POWERS[each.unit] ?? each.unit, head = make("th", {scope: "row"});
      const [symbol, below] = each.name.split("_");
      head.textContent = symbol;
      if (below) head.append(Object.assign(make("sub"), {textContent: below}));
      row.title = `${each.meaning}${each.error === null ? "" : `; may be off by ${each.error.toPrecision(1)} ${unit}`}`;
      row.append(head);
      row.insertCell().textContent = each.value === null ? "not known" : `${each.value.toFixed(each.digits)} ${unit}`;
      row.insertCell().textContent = each.change === null ? "" : signed(each.change, each.digits, unit);
    }
    this.list.replaceChildren(table, this.#areas(areas, before));
    this.cursor.textContent = "Sectional areas, both sides: line now, dashed when the session began, bars 8 × the difference.";
  }

  /** @param {[number[], number[]]} now @param {[number[], number[]]} then */
  #areas(now, then) {
    const [x, area] = now, x0 = Math.min(...x, ...then[0]), x1 = Math.max(...x, ...then[0]), most = Math.max(...area, ...then[1], 1e-9);
    const px = (/** @type {number} */ at) => 6 + (WIDE - 12) * (at - x0) / (x1 - x0 || 1), py = (/** @type {number} */ a) => HIGH - 50 - (HIGH - 74) * a / most;
    const picture = draw("svg", {viewBox: `0 0 ${WIDE} ${HIGH}`, class: "areas", role: "img", "aria-label": `sectional areas, largest ${most.toFixed(1)} square metres`});
    const path = (/** @type {[number[], number[]]} */ [xs, as], /** @type {string} */ name) => picture.append(draw("polyline", {points: xs.map((each, i) => `${px(each).toFixed(1)},${py(as[i]).toFixed(1)}`).join(" "), class: name}));
    picture.append(draw("line", {x1: 6, x2: WIDE - 6, y1: py(0), y2: py(0), class: "axis"}));
    let last = -Infinity;
    x.forEach((each, i) => {
      if (px(each) - last < BAR) return;
      last = px(each);
      const by = 8 * (area[i] - between(then, each)), high = Math.min(Math.abs(py(by) - py(0)), 28);
      if (high > 0.5) picture.append(draw("rect", {x: px(each) - 2, width: 4, y: by > 0 ? py(0) - high : py(0), height: high, class: "bar"}));
    });
    path(then, "then");
    path(now, "now");
    const label = (/** @type {number} */ at, /** @type {number} */ y, /** @type {string} */ words, /** @type {string} */ anchor) => {
      const text = draw("text", {x: at, y, "text-anchor": anchor});
      text.textContent = words;
      picture.append(text);
    };
    for (const [name, at] of /** @type {[string, number][]} */ ([["AP", 0], ["FP", this.page.store.net?.particulars.length ?? 0]])) {
      picture.append(draw("line", {x1: px(at), x2: px(at), y1: 30, y2: py(0) + 6, class: "axis"}));
      label(px(at), py(0) + 24, name, at > 0 ? "end" : "start");
    }
    label(6, HIGH - 4, `x ${x0.toFixed(1)} m`, "start");
    label(WIDE - 6, HIGH - 4, `${x1.toFixed(1)} m`, "end");
    label(6, 18, `Sectional areas, largest ${most.toFixed(1)} m²`, "start");
    picture.addEventListener("pointermove", (event) => {
      const box = picture.getBoundingClientRect(), at = x0 + (x1 - x0) * ((/** @type {PointerEvent} */ (event).clientX - box.left) / box.width * WIDE - 6) / (WIDE - 12), clamped = Math.min(Math.max(at, x0), x1);
      const a = between(now, clamped);
      this.cursor.textContent = `x ${clamped.toFixed(2)} m: A ${a.toFixed(2)} m², ${signed(a - between(then, clamped), 3, "m²")}`;
    });
    return picture;
  }
}
