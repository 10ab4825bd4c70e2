// The picture of an arm: its link as it bends, the way of its tip, and its shape every so often.

const TAU = 2 * Math.PI;

/** Shapes that stay in the picture while the hub moves. */
const TRACES = 7;

export class ArmView {
  constructor(canvas, core) {
    this.canvas = canvas;
    this.core = core;
    this.run = null;
  }

  /** Takes a run, what it shall reach (rad), and the box in m that all the pictures share. */
  show(run, scene) {
    this.run = run;
    this.scene = scene;
    if (!run) return;
    const every = Math.max(1, Math.round(run.arrival / scene.tick / TRACES));
    const last = Math.round(run.arrival / scene.tick);
    this.traces = [];
    for (let row = 0; row < last; row += every) this.traces.push(this.centreline(row * scene.tick));
  }

  /** Returns the centreline at a time in the global frame: x and y in turn, m. */
  centreline(time) {
    const { angle, modes } = this.run.pose(time, this.scene.tick);
    const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
    const points = this.core.shape(...modes);
    const turned = new Float64Array(points.length);
    for (let i = 0; i < points.length; i += 2) {
      turned[i] = points[i] * cos - points[i + 1] * sin;
      turned[i + 1] = points[i] * sin + points[i + 1] * cos;
    }
    return turned;
  }

  /** Draws the arm at a time, s. */
  draw(time) {
    const context = this.fit();
    if (!this.run || this.size < 10) return;
    const style = getComputedStyle(this.canvas);
    const colour = (name) => style.getPropertyValue(name).trim();
    const own = colour("--colour");
    this.target(context, colour("--quiet"));
    context.lineWidth = 1.2;
    for (const trace of this.traces) this.stroke(context, trace, own, 0.22);
    this.way(context, own, time);
    const { angle } = this.run.pose(time, this.scene.tick);
    this.rigid(context, angle, colour("--quiet"));
    const shape = this.centreline(time);
    context.lineWidth = Math.min(9, Math.max(3, this.scene.thickness * this.scale));
    this.stroke(context, shape, own, 1);
    this.payload(context, shape, own, colour("--card"));
    this.hub(context, angle, colour("--ink"), colour("--card"));
  }

  /** Clears the canvas in the resolution of the screen, and fits the box of the scene into it. */
  fit() {
    const { canvas } = this;
    const ratio = window.devicePixelRatio || 1;
    const width = canvas.clientWidth;
    const height = canvas.clientHeight;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.lineCap = "round";
    context.lineJoin = "round";
    this.size = Math.min(width, height);
    if (this.run) {
      const { left, right, low, high } = this.scene.box;
      const margin = 12 + 4 * (this.size > 200);
      this.scale = Math.min((width - 2 * margin) / (right - left), (height - 2 * margin) / (high - low));
      this.x = (x) => 0.5 * width + (x - 0.5 * (left + right)) * this.scale;
      this.y = (y) => 0.5 * height - (y - 0.5 * (low + high)) * this.scale;
    }
    return context;
  }

  stroke(context, points, colour, alpha) {
    context.globalAlpha = alpha;
    context.strokeStyle = colour;
    context.beginPath();
    for (let i = 0; i < points.length; i += 2) context.lineTo(this.x(points[i]), this.y(points[i + 1]));
    context.stroke();
    context.globalAlpha = 1;
  }

  /** Draws where the straight arm shall come to rest. */
  target(context, colour) {
    const { to, length } = this.scene;
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.setLineDash([4, 4]);
    context.beginPath();
    context.moveTo(this.x(0), this.y(0));
    context.lineTo(this.x(length * Math.cos(to)), this.y(length * Math.sin(to)));
    context.stroke();
    context.setLineDash([]);
    context.beginPath();
    context.arc(this.x(length * Math.cos(to)), this.y(length * Math.sin(to)), this.radius() + 3, 0, TAU);
    context.stroke();
  }

  /** Draws where a rigid arm would be. */
  rigid(context, angle, colour) {
    const { length } = this.scene;
    context.globalAlpha = 0.8;
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(this.x(0), this.y(0));
    context.lineTo(this.x(length * Math.cos(angle)), this.y(length * Math.sin(angle)));
    context.stroke();
    context.globalAlpha = 1;
  }

  /** Draws the way of the tip, what is behind it stronger. */
  way(context, colour, time) {
    const { run } = this;
    const until = Math.min(run.count - 1, Math.floor(time / this.scene.tick));
    context.strokeStyle = colour;
    for (const [first, last, alpha] of [[0, run.count - 1, 0.3], [0, until, 0.9]]) {
      context.globalAlpha = alpha;
      context.lineWidth = 1.2;
      context.beginPath();
      for (let row = first; row <= last; row++) context.lineTo(this.x(run.at(row, 4)), this.y(run.at(row, 5)));
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /** Radius of the payload in the picture, px: by the cube root of its mass. */
  radius() {
    return (this.size > 200 ? 1 : 0.65) * (3 + 11 * Math.cbrt(this.scene.payload / 0.5));
  }

  payload(context, shape, colour, ground) {
    if (this.scene.payload === 0) return;
    context.fillStyle = colour;
    context.strokeStyle = ground;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(this.x(shape.at(-2)), this.y(shape.at(-1)), this.radius(), 0, TAU);
    context.fill();
    context.stroke();
  }

  hub(context, angle, ink, ground) {
    const [x, y, radius] = [this.x(0), this.y(0), this.size > 200 ? 11 : 7];
    context.fillStyle = ink;
    context.beginPath();
    context.arc(x, y, radius, 0, TAU);
    context.fill();
    context.strokeStyle = ground;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + 0.8 * radius * Math.cos(angle), y - 0.8 * radius * Math.sin(angle));
    context.stroke();
  }
}

/** Returns the smallest box in m that holds hub, target and the way of every tip. */
export function boxOf(runs, length, to) {
  const box = { left: 0, right: 0, low: 0, high: 0 };
  const hold = (x, y) => {
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.low = Math.min(box.low, y);
    box.high = Math.max(box.high, y);
  };
  hold(length, 0);
  hold(length * Math.cos(to), length * Math.sin(to));
  for (const run of runs) {
    for (let row = 0; row < run.count; row++) hold(run.at(row, 4), run.at(row, 5));
  }
  return box;
}
