// Why an edit is refused, in few words: of a move that goes too far the first line that folds tells enough.

const SHOWN = 3;
const FOLDS = [/^(?:.+?: )?(.+?) folds (?:back on itself|through the plane of .+?) at \((.+?)\) m/, /^two neighbouring points of (.+?) at \((.+?)\) m lie/];

/** One sentence of all folds, and what to do; else the reasons. @param {readonly string[]} reasons @param {boolean} [pull] whether a radius could be wider */
export function reasonWords(reasons, pull = false) {
  const folds = reasons.map((each) => FOLDS.map((fold) => fold.exec(each)).find((found) => found)).filter((each) => each != null);
  const more = new Set(folds.map(([, line]) => line)).size - 1, left = reasons.length - SHOWN;
  if (folds.length) return `Too far: ${folds[0][1]} would fold at (${folds[0][2]}) m${more ? `, and ${more} more ${more === 1 ? "line" : "lines"}` : ""}. ${pull ? "Pull less, or widen the radius of the pull." : "Move less, or move the points beside it too."}`;
  return [...reasons.slice(0, SHOWN), ...left > 0 ? [`and ${left} more ${left === 1 ? "reason" : "reasons"}`] : []].join("\n");
}
