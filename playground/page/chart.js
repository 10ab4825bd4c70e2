// Line charts in SVG, drawn in the pixels of the page so that their text keeps its size.

const SPACE = { left: 46, right: 12, top: 24, bottom: 40 };

export class Chart {
  /** `log` takes a logarithmic vertical axis; values below its range are drawn at its foot. */
  constructor(svg, { log = false, onTime = null } = {}) {
    Object.assign(this, { svg, log, data: null });
    if (onTime) this.scrub(onTime);
    new ResizeObserver(() => this.draw()).observe(svg);
  }

  /** Takes `{ x: [from, to], y: [from, to], labels: [x, y], series: [{ name, points }], mark: [x, text], about }`. */
  show(data) {
    this.data = data;
    this.draw();
  }

  draw() {
    const { svg, data } = this;
    const [width, height] = [svg.clientWidth, svg.clientHeight];
    if (!data || width < 60) return;
    this.plane(width, height);
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("aria-label", data.about);
    svg.replaceChildren(...this.axes(width, height));
    const [mark, text] = data.mark;
    this.vertical(mark, "mark");
    this.svg.append(label(this.x(mark), SPACE.top - 5, "middle", text));
    for (const { name, points } of data.series) {
      const path = points.filter(([, y]) => Number.isFinite(y)).map(([x, y]) => `${this.x(x)},${this.y(y)}`);
      if (path.length > 0) this.add("path", { class: `curve ${name}`, d: `M${path.join("L")}` });
    }
    for (const { name, at: [x, y] } of data.dots ?? []) {
      if (Number.isFinite(y)) this.add("circle", { class: `dot ${name}`, cx: this.x(x), cy: this.y(y), r: 4.5 });
    }
    this.line = this.vertical(data.x[0], "cursor");
    this.at(this.time ?? null);
  }

  /** Moves the cursor; `null` hides it. */
  at(time) {
    this.time = time;
    if (!this.line) return;
    this.line.style.display = time === null ? "none" : "";
    if (time !== null) for (const end of ["x1", "x2"]) this.line.setAttribute(end, this.x(time));
  }

  plane(width, height) {
    const { x, y } = this.data;
    const [right, foot] = [width - SPACE.right, height - SPACE.bottom];
    const map = this.log ? (value) => Math.log10(Math.max(value, y[0])) : (value) => value;
    const [low, high] = y.map(map);
    this.x = (value) => round(SPACE.left + ((value - x[0]) / (x[1] - x[0])) * (right - SPACE.left));
    this.y = (value) => round(foot - ((map(value) - low) / (high - low)) * (foot - SPACE.top));
    this.invert = (pixel) => x[0] + ((pixel - SPACE.left) / (right - SPACE.left)) * (x[1] - x[0]);
  }

  axes(width, height) {
    const { x, y } = this.data;
    const [right, foot] = [width - SPACE.right, height - SPACE.bottom];
    const parts = [];
    const rows = this.log ? decades(...y) : ticks(...y, 5);
    for (const value of rows) {
      const at = this.y(value);
      parts.push(node("line", { class: "grid", x1: SPACE.left, x2: right, y1: at, y2: at }));
      parts.push(label(SPACE.left - 6, at + 4, "end", number(value)));
    }
    for (const value of ticks(...x, Math.max(4, Math.floor(width / 60)))) {
      parts.push(node("line", { class: "axis", x1: this.x(value), x2: this.x(value), y1: foot, y2: foot + 4 }));
      parts.push(label(this.x(value), foot + 17, "middle", number(value)));
    }
    parts.push(node("line", { class: "axis", x1: SPACE.left, x2: right, y1: foot, y2: foot }));
    const [across, up] = this.data.labels;
    parts.push(label(right, height - 4, "end", across), label(4, 12, "start", up));
    return parts;
  }

  vertical(value, kind) {
    const x = this.x(value);
    return this.add("line", {
      class: kind, x1: x, x2: x, y1: SPACE.top, y2: this.svg.clientHeight - SPACE.bottom,
    });
  }

  add(name, attributes) {
    const element = node(name, attributes);
    this.svg.append(element);
    return element;
  }

  /** Hands the time under the pointer over while it is pressed. */
  scrub(onTime) {
    const move = (event) => {
      if (!this.data || event.buttons !== 1) return;
      const time = this.invert(event.clientX - this.svg.getBoundingClientRect().left);
      onTime(Math.min(this.data.x[1], Math.max(this.data.x[0], time)));
    };
    this.svg.addEventListener("pointerdown", move);
    this.svg.addEventListener("pointermove", move);
  }
}

function node(name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

/** Returns the text of a tick. */
function number(value) {
  return String(Number(value.toPrecision(6))).replace("-", "\u2212");
}

function label(x, y, anchor, text) {
  const element = node("text", { x, y, "text-anchor": anchor });
  element.textContent = text;
  return element;
}

function round(pixels) {
  return Math.round(pixels * 100) / 100;
}

/** Returns round numbers from `low` to `high`, about `count` of them. */
export function ticks(low, high, count) {
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999);
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k <= high / step + 1e-9; k++) found.push(k * step);
  return found;
}

function decades(low, high) {
  const found = [];
  for (let k = Math.round(Math.log10(low)); k <= Math.round(Math.log10(high)); k++) found.push(10 ** k);
  return found;
}

/** Returns a range that holds zero and the values, with a little room. */
export function range(values) {
  const [low, high] = [Math.min(0, ...values), Math.max(0, ...values)];
  const room = 0.06 * (high - low || 1);
  return [low < 0 ? low - room : 0, high > 0 ? high + room : 0];
}
