// How the page looks: what the browser keeps of that, colours, the room of each view. What it says: a
// refusal beside its point; in live regions, once a second at most.

import {signed} from "./units.js";

/** @param {Page} page */
export function keepLooks(page) {
  const {show, tools: {radius, ...tools}, gain, squeeze, theme} = page.store;
  page.options.keep("looks", JSON.stringify({show, ...tools, gain, squeeze, theme}));
}

/** @param {Page} page */
export function restoreLooks(page) {
  const {store} = page;
  try {
    const {show, how, fairShapes, gain, squeeze, theme, ...kept} = JSON.parse(page.options.kept("looks") ?? "{}");
    for (const name of /** @type {(keyof Store["show"])[]} */ (Object.keys(store.show))) if (typeof show?.[name] === "boolean") store.show[name] = show[name];
    if (how === "pull" || how === "move") store.tools.how = how;
    for (const name of /** @type {const} */ (["fine", "fair", "pinned"])) store.tools[name] = kept[name] === true;
    store.tools.fairShapes = fairShapes !== false;
    if (gain > 0 && gain < 100) store.gain = gain;
    if ([1, 2, 5, 10].includes(squeeze)) store.squeeze = squeeze;
    if (["auto", "light", "dark"].includes(theme)) store.theme = theme;
  } catch {
    page.options.keep("looks", "{}"); // what was kept is none of ours
  }
}

const NAMES = ["paper", "ink", "soft", "grid", "rule", "water", "live", "spike", "comb", "hot", "ghost",
  "boundary", "sections", "waterlines", "buttocks", "diagonals", "frames"];

/** @param {HTMLElement} root @returns {Record<string, string>} */
export function readInk(root) {
  const style = getComputedStyle(root);
  return Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** Which of the two is shown. @param {string} wish */
export function themeOf(wish) {
  if (matchMedia("print").matches) return "light";
  if (wish !== "auto") return wish;
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

const SHARE = 0.254, LEAST = 104; // of the height at most, px at least

/** Gives the low views the height that the hull fills, or half of all where lengths are much compressed. @param {Page} page */
export function layRows(page) {
  const {store, views} = page, box = views.profile.element.parentElement;
  if (!box || !store.net) return;
  const {clientWidth: wide, clientHeight: high} = box, key = `${wide}/${high}/${store.squeeze}/${store.tab}/${store.net.particulars.name}`;
  if (box.dataset.laid === key) return;
  box.dataset.laid = key;
  box.dataset.squeeze = String(store.squeeze); // a ship that is as high as long fills a square
  const want = (/** @type {View} */ view) => view.heightFor(wide, view.kind === "body" ? 1 : store.squeeze);
  // Where one view is seen at a time it is as high as it fills; the wire is turned, and has room for that.
  box.style.setProperty("--alone", `${Math.round(store.tab === "wire" ? 0.75 * wide : want(views[store.tab]))}px`);
  for (const view of [views.profile, views.half]) box.style.setProperty(`--${view.kind}`, `${Math.round(Math.min(Math.max(want(view), LEAST), Math.max(SHARE * high, LEAST)))}px`);
}
