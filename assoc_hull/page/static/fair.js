// The waviest lines, and a window around a point that is faired: shown as a ghost before it is made.

import {button, form, link, make, paragraph, tableOf} from "./elements.js";
import {Offer, costWords} from "./propose.js";
import {curveOf} from "./ways.js";
import {millimetres, signed, typedNumber} from "./units.js";

/** mm: round figures, as a person asks for them, from 0.1 to 200. */
const WAVES = [[0.1, 0.1, 0.9], [1, 0.5, 10], [12, 2, 20], [25, 5, 50], [60, 10, 100], [120, 20, 200]].flatMap(([from, step, to]) => Array.from({length: Math.round((to - from) / step) + 1}, (_, i) => Number((from + i * step).toFixed(1))));

/** @typedef {{line: string, springs: number, ratio: number, at: string, inflections: number | null}} Wavy */

export class Fairing extends Offer {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    this.made = "The window is faired: one edit. Ctrl+Z takes it back.";
    /** Of which state the list is, and what says that it is old. */
    this.listed = -1;
    this.old = paragraph("");
    this.slider = make("input", {type: "range", min: "0", max: String(WAVES.length - 1), step: "1", value: String(WAVES.indexOf(2)), ariaLabel: "waviness that is taken out, mm", title: "How far given points may be off the fair line, usually; so much is taken out", oninput: () => this.#look()});
    this.noise = paragraph("");
    this.go = button("Apply", () => this.#make());
    box.append(button("List the waviest lines", () => this.#list()), form(this.noise, this.slider, button("Preview", () => this.#look()), this.go, button("Give up", () => page.dropGhost())), this.words, this.old, this.list);
  }

  #value() { return WAVES[Number(this.slider.value)] / 1e3; }

  render() {
    super.render();
    const {store} = this.page, value = this.#value(), {row} = store.selection, point = row === null ? undefined : store.net?.points.get(row), {radius} = store.tools;
    const where = point && radius ? `around ${point.name}, ${radius[0].toFixed(1)} × ${radius[1].toFixed(1)} m` : "around the chosen point: click one first";
    this.slider.setAttribute("aria-valuetext", millimetres(value));
    const words = store.said(`Take out waviness of ${(1e3 * value).toFixed(1)} mm ${where}`);
    if (this.noise.textContent !== words) this.noise.textContent = words;
    const old = this.listed >= 0 && this.listed !== store.state ? "The list is that of before the last edit: list again." : "";
    if (this.old.textContent !== old) this.old.textContent = old;
    this.go.disabled = !this.ready;
  }

  #list() {
    this.page.dropGhost();
    this.ask({t: "fairness"}, "Laying battens along all lines …");
    this.listed = this.page.store.state;
  }

  #look() {
    const {store} = this.page, {row} = store.selection, {radius} = store.tools, point = row === null ? undefined : store.net?.points.get(row), noise = this.#value();
    store.changed("panel");
    if (!point || !radius) this.words.textContent = "Click a point first: the window lies around it. Its size is that of a pull.";
    else this.offer({t: "window", row, noise, radius}, "Fairing the window …", {name: point.name, noise, radius});
  }

  #make() {
    const {what, page} = this;
    if (!what) return;
    this.make(`fair around ${what.name}, waviness ${(1e3 * what.noise).toFixed(1)} mm`, [{op: "fair", at: what.name, radius: what.radius, noise: what.noise}]);
    this.words.textContent = "Fairing the hull …";
    page.activeView().upper.focus({preventScroll: true});
  }

  /** @param {{id: number, value: any}} message */
  answer({id, value}) {
    if (id !== this.asked || !value) return;
    if (id !== this.ghost) return this.#show(value);
    this.tell(value, `Dashed: ${costWords(value, this.page.store)}; ${value.moved} of ${value.points} points move by more than 0.1 mm. Nothing is changed yet.`);
  }

  /** @param {{lines: Wavy[], unfair: {line: string, point: string, residual: number, expected: number, ratio: number}[], points: {point: string, off: number, score: number, alarm: boolean}[]}} found */
  #show({lines, unfair, points}) {
    this.words.textContent = `${unfair.length ? `${unfair.length} unfair ${unfair.length === 1 ? "place" : "places"}` : "No unfair place"}; ${points.filter(({alarm}) => alarm).length} points look wrong.`;
    const table = tableOf("The waviest lines: how far a batten springs, mm, outward +, where that is least like the lines beside; times the usual there; inflections", ["line", "springs", "× usual", "inflections"]), body = table.createTBody();
    for (const each of lines) {
      const row = body.insertRow();
      row.insertCell().append(link(each.line, () => this.#fly(each.at, each.line)));
      for (const words of [signed(1e3 * each.springs, 1, ""), each.ratio.toFixed(1), each.inflections === null ? "–" : String(each.inflections)]) row.insertCell().textContent = words;
    }
    const said = (/** @type {string} */ name) => this.page.store.said(name), list = (/** @type {string} */ title, /** @type {HTMLElement[]} */ rows) => rows.length ? [paragraph(title), ...rows] : [];
    this.list.replaceChildren(table,
      ...list("Unfair places", unfair.map((each) => link(`${said(each.point)}${each.point.startsWith(`${each.line} @ `) ? "" : ` on ${each.line}`}: a ${each.residual > each.expected ? "hollow" : "hump"} of ${millimetres(Math.abs(each.residual - each.expected))} beside its neighbours, ${each.ratio.toFixed(1)} times the usual`, () => this.#fly(each.point, each.line)))),
      ...list(points.some(({alarm}) => alarm) ? "Points that their lines do not bear out" : "Points farthest off their fair lines; none so far that it looks wrong", points.map((each) => link(`${said(each.point)}: ${millimetres(Math.abs(each.off))} too far ${each.off > 0 ? "out" : "in"}, score ${each.score.toFixed(1)}${each.alarm ? ": looks wrong" : ""}`, () => this.#fly(each.point, each.point.split(" x ")[0])))));
  }

  /** Goes to a place, near enough to see it. @param {string} point @param {string} line */
  #fly(point, line) { this.page.goTo(this.page.store.net?.find(point) == null ? line : point, null, curveOf(this.page, line)); }
}
