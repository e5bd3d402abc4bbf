// All lines by family, to choose one without knowing where it lies or typing its name.

/** @typedef {import("./page.js").Page} Page */

const TITLES = /** @type {Record<string, string>} */ ({sections: "Sections", frames: "Frames", waterlines: "Waterlines", buttocks: "Buttocks", diagonals: "Diagonals", boundary: "Boundaries"});

export class LineChoice {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.select = document.createElement("select");
    this.select.setAttribute("aria-label", "the chosen line");
    this.select.onchange = () => {
      if (this.select.value) page.choose(null, Number(this.select.value));
    };
    this.shown = /** @type {import("./net.js").Net | null} */ (null);
    box.append(this.select);
  }

  render() {
    const {net, selection} = this.page.store;
    if (!net) return;
    if (net !== this.shown) {
      this.shown = net;
      const families = new Map();
      for (const line of [...net.lines].sort((p, q) => (p.offset ?? 0) - (q.offset ?? 0))) {
        const group = families.get(line.family) ?? document.createElement("optgroup");
        group.label = TITLES[line.family] ?? line.family;
        line.curves.forEach((id, i) => group.append(new Option(line.names[i], String(id))));
        families.set(line.family, group);
      }
      this.select.replaceChildren(new Option("choose a line …", ""), ...families.values());
    }
    const value = selection.curve === null ? "" : String(selection.curve);
    if (this.select.value !== value) this.select.value = value;
  }
}
