// The core, compiled to WebAssembly. The names of the calls are those of playground/src/lib.rs.

/** Columns of a run's table, as `stillbeam-sim run` writes them. */
export const COLUMNS = [
  "t_s", "hub_angle_rad", "hub_rate_rad_s", "hub_accel_rad_s2", "tip_x_m", "tip_y_m", "deflection_m", "torque_nm",
];

/** Numbers of a row: the columns and two modal coordinates. */
const WIDTH = COLUMNS.length + 2;

/** Points of the arm's centreline. */
const POINTS = 49;

export class Core {
  /** Compiles the module that stands in the page as base64. */
  static async load(base64) {
    const bytes = Uint8Array.from(atob(base64.trim()), (letter) => letter.charCodeAt(0));
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Core(instance.exports);
  }

  constructor(calls) {
    this.calls = calls;
  }

  /** Returns `count` numbers of the module's memory. They change with the next call. */
  numbers(address, count) {
    return new Float64Array(this.calls.memory.buffer, address, count);
  }

  text() {
    const bytes = new Uint8Array(this.calls.memory.buffer, this.calls.text(), this.calls.text_length());
    return new TextDecoder().decode(bytes);
  }

  materials() {
    const names = [];
    while (this.calls.material(names.length)) names.push(this.text());
    return names;
  }

  /** Sets an arm and its move up. Returns what is known of the arm, or the reason why it is refused. */
  setUp(input) {
    this.numbers(this.calls.input(), input.length).set(input);
    if (!this.calls.set_up()) return { refusal: this.text() };
    const [mass, stiffness, first, second, beta, frequency, ratio, rest] = this.numbers(this.calls.facts(), 8);
    return { mass, stiffness, first, second, beta, frequency, ratio, rest };
  }

  /** Runs a motion. Returns its table, or the reason why it is refused. */
  run(kind, error) {
    const count = this.calls.run(kind, error);
    if (count === 0) return { refusal: this.text() };
    return new Run(this.numbers(this.calls.rows(kind), count * WIDTH).slice(), {
      arrival: this.calls.arrival(kind),
      duration: this.calls.duration(kind),
      residual: this.calls.residual(kind, error),
    });
  }

  residual(kind, error) {
    return this.calls.residual(kind, error);
  }

  stiffness(error) {
    return this.calls.stiffness(error);
  }

  /** Returns the centreline for modal coordinates: x and y in turn, in the hub's frame, m. */
  shape(first, second) {
    return this.numbers(this.calls.shape(first, second), 2 * POINTS);
  }
}

/** A run's table, and what it says. */
export class Run {
  constructor(table, about) {
    Object.assign(this, about);
    this.table = table;
    this.count = table.length / WIDTH;
  }

  at(row, column) {
    return this.table[row * WIDTH + column];
  }

  /** Returns time and value of every row of a column. */
  curve(column, scale = 1) {
    return Array.from({ length: this.count }, (_, row) => [this.at(row, 0), scale * this.at(row, column)]);
  }

  /** Returns the largest magnitude in a column. */
  peak(column) {
    let most = 0;
    for (let row = 0; row < this.count; row++) most = Math.max(most, Math.abs(this.at(row, column)));
    return most;
  }

  end() {
    return this.at(this.count - 1, 0);
  }

  /** Returns hub angle and modal coordinates at a time, in straight lines between the rows. */
  pose(time, tick) {
    const ticks = Math.min(Math.max(time / tick, 0), this.count - 1);
    const row = Math.min(Math.floor(ticks), this.count - 2);
    const part = ticks - row;
    const mix = (column) => this.at(row, column) + part * (this.at(row + 1, column) - this.at(row, column));
    return { angle: mix(1), modes: [mix(8), mix(9)] };
  }

  /** Returns the table as CSV, nine digits a number. */
  csv() {
    const lines = [COLUMNS.join(",")];
    for (let row = 0; row < this.count; row++) {
      const cells = COLUMNS.map((_, column) => Number(this.at(row, column).toPrecision(column === 0 ? 12 : 9)));
      lines.push(cells.join(","));
    }
    return `${lines.join("\n")}\n`;
  }
}
