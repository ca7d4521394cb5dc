// The surface of the part as the page has it (src/report/space.rs): heights at the corners of cells, and the numbers of maps.

/** The number of a place that has no value. */
const NONE = 0xffff;

/** How many places of a ray are looked at within the width of a cell. */
const LOOKS = 3;

/**
 * @typedef {object} PlanMap
 * @property {string} what
 * @property {string} unit
 * @property {string} figures least, mean and greatest value, in words
 * @property {string | null} limit
 * @property {number | null} decimals null where classes have no order of size
 * @property {[string, string][]} classes colour and words of each, from the least values on
 * @property {(cell: number) => number | null} classOf
 * @property {(cell: number) => number | null} valueOf
 */

class Relief {
  /** @param {any} raw */
  constructor(raw) {
    /** @type {Vector} */
    this.size = raw.size;
    [this.columns, this.rows] = raw.cells;
    this.pitch = [this.size[0] / this.columns, this.size[1] / this.rows];
    const { low, step, values } = raw.heights;
    const numbers = new Uint16Array(bytesOf(values));
    this.heights = Float32Array.from(numbers, (number) => (number === NONE ? NaN : low + step * number));
    this.highest = this.heights.reduce((most, height) => (height > most ? height : most), 0);
    /** @type {PlanMap[]} */
    this.maps = raw.maps.map((/** @type {any} */ map) => unpackMap(map, raw.parts));
  }

  /**
   * The number of a corner.
   * @param {number} column
   * @param {number} row
   */
  corner(column, row) {
    return row * (this.columns + 1) + column;
  }

  /**
   * A corner in space.
   * @param {number} column
   * @param {number} row
   * @returns {Vector}
   */
  place(column, row) {
    return [column * this.pitch[0], row * this.pitch[1], this.heights[this.corner(column, row)]];
  }

  /**
   * The normal at a corner, from the corners beside it.
   * @param {number} column
   * @param {number} row
   * @returns {Vector}
   */
  normal(column, row) {
    const slope = (/** @type {Vector} */ before, /** @type {Vector} */ after, /** @type {number} */ axis) => {
      const rise = (after[2] - before[2]) / (after[axis] - before[axis]);
      return Number.isFinite(rise) ? rise : 0;
    };
    const [left, right] = [Math.max(0, column - 1), Math.min(this.columns, column + 1)];
    const [front, back] = [Math.max(0, row - 1), Math.min(this.rows, row + 1)];
    return [
      -slope(this.place(left, row), this.place(right, row), 0),
      -slope(this.place(column, front), this.place(column, back), 1),
      1,
    ];
  }

  /**
   * The faces of all cells, those of each class of a map together; at the end those without a value. A cell that lacks a corner has none.
   * @param {PlanMap} map
   * @returns {Float32Array[]}
   */
  faces(map) {
    const meshes = Array.from({ length: map.classes.length + 1 }, () => new Triangles());
    for (let row = 0; row < this.rows; row += 1) {
      for (let column = 0; column < this.columns; column += 1) {
        const corners = [[0, 0], [1, 0], [1, 1], [0, 1]].map(([right, back]) => [column + right, row + back]);
        if (corners.some(([column, row]) => Number.isNaN(this.heights[this.corner(column, row)]))) continue;
        const mesh = meshes[map.classOf(row * this.columns + column) ?? map.classes.length];
        for (const at of [0, 1, 2, 0, 2, 3]) {
          const [column, row] = corners[at];
          mesh.corner(this.place(column, row), this.normal(column, row));
        }
      }
    }
    return meshes.map((mesh) => mesh.done());
  }

