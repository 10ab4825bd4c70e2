// Sliders and lists: built from the table of settings.

import { LISTS, SLIDERS, admit } from "./settings.js";

export class Controls {
  constructor(onChange) {
    this.inputs = new Map();
    for (const list of LISTS.filter(({ key }) => key === "material")) this.list(list, onChange);
    for (const slider of SLIDERS) this.slider(slider, onChange);
    for (const list of LISTS.filter(({ key }) => key !== "material")) this.list(list, onChange);
  }

  slider(slider, onChange) {
    const { key, label, unit, min, max, step } = slider;
    const id = `set-${key}`;
    const field = this.field(slider.group, `
      <label for="${id}">${label}</label>
      <span class="value"><input type="number" id="${id}-number" aria-label="${label}, ${unit}"><span class="unit" aria-hidden="true">${unit}</span></span>
      <input type="range" id="${id}">`);
    const [range, number] = [field.querySelector(`#${id}`), field.querySelector(`#${id}-number`)];
    for (const input of [range, number]) Object.assign(input, { min, max, step });
    range.addEventListener("input", () => onChange(key, admit(slider, range.value)));
    number.addEventListener("change", () => onChange(key, admit(slider, number.value)));
    this.inputs.set(key, (value) => {
      range.value = value;
      range.setAttribute("aria-valuetext", `${value} ${unit}`);
      number.value = value;
    });
  }

  list({ key, group, label, options }, onChange) {
    const id = `set-${key}`;
    const field = this.field(group, `<label for="${id}">${label}</label><select id="${id}"></select>`);
    const select = field.querySelector("select");
    for (const [name, text] of options) select.add(new Option(text, name));
    select.addEventListener("change", () => onChange(key, select.value));
    this.inputs.set(key, (value) => {
      select.value = value;
    });
  }

  field(group, markup) {
    const field = document.createElement("div");
    field.className = "field";
    field.innerHTML = markup;
    document.querySelector(`#${group}-fields`).append(field);
    return field;
  }

  show(settings) {
    for (const [key, set] of this.inputs) set(settings[key]);
  }
}
