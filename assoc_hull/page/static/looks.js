// How the page looks: what the browser keeps of that, colours, the room of each view. What it says: a
// refusal beside its point; in live regions, once a second at most.

import {signed} from "./units.js";

/** @typedef {import("./page.js").Page} Page */
/** @typedef {import("./store.js").Store} Store */

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

const NAMES = ["paper", "ink", "soft", "grid", "water", "live", "spike", "comb", "hot", "ghost",
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

/** Gives the low views the height that the hull fills; all of theirs where lengths are compressed. @param {Page} page */
export function layRows(page) {
  const {store, views} = page, box = views.profile.element.parentElement;
  if (!box || !store.net) return;
  const {clientWidth: wide, clientHeight: high} = box, key = `${wide}/${high}/${store.squeeze}/${store.net.particulars.name}`;
  if (box.dataset.laid === key) return;
  box.dataset.laid = key;
  for (const view of [views.profile, views.half]) {
    const most = Math.max(SHARE * high, LEAST), want = store.squeeze === 1 ? view.heightFor(wide) : most;
    box.style.setProperty(`--${view.kind}`, `${Math.round(Math.min(Math.max(want, LEAST), most))}px`);
  }
}

const WIDE = 340, REASONS = 3;

/** @param {Page} page */
export function placeBubble(page) {
  const {store} = page, {refusal} = store, view = page.activeView();
  let bubble = /** @type {HTMLElement | null} */ (page.root.querySelector(".bubble"));
  if (!refusal) return bubble?.remove();
  if (!bubble) {
    bubble = document.createElement("div");
    bubble.className = "bubble";
  }
  if (bubble.parentElement !== view.element) view.element.append(bubble);
  const words = shortened(refusal.text);
  if (bubble.textContent !== words) bubble.textContent = words;
  const [x, y] = refusal.place && view.kind !== "wire" ? view.atPlace(refusal.place) : [view.width / 2, 40];
  const wide = Math.min(WIDE, view.width - 16);
  bubble.style.maxWidth = `${wide}px`;
  const right = x < view.width / 2, below = y < view.height / 2;
  bubble.style.left = right ? `${Math.min(Math.max(x + 18, 8), Math.max(view.width - wide - 8, 8))}px` : "auto";
  bubble.style.right = right ? "auto" : `${Math.min(Math.max(view.width - x + 18, 8), Math.max(view.width - wide - 8, 8))}px`;
  bubble.style.top = below ? `${Math.min(Math.max(y + 18, 28), view.height - 60)}px` : "auto";
  bubble.style.bottom = below ? "auto" : `${Math.min(Math.max(view.height - y + 18, 8), view.height - 60)}px`;
}

/** A pull that goes much too far folds every line: the first reasons tell enough. @param {string} text */
function shortened(text) {
  const reasons = text.split("\n"), more = reasons.length - REASONS;
  return more > 0 ? [...reasons.slice(0, REASONS), `and ${more} more ${more === 1 ? "reason" : "reasons"}`].join("\n") : text;
}

const PAUSE = 1000; // ms

export class Speaker {
  /** @param {HTMLElement} root */
  constructor(root) {
    const [polite, urgent] = ["polite", "assertive"].map((how) => {
      const region = document.createElement("div");
      region.className = "spoken";
      region.setAttribute("aria-live", how);
      root.append(region);
      return region;
    });
    this.polite = polite;
    this.urgent = urgent;
    this.last = 0;
    this.refused = "";
  }

  /** @param {string} words */
  say(words) { this.polite.textContent = words; }

  /** @param {Store} store */
  listen(store) {
    const refused = store.refusal?.text ?? store.problem ?? "";
    if (refused !== this.refused) this.urgent.textContent = this.refused = refused;
    const {held, overlay, net} = store, now = performance.now();
    if (!held || !overlay || held.amount === null || now - this.last < PAUSE) return;
    this.last = now;
    const name = net?.points.get(held.row)?.name ?? "";
    this.say(`${name}, ${held.how} ${(1e3 * held.amount).toFixed(1)} millimetres, ${overlay.frame.curves.size} curves follow, volume about ${signed(overlay.frame.volume, 1, "cubic metres")}`);
  }
}
