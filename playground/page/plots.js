// The three plots: deflection and torque over time, residual vibration over the error of the frequency.

import { Chart, range } from "./chart.js";
import { percent } from "./number.js";
import { KINDS } from "./cards.js";

/** Errors of the frequency along the axis, %. */
const ERRORS = [...Array.from({ length: 41 }, (_, k) => k - 20), -0.5, -0.25, 0.25, 0.5].sort((a, b) => a - b);

export class Plots {
  constructor(core, onTime) {
    const chart = (id, options) => new Chart(document.querySelector(id), options);
    this.core = core;
    this.deflection = chart("#deflection", { onTime });
    this.torque = chart("#torque", { onTime });
    this.residual = chart("#residual", { log: true });
  }

  /** `runs` holds a run or a refusal for each of the motions. */
  show(runs, settings, end) {
    const known = KINDS.map(({ kind }, index) => ({ name: kind, run: runs[index] })).filter(({ run }) => !run.refusal);
    const along = (column, scale, label, about) => {
      const series = known.map(({ name, run }) => ({ name, points: run.curve(column, scale) }));
      const values = series.flatMap(({ points }) => points.map(([, y]) => y));
      return {
        x: [0, end],
        y: range(values),
        labels: ["time, s", label],
        series,
        mark: [settings.duration, "arrival"],
        about,
      };
    };
    this.deflection.show(along(6, 1e3, "mm", "Deflection of the tip over time; the dashed line is the arrival"));
    this.torque.show(along(7, 1, "N m", "Torque at the hub over time; the dashed line is the arrival"));
    // The runs of a sweep take time on a phone: only those of the last setting are made.
    clearTimeout(this.sweeping);
    this.sweeping = setTimeout(() => this.residual.show(this.sweep(known, settings)), 30);
  }

  /** Runs every motion on arms whose frequencies are not those that it was planned for. */
  sweep(known, settings) {
    const kinds = KINDS.map(({ kind }) => kind);
    const series = kinds.map((name, index) => ({
      name,
      points: ERRORS.map((error) => [error, 100 * this.core.residual(index, error / 100)]),
    }));
    const dots = known.map(({ name, run }) => ({ name, at: [settings.error, 100 * run.residual] }));
    const said = known.map(({ name, run }) => `${name} ${percent(run.residual)}`).join(", ");
    return {
      x: [-20, 20],
      y: [0.001, 100],
      series,
      dots,
      labels: ["difference of the frequency, %", "% of the length"],
      mark: [settings.error, ""],
      about: `Residual vibration over the difference of the frequency; at ${settings.error} %: ${said}`,
    };
  }

  at(time) {
    this.deflection.at(time);
    this.torque.at(time);
  }
}
