// How the page is looked at, kept by the browser for the next time; nothing of the hull is.

/** @typedef {import("./page.js").Page} Page */
/** @typedef {import("./store.js").Store} Store */

/** @param {Page} page */
export function keepLooks(page) {
  const {show, tools, gain, squeeze, theme} = page.store;
  page.options.keep("looks", JSON.stringify({show, how: tools.how, fine: tools.fine, fair: tools.fair, fairShapes: tools.fairShapes, pinned: tools.pinned, gain, squeeze, theme}));
}

/** @param {Page} page */
export function restoreLooks(page) {
  const {store} = page;
  try {
    const {show, how, fine, fair, fairShapes, pinned, gain, squeeze, theme} = JSON.parse(page.options.kept("looks") ?? "{}");
    for (const name of /** @type {(keyof Store["show"])[]} */ (Object.keys(store.show))) if (typeof show?.[name] === "boolean") store.show[name] = show[name];
    if (how === "pull" || how === "move") store.tools.how = how;
    store.tools.fine = fine === true;
    store.tools.fair = fair === true;
    store.tools.fairShapes = fairShapes !== false;
    store.tools.pinned = pinned === true;
    if (gain > 0 && gain < 100) store.gain = gain;
    if ([1, 2, 5, 10].includes(squeeze)) store.squeeze = squeeze;
    if (["auto", "light", "dark"].includes(theme)) store.theme = theme;
  } catch {
    page.options.keep("looks", "{}"); // what was kept is none of ours
  }
}
