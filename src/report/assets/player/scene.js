// What is to be seen at a moment.

const COLOURS = {
  stock: [0.87, 0.76, 0.5, 1],
  clear: [0.87, 0.76, 0.5, 0.3],
  part: [0.36, 0.55, 0.74, 1],
  blade: [0.2, 0.25, 0.36, 1],
  shank: [0.45, 0.47, 0.5, 1],
  machine: [
    [0.93, 0.5, 0.16, 1],
    [0.8, 0.41, 0.12, 1],
  ],
  table: [0.6, 0.62, 0.65, 1],
  cut: [0.8, 0.1, 0.12],
  way: [0.25, 0.45, 0.25],
  kerf: [0.35, 0.05, 0.05],
  floor: [0.5, 0.53, 0.56],
};

/** How many lines stand for an arc. */
const ARC_STEPS = 16;

/** @typedef {{robot: boolean, part: boolean, path: boolean, stock: boolean}} Shown */

class Scene {
  /**
   * @param {Canvas} canvas
   * @param {Timeline} timeline
   * @param {Workpiece} workpiece
   */
  constructor(canvas, timeline, workpiece) {
    this.canvas = canvas;
    this.timeline = timeline;
    this.workpiece = workpiece;
    const { program } = timeline;
    const part = program.part.map(([x, z]) => ({ x, z }));
    const { spine, stock } = program;
    this.stock = canvas.mesh(workpiece.mesh(program));
    this.part = canvas.mesh(swept(part, spine, stock[2]));
    this.tube = canvas.mesh(unitTube());
    this.ball = canvas.mesh(unitBall());
    this.box = canvas.mesh(unitBox());
    this.stage = canvas.mesh(drum({ radius: 1, height: 1 }));
    this.kerfs = canvas.mesh(new Float32Array(0));
    this.triad = canvas.mesh(triad());
    this.floor = canvas.mesh(floorOf(program));
    this.shanks = program.blades.map((blade, i) => shankOf(blade, program.cell, i));
    this.blades = program.blades.map((blade, i) => canvas.mesh(bladeMesh(blade, this.shanks[i].from)));
    this.layPath();
  }

  /** The path of all layers, one after the other, so that a layer is one stretch of the buffer. */
  layPath() {
    const { program, layerOf, layers } = this.timeline;
    /** @type {number[][]} */
    const parts = layers.map(() => []);
    for (let op = 1; op < program.ops; op += 1) {
      if (layerOf[op] === 0 || program.held[op - 1] === 0 || program.kinds[op] === AXIS_TRAVEL) continue;
      const [from, to] = [tipAfter(program, op - 1), tipAfter(program, op)];
      if (from.every((at, i) => at === to[i])) continue;
      const cuts = program.kinds[op] === CUT_LEFT || program.kinds[op] === CUT_RIGHT || program.kinds[op] === FOLLOW;
      const colour = cuts ? COLOURS.cut : COLOURS.way;
      const steps = program.vias.has(op) ? ARC_STEPS : 1;
      let before = from;
      for (let step = 1; step <= steps; step += 1) {
        const at = step === steps ? to : this.timeline.tipAt(op, step / steps);
        parts[layerOf[op] - 1].push(...before, ...colour, ...at, ...colour);
        before = at;
      }
    }
    this.pathStarts = summed(parts.map((part) => part.length / 6), new Uint32Array(parts.length + 1));
    const numbers = new Float32Array(6 * last(Array.from(this.pathStarts)));
    parts.forEach((part, i) => numbers.set(part, 6 * this.pathStarts[i]));
    this.path = this.canvas.mesh(numbers);
  }

  /** The stock's mesh anew, after chips came free. */
  cut() {
    this.canvas.refill(this.stock, this.workpiece.mesh(this.timeline.program));
  }

  /**
   * Draws a moment.
   * @param {Picture} picture
   * @param {Camera} camera
   * @param {Shown} shown
   */
  draw(picture, camera, shown) {
    const { canvas } = this;
    const { clientWidth, clientHeight } = canvas.element;
    canvas.begin(camera.view(clientWidth / Math.max(1, clientHeight)), camera.axes().eye);
    const { workpiece, blade } = picture;
    if (shown.part && this.workpiece.ground === null) canvas.body(this.part, workpiece, COLOURS.part);
    this.drawBlade(picture.tool, blade);
    const length = Math.max(...this.timeline.program.stock);
    this.canvas.lines(this.floor, picture.machine ? picture.scene : workpiece, 0.35);
    this.drawTriad(workpiece, length * 0.3);
    this.drawTriad(blade, length * 0.12);
    // After what stands in it, because one may look through it.
    canvas.body(this.stock, workpiece, shown.stock ? COLOURS.stock : COLOURS.clear, 1);
    this.drawKerfs(picture);
    if (shown.path) this.drawPath(picture);
    // Last, because one may look through it.
    if (picture.machine && shown.robot) this.drawMachine(picture, camera.opacityOfMachine());
  }