  /** The sides of the part and its bottom. */
  sides() {
    const mesh = new Triangles();
    const wall = (/** @type {Vector} */ a, /** @type {Vector} */ b, /** @type {Vector} */ normal) => {
      if (Number.isNaN(a[2] + b[2])) return;
      mesh.quad([[a[0], a[1], 0], [b[0], b[1], 0], b, a], normal);
    };
    for (let column = 0; column < this.columns; column += 1) {
      wall(this.place(column, 0), this.place(column + 1, 0), [0, -1, 0]);
      wall(this.place(column, this.rows), this.place(column + 1, this.rows), [0, 1, 0]);
    }
    for (let row = 0; row < this.rows; row += 1) {
      wall(this.place(0, row), this.place(0, row + 1), [-1, 0, 0]);
      wall(this.place(this.columns, row), this.place(this.columns, row + 1), [1, 0, 0]);
    }
    const [width, depth] = this.size;
    mesh.quad([[0, 0, 0], [width, 0, 0], [width, depth, 0], [0, depth, 0]], [0, 0, -1]);
    return mesh.done();
  }

  /**
   * The height over a place of the plan, between those of the corners around it.
   * @param {number} x
   * @param {number} y
   */
  heightAt(x, y) {
    const [u, v] = [x / this.pitch[0], y / this.pitch[1]];
    const [column, row] = this.cellAt(x, y);
    const [right, back] = [u - column, v - row];
    const [a, b, c, d] = [[0, 0], [1, 0], [0, 1], [1, 1]].map(([i, j]) => this.heights[this.corner(column + i, row + j)]);
    return (a * (1 - right) + b * right) * (1 - back) + (c * (1 - right) + d * right) * back;
  }

  /**
   * The cell over a place of the plan, by column and row.
   * @param {number} x
   * @param {number} y
   */
  cellAt(x, y) {
    const within = (/** @type {number} */ at, /** @type {number} */ count) => Math.max(0, Math.min(count - 1, Math.floor(at)));
    return [within(x / this.pitch[0], this.columns), within(y / this.pitch[1], this.rows)];
  }

  /**
   * Where a ray meets the surface from above; null where it meets a side first, or nothing.
   * @param {Vector} from
   * @param {Vector} along
   * @returns {Vector | null}
   */
  met(from, along) {
    const range = this.within(from, along);
    if (range === null) return null;
    const at = (/** @type {number} */ t) => /** @type {Vector} */ (from.map((part, i) => part + along[i] * t));
    const isBelow = (/** @type {Vector} */ [x, y, z]) => z <= this.heightAt(x, y);
    const count = LOOKS * (this.columns + this.rows);
    if (isBelow(at(range[0]))) return null;
    for (let look = 1; look <= count; look += 1) {
      let [above, below] = [look - 1, look].map((step) => range[0] + ((range[1] - range[0]) * step) / count);
      if (!isBelow(at(below))) continue;
      for (let half = 0; half < 20; half += 1) {
        const middle = (above + below) / 2;
        if (isBelow(at(middle))) below = middle;
        else above = middle;
      }
      return at(below);
    }
    return null;
  }

  /**
   * From where to where along a ray it is within the box of the part, which goes down to the bottom of the stock.
   * @param {Vector} from
   * @param {Vector} along
   * @returns {[number, number] | null}
   */
  within(from, along) {
    const high = [this.size[0], this.size[1], this.highest + 1e-3];
    let [first, end] = [0, Infinity];
    for (const axis of [0, 1, 2]) {
      const [a, b] = [-from[axis] / along[axis], (high[axis] - from[axis]) / along[axis]];
      [first, end] = [Math.max(first, Math.min(a, b)), Math.min(end, Math.max(a, b))];
    }
    return first < end ? [first, end] : null;
  }
}

/**
 * @param {any} raw
 * @param {number} parts into how many parts a class is divided
 * @returns {PlanMap}
 */
function unpackMap(raw, parts) {
  const numbers = new Uint16Array(bytesOf(raw.values));
  const { what, unit, figures, limit, decimals, classes } = raw;
  return {
    what, unit, figures, limit, decimals, classes,
    classOf: (cell) => (numbers[cell] === NONE ? null : Math.floor(numbers[cell] / parts)),
    valueOf: (cell) => (numbers[cell] === NONE ? null : raw.from + (raw.step * numbers[cell]) / parts),
  };
}
