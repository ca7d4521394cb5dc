// The data of the page (src/report/playback/document.rs), unpacked.

/**
 * @typedef {object} Program
 * @property {Vector} stock width, depth, height in mm
 * @property {[number, number][]} spine places along y, each with how much higher the section stands there
 * @property {[number, number][]} part corners of the part's contour
 * @property {Blade[]} blades the first is at hand at the start
 * @property {[number, number][]} changes ops that change the blade, and the blade after each
 * @property {boolean} several whether there are more operations than one
 * @property {Set<number>} pockets operations, counted from 1, that clear regions of the plan
 * @property {Set<number>} walls those that slit walls of regions
 * @property {Map<number, Vector>} vias ops that follow an arc, and a place on it
 * @property {Taken | null} taken what slits and discs take; of Vs it follows from their poses
 * @property {number[][]} orientations quaternions
 * @property {string[]} names of the kinds of op
 * @property {number} ops how many there are
 * @property {Uint8Array} kinds
 * @property {Uint16Array} operations
 * @property {Uint32Array} layers
 * @property {Uint32Array} cuts
 * @property {Int32Array} tips in micrometres
 * @property {Uint32Array} held numbers of orientations, counted from 1
 * @property {Float64Array} starts when each op starts, and when the last one ends
 * @property {Cell | null} cell
 */

/**
 * @typedef {object} Cell
 * @property {{name: string, kind: "rotary" | "linear"}[]} axes
 * @property {Joint[]} tool
 * @property {Joint[]} work
 * @property {Matrix} flangeAtZero
 * @property {Matrix} mountAtZero
 * @property {Matrix[]} bladesInFlange
 * @property {Matrix} workInMount
 * @property {Body[]} bodies
 * @property {Track} track
 */

/** @typedef {{slits: {op: number, x: number, bottom: number}[], chips: {op: number, floor: Point[]}[]}} Taken */
/** @typedef {{kind: "rotary" | "linear", point: Vector, direction: Vector, weights: number[]}} Joint */
/** @typedef {{chain: "tool" | "work", joints: number, shape: "bar" | "block", from: Vector, to: Vector, radius?: number}} Body */
/** @typedef {{start: number[], firsts: Uint32Array, done: Uint16Array, values: Uint16Array, low: number[], step: number[]}} Track */

/** Numbers of kinds of op that matter here. */
const HOME = 0;
const AXIS_TRAVEL = 2;
const CUT_LEFT = 5;
const CUT_RIGHT = 6;
const FOLLOW = 7;

/**
 * What came before each entry, and at the end the sum of all.
 * @template {Float64Array | Uint32Array} T
 * @param {ArrayLike<number>} parts
 * @param {T} sums of one entry more
 */
function summed(parts, sums) {
  for (let i = 0; i < parts.length; i += 1) sums[i + 1] = sums[i] + parts[i];
  return sums;
}

/**
 * @param {any} raw
 * @returns {Program}
 */
function unpack(raw) {
  const columns = raw.timeline;
  const seconds = new Float64Array(bytesOf(columns.seconds));
  return {
    stock: raw.stock,
    spine: raw.spine,
    part: raw.part,
    blades: raw.blades,
    changes: raw.changes,
    several: raw.several,
    pockets: new Set(raw.pockets),
    walls: new Set(raw.walls),
    vias: unpackVias(columns.arcs),
    taken: raw.taken && unpackTaken(raw.taken),
    orientations: raw.orientations,
    names: raw.kinds,
    ops: seconds.length,
    kinds: new Uint8Array(bytesOf(columns.kinds)),
    operations: new Uint16Array(bytesOf(columns.operations)),
    layers: new Uint32Array(bytesOf(columns.layers)),
    cuts: new Uint32Array(bytesOf(columns.cuts)),
    tips: new Int32Array(bytesOf(columns.tips)),
    held: new Uint32Array(bytesOf(columns.held)),
    starts: summed(seconds, new Float64Array(seconds.length + 1)),
    cell: raw.cell && { ...raw.cell, track: unpackTrack(raw.cell.track) },
  };
}

/**
 * @param {any} raw
 * @returns {Map<number, Vector>}
 */
function unpackVias(raw) {
  const vias = new Int32Array(bytesOf(raw.vias));
  const ops = [...new Uint32Array(bytesOf(raw.ops))];
  return new Map(ops.map((op, i) => [op, /** @type {Vector} */ ([0, 1, 2].map((part) => vias[3 * i + part] / 1000))]));
}

/**
 * @param {any} raw
 * @returns {Taken}
 */
function unpackTaken({ slits, chips }) {
  const corner = (/** @type {[number, number]} */ [x, z]) => ({ x, z });
  return {
    slits: slits.map((/** @type {[number, number, number]} */ [op, x, bottom]) => ({ op, x, bottom })),
    chips: chips.map((/** @type {[number, [number, number][]]} */ [op, floor]) => ({ op, floor: floor.map(corner) })),
  };
}

/**
 * @param {any} raw
 * @returns {Track}
 */
function unpackTrack(raw) {
  const counts = new Uint32Array(bytesOf(raw.counts));
  return {
    start: raw.start,
    firsts: summed(counts, new Uint32Array(counts.length + 1)),
    done: new Uint16Array(bytesOf(raw.done)),
    values: new Uint16Array(bytesOf(raw.values)),
    low: raw.low,
    step: raw.step,
  };
}

/**
 * Where the tip is when an op ends, in mm in W.
 * @param {Program} program
 * @param {number} op
 * @returns {Vector}
 */
function tipAfter(program, op) {
  const { tips } = program;
  return [tips[3 * op] / 1000, tips[3 * op + 1] / 1000, tips[3 * op + 2] / 1000];
}

