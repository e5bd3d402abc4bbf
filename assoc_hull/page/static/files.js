// Files for other programs: written by the server, handed over as a download.

import {Asker, button} from "./asker.js";

const FORMS = [["pdf", "Lines plan, PDF"], ["svg", "Lines plan, SVG"], ["dxf", "All lines as splines, DXF"], ["csv", "Table of offsets, CSV"], ["xlsx", "Table of offsets, workbook"],
  ["hull.json", "The hull itself, as text"], ["iges", "Surface, IGES"], ["step", "Surface, STEP"], ["stl", "Closed mesh, STL"]];

export class Files extends Asker {
  /** @param {import("./page.js").Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    const choice = this.choice = document.createElement("select"), form = document.createElement("div");
    choice.setAttribute("aria-label", "form of the file");
    choice.replaceChildren(...FORMS.map(([value, words]) => new Option(words, value)));
    form.className = "form";
    form.append(choice, button("Write the file", () => this.write(choice.value)));
    box.append(form, this.words);
  }

  render() {}

  /** @param {string} form */
  write(form) {
    this.choice.value = form;
    this.ask({t: "export", form}, "Writing; a surface takes some seconds …");
  }

  /** @param {{id: number, value: any}} message */
  answer(message) {
    if (message.id !== this.asked || !message.value) return;
    const {name, data, notes, bytes, what} = message.value;
    const raw = atob(data), whole = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i++) whole[i] = raw.charCodeAt(i);
    const link = document.createElement("a"), address = URL.createObjectURL(new Blob([whole], {type: "application/octet-stream"}));
    link.href = address;
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
    this.words.textContent = [`${name}: ${what}, ${(bytes / 1000).toFixed(0)} kB, of the hull as it is now.`, ...notes].join("\n");
  }
}
