// The heights of the stock over the plan, where tools clear regions of it: what stands after a round tool has passed, in cells.

/** How many cells the longer side of the stock has. */
const CELLS = 320;

/** Steps of a tool's way, in cells. */
const STEP = 0.5;

/** How many ways of tools lie between two states that are kept. */
const BETWEEN_GROUNDS = 400;

class Ground {
  /** @param {Timeline} timeline */
  constructor(timeline) {
    this.timeline = timeline;
    const [width, depth, height] = timeline.program.stock;
    this.size = Math.max(width, depth) / CELLS;
    this.columns = Math.max(1, Math.round(width / this.size));
    this.rows = Math.max(1, Math.round(depth / this.size));
    this.cell = [width / this.columns, depth / this.rows];
    this.heights = new Float32Array(this.columns * this.rows).fill(height);
    /** @type {number[]} ops that clear ground */
    this.ways = [];
    for (let op = 1; op < timeline.program.ops; op += 1) if (timeline.clears(op)) this.ways.push(op);
    this.passed = 0;
    this.done = 0;
    this.kept = [this.heights.slice()];
  }

  /**
   * Goes to a moment. Tells whether anything changed.
   * @param {Moment} moment
   */
  goTo({ op, done }) {
    const count = countWhile(this.ways, (way) => way < op);
    const share = this.ways[count] === op ? done : 0;
    if (count === this.passed && share === this.done) return false;
    const kept = Math.min(Math.floor(count / BETWEEN_GROUNDS), this.kept.length - 1);
    const isBack = count < this.passed || (count === this.passed && share < this.done);
    if (isBack || kept * BETWEEN_GROUNDS > this.passed) {
      this.heights.set(this.kept[kept]);
      this.passed = kept * BETWEEN_GROUNDS;
      this.done = 0;
    }
    while (this.passed < count) {
      this.pass(this.ways[this.passed], this.done, 1);
      this.passed += 1;
      this.done = 0;
      if (this.passed === this.kept.length * BETWEEN_GROUNDS) this.kept.push(this.heights.slice());
    }
    if (share > this.done) this.pass(this.ways[count], this.done, share);
    this.done = share;
    return true;
  }

  /**
   * Takes off what the tool passes on a part of an op.
   * @param {number} op
   * @param {number} from
   * @param {number} to
   */
  pass(op, from, to) {
    const { timeline } = this;
    const blade = timeline.program.blades[timeline.toolAt(op)];
    const radius = "radius" in blade ? blade.radius : 0;
    const steps = Math.max(1, Math.ceil((timeline.lengthOf(op) * (to - from)) / (this.size * STEP)));
    for (let step = 0; step <= steps; step += 1) {
      this.lower(timeline.tipAt(op, from + ((to - from) * step) / steps), radius);
    }
  }

  /**
   * @param {Vector} tip
   * @param {number} radius
   */
  lower([x, y, z], radius) {
    const [wide, deep] = this.cell;
    const first = Math.max(0, Math.ceil((y - radius) / deep - 0.5));
    const end = Math.min(this.rows - 1, Math.floor((y + radius) / deep - 0.5));
    for (let row = first; row <= end; row += 1) {
      const off = (row + 0.5) * deep - y;
      const half = Math.sqrt(Math.max(0, radius * radius - off * off));
      const low = Math.max(0, Math.ceil((x - half) / wide - 0.5));
      const high = Math.min(this.columns - 1, Math.floor((x + half) / wide - 0.5));
      for (let at = row * this.columns + low; at <= row * this.columns + high; at += 1) {
        if (this.heights[at] > z) this.heights[at] = z;
      }
    }
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  heightAt(x, y) {
    const [column, row] = [x / this.cell[0], y / this.cell[1]].map(Math.floor);
    return this.heights[Math.min(row, this.rows - 1) * this.columns + Math.min(column, this.columns - 1)];
  }

  /**
   * The stock below its section and below the cells: flat cells, walls between them, and the sides of the stock.
   * @param {Surface} surface
   */
  mesh(surface) {
    const { columns, rows, heights } = this;
    const [wide, deep] = this.cell;
    const mesh = new Triangles();
    // The section over both ends of each column: where no tool has been the stock is as high.
    const tops = Array.from({ length: columns }, (_, column) => [surface.sides(column * wide)[1], surface.sides((column + 1) * wide)[0]]);
    /** @returns {[number, number]} heights at both ends of a cell */
    const ends = (/** @type {number} */ row, /** @type {number} */ column) => {
      const height = heights[row * columns + column];
      return [Math.min(height, tops[column][0]), Math.min(height, tops[column][1])];
    };
    for (let row = 0; row < rows; row += 1) {
      const [front, back] = [row * deep, (row + 1) * deep];
      let begin = 0;
      for (let column = 0; column < columns; column += 1) {
        const [left, right] = ends(row, column);
        const next = column + 1 < columns ? ends(row, column + 1) : [0, 0];
        const [x, after] = [begin * wide, (column + 1) * wide];
        const isFlat = left === right && next[0] === right && next[1] === right;
        if (!isFlat || column + 1 === columns) {
          const [from] = ends(row, begin);
          mesh.quad([[x, front, from], [after, front, right], [after, back, right], [x, back, from]], [from - right, 0, after - x]);
          begin = column + 1;
        }
        if (next[0] !== right) mesh.quad([[after, front, right], [after, front, next[0]], [after, back, next[0]], [after, back, right]], [1, 0, 0]);
        if (column === 0) mesh.quad([[0, front, 0], [0, front, left], [0, back, left], [0, back, 0]], [-1, 0, 0]);
      }
    }
    for (let row = 0; row <= rows; row += 1) this.across(mesh, row, ends);
    const [width, depth] = [columns * wide, rows * deep];
    mesh.quad([[0, 0, 0], [width, 0, 0], [width, depth, 0], [0, depth, 0]], [0, 0, -1]);
    return mesh.done();
  }

  /**
   * Walls between a row of cells and the one before it; beside the first and the last one the sides of the stock.
   * @param {Triangles} mesh
   * @param {number} row
   * @param {(row: number, column: number) => [number, number]} ends
   */
  across(mesh, row, ends) {
    const { columns, rows } = this;
    const [wide, deep] = this.cell;
    const y = row * deep;
    const none = /** @type {[number, number]} */ ([0, 0]);
    for (let column = 0; column < columns; column += 1) {
      const here = row < rows ? ends(row, column) : none;
      const before = row > 0 ? ends(row - 1, column) : none;
      if (here[0] === before[0] && here[1] === before[1]) continue;
      const [x, after] = [column * wide, (column + 1) * wide];
      mesh.quad([[x, y, before[0]], [after, y, before[1]], [after, y, here[1]], [x, y, here[0]]], [0, row === 0 ? -1 : 1, 0]);
    }
  }
}
