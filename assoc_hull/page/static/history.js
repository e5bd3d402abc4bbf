// What has changed the hull: all steps, going back to one, comparing with it; why the chosen moved last.

import {Asker} from "./asker.js";
import {button, form, link, make, paragraph} from "./elements.js";
import {VOLUME, millimetres, signed} from "./units.js";

/** @typedef {{number: number, parent: number, name: string, way: number, author: string, time: string, normal: number | null}} Step */

/** @param {string} time */
const clock = (time) => time ? new Date(time).toLocaleString([], {dateStyle: "short", timeStyle: "short"}) + ago(time) : "";

/** Within the last hours, how long ago. @param {string} time */
function ago(time) {
  const minutes = Math.round((Date.now() - Date.parse(time)) / 60_000);
  return minutes < 0 || minutes > 600 ? "" : minutes < 1 ? ", just now" : minutes < 100 ? `, ${minutes} min ago` : `, ${(minutes / 60).toFixed(1)} h ago`;
}

export class Past extends Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    /** The list comes unasked, also while something else is waited for. */
    this.listed = 0;
    /** The state that its words tell of, -1 where they tell of none. */
    this.at = -1;
    this.name = make("input", {ariaLabel: "name of the present state", placeholder: "name of this state", maxLength: 80});
    this.name.onkeydown = (event) => {
      if (event.key === "Enter") this.#keep();
    };
    box.append(form(this.name, button("Keep under this name", () => this.#keep())), this.words, this.list);
  }

  render() {
    const {state, history} = this.page.store;
    // An edit that moves nothing, and its undo, are steps too.
    this.fresh([state, history.edits, history.undo, history.redo].join("/"), () => { this.listed = this.page.request({t: "steps"}); });
    if (this.at !== state && this.at >= 0) this.words.textContent = "";
    if (this.at !== state) this.at = -1;
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
      this.at = this.page.store.state;
      this.page.say(this.words.textContent);
    } else {
      const {count, lines, volume, lcb} = message.value;
      const figures = [volume && `${VOLUME} ${signed(volume[1] - volume[0], 2, "m³")}`, lcb && `LCB ${signed(lcb[1] - lcb[0], 4, "m")}`].filter(Boolean).join(", ");
      this.words.textContent = count ? `Dashed: the hull as it was then. ${count} lines differ${figures ? `; since then ${figures}` : ""}. Most: ${lines.slice(0, 3).map((/** @type {string} */ each) => each.replace(/: (?=[^\d])/, " ").replace(/: ([\d.]+) mm at .+$/, (_, far) => ` by ${millimetres(far / 1e3)}`)).join(", ")}. Esc takes it away.` : "Nothing differs.";
    }
  }

  /** @param {{head: number, steps: Step[], older: number, labels: {name: string, step: number}[]}} found */
  #show(found) {
    const list = make("ol", {className: "steps"});
    const first = {number: 0, parent: 0, name: "the hull as it came", way: 1, author: "", time: "", normal: null};
    for (const step of [...found.steps].reverse().concat([first])) {
      const item = make("li"), names = found.labels.filter((each) => each.step === step.number).map(({name}) => name);
      const here = step.number === found.head, note = here ? "the present state" : step.way < 0 ? "taken back" : step.way ? "" : `on a branch from step ${step.parent}`;
      const title = here ? paragraph(this.page.store.said(step.name), "now") : link(this.page.store.said(step.name), () => this.#go(step.number));
      if (here) item.setAttribute("aria-current", "step");
      else title.title = "Bring the hull to the state after this step";
      item.append(title, paragraph([...names.map((name) => `“${name}”`), note, step.author, clock(step.time), step.normal === null ? "" : `hull moved ${millimetres(step.normal)} along its normal at most`].filter(Boolean).join(" · ")));
      if (!here) {
        const compare = link("compare with it", () => this.#compare(step.number));
        compare.setAttribute("aria-label", `compare with ${this.page.store.said(step.name)}`);
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
  /** @param {Page} page @param {HTMLElement} box */
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
    this.words.textContent = this.page.store.said(edit === null ? `${tree.name} is as it came: no edit has reached it.` : `Last moved by step ${step}, “${edit}”${because ? `: ${because}` : ""}.`);
    const list = make("ul", {className: "tree"});
    if (edit !== null) list.append(this.#item(tree));
    this.list.replaceChildren(list);
  }

  /** @param {Cause} cause */
  #item(cause) {
    const item = make("li"), moved = (cause.moved === null ? "" : `, moved ${millimetres(cause.moved)}`) + (cause.slid ? `, slid ${millimetres(cause.slid)}` : "");
    item.append(link(this.page.store.said(cause.name), () => this.page.find(cause.name)), ` ${this.page.store.said(cause.what)}${moved}`);
    const below = make("ul");
    for (const each of cause.causes) below.append(this.#item(each));
    if (cause.left) below.append(this.#note(cause.causes.length ? `${cause.left} more moved less` : `made from ${cause.left} more: click it`));
    if (cause.stopped.length) below.append(this.#note(`came out as they were: ${cause.stopped.slice(0, 3).map((each) => this.page.store.said(each)).join(", ")}`));
    if (below.childElementCount) item.append(below);
    return item;
  }

  /** @param {string} words */
  #note(words) {
    const item = make("li");
    item.append(paragraph(words));
    return item;
  }
}
