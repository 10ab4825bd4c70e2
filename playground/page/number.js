// Numbers as a reader sees them, and as a file holds them.

/** Returns a number with that many significant digits, a true minus, and no exponent. */
export function digits(value, count = 3) {
  if (!Number.isFinite(value)) return "–";
  const rounded = Number(value.toPrecision(count));
  const places = rounded === 0 ? 0 : Math.max(0, count - 1 - Math.floor(Math.log10(Math.abs(rounded))));
  return fixed(rounded, Math.min(places, 8));
}

/** Returns a number with that many decimals and a true minus. */
export function fixed(value, places) {
  const text = value.toFixed(places);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "\u2212");
}

/** Returns a fraction of the length as a percentage, no finer than a thousandth of one. */
export function percent(fraction) {
  if (!Number.isFinite(fraction)) return "–";
  const value = 100 * fraction;
  return value < 0.001 ? "<\u202f0.001\u202f%" : `${digits(value, value < 0.01 ? 1 : value < 0.1 ? 2 : 3)}\u202f%`;
}

/** Returns a number as TOML writes a float; it reads back as the same number. */
export function float(value) {
  const text = String(value);
  return /[.e]/.test(text) ? text : `${text}.0`;
}

/** Returns the number in SI units of a slider's, which has few decimals: 2.3 mm is 0.0023 m. */
export function scaled(value, scale) {
  return Number((value * scale).toPrecision(12));
}
