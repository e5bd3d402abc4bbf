// The palette: all that can be done, found by a few letters of its words; points and lines by name.

/** @typedef {import("./page.js").Page} Page */
/** @typedef {{words: string, keys: string, run: () => void}} Row */

const MOST = 12;

/** @param {Page} page @param {Row[]} acts all that can be done now */
export function openPalette(page, acts) {
  const dialog = document.createElement("dialog"), field = document.createElement("input"), list = document.createElement("ul");
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
    const names = field.value.trim() ? [...(page.store.net?.curves.values() ?? []), ...(page.store.net?.points.values() ?? [])].filter(({name}) => fit(name)) : [];
    rows = [...acts.filter(({words}) => fit(words)),
      ...names.slice(0, MOST).map(({name}) => ({words: name, keys: "go there", run: () => page.find(name)}))].slice(0, MOST);
    at = 0;
    list.replaceChildren(...rows.map((row, i) => {
      const item = document.createElement("li"), keys = document.createElement("kbd");
      item.id = `palette-${i}`;
      item.setAttribute("role", "option");
      keys.textContent = row.keys;
      item.append(row.words, keys);
      item.onclick = () => run(row);
      return item;
    }));
    if (!rows.length) {
      const none = document.createElement("li");
      none.id = "palette-0";
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
