// Numbers with their units, in words.

/** What was typed, with a point or a comma; NaN where it is no number. @param {HTMLInputElement} field */
export const typedNumber = ({value}) => Number(value.replace(",", ".").replace("−", "-").trim() || NaN);
/** @param {number} n @param {string} one */
export const count = (n, one) => `${n} ${one}${n === 1 ? "" : "s"}`;
/** @param {number} metres */
export const millimetres = (metres) => {
  const size = 1e3 * Math.abs(metres);
  // What has moved at all has not moved by nothing.
  return size > 1e-6 && size < 0.05 ? "under 0.1 mm" : `${metres < 0 ? "−" : ""}${size.toFixed(1)} mm`;
};
/** @param {number} value @param {number} digits @param {string} unit */
export const signed = (value, digits, unit) => {
  const size = Math.abs(value).toFixed(digits);
  const sign = Number(size) === 0 ? "±" : value < 0 ? "−" : "+";
  return `${sign}${size}${unit && ` ${unit}`}`;
};
/** One word and one symbol wherever it is told. */
export const VOLUME = "volume ∇";
