// The machined surface by its exact corners: src/process/sim/surface.rs over again, so that what is seen is what was proven.

/** Heights this close are equal, in mm, as in the proof. */
const TOUCH = 1e-6;

/** @typedef {{x: number, z: number}} Point */
/** @typedef {{tip: Point, slope: number}} Vee */

/**
 * Height of a V over x.
 * @param {Vee} vee
 * @param {number} x
 */
function heightOf(vee, x) {
  return vee.tip.z + Math.abs(x - vee.tip.x) * vee.slope;
}

/** Corners in two stacks with the place of work between them, nearest last in both. */
class Surface {
  /**
   * The flat top of a stock.
   * @param {number} width
   * @param {number} top
   */
  constructor(width, top) {
    /** @type {Point[]} */
    this.left = [{ x: 0, z: top }];
    /** @type {Point[]} */
    this.right = [{ x: width, z: top }];
    this.top = top;
  }

  /** The same surface by itself. Corners are never changed, so they are shared. */
  clone() {
    const copy = new Surface(0, this.top);
    copy.left = this.left.slice();
    copy.right = this.right.slice();
    return copy;
  }

  /** The corners from left to right. */
  corners() {
    return this.left.concat(this.right.slice().reverse());
  }

  /**
   * Takes the chip of a V out; a V whose tip is not covered changes nothing.
   * @param {Vee} vee
   */
  release(vee) {
    if (!this.covers(vee.tip)) return;
    const left = this.walk(vee, this.left);
    const right = this.walk(vee, this.right);
    this.left.length -= left.passed;
    this.right.length -= right.passed;
    pushCorner(this.left, left.exit);
    pushCorner(this.left, vee.tip);
    if (right.exit.x - vee.tip.x > TOUCH) pushCorner(this.right, right.exit);
  }

  /**
   * Lowers a stretch to what lies below a chip. Where its ends lie below the surface, walls stay: two corners at one x.
   * @param {Point[]} floor from left to right
   */
  lower(floor) {
    const [first, end] = [floor[0], last(floor)];
    if (end.x - first.x <= TOUCH) return;
    const [before] = this.sides(first.x);
    const [, after] = this.sides(end.x);
    this.goTo(first.x - TOUCH);
    while (this.right.length > 0 && last(this.right).x <= end.x + TOUCH) this.right.pop();
    // Beside the stock nothing stands.
    if (this.left.length > 0) pushDistinct(this.left, { x: first.x, z: before });
    for (const corner of floor) pushDistinct(this.left, corner);
    if (this.right.length > 0 && Math.abs(after - end.z) > TOUCH) this.right.push({ x: end.x, z: after });
  }

  /**
   * The heights just left and just right of x, which differ at a wall.
   * @param {number} x
   * @returns {[number, number]}
   */
  sides(x) {
    this.goTo(x + TOUCH);
    let at = this.left.length - 1;
    if (at < 0 || last(this.left).x < x - TOUCH) {
      const height = this.heightHere(x);
      return [height, height];
    }
    while (at > 0 && this.left[at - 1].x >= x - TOUCH) at -= 1;
    return [this.left[at].z, last(this.left).z];
  }

  /**
   * Whether a V with this tip would cut anything at its tip.
   * @param {Point} tip
   */
  covers(tip) {
    this.goTo(tip.x);
    return this.heightHere(tip.x) > tip.z + TOUCH;
  }

  /**
   * Where a flank of a V comes out of the present surface.
   * @param {Vee} vee
   * @param {"left" | "right"} side
   * @returns {Point}
   */
  exit(vee, side) {
    if (!this.covers(vee.tip)) return vee.tip;
    return this.walk(vee, side === "left" ? this.left : this.right).exit;
  }

  /**
   * Moves the place of work to x.
   * @param {number} x
   */
  goTo(x) {
    while (this.left.length > 0 && last(this.left).x > x) this.right.push(this.left.pop());
    while (this.right.length > 0 && last(this.right).x <= x) this.left.push(this.right.pop());
  }

  /**
   * Follows a flank from the place of work to where it comes out.
   * @param {Vee} vee
   * @param {Point[]} stack
   */
  walk(vee, stack) {
    let before = { x: vee.tip.x, z: this.heightHere(vee.tip.x) };
    for (let passed = 0; passed < stack.length; passed += 1) {
      const corner = stack[stack.length - 1 - passed];
      const above = corner.z - heightOf(vee, corner.x);
      if (above > TOUCH) {
        before = corner;
        continue;
      }
      const aboveBefore = before.z - heightOf(vee, before.x);
      const share = above >= -TOUCH ? 1 : aboveBefore / (aboveBefore - above);
      const x = before.x + (corner.x - before.x) * share;
      return { passed, exit: { x, z: heightOf(vee, x) } };
    }
    return { passed: stack.length, exit: { x: before.x, z: heightOf(vee, before.x) } };
  }

  /**
   * Height at the place of work.
   * @param {number} x
   */
  heightHere(x) {
    if (this.left.length === 0) return this.right.length === 0 ? this.top : last(this.right).z;
    const a = last(this.left);
    if (this.right.length === 0) return a.z;
    const b = last(this.right);
    return b.x - a.x > TOUCH ? a.z + (b.z - a.z) * ((x - a.x) / (b.x - a.x)) : a.z;
  }
}

/**
 * Pushes a corner unless it is the last one.
 * @param {Point[]} stack
 * @param {Point} corner
 */
function pushDistinct(stack, corner) {
  const top = stack[stack.length - 1];
  if (top === undefined || Math.abs(top.x - corner.x) > TOUCH || Math.abs(top.z - corner.z) > TOUCH) stack.push(corner);
}

/**
 * @template T
 * @param {T[]} list
 * @returns {T}
 */
function last(list) {
  return list[list.length - 1];
}

/**
 * Pushes a corner unless it is the one already there.
 * @param {Point[]} stack
 * @param {Point} corner
 */
function pushCorner(stack, corner) {
  const top = stack.length - 1;
  if (top >= 0 && Math.abs(stack[top].x - corner.x) < TOUCH) {
    stack[top] = { x: stack[top].x, z: Math.min(stack[top].z, corner.z) };
  } else {
    stack.push(corner);
  }
}

