// Panels that tell of the hull: its steps, why the chosen moved last, hydrostatics and sectional areas.

import {Asker, button, link, paragraph} from "./asker.js";
import {millimetres, signed} from "./units.js";

/** @typedef {{number: number, parent: number, name: string, way: number, author: string, time: string, normal: number | null}} Step */

/** @param {string} time */
const clock = (time) => time ? new Date(time).toLocaleString([], {dateStyle: "short", timeStyle: "short"}) + ago(time) : "";

/** Within the last hours, how long ago. @param {string} time */
function ago(time) {
  const minutes = Math.round((Date.now() - Date.parse(time)) / 60_000);
  return minutes < 0 || minutes > 600 ? "" : minutes < 1 ? ", just now" : minutes < 100 ? `, ${minutes} min ago` : `, ${(minutes / 60).toFixed(1)} h ago`;
}

export class Past extends Asker {
  /** @param {import("./page.js").Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    /** The list comes unasked, also while something else is waited for. */
    this.listed = 0;
    this.name = document.createElement("input");
    this.name.setAttribute("aria-label", "name of the present state");
    this.name.placeholder = "name of this state";
    this.name.maxLength = 80;
    this.name.onkeydown = (event) => {
      if (event.key === "Enter") this.#keep();
    };
    const form = document.createElement("div");
    form.className = "form";
    form.append(this.name, button("Keep under this name", () => this.#keep()));
    box.append(form, this.words, this.list);
  }

  render() {
    this.fresh(String(this.page.store.state), () => { this.listed = this.page.request({t: "steps"}); });
  }

  #keep() {
    if (!this.name.value.trim()) {
      this.words.textContent = "Type a name for the state first.";
      return;
    }
    this.ask({t: "checkpoint", name: this.name.value.trim()}, "");
    this.listed = this.asked;
    this.name.value = "";
  }

  /** @param {number} step */
  #go(step) { this.ask({t: "go", step}, ""); }

  /** @param {number} step */
  #compare(step) { this.askGhost({t: "compare", step}, "Looking back …"); }

  /** @param {{id: number, value: any}} message */
  answer(message) {
    if (message.id === this.listed) return this.#show(message.value);
    if (message.id !== this.asked) return;
    if (this.asked !== this.ghost) {
      this.words.textContent = "The hull is at that state; what was left is kept in this list.";
      this.page.say(this.words.textContent);
    } else {
      const {count, lines, volume, lcb} = message.value;
      const figures = [volume && `V ${signed(volume[1] - volume[0], 2, "m³")}`, lcb && `LCB ${signed(lcb[1] - lcb[0], 4, "m")}`].filter(Boolean).join(", ");
      this.words.textContent = count ? `Dashed: the hull as it was then. ${count} lines differ${figures ? `; since then ${figures}` : ""}. Most: ${lines.slice(0, 3).map((/** @type {string} */ each) => each.split(": ")[0]).join(", ")}. Esc takes it away.` : "Nothing differs.";
    }
  }

