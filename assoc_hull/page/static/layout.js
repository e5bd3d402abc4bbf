// How high profile and half-breadth plan are: no more than they use, so that the body plan gets the rest.

/** @typedef {import("./page.js").Page} Page */

const SHARE = 0.254, LEAST = 104; // of the height at most, px at least

/** Gives the low views the height that the hull fills at the scale of its length; all of theirs where lengths are compressed. @param {Page} page */
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
