// The bar above: the ship, tools, switches, keys; the palette finds actions, points and lines.

import {make} from "./elements.js";
import {ACTIONS, keyWords} from "./actions.js";

const GROUPS = [["pull", "move", "fine"], ["undo", "redo"], ["combs", "movement", "points", "labels", "compress"], ["fit", "theme", "keys"]];
const SHORT = /** @type {Record<string, string>} */ ({combs: "Combs", movement: "Movement", points: "Points", labels: "Labels"});
const TABS = /** @type {[Kind, string][]} */ ([["body", "Body"], ["profile", "Profile"], ["half", "Half-breadth"], ["wire", "Wire"]]);
const HANDS = [
  ["Choose a point or a line", "click"], ["Pull the hull, or move the point", "drag a point"], ["Move along its freedom", "Ctrl + drag"],
  ["Ten times finer (or, with Fine on, coarser); lock an axis", "Alt; Shift"], ["Radius of a pull", "wheel while dragging"], ["Pan, zoom, turn the wire", "drag the ground, wheel, drag the wire"],
  ["Nudge by 1, 10, 0.1 mm", "arrows, with Shift, with Alt"], ["End a burst of arrows", "Enter, or a pause"], ["Pan", "Ctrl + arrows"], ["Cancel; from the panel back to the drawing", "Esc"],
];

/** @param {Page} page */
export function makeBar(page) {
  const title = make("h1"), dims = make("span", {className: "dims"}), tools = make("div", {className: "tools", ariaLabel: "Tools"});
  tools.setAttribute("role", "toolbar");
  const search = make("input", {type: "search", placeholder: "Find ST 7", ariaLabel: "Find a point or a line by its name"});
  search.onkeydown = (event) => {
    if (event.key === "Enter") page.find(search.value);
  };
  /** @type {Map<string, HTMLButtonElement>} */
  const buttons = new Map();
  for (const group of GROUPS) {
    const box = make("span", {className: "group"});
    for (const id of group) {
      const action = ACTIONS.find((each) => each.id === id);
      if (!action) continue;
      const button = make("button", {type: "button", onclick: () => action.run(page)});
      button.dataset.action = id;
      buttons.set(id, button);
      box.append(button);
    }
    tools.append(box);
  }
  const tabs = make("nav", {className: "tabs", ariaLabel: "Views"});
  for (const [kind, words] of TABS) {
    const button = make("button", {type: "button", textContent: words, onclick: () => {
      page.store.maximised = null;
      page.maximise(kind);
    }});
    button.dataset.tab = kind;
    tabs.append(button);
  }
  const element = make("header", {className: "bar"}, make("div", {className: "ship"}, title, dims), tools, search, tabs);
  const dialog = make("dialog", {className: "sheet", ariaLabel: "Keys"});
  page.root.append(dialog);
  return {
    element,
    /** What was looked for before goes with the first letter. */
    look() {
      search.focus();
      search.select();
    },
    /** @param {Particulars} ship @param {number} lines @param {number} points */
    name(ship, lines, points) {
      title.textContent = ship.name;
      dims.textContent = `Lpp ${ship.length.toFixed(2)} · B ${ship.breadth.toFixed(2)} · T ${ship.draught.toFixed(2)} · D ${ship.depth.toFixed(2)} m · ${lines} lines`;
      dims.title = `${dims.textContent} · ${points} points`;
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
      const heading = make("h2"), close = make("button"), table = make("table");
      heading.textContent = "Hands and keys";
      for (const [words, keys] of [...HANDS, ...rows]) {
        const line = table.insertRow();
        line.insertCell().textContent = words;
        const cell = line.insertCell();
        cell.textContent = keys;
      }
      const note = make("p", {textContent: "Single letters act while a drawing or a button of the bar has the focus, arrows and Enter in the drawing: click it, or reach it with Tab."});
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
  if (id === "undo" && undo !== null) return page.store.said(above === null ? `Undo: ${undo}` : `The last edit is ${above}'s: ${undo}`);
  if (id === "theme") return `Light, dark, or as the system: now ${page.store.theme === "auto" ? "as the system" : page.store.theme}`;
  if (id === "redo" && redo !== null) return page.store.said(`Redo: ${redo}`);
  return undefined;
}

/** @typedef {{words: string, keys: string, run: () => void}} Row */

const MOST = 12;

/** @param {Page} page @param {Row[]} acts all that can be done now */
export function openPalette(page, acts) {
  const dialog = make("dialog"), field = make("input"), list = make("ul");
  dialog.className = "sheet palette";
  dialog.setAttribute("aria-label", "What to do");
  field.type = "search";
  field.placeholder = "what to do, or a name such as WL 2 x ST 7";
  for (const [name, value] of Object.entries({role: "combobox", "aria-label": "what to do, or the name of a point or a line", "aria-controls": "palette-rows", "aria-expanded": "true", autocomplete: "off"})) field.setAttribute(name, value);
  list.id = "palette-rows";
  list.setAttribute("role", "listbox");
  list.setAttribute("aria-label", "what fits");
  /** @type {Row[]} */
  let rows = [];
  let at = 0;
  const mark = () => [...list.children].forEach((row, i) => {
    row.setAttribute("aria-selected", String(i === at));
    if (i === at) field.setAttribute("aria-activedescendant", row.id);
  });
  const run = (/** @type {Row | undefined} */ row) => {
    dialog.close();
    row?.run();
  };
  const look = () => {
    const parts = field.value.trim().toLowerCase().split(/\s+/);
    const fit = (/** @type {string} */ words) => parts.every((part) => words.toLowerCase().includes(part));
    const names = field.value.trim() ? [...(page.store.net?.curves.values() ?? []), ...(page.store.net?.points.values() ?? [])].map(({name}) => ({name, words: page.store.said(name)})).filter(({name, words}) => fit(name) || fit(words)) : [];
    rows = [...acts.filter(({words}) => fit(words)),
      ...names.slice(0, MOST).map(({name, words}) => ({words, keys: "go there", run: () => page.find(name)}))].slice(0, MOST);
    at = 0;
    list.replaceChildren(...rows.map((row, i) => {
      const item = make("li"), keys = make("kbd");
      item.id = `palette-${i}`;
      item.setAttribute("role", "option");
      keys.textContent = row.keys;
      item.append(row.words, keys);
      item.onclick = () => run(row);
      return item;
    }));
    if (!rows.length) {
      const none = make("li", {id: "palette-0"});
      none.setAttribute("role", "option");
      none.textContent = `Nothing is called so: type fewer letters, or a name such as ${page.store.net?.byName[0]?.[0] ?? "WL 1"}.`;
      list.append(none);
    }
    mark();
  };
  field.oninput = look;
  field.onkeydown = (event) => {
    event.stopPropagation(); // letters are words here, and Esc closes this alone
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      at = (at + (event.key === "ArrowDown" ? 1 : -1) + rows.length) % (rows.length || 1);
      mark();
    } else if (event.key === "Escape") {
      event.preventDefault(); // else the first only empties the field
      dialog.close();
    } else if (event.key === "Enter") {
      event.preventDefault(); // else it would press what has the focus then
      run(rows[at]);
    }
  };
  dialog.onclose = () => dialog.remove();
  dialog.append(field, list);
  page.root.append(dialog);
  look();
  dialog.showModal();
}
