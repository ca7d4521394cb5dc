// What happens when: ops, poses, layers, and the cuts that free chips.

/** @typedef {{op: number, done: number}} Moment */
/** @typedef {{op: number, x: number, bottom: number}} Slit */
/** @typedef {{op: number, layer: number, vee: Vee, side: "left" | "right", freedBy: number}} Kerf */

class Timeline {
  /** @param {Program} program */
  constructor(program) {
    this.program = program;
    this.duration = program.starts[program.ops];
    this.findLayers();
    this.findChips();
    this.findCuts();
  }

  /** Numbers the layers of all operations in the order in which they are first worked on, from 1; 0 is none. */
  findLayers() {
    const { ops, operations, layers } = this.program;
    const numbers = new Map();
    this.layerOf = new Uint32Array(ops);
    /** @type {{operation: number, layer: number}[]} */
    this.layers = [];
    for (let op = 0; op < ops; op += 1) {
      if (layers[op] === 0) continue;
      const key = operations[op] * 2 ** 32 + layers[op];
      if (!numbers.has(key)) {
        this.layers.push({ operation: operations[op], layer: layers[op] });
        numbers.set(key, this.layers.length);
      }
      this.layerOf[op] = numbers.get(key);
    }
  }

  /** Pairs the flanks of every V: with the second one its chip comes free, as src/process/sim/prove.rs has it. */
  findChips() {
    const { ops, kinds, cuts } = this.program;
    /** @type {Kerf[]} first flanks in order */
    this.kerfs = [];
    /** @type {{op: number, vee: Vee}[]} */
    this.vees = [];
    /** @type {Slit[]} */
    this.slits = this.program.taken === null ? [] : this.program.taken.slits;
    const slits = new Set(this.slits.map(({ op }) => op));
    const open = new Map();
    for (let op = 0; op < ops; op += 1) {
      if ((kinds[op] !== CUT_LEFT && kinds[op] !== CUT_RIGHT) || slits.has(op)) continue;
      const key = this.layerOf[op] * 2 ** 32 + cuts[op];
      const first = open.get(key);
      if (first === undefined) {
        const kerf = this.kerfOf(op);
        open.set(key, kerf);
        this.kerfs.push(kerf);
      } else {
        open.delete(key);
        first.freedBy = op;
        this.vees.push({ op, vee: this.veeOf(op) });
      }
    }
    /** @type {{op: number, vee?: Vee, floor?: Point[]}[]} */
    this.chips = this.program.taken === null ? this.vees : this.program.taken.chips;
  }

  /** Where cuts begin, in order: first flanks, slits, and passes of discs. */
  findCuts() {
    const { ops, kinds } = this.program;
    /** @type {{op: number, x: number}[]} */
    this.cuts = this.kerfs.map(({ op, vee }) => ({ op, x: vee.tip.x }));
    if (this.program.taken === null && this.program.pockets.size + this.program.walls.size === 0) return;
    this.cuts.push(...this.slits);
    for (let op = 1; op < ops; op += 1) {
      if (kinds[op] === FOLLOW && kinds[op - 1] !== FOLLOW) this.cuts.push({ op, x: tipAfter(this.program, op)[0] });
    }
    this.cuts.sort((a, b) => a.op - b.op);
  }

  /**
   * The blade at hand during an op.
   * @param {number} op
   */
  toolAt(op) {
    const done = countWhile(this.program.changes, ([change]) => change < op);
    return done === 0 ? 0 : this.program.changes[done - 1][1];
  }

  /**
   * The slits that are cut at a time, whether they are still there or not.
   * @param {number} time
   */
  slitsAt(time) {
    return this.slits.slice(0, countWhile(this.slits, ({ op }) => this.endOf(op) <= time));
  }

  /**
   * @param {number} op
   * @returns {Kerf}
   */
  kerfOf(op) {
    const side = this.program.kinds[op] === CUT_LEFT ? "left" : "right";
    return { op, layer: this.layerOf[op], vee: this.veeOf(op), side, freedBy: Infinity };
  }

  /**
   * The V that a cut is a flank of: its slope is that of the shank seen along y.
   * @param {number} op
   * @returns {Vee}
   */
  veeOf(op) {
    const [x, , z] = tipAfter(this.program, op);
    const m = pose(this.program.orientations[this.program.held[op] - 1], [0, 0, 0]);
    return { tip: { x, z }, slope: -m[10] / Math.abs(m[8]) };
  }

  /**
   * The op at a time and how much of it is done. At a border it is the op that begins there.
   * @param {number} time
   * @returns {Moment}
   */
  at(time) {
    const { starts, ops } = this.program;
    const op = Math.max(0, Math.min(countUpTo(starts, time) - 1, ops - 1));
    const length = starts[op + 1] - starts[op];
    return { op, done: length > 0 ? Math.min(1, Math.max(0, (time - starts[op]) / length)) : 1 };
  }

  /** @param {number} op */
  endOf(op) {
    return this.program.starts[op + 1];
  }

  /**
   * How many chips are free at a time.
   * @param {number} time
   */
  chipsFreeAt(time) {
    return countWhile(this.chips, (chip) => this.endOf(chip.op) <= time);
  }

