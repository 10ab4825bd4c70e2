// The page: settings in, runs of the core, pictures and plots out.

import { boxOf } from "./arm.js";
import { Card, KINDS } from "./cards.js";
import { Controls } from "./controls.js";
import { Core } from "./core.js";
import { listenToKeys } from "./keys.js";
import { digits, fixed, percent } from "./number.js";
import { Player } from "./player.js";
import { Plots } from "./plots.js";
import { sceneFile } from "./scene.js";
import { LISTS, defaults, fromLink, inSi, toLink } from "./settings.js";
import { Share } from "./share.js";
import { listenToTheme } from "./themes.js";

/** Setpoint interval, s. */
const TICK = 0.01;

class Playground {
  constructor(core) {
    this.core = core;
    const materials = core.materials();
    LISTS.find(({ key }) => key === "material").options = materials.map((name) => [name, name.replaceAll("-", " ")]);
    this.cards = KINDS.map((kind) => new Card(kind, core));
    this.player = new Player((time) => this.draw(time), (playing) => this.said(playing));
    this.plots = new Plots(core, (time) => this.player.go(time));
    this.controls = new Controls((key, value) => this.change({ ...this.settings, [key]: value }));
    this.share = new Share((kind) => this.scene(kind), (kind) => this.runOf(kind));
    this.listen();
    this.change(fromLink(location.hash));
    listenToTheme(() => this.draw(this.player.shown()));
    if (!matchMedia("(prefers-reduced-motion: reduce)").matches) this.player.play();
  }

  listen() {
    const on = (id, event, action) => document.querySelector(id).addEventListener(event, action);
    on("#play", "click", () => this.player.toggle());
    on("#speed", "change", (event) => {
      this.player.speed = Number(event.target.value);
    });
    on("#time", "input", (event) => this.player.go(Number(event.target.value) * TICK));
    on("#reset", "click", () => this.change(defaults()));
    on("#controls", "submit", (event) => event.preventDefault());
    addEventListener("hashchange", () => {
      if (location.hash !== toLink(this.settings)) this.change(fromLink(location.hash));
    });
    new ResizeObserver(() => this.draw(this.player.shown())).observe(document.querySelector("#arms"));
    listenToKeys(this.player, TICK);
  }

  /** Takes other settings: sets the arm up and runs the three motions. */
  change(settings) {
    this.settings = settings;
    this.controls.show(settings);
    this.si = inSi(settings);
    const index = (key) => LISTS.find((list) => list.key === key).options.findIndex(([name]) => name === settings[key]);
    const { length, width, thickness, payload, damping, angle, duration, error } = this.si;
    this.facts = this.core.setUp([
      length, width, thickness, index("material"), payload, damping, angle, duration, index("shaper"),
      Number(settings.robust),
    ]);
    const { refusal } = this.facts;
    this.runs = KINDS.map((_, kind) => (refusal ? { refusal } : this.core.run(kind, error)));
    this.show();
    clearTimeout(this.linking);
    // Browsers refuse an address that changes too often.
    this.linking = setTimeout(() => history.replaceState(null, "", toLink(settings)), 250);
  }

  show() {
    const { settings, si, facts, runs } = this;
    const known = runs.filter((run) => !run.refusal);
    const scene = {
      tick: TICK,
      to: si.angle,
      length: si.length,
      thickness: si.thickness,
      payload: si.payload,
      box: boxOf(known, si.length, si.angle),
    };
    this.cards.forEach((card, index) => card.show(runs[index], settings, scene));
    const end = si.duration + (facts.rest ?? 1);
    document.querySelector("#time").max = Math.round(end / TICK);
    this.plots.show(runs, settings, end);
    document.querySelector("#facts").textContent = this.about();
    this.share.show();
    this.player.lasts(end);
    clearTimeout(this.saying);
    this.saying = setTimeout(() => {
      document.querySelector("#summary").textContent = this.summary();
    }, 600);
  }

  /** Says what the arm is. */
  about() {
    const { facts, si } = this;
    if (facts.refusal) return facts.refusal;
    const periods = digits(si.duration * facts.first);
    return `First mode ${digits(facts.first)} Hz, a period of ${digits(1e3 / facts.first)} ms; second mode ${digits(
      facts.second,
    )} Hz. The link weighs ${digits(1e3 * facts.mass)} g. The move takes ${periods} periods.`;
  }

  /** Says what the motions leave. */
  summary() {
    const leaves = ({ title }, run) => `${title(this.settings)} ${run.refusal ? "is refused" : percent(run.residual)}`;
    return `Left ringing: ${KINDS.map((kind, index) => leaves(kind, this.runs[index])).join(", ")}.`;
  }

  draw(time) {
    if (!this.runs) return;
    for (const card of this.cards) card.draw(time);
    this.plots.at(time);
    const slider = document.querySelector("#time");
    slider.value = Math.round(time / TICK);
    slider.setAttribute("aria-valuetext", `${fixed(time, 2)} s`);
    document.querySelector("#clock").textContent = `${fixed(time, 2)} s`;
  }

  said(playing) {
    document.querySelector("#play").textContent = playing ? "Pause" : "Play";
  }

  runOf(kind) {
    return this.runs[KINDS.findIndex((known) => known.kind === kind)];
  }

  /** Returns the scene file of a motion, or a comment with the reason why there is none. */
  scene(kind) {
    const run = this.runOf(kind);
    if (run.refusal) return `# ${run.refusal}\n`;
    return sceneFile(kind, this.settings, this.si, this.facts, run, this.core.stiffness(this.si.error));
  }
}

try {
  const core = await Core.load(document.querySelector("#module").textContent);
  // For the console, and for the tests.
  globalThis.playground = new Playground(core);
} catch (error) {
  const fault = document.querySelector("#fault");
  fault.textContent = `This browser cannot run the page: ${error}`;
  fault.hidden = false;
  throw error;
}
