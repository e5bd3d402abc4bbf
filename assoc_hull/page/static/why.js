// Why the chosen point or line moved last.

import {Asker} from "./asker.js";
import {link, make, paragraph} from "./elements.js";
import {millimetres} from "./units.js";

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
    const list = make("ul", {className: "tree"});
    if (edit !== null) list.append(this.#item(tree));
    this.list.replaceChildren(list);
  }

  /** @param {Cause} cause */
  #item(cause) {
    const item = make("li"), moved = (cause.moved === null ? "" : `, moved ${millimetres(cause.moved)}`) + (cause.slid ? `, slid ${millimetres(cause.slid)}` : "");
    item.append(link(cause.name, () => this.page.find(cause.name)), ` ${cause.what}${moved}`);
    const below = make("ul");
    for (const each of cause.causes) below.append(this.#item(each));
    if (cause.left) below.append(this.#note(cause.causes.length ? `${cause.left} more moved less` : `made from ${cause.left} more: click it`));
    if (cause.stopped.length) below.append(this.#note(`came out as they were: ${cause.stopped.slice(0, 3).join(", ")}`));
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
