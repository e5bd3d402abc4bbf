// The bar above: the ship, the tools, the switches; and the sheet of all keys.

import {ACTIONS, keyWords} from "./actions.js";

/** @typedef {import("./page.js").Page} Page */

const GROUPS = [["pull", "move", "fine"], ["undo", "redo"], ["combs", "movement", "points", "labels", "compress"], ["fit", "theme", "keys"]];
const SHORT = /** @type {Record<string, string>} */ ({combs: "Combs", movement: "Movement", points: "Points", labels: "Labels"});
const TABS = /** @type {[import("./view.js").Kind, string][]} */ ([["body", "Body"], ["profile", "Profile"], ["half", "Half-breadth"], ["wire", "Wire"]]);
const HANDS = [
  ["Choose a point or a line", "click"], ["Pull the hull, or move the point", "drag a point"], ["Move along its freedom", "Ctrl + drag"],
  ["Ten times finer (or, with Fine on, coarser); lock an axis", "Alt; Shift"], ["Radius of a pull", "wheel while dragging"], ["Pan, zoom, turn the wire", "drag the ground, wheel, drag the wire"],
  ["Nudge by 1, 10, 0.1 mm", "arrows, with Shift, with Alt"], ["End a burst of arrows", "Enter, or a pause"], ["Pan", "Ctrl + arrows"], ["Cancel; from the panel back to the drawing", "Esc"],
];

/** @param {Page} page */
export function makeBar(page) {
  const element = document.createElement("header"), ship = document.createElement("div"), title = document.createElement("h1"), dims = document.createElement("span"), tools = document.createElement("div");
  element.className = "bar";
  ship.className = "ship";
  dims.className = "dims";
  ship.append(title, dims);
  tools.className = "tools";
  tools.setAttribute("role", "toolbar");
  tools.setAttribute("aria-label", "Tools");
  const search = document.createElement("input");
  search.type = "search";
  search.placeholder = "Find: WL 2 x ST 7";
  search.setAttribute("aria-label", "Find a point or a line by its name");
  search.onkeydown = (event) => {
    if (event.key === "Enter") page.find(search.value);
  };
  /** @type {Map<string, HTMLButtonElement>} */
  const buttons = new Map();
  for (const group of GROUPS) {
    const box = document.createElement("span");
    box.className = "group";
    for (const id of group) {
      const action = ACTIONS.find((each) => each.id === id);
      if (!action) continue;
      const button = document.createElement("button");
      button.type = "button";
      button.dataset.action = id;
      button.onclick = () => action.run(page);
      buttons.set(id, button);
      box.append(button);
    }
    tools.append(box);
  }
  const tabs = document.createElement("nav");
  tabs.className = "tabs";
  tabs.setAttribute("aria-label", "Views");
  for (const [kind, words] of TABS) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = words;
    button.dataset.tab = kind;
    button.onclick = () => {
      page.store.maximised = null;
      page.maximise(kind);
    };
    tabs.append(button);
  }
  element.append(ship, tools, search, tabs);
  const dialog = document.createElement("dialog");
  dialog.className = "sheet";
  dialog.setAttribute("aria-label", "Keys");
  page.root.append(dialog);
  return {
    element, search,
    /** @param {import("./net.js").Particulars} ship @param {number} lines @param {number} points */
    name(ship, lines, points) {
      title.textContent = ship.name;
      dims.textContent = `Lpp ${ship.length.toFixed(2)} · B ${ship.breadth.toFixed(2)} · T ${ship.draught.toFixed(2)} · D ${ship.depth.toFixed(2)} m · ${lines} lines · ${points} points`;
      dims.title = dims.textContent;
    },
    render() {
      for (const [id, button] of buttons) {
        const action = ACTIONS.find((each) => each.id === id);
        if (!action) continue;
        button.textContent = action.label?.(page) ?? SHORT[id] ?? action.words;
        button.disabled = !(action.enabled?.(page) ?? true);
        if (action.pressed) button.setAttribute("aria-pressed", String(action.pressed(page)));
        button.title = `${hint(page, id) ?? action.words} (${action.keys.map(keyWords).join(", ")})`;
      }
      for (const button of tabs.querySelectorAll("button")) button.setAttribute("aria-pressed", String(button.dataset.tab === page.store.tab));
    },
    /** @param {string[][]} rows */
    sheet(rows) {
      const heading = document.createElement("h2"), close = document.createElement("button"), table = document.createElement("table");
      heading.textContent = "Hands and keys";
      for (const [words, keys] of [...HANDS, ...rows]) {
        const line = table.insertRow();
        line.insertCell().textContent = words;
        const cell = line.insertCell();
        cell.textContent = keys;
      }
      const note = document.createElement("p");
      note.textContent = "Single letters act while a drawing has the focus: click it, or reach it with Tab.";
      close.type = "button";
      close.textContent = "Close";
      close.onclick = () => dialog.close();
      dialog.replaceChildren(close, heading, note, table);
      dialog.showModal();
    },
  };
}

/** What undo and redo would do. @param {Page} page @param {string} id */
function hint(page, id) {
  const {undo, redo, above} = page.store.history;
  if (id === "undo" && undo !== null) return above === null ? `Undo: ${undo}` : `The last edit is ${above}'s: ${undo}`;
  if (id === "theme") return `Light, dark, or as the system: now ${page.store.theme === "auto" ? "as the system" : page.store.theme}`;
  if (id === "redo" && redo !== null) return `Redo: ${redo}`;
  return undefined;
}
