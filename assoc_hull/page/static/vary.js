// A named parameter of the whole hull: the variant is shown as a ghost before it is made.

import {button, form, make, paragraph} from "./elements.js";
import {Offer, costWords} from "./propose.js";
import {VOLUME, typedNumber} from "./units.js";

/** @typedef {{name: string, unit: string, meaning: string, value: number | null, low: number | null, high: number | null, least: number | null, most: number | null, reason: string | null}} Parameter */

/** How much one press on more or less is. @type {Record<string, number>} */
const STEPS = {m: 0.1, m2: 1, m3: 100, deg: 1, "-": 0.01};

/** @param {number | null} low @param {number | null} high @param {string} unit */
function spanWords(low, high, unit) {
  const words = [low === null ? "" : `from ${low.toFixed(3)}${unit}`, high === null ? "" : `up to ${high.toFixed(3)}${unit}`];
  return words.filter(Boolean).join(" ") || "without limits";
}

/** What is fair, and what is possible where that is more. @param {Parameter} found @param {string} unit */
function limitWords({low, high, least, most}, unit) {
  const fair = spanWords(low, high, unit), all = spanWords(least, most, unit);
  return fair === all ? `possible ${all}` : `fair ${fair}; possible ${all}`;
}

export class Vary extends Offer {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    /** @type {Parameter[]} */
    this.found = [];
    /** The number of the answer that tells limits: each takes a moment. */
    this.limits = 0;
    /** The number of the answer that tells values anew, after an edit, an undo, a redo. */
    this.renewed = 0;
    this.made = "The hull is varied: one edit. Ctrl+Z takes it back.";
    this.choice = make("select", {ariaLabel: "parameter of the hull", onchange: () => this.#choose()});
    this.about = paragraph("");
    this.field = make("input", {inputMode: "decimal", onkeydown: (/** @type {KeyboardEvent} */ event) => {
      // Asked once more: it was seen, and is wanted.
      if (event.key === "Enter") this.#ask(this.ready && JSON.stringify(this.#wish()) === this.what?.wish);
      if (event.key === "Escape") page.dropGhost();
    }});
    this.steps = [-1, 1].map((sign) => button("", () => this.#step(sign)));
    this.unfair = make("input", {type: "checkbox"});
    const unfair = make("label", {title: "Also a hull whose lines bend more sharply than anyone would have them"}, this.unfair, " also unfair");
    this.form = form(this.choice, this.about, this.field, ...this.steps, unfair, button("Preview", () => this.#ask(false)), button("Apply", () => this.#ask(true)), button("Remove ghost", () => page.dropGhost()));
    this.form.hidden = true;
    box.append(button("List the parameters", () => this.all()), this.form, this.words);
  }

  all() {
    this.ask({t: "parameters"}, "Looking …");
    this.key = String(this.page.store.state);
    this.led = true;
  }

  render() {
    super.render();
    if (!this.form.hidden) this.fresh(String(this.page.store.state), () => { this.renewed = this.page.request({t: "parameters"}); });
  }

  #chosen() { return this.found.find(({name}) => name === this.choice.value); }

  #wish() { return {set: {[this.choice.value]: typedNumber(this.field)}, accept: this.unfair.checked}; }

  /** @param {string} [typed] what stays in the field, and what is said below it */
  #choose(typed) {
    const found = this.#chosen();
    if (!found || found.value === null) return;
    const unit = found.unit === "-" ? "" : ` ${found.unit}`;
    const told = this.about.textContent = `${found.meaning}: ${found.value.toFixed(3)}${unit} now; `;
    this.about.append("looking for its limits …");
    this.limits = this.page.request({t: "parameters", of: found.name});
    /** @param {Parameter} each */
    this.onLimits = (each) => {
      Object.assign(found, each);
      this.about.textContent = told + (each.reason ?? limitWords(each, unit));
    };
    this.field.value = typed ?? found.value.toFixed(3);
    this.field.setAttribute("aria-label", `wanted ${found.name}${unit && `,${unit}`}`);
    if (typed === undefined) this.words.textContent = "";
    this.steps.forEach((each, i) => each.textContent = `${i ? "+" : "−"}${STEPS[found.unit] ?? STEPS["-"]}${unit}`);
  }

  /** The wanted value, a step more or less; within what is possible. @param {number} sign */
  #step(sign) {
    const found = this.#chosen(), value = typedNumber(this.field), base = Number.isFinite(value) ? value : found?.value ?? 0;
    if (!found) return;
    const wanted = base + sign * (STEPS[found.unit] ?? STEPS["-"]);
    const [low, high] = this.unfair.checked ? [found.least, found.most] : [found.low, found.high];
    this.field.value = Math.min(Math.max(wanted, low ?? -Infinity), high ?? Infinity).toFixed(3);
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
    const wish = this.#wish(), message = {t: "vary", ...wish, apply};
    if (apply) {
      this.ask(message, "Varying the hull …");
      this.page.applying = this.asked;
    } else this.offer(message, "Making the ghost …", {wish: JSON.stringify(wish)});
  }

  /** @param {{id: number, text: string}} message */
  problem({id, text}) { return super.problem({id, text: text.replace("with accept=True (--accept)", "by “also unfair”")}); }

  /** @param {{id: number, value: any}} message */
  answer(message) {
    const name = this.choice.value;
    if (message.id === this.limits) return this.onLimits?.(message.value.find((/** @type {Parameter} */ each) => each.name === name));
    const anew = message.id === this.renewed;
    if (!anew && message.id !== this.asked || !message.value) return;
    if (anew || this.asked !== this.ghost) {
      const old = this.#chosen()?.value?.toFixed(3);
      this.found = message.value.filter((/** @type {Parameter} */ each) => each.value !== null && each.reason === null);
      this.choice.replaceChildren(...this.found.map((each) => new Option(`${each.name.replace(/_deg$/, "").replaceAll("_", " ")}${each.unit === "-" ? "" : `, ${each.unit}`}`, each.name)));
      if (this.found.some((each) => each.name === name)) this.choice.value = name;
      this.form.hidden = false;
      // What was typed stays when the hull is edited meanwhile.
      if (anew) return this.#choose(this.choice.value === name && typedNumber(this.field).toFixed(3) !== old ? this.field.value : this.#chosen()?.value?.toFixed(3));
      this.#choose();
      this.words.textContent = `${this.found.length} parameters can be varied.`;
      return;
    }
    const {volume, lcb} = message.value;
    this.tell({...message.value, refused: []}, `Ghost: ${costWords(message.value, this.page.store)}; then ${VOLUME} ${volume.toFixed(2)} m³, LCB ${lcb.toFixed(3)} m. Nothing is changed yet: Enter or Apply makes it.`);
    this.words.scrollIntoView({block: "nearest"});
  }
}
