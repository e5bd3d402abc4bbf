// What the live regions say: at most once a second while something is dragged; refusals at once.

import {signed} from "./units.js";

/** @typedef {import("./store.js").Store} Store */

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