  /** @param {Picture} picture */
  drawPath({ layer, workpiece }) {
    if (layer === 0) return;
    const first = this.pathStarts[layer - 1];
    // Weak enough that many cuts beside one another do not cover the work.
    this.canvas.lines(this.path, workpiece, 0.6, first, this.pathStarts[layer] - first);
  }

  /** @param {Picture} picture */
  drawKerfs({ kerfs, slits, workpiece, moment }) {
    const numbers = wallLines(this.timeline, moment);
    numbers.push(...slits.flatMap(({ slit, from, to }) => slitLines(slit, this.workpiece.surface, from, to)));
    numbers.push(...kerfs.flatMap(({ kerf, from, to }) => kerfLines(kerf, this.workpiece.surface, from, to)));
    this.canvas.refill(this.kerfs, new Float32Array(numbers));
    this.canvas.lines(this.kerfs, workpiece);
  }

  /**
   * @param {number} tool
   * @param {Matrix} blade
   */
  drawBlade(tool, blade) {
    const { canvas } = this;
    const { from, neck, slim, to, radius, stages } = this.shanks[tool];
    canvas.body(this.blades[tool], blade, COLOURS.blade);
    if (stages.length > 0) {
      for (const { begin, end, radius } of stages) {
        const stage = [radius, 0, 0, 0, 0, radius, 0, 0, 0, 0, end - begin, 0, 0, 0, -begin, 1];
        canvas.body(this.stage, product(blade, stage), COLOURS.shank);
      }
      return;
    }
    this.bar(blade, [0, 0, from], [0, 0, neck], slim, COLOURS.shank);
    this.bar(blade, [0, 0, neck], to, radius, COLOURS.shank);
  }

  /**
   * @param {Picture} picture
   * @param {number} opacity
   */
  drawMachine(picture, opacity) {
    if (opacity < 1) {
      // Only what is in front is seen of a faint machine: first how deep it is, then its colours.
      this.canvas.onlyDepth(() => this.drawBodies(picture, 1));
    }
    this.drawBodies(picture, opacity);
    const { cell } = this.timeline.program;
    const size = cell.bodies.reduce((most, body) => Math.max(most, body.radius || 0), 50);
    this.drawTriad(picture.scene, size * 4);
  }

  /**
   * @param {Picture} picture
   * @param {number} opacity
   */
  drawBodies({ machine, scene }, opacity) {
    const { cell } = this.timeline.program;
    for (const body of cell.bodies) {
      const frame = product(scene, machine[body.chain][body.joints]);
      // A table is under the work and hides nothing.
      const colour = body.chain === "work" ? COLOURS.table : [...COLOURS.machine[body.joints % 2].slice(0, 3), opacity];
      if (body.shape === "bar") {
        this.bar(frame, body.from, body.to, body.radius, colour);
      } else {
        this.canvas.body(this.box, product(frame, boxed(body.from, body.to)), colour, 2);
      }
    }
  }

  /**
   * A bar with round ends.
   * @param {Matrix} frame
   * @param {Vector} from
   * @param {Vector} to
   * @param {number} radius
   * @param {number[]} colour
   */
  bar(frame, from, to, radius, colour) {
    this.canvas.body(this.tube, product(frame, along(from, to, radius)), colour);
    for (const end of [from, to]) {
      const ball = product(frame, product(shift(end), scaled(radius)));
      this.canvas.body(this.ball, ball, colour);
    }
  }

  /**
   * The axes of a frame: x red, y green, z blue.
   * @param {Matrix} frame
   * @param {number} size
   */
  drawTriad(frame, size) {
    this.canvas.lines(this.triad, product(frame, scaled(size)));
  }
}

/**
 * Lines on the floor, in the machine's frame; without a machine under the work.
 * @param {Program} program
 */
function floorOf({ stock, cell }) {
  const ends = cell === null ? [[0, 0, 0], stock] : cell.bodies.flatMap(({ from, to }) => [from, to]);
  const low = [0, 1, 2].map((i) => Math.min(...ends.map((end) => end[i])));
  const high = [0, 1, 2].map((i) => Math.max(...ends.map((end) => end[i])));
  const size = Math.max(high[0] - low[0], high[1] - low[1], 1);
  const step = size > 1500 ? 1000 : 100;
  const from = [0, 1].map((i) => Math.floor((low[i] - size * 0.5) / step));
  const to = [0, 1].map((i) => Math.ceil((high[i] + size * 0.5) / step));
  const numbers = [];
  const line = (/** @type {number[]} */ a, /** @type {number[]} */ b) => numbers.push(...a, ...COLOURS.floor, ...b, ...COLOURS.floor);
  for (let x = from[0]; x <= to[0]; x += 1) line([x * step, from[1] * step, low[2]], [x * step, to[1] * step, low[2]]);
  for (let y = from[1]; y <= to[1]; y += 1) line([from[0] * step, y * step, low[2]], [to[0] * step, y * step, low[2]]);
  return new Float32Array(numbers);
}

