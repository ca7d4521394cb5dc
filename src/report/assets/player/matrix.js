// Rigid motions as matrices of 4 x 4, column by column as WebGL has them, and turns as quaternions [w, x, y, z].

/** @typedef {number[]} Matrix */
/** @typedef {[number, number, number]} Vector */

/** @returns {Matrix} */
function identity() {
  return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
}

/**
 * First `b`, then `a`.
 * @param {Matrix} a
 * @param {Matrix} b
 * @returns {Matrix}
 */
function product(a, b) {
  const out = new Array(16);
  for (let column = 0; column < 16; column += 4) {
    for (let row = 0; row < 4; row += 1) {
      out[column + row] =
        a[row] * b[column] + a[4 + row] * b[column + 1] + a[8 + row] * b[column + 2] + a[12 + row] * b[column + 3];
    }
  }
  return out;
}

/**
 * The way back of a rigid motion.
 * @param {Matrix} m
 * @returns {Matrix}
 */
function inverse(m) {
  const back = [m[0], m[4], m[8], 0, m[1], m[5], m[9], 0, m[2], m[6], m[10], 0, 0, 0, 0, 1];
  const [x, y, z] = turned(back, [m[12], m[13], m[14]]);
  [back[12], back[13], back[14]] = [-x, -y, -z];
  return back;
}

/**
 * A point moved.
 * @param {Matrix} m
 * @param {Vector} p
 * @returns {Vector}
 */
function moved(m, p) {
  const [x, y, z] = turned(m, p);
  return [x + m[12], y + m[13], z + m[14]];
}

/**
 * A direction turned.
 * @param {Matrix} m
 * @param {Vector} p
 * @returns {Vector}
 */
function turned(m, p) {
  return [
    m[0] * p[0] + m[4] * p[1] + m[8] * p[2],
    m[1] * p[0] + m[5] * p[1] + m[9] * p[2],
    m[2] * p[0] + m[6] * p[1] + m[10] * p[2],
  ];
}

/**
 * The place of a matrix's origin.
 * @param {Matrix} m
 * @returns {Vector}
 */
function origin(m) {
  return [m[12], m[13], m[14]];
}

/**
 * @param {Vector} to
 * @returns {Matrix}
 */
function shift(to) {
  const m = identity();
  [m[12], m[13], m[14]] = to;
  return m;
}

/**
 * The turn about a line through a point (Rodrigues).
 * @param {Vector} point
 * @param {Vector} direction of length 1
 * @param {number} angle
 * @returns {Matrix}
 */
function turnAbout(point, direction, angle) {
  const [x, y, z] = direction;
  const [s, c] = [Math.sin(angle), Math.cos(angle)];
  const t = 1 - c;
  const m = [
    t * x * x + c, t * x * y + s * z, t * x * z - s * y, 0,
    t * x * y - s * z, t * y * y + c, t * y * z + s * x, 0,
    t * x * z + s * y, t * y * z - s * x, t * z * z + c, 0,
    0, 0, 0, 1,
  ];
  const away = turned(m, point);
  [m[12], m[13], m[14]] = [point[0] - away[0], point[1] - away[1], point[2] - away[2]];
  return m;
}

/**
 * A pose from a turn and a place.
 * @param {number[]} q
 * @param {Vector} at
 * @returns {Matrix}
 */
function pose(q, at) {
  const [w, x, y, z] = q;
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0,
    2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0,
    2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0,
    at[0], at[1], at[2], 1,
  ];
}

/**
 * The turn a share of the shortest way from one to another, about one fixed axis.
 * @param {number[]} a
 * @param {number[]} b
 * @param {number} share
 */
function between(a, b, share) {
  const along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const sign = along < 0 ? -1 : 1;
  const half = Math.acos(Math.min(1, Math.abs(along)));
  const sine = Math.sin(half);
  const toGo = sine > 1e-9 ? Math.sin(half * (1 - share)) / sine : 1 - share;
  const gone = (sine > 1e-9 ? Math.sin(half * share) / sine : share) * sign;
  const q = a.map((part, i) => part * toGo + b[i] * gone);
  const length = Math.hypot(...q);
  return q.map((part) => part / length);
}

/**
 * @param {Vector} a
 * @param {Vector} b
 * @returns {Vector}
 */
function minus(a, b) {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/**
 * A frame whose z leads from one point to another, x and y being of length `radius`, z of their distance: what brings a bar
 * of unit size where it belongs.
 * @param {Vector} from
 * @param {Vector} to
 * @param {number} radius
 * @returns {Matrix}
 */
function along(from, to, radius) {
  const [dx, dy, dz] = minus(to, from);
  const length = Math.hypot(dx, dy, dz);
  const z = length > 0 ? [dx / length, dy / length, dz / length] : [0, 0, 1];
  const other = Math.abs(z[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const raw = cross(other, z);
  const size = Math.hypot(...raw);
  const x = raw.map((part) => part / size);
  const y = cross(z, x);
  return [
    x[0] * radius, x[1] * radius, x[2] * radius, 0,
    y[0] * radius, y[1] * radius, y[2] * radius, 0,
    dx, dy, dz, 0,
    from[0], from[1], from[2], 1,
  ];
}

/**
 * @param {number[]} a
 * @param {number[]} b
 */
function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/**
 * @param {number[]} a
 * @param {number[]} b
 */
function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/**
 * A box of unit size, its corner at the origin, brought to where it belongs.
 * @param {Vector} low
 * @param {Vector} high
 * @returns {Matrix}
 */
function boxed(low, high) {
  const [x, y, z] = minus(high, low);
  return [x, 0, 0, 0, 0, y, 0, 0, 0, 0, z, 0, low[0], low[1], low[2], 1];
}

/**
 * @param {number} factor
 * @returns {Matrix}
 */
function scaled(factor) {
  return [factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, factor, 0, 0, 0, 0, 1];
}
