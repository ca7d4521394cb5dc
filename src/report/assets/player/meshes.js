// Shapes as triangles (triangles.js): sections along a spine, bodies of unit size, blades.

/**
 * The body below a contour, along a spine: at each of its places the contour is as much higher, but no higher than the stock.
 * @param {Point[]} contour from left to right
 * @param {[number, number][]} spine places along y, each with its rise
 * @param {number} top
 */
function swept(contour, spine, top) {
  const mesh = new Triangles();
  const at = (/** @type {Point} */ { x, z }, /** @type {[number, number]} */ [y, rise]) =>
    /** @type {Vector} */ ([x, y, Math.min(z + rise, top)]);
  const foot = (/** @type {Point} */ { x }, /** @type {[number, number]} */ [y]) => /** @type {Vector} */ ([x, y, 0]);
  const [front, back] = [spine[0], last(spine)];
  for (let k = 1; k < spine.length; k += 1) {
    const [from, to] = [spine[k - 1], spine[k]];
    const slope = (to[1] - from[1]) / (to[0] - from[0]);
    for (let i = 1; i < contour.length; i += 1) {
      const [a, b] = [contour[i - 1], contour[i]];
      const along = b.x - a.x;
      mesh.quad([at(a, from), at(b, from), at(b, to), at(a, to)], [a.z - b.z, -slope * along, along]);
    }
    for (const [end, side] of /** @type {[Point, number][]} */ ([[contour[0], -1], [last(contour), 1]])) {
      mesh.quad([foot(end, from), at(end, from), at(end, to), foot(end, to)], [side, 0, 0]);
    }
  }
  for (let i = 1; i < contour.length; i += 1) {
    const [a, b] = [contour[i - 1], contour[i]];
    mesh.quad([foot(a, front), foot(b, front), at(b, front), at(a, front)], [0, -1, 0]);
    mesh.quad([foot(a, back), foot(b, back), at(b, back), at(a, back)], [0, 1, 0]);
  }
  const [first, end] = [contour[0], last(contour)];
  mesh.quad([foot(first, front), foot(end, front), foot(end, back), foot(first, back)], [0, 0, -1]);
  return mesh.done();
}

/** A box from the origin to (1, 1, 1). */
function unitBox() {
  const mesh = new Triangles();
  for (let axis = 0; axis < 3; axis += 1) {
    for (const side of [0, 1]) {
      const corner = (/** @type {number} */ u, /** @type {number} */ v) => {
        const at = [0, 0, 0];
        at[axis] = side;
        at[(axis + 1) % 3] = u;
        at[(axis + 2) % 3] = v;
        return /** @type {Vector} */ (at);
      };
      const normal = /** @type {Vector} */ ([0, 0, 0]);
      normal[axis] = side * 2 - 1;
      mesh.quad([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)], normal);
    }
  }
  return mesh.done();
}

/** How many sides round shapes have. */
const ROUND = 24;

/** A tube of radius 1 about z from 0 to 1, open. */
function unitTube() {
  const mesh = new Triangles();
  for (let i = 0; i < ROUND; i += 1) {
    const [a, b] = [onCircle(i), onCircle(i + 1)];
    for (const [at, z] of /** @type {[number[], number][]} */ ([[a, 0], [b, 0], [b, 1], [a, 0], [b, 1], [a, 1]])) {
      mesh.corner([at[0], at[1], z], [at[0], at[1], 0]);
    }
  }
  return mesh.done();
}

/** A ball of radius 1. */
function unitBall() {
  const mesh = new Triangles();
  const half = ROUND / 2;
  const at = (/** @type {number} */ ring, /** @type {number} */ i) => {
    const [sine, height] = [Math.sin((Math.PI * ring) / half), Math.cos((Math.PI * ring) / half)];
    const [x, y] = onCircle(i);
    return /** @type {Vector} */ ([x * sine, y * sine, height]);
  };
  for (let ring = 0; ring < half; ring += 1) {
    for (let i = 0; i < ROUND; i += 1) {
      const [a, b, c, d] = [at(ring, i), at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i)];
      for (const corner of [a, b, c, a, c, d]) mesh.corner(corner, corner);
    }
  }
  return mesh.done();
}

/** @param {number} i */
function onCircle(i) {
  const angle = (2 * Math.PI * i) / ROUND;
  return [Math.cos(angle), Math.sin(angle)];
}

/**
 * A straight blade, or one that spins.
 * @typedef {[number, number][]} Stages heights above the tip at which stages begin, and their radii
 * @typedef {{length: number, halfApex: number, thickness: number, edges: 1 | 2, body?: Stages}} Dagger
 * @typedef {{radius: number, height: number, body?: Stages}} Drum
 * @typedef {Dagger | Drum} Blade
 */

/**
 * A blade in its own frame: tip at the origin, body towards -z.
 * @param {Blade} blade
 * @param {number} shank where the shank begins, as z
 */
function bladeMesh(blade, shank) {
  return "radius" in blade ? drum(blade) : dagger(blade, shank);
}

/**
 * A disc or a crusher: its edge at z = 0.
 * @param {Drum} blade
 */
function drum({ radius, height }) {
  const mesh = new Triangles();
  const at = (/** @type {number} */ i, /** @type {number} */ z) => {
    const [x, y] = onCircle(i);
    return /** @type {Vector} */ ([x * radius, y * radius, z]);
  };
  for (let i = 0; i < ROUND; i += 1) {
    for (const z of [0, -height]) mesh.triangle([0, 0, z], at(i, z), at(i + 1, z));
    mesh.triangle(at(i, 0), at(i + 1, 0), at(i + 1, -height));
    mesh.triangle(at(i, 0), at(i + 1, -height), at(i, -height));
  }
  return mesh.done();
}

/**
 * A dagger in its own frame: tip at the origin, body towards -z, edges along x, thin along y.
 * @param {Dagger} blade
 * @param {number} shank where the shank begins, as z
 */
function dagger(blade, shank) {
  const mesh = new Triangles();
  const { half, back, top } = daggerSize(blade);
  const thick = Math.max(blade.thickness, blade.length * 0.012) / 2;
  const outline = [[0, 0], [half, top], [half, shank], [back, shank], [back, top]];
  // The middle of the tip end is thin, so that the two sides of a V do not overlap there.
  const side = (/** @type {number[]} */ [x, z], /** @type {number} */ y) => /** @type {Vector} */ ([x, y * (z === 0 ? 0 : 1), z]);
  for (const y of [thick, -thick]) {
    for (let i = 2; i < outline.length; i += 1) {
      mesh.triangle(side(outline[0], y), side(outline[i - 1], y), side(outline[i], y));
    }
  }
  outline.forEach((from, i) => {
    const to = outline[(i + 1) % outline.length];
    mesh.triangle(side(from, thick), side(to, thick), side(to, -thick));
    mesh.triangle(side(from, thick), side(to, -thick), side(from, -thick));
  });
  return mesh.done();
}

/**
 * The leading edge's end, the back's x and the edge's end as z of a dagger.
 * @param {Dagger} blade
 */
function daggerSize({ length, halfApex, edges }) {
  const half = Math.max(length * Math.sin(halfApex), length * 0.05);
  return { half, back: edges === 2 ? -half : 0, top: -length * Math.cos(halfApex) };
}

