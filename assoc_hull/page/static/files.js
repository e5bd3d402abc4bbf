// Files: those that the server writes, and those that are dropped: a hull beside, a picture to trace.

import {button, form, make, paragraph} from "./elements.js";
import {Asker} from "./asker.js";
import {typedNumber} from "./units.js";
import {parseFrame} from "./wire.js";

const FORMS = [["pdf", "Lines plan, PDF"], ["svg", "Lines plan, SVG"], ["dxf", "All lines as splines, DXF"], ["csv", "Table of offsets, CSV"], ["xlsx", "Table of offsets, workbook"],
  ["hull.json", "The hull itself, as text"], ["iges", "Surface, IGES"], ["step", "Surface, STEP"], ["stl", "Closed mesh, STL"]];

export class Files extends Asker {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    super(page, box);
    const choice = this.choice = make("select", {ariaLabel: "form of the file"}, ...FORMS.map(([value, words]) => new Option(words, value)));
    box.append(form(choice, button("Write the file", () => this.write(choice.value))), this.words);
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
    const href = URL.createObjectURL(new Blob([whole], {type: "application/octet-stream"}));
    make("a", {href, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(href), 10_000);
    this.words.textContent = [`${name}: ${what}, ${(bytes / 1000).toFixed(0)} kB, of the hull as it is now.`, ...notes].join("\n");
  }
}

const MOST = 64 * 2 ** 20, SLOW = 4 * 2 ** 20, AXIS_NAMES = "xyz";

export class Beside {
  /** @param {Page} page @param {HTMLElement} box */
  constructor(page, box) {
    this.page = page;
    this.words = paragraph("Drop a file with a hull on the page, or a picture on a drawing: it is shown beside, your hull stays as it is.");
    this.words.setAttribute("role", "status");
    this.form = form();
    const file = make("input", {type: "file", ariaLabel: "a file to be shown beside"});
    file.onchange = () => {
      if (file.files?.[0]) this.take(file.files[0], page.activeView());
      file.value = "";
    };
    box.append(file, this.words, this.form);
    /** Two places of the picture, in pixels of it and in m. @type {{view: View, at: number[][], given: HTMLInputElement[]} | null} */
    this.placing = null;
    /** Counts what was dropped: a file that is read after a newer one is not shown. */
    this.newest = 0;
    const {root} = page;
    root.addEventListener("dragover", (event) => event.preventDefault());
    root.addEventListener("drop", (event) => {
      event.preventDefault();
      const given = event.dataTransfer?.files, found = given?.[0], over = Object.values(page.views).find((view) => event.target instanceof Node && view.element.contains(event.target));
      if (given && given.length > 1) return this.#say(`${given.length} files were dropped: drop one at a time.`);
      if (found) this.take(found, over ?? page.activeView());
    });
  }

