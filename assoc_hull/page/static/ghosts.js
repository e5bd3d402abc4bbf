// Panels that show another hull as a ghost before it is made: a window that is faired, a named parameter.

import {Asker, button, link, paragraph, tableOf} from "./asker.js";
import {costWords} from "./propose.js";
import {curveOf} from "./lists.js";
import {millimetres, typedNumber} from "./units.js";

/** @typedef {import("./page.js").Page} Page */

const LEAST = 1e-4, TIMES = 2000; // m: the slider goes from 0.1 to 200 mm

/** @typedef {{line: string, springs: number, ratio: number, at: string, inflections: number | null}} Wavy */

export class Fairing extends Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    /** @type {{row: number, name: string, noise: number, radius: number[], state: number} | null} */
    this.window = null;
    this.waiting = false;
    /** Of which state the list is, and what says that it is old. */
    this.listed = -1;
    this.old = paragraph("");
    this.slider = document.createElement("input");
    this.slider.type = "range";
    Object.assign(this.slider, {min: "0", max: "100", step: "1", value: "40"});
    this.slider.setAttribute("aria-label", "noise that is taken out, mm");
    this.slider.oninput = () => this.#look();
    this.noise = paragraph("");
    this.make = button("Apply", () => this.#make());
    const form = document.createElement("div");
    form.className = "form";
    form.append(this.noise, this.slider, button("Preview", () => this.#look()), this.make, button("Give up", () => page.dropGhost()));
    box.append(button("List the waviest lines", () => this.#list()), form, this.words, this.old, this.list);
  }

  #value() { return LEAST * TIMES ** (Number(this.slider.value) / 100); }

  render() {
    const value = this.#value(), row = this.page.store.selection.row, point = row === null ? undefined : this.page.store.net?.points.get(row), radius = this.page.store.tools.radius;
    const where = point && radius ? `around ${point.name}, ${radius[0].toFixed(1)} × ${radius[1].toFixed(1)} m` : "around the chosen point: click one first";
    this.slider.setAttribute("aria-valuetext", millimetres(value));
    const words = `Take out noise of ${(1e3 * value).toFixed(1)} mm ${where}`;
    if (this.noise.textContent !== words) this.noise.textContent = words;
    if (this.window && this.window.state !== this.page.store.state) this.window = null;
    const old = this.listed >= 0 && this.listed !== this.page.store.state ? "The list is that of before the last edit: list again." : "";
    if (this.old.textContent !== old) this.old.textContent = old;
    this.make.disabled = !this.window || this.waiting || this.asked !== this.ghost;
  }

  #list() {
    this.page.dropGhost();
    this.ask({t: "fairness"}, "Laying battens along all lines …");
    this.listed = this.page.store.state;
  }

  #look() {
    const {store} = this.page, {row} = store.selection, radius = store.tools.radius, point = row === null ? undefined : store.net?.points.get(row);
    store.changed("panel");
    if (row === null || !point || !radius) {
      this.words.textContent = "Click a point first: the window lies around it. Its size is that of a pull.";
      return;
    }
    const noise = this.#value();
    this.askGhost({t: "window", row, noise, radius}, "Fairing the window …");
    this.waiting = true;
    this.window = {row, name: point.name, noise, radius, state: store.state};
  }

  #make() {
    const {window: found, page} = this;
    if (!found) return;
    this.asked = page.apply(`fair around ${found.name}, noise ${(1e3 * found.noise).toFixed(1)} mm`, [{op: "fair", at: found.name, radius: found.radius, noise: found.noise}]);
    this.words.textContent = "Fairing the hull …";
    page.activeView().upper.focus({preventScroll: true});
  }

  dropped() {
    super.dropped();
    this.window = null;
    this.page.store.changed("panel");
  }

  /** @param {{id: number}} message */
  done(message) {
    if (!message.id || message.id !== this.asked) return;
    this.window = null;
    this.words.textContent = "The window is faired: one edit. Ctrl+Z takes it back.";
  }

  /** @param {{id: number, text: string}} message */
  problem(message) {
    const mine = super.problem(message);
    if (mine) {
      this.window = null;
      this.page.store.changed("panel");
    }
    return mine;
  }

  /** @param {{id: number, value: any}} message */
  answer(message) {
    if (message.id !== this.asked || !message.value) return;
    if (this.asked !== this.ghost) return this.#show(message.value);
    const {refused, moved, points} = message.value;
    this.waiting = refused.length > 0;
    this.words.textContent = refused.length ? `${refused.join("\n")}\nNothing is changed.` : `Dashed: ${costWords(message.value, this.page.store)}; ${moved} of ${points} points move by more than 0.1 mm. Nothing is changed yet.`;
    this.page.say(this.words.textContent);
    this.page.store.changed("panel");
  }

  /** @param {{lines: Wavy[], unfair: {line: string, point: string, residual: number, ratio: number}[], points: {point: string, off: number, score: number, alarm: boolean}[]}} found */
  #show({lines, unfair, points}) {
    this.words.textContent = `${unfair.length ? `${unfair.length} unfair ${unfair.length === 1 ? "place" : "places"}` : "No unfair place"}; ${points.filter(({alarm}) => alarm).length} points look wrong.`;
    const table = tableOf("The waviest lines: how far a batten springs where that is least like the lines beside, times the usual there, inflections", ["line", "springs", "× usual", "turns"]), body = table.createTBody();
    for (const each of lines) {
      const row = body.insertRow();
      row.insertCell().append(link(each.line, () => this.#fly(each.at, each.line)));
      for (const words of [millimetres(each.springs), each.ratio.toFixed(1), each.inflections === null ? "–" : String(each.inflections)]) row.insertCell().textContent = words;
    }
    const list = (/** @type {string} */ title, /** @type {HTMLElement[]} */ rows) => rows.length ? [paragraph(title), ...rows] : [];
    this.list.replaceChildren(table,
      ...list("Unfair places", unfair.map((each) => link(`${each.point} on ${each.line}: springs ${millimetres(each.residual)}, ${each.ratio.toFixed(1)} times the usual`, () => this.#fly(each.point, each.line)))),
      ...list("Points that their lines do not bear out", points.map((each) => link(`${each.point}: ${millimetres(Math.abs(each.off))} too far ${each.off > 0 ? "out" : "in"}, score ${each.score.toFixed(1)}${each.alarm ? "" : " (not called wrong)"}`, () => this.#fly(each.point, each.point.split(" x ")[0])))));
  }

  /** Goes to a place, near enough to see it. @param {string} point @param {string} line */
  #fly(point, line) { this.page.goTo(this.page.store.net?.find(point) == null ? line : point, null, curveOf(this.page, line)); }
}

/** @typedef {{name: string, unit: string, meaning: string, value: number | null, low: number | null, high: number | null, reason: string | null}} Parameter */

/** How much one press on more or less is. @type {Record<string, number>} */
const STEPS = {m: 0.1, m2: 1, m3: 100, deg: 1, "-": 0.01};

/** @param {Parameter} found @param {string} unit */
function spanWords({low, high}, unit) {
  const words = [low === null ? "" : `from ${low.toFixed(3)}${unit}`, high === null ? "" : `up to ${high.toFixed(3)}${unit}`];
  return words.filter(Boolean).join(" ") || "no limits";
}

export class Vary extends Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    /** @type {Parameter[]} */
    this.found = [];
    /** The number of the answer that tells limits: each takes a moment. */
    this.limits = 0;
    this.choice = document.createElement("select");
    this.choice.setAttribute("aria-label", "parameter of the hull");
    this.choice.onchange = () => this.#choose();
    this.about = paragraph("");
    this.field = document.createElement("input");
    this.field.inputMode = "decimal";
    this.field.onkeydown = (event) => {
      if (event.key === "Enter") this.#ask(false);
      if (event.key === "Escape") this.drop();
    };
    this.form = document.createElement("div");
    this.form.className = "form";
    this.form.hidden = true;
    const steps = [-1, 1].map((sign) => button("", () => this.#step(sign)));
    this.steps = steps;
    this.form.append(this.choice, this.about, this.field, ...steps, button("Preview", () => this.#ask(false)), button("Apply", () => this.#ask(true)), button("Remove ghost", () => this.drop()));
    box.append(button("List the parameters", () => this.all()), this.form, this.words);
  }

  all() {
    this.ask({t: "parameters"}, "Looking …");
    this.led = true;
  }

  #chosen() { return this.found.find(({name}) => name === this.choice.value); }

  #choose() {
    const found = this.#chosen();
    if (!found || found.value === null) return;
    const unit = found.unit === "-" ? "" : ` ${found.unit}`;
    const told = this.about.textContent = `${found.meaning}: ${found.value.toFixed(3)}${unit} now; `;
    this.about.append("looking for its limits …");
    this.limits = this.page.request({t: "parameters", of: found.name});
    /** @param {Parameter} each */
    this.onLimits = (each) => {
      Object.assign(found, each);
      this.about.textContent = told + (each.reason ?? spanWords(each, unit));
    };
    this.field.value = found.value.toFixed(3);
    this.field.setAttribute("aria-label", `wanted ${found.name}${unit && `,${unit}`}`);
    this.words.textContent = "";
    this.steps.forEach((each, i) => each.textContent = `${i ? "+" : "−"}${STEPS[found.unit] ?? STEPS["-"]}${unit}`);
  }

  /** The wanted value, a step more or less; within what is possible. @param {number} sign */
  #step(sign) {
    const found = this.#chosen(), value = typedNumber(this.field), base = Number.isFinite(value) ? value : found?.value ?? 0;
    if (!found) return;
    const wanted = base + sign * (STEPS[found.unit] ?? STEPS["-"]);
    this.field.value = Math.min(Math.max(wanted, found.low ?? -Infinity), found.high ?? Infinity).toFixed(3);
    this.words.textContent = "Preview shows what that does.";
  }

  /** @param {boolean} apply */
  #ask(apply) {
    const found = this.#chosen(), value = typedNumber(this.field);
    if (!found) return;
    if (!Number.isFinite(value)) {
      this.words.textContent = `${this.field.value || "Nothing"} is no number: type one such as ${found.value?.toFixed(3)}`;
      return;
    }
    this.page.dropGhost();
    const message = {t: "vary", set: {[found.name]: value}, apply};
    if (apply) {
      this.ask(message, "Varying the hull …");
      this.page.applying = this.asked;
    } else this.askGhost(message, "Making the ghost …");
  }

  /** Removes the ghost; an answer that is still to come shows none. */
  drop() { this.page.dropGhost(); }

  render() {}

  /** @param {{id: number, value: any}} message */
  answer(message) {
    const name = this.choice.value;
    if (message.id === this.limits) return this.onLimits?.(message.value.find((/** @type {Parameter} */ each) => each.name === name));
    if (message.id !== this.asked || !message.value) return;
    if (this.asked !== this.ghost) {
      this.found = message.value.filter((/** @type {Parameter} */ each) => each.value !== null && each.reason === null);
      this.choice.replaceChildren(...this.found.map((each) => new Option(`${each.name.replace(/_deg$/, "").replaceAll("_", " ")}${each.unit === "-" ? "" : `, ${each.unit}`}`, each.name)));
      if (this.found.some((each) => each.name === name)) this.choice.value = name;
      this.form.hidden = false;
      this.#choose();
      this.words.textContent = `${this.found.length} parameters can be varied.`;
      return;
    }
    const {volume, lcb} = message.value;
    this.words.textContent = `Ghost: ${costWords(message.value, this.page.store)}: V ${volume.toFixed(2)} m³, LCB ${lcb.toFixed(3)} m. Nothing is changed yet.`;
  }

  /** @param {{id: number}} message */
  done(message) {
    if (!message.id || message.id !== this.asked) return;
    this.all();
  }
}