  /** @param {{head: number, steps: Step[], older: number, labels: {name: string, step: number}[]}} found */
  #show(found) {
    const list = document.createElement("ol");
    list.className = "steps";
    const first = {number: 0, parent: 0, name: "the hull as it came", way: 1, author: "", time: "", normal: null};
    for (const step of [...found.steps].reverse().concat([first])) {
      const item = document.createElement("li"), names = found.labels.filter((each) => each.step === step.number).map(({name}) => name);
      const here = step.number === found.head, note = here ? "the present state" : step.way < 0 ? "taken back" : step.way ? "" : `on a branch from step ${step.parent}`;
      const title = here ? paragraph(step.name, "now") : link(step.name, () => this.#go(step.number));
      if (here) item.setAttribute("aria-current", "step");
      else title.title = "Bring the hull to the state after this step";
      item.append(title, paragraph([...names.map((name) => `“${name}”`), note, step.author, clock(step.time), step.normal === null ? "" : millimetres(step.normal)].filter(Boolean).join(" · ")));
      if (!here) {
        const compare = link("compare with it", () => this.#compare(step.number));
        compare.setAttribute("aria-label", `compare with ${step.name}`);
        item.append(compare);
      }
      list.append(item);
    }
    const more = found.older ? [paragraph(`${found.older} older steps, between the last two, are not listed.`)] : [];
    // The list is made anew: who is in it with the keys stays in it.
    const at = this.box.ownerDocument.activeElement, label = at instanceof HTMLElement && this.list.contains(at) ? at.getAttribute("aria-label") ?? at.textContent : null;
    this.list.replaceChildren(list, ...more);
    if (label === null) return;
    const links = [...this.list.querySelectorAll("button")], same = links.find((each) => (each.getAttribute("aria-label") ?? each.textContent) === label);
    (same ?? links[0])?.focus({preventScroll: true});
  }
}

/** @typedef {{name: string, what: string, moved: number | null, slid: number | null, left: number, stopped: string[], causes: Cause[]}} Cause */

export class WhyPanel extends Asker {
  /** @param {import("./page.js").Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    box.append(this.words, this.list);
  }

  render() {
    const {selection, net, state} = this.page.store, name = selection.row !== null ? net?.points.get(selection.row)?.name : selection.curve !== null ? net?.curveName(selection.curve) : undefined;
    if (!name) {
      this.key = "";
      this.asked = 0;
      this.words.textContent = "Click a point or a line: what made it move last is told here.";
      return this.list.replaceChildren();
    }
    this.fresh(`${name}/${state}`, () => {
      this.list.replaceChildren();
      this.ask({t: "why", of: name}, "");
    });
  }

  /** @param {{id: number, value: any}} message */
  answer(message) {
    if (message.id !== this.asked || !message.value) return;
    const {edit, step, because, tree} = message.value;
    this.words.textContent = edit === null ? `${tree.name} is as it came: no edit has reached it.` : `Last moved by step ${step}, “${edit}”${because ? `: ${because}` : ""}.`;
    const list = document.createElement("ul");
    list.className = "tree";
    if (edit !== null) list.append(this.#item(tree));
    this.list.replaceChildren(list);
  }

  /** @param {Cause} cause */
  #item(cause) {
    const item = document.createElement("li"), moved = (cause.moved === null ? "" : `, moved ${millimetres(cause.moved)}`) + (cause.slid ? `, slid ${millimetres(cause.slid)}` : "");
    item.append(link(cause.name, () => this.page.find(cause.name)), ` ${cause.what}${moved}`);
    const below = document.createElement("ul");
    for (const each of cause.causes) below.append(this.#item(each));
    if (cause.left) below.append(this.#note(cause.causes.length ? `${cause.left} more moved less` : `made from ${cause.left} more: click it`));
    if (cause.stopped.length) below.append(this.#note(`came out as they were: ${cause.stopped.slice(0, 3).join(", ")}`));
    if (below.childElementCount) item.append(below);
    return item;
  }

  /** @param {string} words */
  #note(words) {
    const item = document.createElement("li");
    item.append(paragraph(words));
    return item;
  }
}

const SVG = "http://www.w3.org/2000/svg", WIDE = 480, HIGH = 190;
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
  /** @param {import("./page.js").Page} page @param {HTMLElement} box */
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
    const table = document.createElement("table"), body = table.createTBody();
    for (const each of /** @type {Value[]} */ (values)) {
      const row = body.insertRow(), unit = POWERS[each.unit] ?? each.unit, head = document.createElement("th");
      head.scope = "row";
      const [symbol, below] = each.name.split("_");
      head.textContent = symbol;
      if (below) head.append(Object.assign(document.createElement("sub"), {textContent: below}));
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
    x.forEach((each, i) => {
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
    label(6, HIGH - 4, `x ${x0.toFixed(1)} m`, "start");
    label(WIDE - 6, HIGH - 4, `${x1.toFixed(1)} m`, "end");
    label(6, 18, `${most.toFixed(1)} m²`, "start");
    picture.addEventListener("pointermove", (event) => {
      const box = picture.getBoundingClientRect(), at = x0 + (x1 - x0) * ((/** @type {PointerEvent} */ (event).clientX - box.left) / box.width * WIDE - 6) / (WIDE - 12), clamped = Math.min(Math.max(at, x0), x1);
      const a = between(now, clamped);
      this.cursor.textContent = `x ${clamped.toFixed(2)} m: A ${a.toFixed(2)} m², ${signed(a - between(then, clamped), 3, "m²")}`;
    });
    return picture;
  }
}
