// One card a motion: its picture, and what it asks and leaves.

import { ArmView } from "./arm.js";
import { digits, fixed, percent } from "./number.js";

/** The motions, in the order of the core. */
export const KINDS = [
  { kind: "cubic", title: () => "Cubic" },
  { kind: "shaped", title: (settings) => `Cubic, ${settings.shaper.toUpperCase()} shaper` },
  { kind: "still", title: (settings) => (settings.robust === "0" ? "Still move" : "Still move, robust") },
];

const DEFLECTION = 6;
const TORQUE = 7;

export class Card {
  constructor({ kind, title }, core) {
    this.title = title;
    this.article = document.createElement("article");
    this.article.className = `arm ${kind}`;
    this.article.innerHTML = `
      <h2><svg width="22" height="8" aria-hidden="true"><line class="key ${kind}" x1="0" x2="22" y1="4" y2="4"/></svg><span></span></h2>
      <canvas role="img"></canvas>
      <dl>
        <dt class="big">left ringing</dt><dd class="left"></dd>
        <dt>largest deflection</dt><dd data-fact="deflection"></dd>
        <dt>largest torque</dt><dd data-fact="torque"></dd>
        <dt>tip now</dt><dd data-fact="now"></dd>
      </dl>
      <p class="refusal"></p>`;
    this.view = new ArmView(this.article.querySelector("canvas"), core);
    document.querySelector("#arms").append(this.article);
  }

  fact(name, text) {
    this.article.querySelector(`[data-fact="${name}"]`).textContent = text;
  }

  /** Shows a run, or the reason why there is none. */
  show(run, settings, scene) {
    const name = this.title(settings);
    const refused = run.refusal !== undefined;
    this.article.querySelector("h2 span").textContent = name;
    this.article.toggleAttribute("data-refused", refused);
    this.article.querySelector(".refusal").textContent = run.refusal ?? "";
    this.run = refused ? null : run;
    this.view.show(this.run, scene);
    const canvas = this.article.querySelector("canvas");
    if (refused) {
      canvas.setAttribute("aria-label", `${name}: refused`);
      return;
    }
    const deflection = run.peak(DEFLECTION);
    this.article.querySelector(".left").textContent = percent(run.residual);
    this.fact("deflection", `${digits(1e3 * deflection)} mm (${fixed((100 * deflection) / scene.length, 0)} %)`);
    this.fact("torque", `${digits(run.peak(TORQUE))} N m`);
    canvas.setAttribute(
      "aria-label",
      `${name}: the arm bends by up to ${digits(1e3 * deflection)} mm and rings on with ${percent(run.residual)} of its length`,
    );
  }

  draw(time) {
    this.view.draw(time);
    if (!this.run) return;
    const row = Math.min(this.run.count - 1, Math.round(time / this.view.scene.tick));
    this.fact("now", `${fixed(1e3 * this.run.at(row, DEFLECTION), 1)} mm, ${fixed(this.run.at(row, TORQUE), 2)} N m`);
  }
}