/**
 * The shank between blade and flange, seen from the blade; without a machine it is drawn a few blades long. A body that is stated
 * is drawn instead, stage by stage, the last one up to the flange.
 * @param {Blade} blade
 * @param {Cell | null} cell
 * @param {number} tool
 */
function shankOf(blade, cell, tool) {
  const flange = cell === null ? null : origin(inverse(cell.bladesInFlange[tool]));
  if ("radius" in blade) {
    const { radius, height } = blade;
    const to = /** @type {Vector} */ (flange !== null && flange[2] < -height ? flange : [0, 0, -height - 4 * radius]);
    const neck = -height + (to[2] + height) * 0.3;
    return { from: -height, neck, slim: radius * 0.3, to, radius: Math.max(radius * 0.5, -to[2] * 0.05), stages: stagesOf(blade, -to[2]) };
  }
  const { half, top } = daggerSize(blade);
  const to = /** @type {Vector} */ (flange !== null && flange[2] < top * 2.5 ? flange : [0, 0, top * 6]);
  const from = blade.body && blade.body.length > 0 ? Math.min(top, -blade.body[0][0]) : top * 1.5;
  const neck = from + (to[2] - from) * 0.3;
  return { from, neck, slim: half * 1.3, to, radius: Math.max(half * 1.6, -to[2] * 0.05), stages: stagesOf(blade, -to[2]) };
}

/**
 * The stages of a body, each up to where the next one begins; none where no body is stated.
 * @param {Blade} blade
 * @param {number} flange height above the tip
 */
function stagesOf({ body }, flange) {
  if (body === undefined) return [];
  return body.map(([begin, radius], i) => {
    const end = i + 1 < body.length ? body[i + 1][0] : Math.max(flange, begin + radius);
    return { begin, end, radius };
  });
}

/**
 * The lines of a slit as far as it is still there: on the faces of the stock it has passed, and along the top.
 * @param {Slit} slit
 * @param {Surface} surface
 * @param {number} from y where the cut begins
 * @param {number} to y how far it has come
 */
function slitLines({ x, bottom }, surface, from, to) {
  const top = Math.min(...surface.sides(x));
  // A disc that leads leaves less of a slit below its strip.
  if (bottom > top - 0.05 || to === from) return [];
  const line = (/** @type {Vector} */ a, /** @type {Vector} */ b) => [...a, ...COLOURS.kerf, ...b, ...COLOURS.kerf];
  const across = (/** @type {number} */ y) => line([x, y, bottom], [x, y, top]);
  return [...across(from), ...across(to), ...line([x, from, top], [x, to, top])];
}

/**
 * The lines of a flank that is cut while its chip is still there: on the faces of the stock it has passed, and along the top.
 * @param {Kerf} kerf
 * @param {Surface} surface
 * @param {number} from y where the cut begins
 * @param {number} to y how far it has come
 */
function kerfLines({ vee, side }, surface, from, to) {
  const exit = surface.exit(vee, side);
  if (exit === vee.tip || to === from) return [];
  const line = (/** @type {Vector} */ a, /** @type {Vector} */ b) => [...a, ...COLOURS.kerf, ...b, ...COLOURS.kerf];
  const across = (/** @type {number} */ y) => line([vee.tip.x, y, vee.tip.z], [exit.x, y, exit.z]);
  return [...across(from), ...across(to), ...line([exit.x, from, exit.z], [exit.x, to, exit.z])];
}

/**
 * The lines of slits along walls up to a moment, along their floor and along the top of the stock.
 * @param {Timeline} timeline
 * @param {Moment} moment
 */
function wallLines(timeline, moment) {
  const { program } = timeline;
  const numbers = /** @type {number[]} */ ([]);
  if (program.walls.size === 0) return numbers;
  const top = program.stock[2];
  for (let op = 1; op <= moment.op; op += 1) {
    if (program.kinds[op] !== FOLLOW || !program.walls.has(program.operations[op])) continue;
    if ("radius" in program.blades[timeline.toolAt(op)]) continue;
    const done = op < moment.op ? 1 : moment.done;
    const steps = program.vias.has(op) ? ARC_STEPS : 1;
    for (let step = 0; step < steps; step += 1) {
      const ends = [step, step + 1].map((at) => timeline.tipAt(op, (done * at) / steps));
      const heights = ends.every((end) => end[2] < top - 0.05) ? [0, 1] : [];
      for (const height of heights) {
        for (const [x, y, z] of ends) numbers.push(x, y, height === 0 ? z : top, ...COLOURS.kerf);
      }
    }
  }
  return numbers;
}