  /** @param {string} words */
  #say(words) {
    this.words.textContent = words;
    this.page.panel.open("Beside");
    this.page.say(words);
  }

  /** @param {File} file @param {View} view */
  async take(file, view) {
    if (file.size > MOST) return this.#say(`${file.name} has ${(file.size / 2 ** 20).toFixed(0)} MiB: ${MOST / 2 ** 20} at most are read.`);
    if (file.type.startsWith("image/")) return this.#picture(file, view);
    const {upload} = this.page.options;
    if (!upload) return this.#say("Files cannot be handed over here: open the page by assoc-hull page.");
    const number = ++this.newest;
    this.#say(`Reading ${file.name} …${file.size > SLOW ? " A large mesh takes a minute; the page can be used meanwhile." : ""}`);
    this.form.replaceChildren(button("Give up", () => this.clear()));
    const found = await upload(file).catch(() => ({problem: "it could not be read, or the server did not answer: drop the file itself, or try again"}));
    if (number !== this.newest) return;
    this.form.replaceChildren(...this.page.store.beside ? [button("Take it away", () => this.clear())] : []);
    if (found.problem) return this.#say(found.problem.includes(file.name) ? found.problem : `${file.name}: ${found.problem}`);
    const raw = atob(found.frame), bytes = Uint8Array.from(raw, (each) => each.charCodeAt(0)), {store} = this.page;
    store.beside = {lines: found.lines, frame: parseFrame(bytes.buffer)};
    store.changed("overlay");
    const {name, length, breadth, draught, depth} = found.particulars;
    this.#say(`${found.name}, dotted: ${name}, Lpp ${length.toFixed(2)}, B ${breadth.toFixed(2)}, T ${draught.toFixed(2)}, D ${depth.toFixed(2)} m, ${found.lines.length} lines.\n${found.report}`);
    this.form.replaceChildren(button("Take it away", () => this.clear()));
  }

  /** Takes away what is shown beside. */
  clear() {
    const {store, views} = this.page;
    this.newest++;
    store.beside = null;
    for (const view of Object.values(views)) view.picture = null;
    this.placing = null;
    this.form.replaceChildren();
    this.words.textContent = "Nothing is shown beside.";
    store.changed("hull", "overlay");
  }

  /** It never leaves the browser. @param {File} file @param {View} view */
  async #picture(file, view) {
    if (view.kind === "wire") return this.#say("Drop a picture on the body plan, the profile or the half-breadth plan.");
    const number = ++this.newest, image = await createImageBitmap(file).catch(() => null);
    if (number !== this.newest) return;
    if (!image) return this.#say(`${file.name} is no picture that this browser reads: give a PNG or a JPEG.`);
    // At first as wide as the drawing; two known places put it right.
    const s = view.width / image.width, across = s / view.axis.s, up = s / view.sy;
    view.picture = {image, x: -view.axis.o / view.axis.s, y: view.oy / view.sy, across, up};
    this.placing = {view, at: [], given: []};
    this.page.store.changed("hull");
    this.#ask();
  }

  #ask() {
    const {placing} = this, n = placing?.at.length ?? 0;
    if (!placing) return;
    const names = [placing.view.a, placing.view.b].map((axis) => AXIS_NAMES[axis]);
    placing.given = n ? ["first", "second"].slice(0, n).flatMap((which, i) => names.map((name, j) => {
      const field = placing.given[2 * i + j] ?? make("input");
      field.inputMode = "decimal";
      field.placeholder = field.ariaLabel = `${name} of the ${which} place, m`;
      return field;
    })) : [];
    this.#say(n < 2 ? `Click ${n ? "a second" : "a"} place of the picture whose coordinates you know; far apart is better.` : `Type ${names.join(" and ")} of both places, in m${placing.view.kind === "body" ? "; y of the aft body is negative" : ""}, and press Place it.`);
    this.form.replaceChildren(...placing.given, ...n > 1 ? [button("Place it", () => this.#place())] : [], button("Take it away", () => this.clear()));
    if (n === 2) placing.given[0].focus();
  }

  /** A click while a picture is placed; tells whether it was taken. @param {View} view @param {number} x @param {number} y */
  click(view, x, y) {
    const {placing} = this, picture = view.picture;
    if (!placing || !picture || placing.view !== view || placing.at.length > 1) return false;
    placing.at.push([((x - view.axis.o) / view.axis.s - picture.x) / picture.across, (picture.y - (view.oy - y) / view.sy) / picture.up]);
    this.#ask();
    return true;
  }

  #place() {
    const {placing} = this, picture = placing?.view.picture;
    if (!placing || !picture) return;
    const [x0, y0, x1, y1] = placing.given.map(typedNumber), [[u0, v0], [u1, v1]] = placing.at;
    if (![x0, y0, x1, y1].every(Number.isFinite)) return void (this.words.textContent = "Type four numbers of metres, such as 6.953.");
    const across = (x1 - x0) / (u1 - u0), up = (y0 - y1) / (v1 - v0), wide = Math.abs(u1 - u0) >= 0.05 * Math.abs(v1 - v0), tall = Math.abs(v1 - v0) >= 0.05 * Math.abs(u1 - u0);
    // Two places on one level say nothing of heights: these have the scale of the length.
    const sx = wide ? across : up, sy = tall ? up : across;
    if (!(sx > 0 && sy > 0 && Number.isFinite(sx + sy))) return void (this.words.textContent = "These coordinates turn the picture over or make it vanish: x or y grows to the right, z or y upward.");
    Object.assign(picture, {x: x0 - u0 * sx, y: y0 + v0 * sy, across: sx, up: sy});
    this.placing = null;
    this.form.replaceChildren(button("Take it away", () => this.clear()));
    this.#say(`The picture is placed: ${(1e3 * sx).toPrecision(3)} mm for a pixel of it.`);
    this.page.store.changed("hull");
  }
}

/** The picture to trace, below all lines. @param {View} view @param {CanvasRenderingContext2D} g */
export function drawPicture(view, g) {
  const {picture} = view;
  if (!picture) return;
  const {image, x, y, across, up} = picture;
  g.globalAlpha = 0.4;
  g.drawImage(image, view.axis.o + view.axis.s * x, view.oy - view.sy * y, view.axis.s * across * image.width, view.sy * up * image.height);
  g.globalAlpha = 1;
}

/** A hull that is shown beside, dotted. @param {View} view @param {CanvasRenderingContext2D} g @param {string} colour */
export function drawBeside(view, g, colour) {
  const {beside} = view.store;
  if (!beside) return;
  g.beginPath();
  for (const line of beside.lines) {
    if (line.family === "boundary" ? view.kind !== "profile" && view.kind !== "wire" : !view.shows(line)) continue;
    for (const id of line.curves) {
      const c = beside.frame.curves.get(id);
      if (c) view.trace(g, c, line);
    }
  }
  g.strokeStyle = colour;
  g.lineWidth = 1;
  g.setLineDash([2, 3]);
  g.stroke();
  g.setLineDash([]);
}
