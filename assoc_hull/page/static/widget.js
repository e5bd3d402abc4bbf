// The page in a notebook: one view of a widget. What it says and hears goes through the kernel.

import {mount} from "./page.js";

const GONE = "The kernel has gone. Run the cell again: a hull file has all that was committed.";

/** @param {{model: any, el: HTMLElement}} given */
export function render({model, el}) {
  const view = Math.random().toString(36).slice(2), frame = document.createElement("div"), root = document.createElement("div"), end = new AbortController();
  frame.className = "assoc-hull-widget";
  frame.dataset.lmSuppressShortcuts = "true"; // keys of the notebook's command mode
  root.className = "page";
  root.style.height = `${model.get("_height")}px`;
  frame.append(root);
  el.append(frame);
  /** @type {(content: any, buffers: DataView[]) => void} */
  let hear = () => {};
  let lost = () => {};
  const page = mount(root, {
    token: "none", // the kernel lets nobody else in
    author: model.get("_author"),
    within: end.signal,
    connect: (hands) => {
      hear = (content, buffers) => {
        if (content.view !== view) return;
        if (content.text !== undefined) hands.text(content.text);
        for (const {buffer, byteOffset, byteLength} of buffers ?? []) hands.bytes(/** @type {ArrayBuffer} */ (buffer.slice(byteOffset, byteOffset + byteLength)));
      };
      lost = () => { if (!model.comm_live) hands.over(GONE); };
      setTimeout(() => hands.open()); // when the page has its link
      return {send: (message) => model.send({view, text: JSON.stringify(message)})};
    },
    keep: (name, value) => localStorage.setItem(`assoc-hull ${name}`, value),
    kept: (name) => localStorage.getItem(`assoc-hull ${name}`),
  });
  let row = /** @type {number | null} */ (null);
  page.store.listeners.add(() => {
    if (page.store.selection.row === row) return;
    row = page.store.selection.row;
    model.send({view, row});
  });
  model.on("msg:custom", hear);
  model.on("comm_live_update", lost);
  return () => {
    model.off("msg:custom", hear);
    model.off("comm_live_update", lost);
    if (model.comm_live !== false) model.send({view, gone: true});
    end.abort();
  };
}
