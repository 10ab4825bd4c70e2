// What can be set: ranges, units, and the link that restores them.

import { scaled } from "./number.js";

/** Sliders, each with the factor to SI units. */
export const SLIDERS = [
  { key: "length", group: "arm", label: "Length", unit: "mm", min: 100, max: 1000, step: 10, value: 500, scale: 1e-3 },
  { key: "thickness", group: "arm", label: "Thickness", unit: "mm", min: 0.5, max: 6, step: 0.1, value: 2, scale: 1e-3 },
  { key: "width", group: "arm", label: "Width", unit: "mm", min: 5, max: 60, step: 1, value: 20, scale: 1e-3 },
  { key: "payload", group: "arm", label: "Payload", unit: "g", min: 0, max: 500, step: 5, value: 50, scale: 1e-3 },
  { key: "damping", group: "arm", label: "Damping ratio", unit: "%", min: 0, max: 5, step: 0.1, value: 0.5, scale: 1e-2 },
  { key: "angle", group: "move", label: "Angle", unit: "°", min: 10, max: 180, step: 5, value: 90, scale: Math.PI / 180 },
  { key: "duration", group: "move", label: "Duration", unit: "s", min: 0.1, max: 3, step: 0.01, value: 0.4, scale: 1 },
  { key: "error", group: "truth", label: "Frequency differs by", unit: "%", min: -20, max: 20, step: 1, value: 0, scale: 1e-2 },
];

/** Lists, each option with its name in scene files and in the link. */
export const LISTS = [
  { key: "material", group: "arm", label: "Material", value: "aluminium", options: [] },
  {
    key: "shaper", group: "move", label: "Shaper", value: "zv",
    options: [["zv", "ZV"], ["mzv", "MZV"], ["zvd", "ZVD"], ["ei", "EI"], ["2hump-ei", "two-hump EI"]],
  },
  {
    key: "robust", group: "move", label: "Still move", value: "0",
    options: [["0", "for this arm"], ["0.1", "robust to ±10 %"], ["0.2", "robust to ±20 %"]],
  },
];

/** Returns the settings that the page begins with. */
export function defaults() {
  return Object.fromEntries([...SLIDERS, ...LISTS].map(({ key, value }) => [key, value]));
}

/** Returns the nearest value that a slider has, or its default if the text is no number. */
export function admit(slider, text) {
  const value = Number(text);
  if (text === null || String(text).trim() === "" || !Number.isFinite(value)) return slider.value;
  const steps = Math.round((Math.min(slider.max, Math.max(slider.min, value)) - slider.min) / slider.step);
  return Number((slider.min + steps * slider.step).toFixed(6));
}

/** Reads settings from the part of a link behind `#`. What it does not hold, or not in range, is at its default. */
export function fromLink(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const settings = defaults();
  for (const slider of SLIDERS) settings[slider.key] = admit(slider, words.get(slider.key));
  for (const { key, options } of LISTS) {
    const word = words.get(key);
    if (options.some(([name]) => name === word)) settings[key] = word;
  }
  return settings;
}

/** Returns the part of a link behind `#` that restores the settings. */
export function toLink(settings) {
  return `#${new URLSearchParams(settings)}`;
}

/** Returns the settings in SI units, angles in rad. */
export function inSi(settings) {
  const si = {};
  for (const { key, scale } of SLIDERS) {
    si[key] = key === "angle" ? settings.angle * scale : scaled(settings[key], scale);
  }
  return si;
}
