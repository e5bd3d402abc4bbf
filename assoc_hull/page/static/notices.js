// What the page says: a refusal beside its point; in live regions, once a second at most; in its foot.

import {make} from "./elements.js";
import {VOLUME, signed} from "./units.js";

export const READ = 6000; // ms
const WIDE = 440;

/** @param {Page} page */
export function placeBubble(page) {
  const {store} = page, {refusal} = store, view = page.activeView();
  let bubble = /** @type {HTMLElement | null} */ (page.root.querySelector(".bubble"));
  if (!refusal) return bubble?.remove();
  if (!bubble) {
    bubble = make("div", {className: "bubble"});
  }
  if (bubble.parentElement !== view.element) view.element.append(bubble);
  if (bubble.textContent !== refusal.text) bubble.textContent = refusal.text;
  const [x, y] = refusal.place && view.kind !== "wire" ? view.atPlace(refusal.place) : [view.width / 2, 40];
  const wide = Math.min(WIDE, view.width - 16);
  bubble.style.maxWidth = `${wide}px`;
  const right = x < view.width / 2, below = y < view.height / 2;
  bubble.style.left = right ? `${Math.min(Math.max(x + 18, 8), Math.max(view.width - wide - 8, 8))}px` : "auto";
  bubble.style.right = right ? "auto" : `${Math.min(Math.max(view.width - x + 18, 8), Math.max(view.width - wide - 8, 8))}px`;
  // How far the point was pulled stands over it, near the upper edge below it.
  const apart = below ? y < 46 ? 32 : 18 : 28;
  bubble.style.maxHeight = `${Math.max((below ? view.height - y : y) - apart - 8, 60)}px`; // its first words are never cut
  bubble.style.top = below ? `${Math.min(Math.max(y + apart, 28), view.height - 60)}px` : "auto";
  bubble.style.bottom = below ? "auto" : `${Math.min(Math.max(view.height - y + apart, 8), view.height - 60)}px`;
}

const PAUSE = 1000; // ms

export class Speaker {
  /** @param {HTMLElement} root */
  constructor(root) {
    const [polite, urgent] = ["polite", "assertive"].map((how) => {
      const region = make("div", {className: "spoken"});
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
    const name = store.said(net?.points.get(held.row)?.name ?? "");
    this.say(`${name}, ${held.how} ${(1e3 * held.amount).toFixed(1)} millimetres, ${overlay.frame.curves.size} curves follow, ${VOLUME} about ${signed(overlay.frame.volume, 1, "cubic metres")}`);
  }
}

/** What went wrong, what was said or can be done, and figures of what is in hand. @param {Page} page */
export function writeFoot(page) {
  const {store} = page, {held, overlay} = store;
  const gone = store.connection === "lost" || store.connection === "over";
  page.root.classList.toggle("gone", gone);
  page.banner.hidden = !gone && !store.problem;
  page.banner.textContent = gone ? store.reason : store.problem ?? "";
  const touch = matchMedia("(pointer: coarse)").matches; // there is neither wheel nor key
  const hints = store.shaping ? "Re-shape: click where the line is to pass, drag a place, Backspace removes the last, Enter shows the answer, Esc gives up"
    : held?.how === "pull" ? touch ? "Pull: a second finger cancels; Fine is ten times finer" : "Pull: wheel changes the radius, Alt is ten times finer, Esc cancels"
    : held ? touch ? "Move: a second finger cancels; Fine is ten times finer" : "Move: Alt is ten times finer, Shift locks an axis, Esc cancels"
    : store.selection.row !== null ? touch ? "Drag the point, or press −1 mm and +1 mm" : "Drag, or use the arrows: 1 mm, Shift 10 mm, Alt 0.1 mm"
    : touch ? "Tap a point or a line; drag the ground to pan, two fingers zoom" : "Click a point or a line; drag the ground to pan, the wheel zooms";
  // What was said is read before it gives way to a hint.
  const said = !held && performance.now() - page.said.at < READ ? page.said.words : "";
  page.status.textContent = store.connection === "connecting" ? "Connecting" : said || hints;
  // Across the ship, unless the point goes along it only: lengths may be compressed.
  const view = page.activeView(), pixel = 1e3 / (held?.how === "move" && held.free === "x" ? view.axis.s : view.sy) * ((held ?? page.store.tools).fine ? 0.1 : 1), gear = held ? `1 px is ${pixel.toFixed(pixel < 10 ? 1 : 0)} mm` : "";
  const radius = held?.radius ? `felt over ${held.radius[0].toFixed(1)} × ${held.radius[1].toFixed(1)} m` : "";
  const drawn = store.magnified && store.show.movement && !held?.refused ? `movement is drawn × ${store.magnified.toLocaleString("en")}` : "";
  page.figures.textContent = overlay && held ? [gear, radius, drawn, held.waiting ? "catching up" : `computed in ${overlay.frame.ms.toFixed(1)} ms`].filter(Boolean).join(" · ") : store.theirs ? `${store.theirs.author} holds ${store.said(store.net?.points.get(store.theirs.row)?.name ?? "a point")}` : drawn ? drawn : store.file ? `kept in ${store.file}` : store.net ? "in memory" : "";
}