  /**
   * First flanks that are cut at a time while their chips are not free.
   * @param {number} time
   * @returns {Kerf[]}
   */
  kerfsAt(time) {
    const cut = countWhile(this.kerfs, (kerf) => this.endOf(kerf.op) <= time);
    const wanted = cut - countWhile(this.vees, (vee) => this.endOf(vee.op) <= time);
    const found = [];
    for (let i = cut - 1; i >= 0 && found.length < wanted; i -= 1) {
      const kerf = this.kerfs[i];
      if (kerf.freedBy === Infinity || this.endOf(kerf.freedBy) > time) found.push(kerf);
    }
    return found;
  }

  /**
   * The blade in W as the program has it; none while only the axes know.
   * @param {Moment} moment
   * @returns {Matrix | null}
   */
  bladeAt({ op, done }) {
    const { program } = this;
    const { kinds, held, orientations } = program;
    const axesOnly = kinds[op] === HOME || kinds[op] === AXIS_TRAVEL;
    if (held[op] === 0 || (axesOnly && done < 1)) return null;
    const then = orientations[held[op] - 1];
    const to = tipAfter(program, op);
    if (op === 0 || held[op - 1] === 0) return pose(then, to);
    return pose(between(orientations[held[op - 1] - 1], then, done), this.tipAt(op, done));
  }

  /**
   * The tip in W while an op moves it from where the one before it ended, along a line or an arc.
   * @param {number} op
   * @param {number} done
   * @returns {Vector}
   */
  tipAt(op, done) {
    const [from, to] = [tipAfter(this.program, op - 1), tipAfter(this.program, op)];
    const via = this.program.vias.get(op);
    if (via !== undefined) return placeOnArc(arcThrough(from, via, to), done);
    return /** @type {Vector} */ (from.map((part, i) => part + (to[i] - part) * done));
  }

  /**
   * How long the way of the tip is during an op, in mm.
   * @param {number} op
   */
  lengthOf(op) {
    const [from, to] = [tipAfter(this.program, op - 1), tipAfter(this.program, op)];
    const via = this.program.vias.get(op);
    if (via === undefined) return Math.hypot(...minus(to, from));
    const { radius, sweep } = arcThrough(from, via, to);
    return radius * sweep;
  }

  /**
   * Whether a round tool clears ground of a region during an op.
   * @param {number} op
   */
  clears(op) {
    const { program } = this;
    const isRound = "radius" in program.blades[this.toolAt(op)];
    return isRound && program.kinds[op] === FOLLOW && program.pockets.has(program.operations[op]);
  }

  /**
   * The blade in W where only the axes know it and there are none: where it was last, else where it will first be.
   * @param {number} op
   * @returns {Matrix}
   */
  nearestBlade(op) {
    const { held, ops, orientations } = this.program;
    let known = op;
    while (known >= 0 && held[known] === 0) known -= 1;
    if (known < 0) {
      known = op;
      while (known < ops - 1 && held[known] === 0) known += 1;
    }
    const q = held[known] === 0 ? [1, 0, 0, 0] : orientations[held[known] - 1];
    return pose(q, tipAfter(this.program, known));
  }
}

/**
 * How many sorted numbers are not above a value.
 * @param {Float64Array} sorted
 * @param {number} value
 */
function countUpTo(sorted, value) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * How many entries at the beginning of a list a condition holds for that holds for none after them.
 * @template T
 * @param {T[]} list
 * @param {(entry: T) => boolean} holds
 */
function countWhile(list, holds) {
  let [low, high] = [0, list.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(list[middle])) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** @typedef {{centre: Vector, start: Vector, aside: Vector, radius: number, sweep: number}} Arc */

/**
 * The arc from one place through another to a third: its centre, its radii at the start and square to that, and the angle it goes
 * through.
 * @param {Vector} from
 * @param {Vector} via
 * @param {Vector} to
 * @returns {Arc}
 */
function arcThrough(from, via, to) {
  const [a, b] = [minus(via, from), minus(to, from)];
  const normal = /** @type {Vector} */ (cross(a, b));
  const square = dot(normal, normal);
  const [aa, bb] = [dot(a, a), dot(b, b)];
  const scaledTo = cross(/** @type {Vector} */ (b.map((part, i) => part * aa - a[i] * bb)), normal);
  const start = /** @type {Vector} */ (scaledTo.map((part) => part / (-2 * square)));
  const centre = /** @type {Vector} */ (from.map((part, i) => part - start[i]));
  const radius = Math.hypot(...start);
  const aside = /** @type {Vector} */ (cross(normal, start).map((part) => part / Math.sqrt(square)));
  const end = minus(to, centre);
  const angle = Math.atan2(dot(end, aside), dot(end, start));
  return { centre, start, aside, radius, sweep: angle > 0 ? angle : angle + 2 * Math.PI };
}

/**
 * @param {Arc} arc
 * @param {number} done
 * @returns {Vector}
 */
function placeOnArc({ centre, start, aside, sweep }, done) {
  const [cosine, sine] = [Math.cos(sweep * done), Math.sin(sweep * done)];
  return /** @type {Vector} */ (centre.map((part, i) => part + start[i] * cosine + aside[i] * sine));
}
