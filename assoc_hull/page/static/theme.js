// Colours, read from the style sheet once for each change of it.

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
