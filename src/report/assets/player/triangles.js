// Triangles: place and normal of every corner, six numbers. And lines: place and colour of every end.

/** Triangles under construction. */
class Triangles {
  constructor() {
    this.numbers = new Float32Array(1 << 12);
    this.count = 0;
  }

  /**
   * A quad a, b, c, d, flat.
   * @param {Vector[]} corners
   * @param {Vector} normal
   */
  quad([a, b, c, d], normal) {
    for (const corner of [a, b, c, a, c, d]) this.corner(corner, normal);
  }

  /**
   * @param {Vector} a
   * @param {Vector} b
   * @param {Vector} c
   */
  triangle(a, b, c) {
    const normal = /** @type {Vector} */ (cross(minus(b, a), minus(c, a)));
    for (const corner of [a, b, c]) this.corner(corner, normal);
  }

  /**
   * @param {Vector} at
   * @param {Vector} normal
   */
  corner(at, normal) {
    if (this.count + 6 > this.numbers.length) {
      const more = new Float32Array(this.numbers.length * 2);
      more.set(this.numbers);
      this.numbers = more;
    }
    const { numbers, count } = this;
    numbers[count] = at[0];
    numbers[count + 1] = at[1];
    numbers[count + 2] = at[2];
    numbers[count + 3] = normal[0];
    numbers[count + 4] = normal[1];
    numbers[count + 5] = normal[2];
    this.count += 6;
  }

  done() {
    return this.numbers.subarray(0, this.count);
  }
}

/** Colours of x, y and z. */
const AXES = [
  [0.85, 0.15, 0.15],
  [0.1, 0.6, 0.15],
  [0.15, 0.3, 0.9],
];

/** Lines from the origin along x, y and z, of length 1. */
function triad() {
  const ends = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  return new Float32Array(ends.flatMap((end, i) => [0, 0, 0, ...AXES[i], ...end, ...AXES[i]]));
}
