// Elements of the page, each made in one line.

/**
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} name @param {object} [given] @param {...(Node | string)} inside
 */
export function make(name, given, ...inside) {
  const found = document.createElement(name);
  Object.assign(found, given).append(...inside);
  return found;
}

/** @param {string} words @param {() => void} run */
export const button = (words, run, className = "") => make("button", {type: "button", textContent: words, onclick: run, className});

/** @param {string} words @param {() => void} run */
export const link = (words, run) => button(words, run, "link");

/** @param {string} words */
export const paragraph = (words, className = "") => make("p", {textContent: words, className});

/** What belongs together in a panel. @param {...(Node | string)} inside */
export const form = (...inside) => make("div", {className: "form"}, ...inside);

/** A table with words above it and heads of its columns. @param {string} words @param {string[]} titles */
export function tableOf(words, titles) {
  const table = make("table"), head = table.createTHead().insertRow();
  table.createCaption().textContent = words;
  head.append(...titles.map((textContent) => make("th", {scope: "col", textContent})));
  return table;
}
