// The page in a browser: the only module that knows the address, the socket and what is kept.

import {mount} from "./page.js";
import {Transport} from "./transport.js";

const KEPT = "assoc-hull page", AUTHOR = "assoc-hull author";

/** What the address says behind #; it is taken out of the address bar, and kept for a reload. */
function admission() {
  const given = new URLSearchParams(location.hash.slice(1));
  if (given.has("t")) {
    sessionStorage.setItem(KEPT, given.toString());
    history.replaceState(null, "", location.pathname);
    return given;
  }
  return new URLSearchParams(sessionStorage.getItem(KEPT) ?? "");
}

const root = /** @type {HTMLElement} */ (document.querySelector(".page"));
const given = admission();
const author = localStorage.getItem(AUTHOR) || given.get("author") || "designer";
mount(root, {
  token: given.get("t") ?? "",
  author,
  upload: (file) => fetch(`drop?name=${encodeURIComponent(file.name)}`, {method: "POST", body: file, headers: {"X-Token": given.get("t") ?? ""}}).then((answer) => answer.json()),
  connect: (hands) => new Transport(`ws://${location.host}/socket`, hands),
  keep: (name, value) => localStorage.setItem(`assoc-hull ${name}`, value),
  kept: (name) => localStorage.getItem(`assoc-hull ${name}`),
});
