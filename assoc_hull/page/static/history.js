// All steps of the hull: going back to one, comparing with it, keeping the present one by name.

import {Asker} from "./asker.js";
import {button, link, make, paragraph} from "./elements.js";
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
    this.name = make("input", {ariaLabel: "name of the present state", placeholder: "name of this state", maxLength: 80});
    this.name.onkeydown = (event) => {
      if (event.key === "Enter") this.#keep();
    };
    const form = make("div", {className: "form"});
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
    const list = make("ol", {className: "steps"});
    const first = {number: 0, parent: 0, name: "the hull as it came", way: 1, author: "", time: "", normal: null};
    for (const step of [...found.steps].reverse().concat([first])) {
      const item = make("li"), names = found.labels.filter((each) => each.step === step.number).map(({name}) => name);
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
