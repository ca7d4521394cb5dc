// The time that is shown, and what people do to change it.

/**
 * @typedef {object} Picture
 * @property {Matrix} scene the machine's frame in the scene
 * @property {Matrix} workpiece W in the scene
 * @property {Matrix} blade T in the scene
 * @property {Vector} tip in W
 * @property {number[]} axes in rad and mm
 * @property {{tool: Matrix[], work: Matrix[]} | null} machine
 * @property {{kerf: Kerf, from: number, to: number}[]} kerfs
 * @property {{slit: Slit, from: number, to: number}[]} slits
 * @property {number} layer as the timeline numbers them; 0 is none
 * @property {number} tool the blade at hand
 * @property {Moment} moment
 */

/**
 * With two decimals; nothing is less than nothing.
 * @param {number} value
 */
function hundredths(value) {
  const text = value.toFixed(2);
  return text === "-0.00" ? "0.00" : text;
}

/** What kinds of op are called, by the names of the data. */
const CALLED = {
  home: "all axes to home",
  travel: "through the air",
  axis_travel: "all axes through the air",
  approach: "down to the work",
  retract: "away from the work",
  cut_left: "cut, left flank",
  cut_right: "cut, right flank",
  follow: "cut along a path",
  turn: "turn about the tip",
  ultrasonic: "ultrasonic switched",
  spin: "spindle switched",
  await_ready: "wait for the generator",
  dwell: "wait",
  change_place: "all axes to where blades are changed",
  tool_change: "tool change",
};

/** The time that is shown, and what is there to be seen at it. */
class Player {
  /** @param {Program} program */
  constructor(program) {
    this.program = program;
    this.timeline = new Timeline(program);
    this.workpiece = new Workpiece(this.timeline);
    this.time = 0;
    this.speed = 1;
    this.playing = false;
    this.selectLayers(1, this.timeline.layers.length);
    const { cell } = program;
    // The scene's frame is W while all axes are at zero: on a table that turns it moves, and the scene must not.
    this.scene = cell === null ? identity() : inverse(posed(cell, cell.axes.map(() => 0), 0).workpiece);
    this.holdFrames();
  }

  /** Where machine and blade are before anybody asks again. */
  holdFrames() {
    this.now = this.picture();
  }

  /**
   * Shows these layers only, counted from 1 in the order of work.
   * @param {number} from
   * @param {number} to
   */
  selectLayers(from, to) {
    const count = this.timeline.layers.length;
    this.from = Math.max(1, Math.min(from, count));
    this.to = Math.max(this.from, Math.min(to, count));
    const { ops, starts } = this.program;
    let [first, end] = [0, ops - 1];
    while (first < end && !this.isSelected(first)) first += 1;
    while (end > first && !this.isSelected(end)) end -= 1;
    this.begin = starts[first];
    this.end = starts[end + 1];
  }

  /**
   * Whether an op is shown. All layers together are the whole program.
   * @param {number} op
   */
  isSelected(op) {
    if (this.from === 1 && this.to === this.timeline.layers.length) return true;
    const layer = this.timeline.layerOf[op];
    return layer >= this.from && layer <= this.to;
  }

  /** @param {number} time */
  seek(time) {
    this.time = Math.max(this.begin, Math.min(this.end, time));
    this.holdFrames();
  }

  /**
   * Lets time go on, past the ops that are not shown.
   * @param {number} seconds
   */
  advance(seconds) {
    let time = this.time + seconds * this.speed;
    let { op } = this.timeline.at(time);
    while (op < this.program.ops - 1 && !this.isSelected(op)) {
      op += 1;
      time = this.program.starts[op];
    }
    if (time >= this.end) this.playing = false;
    this.seek(time);
  }

  /**
   * Goes to the beginning of the op after or before the present one.
   * @param {1 | -1} way
   */
  step(way) {
    const { starts, ops } = this.program;
    const { op, done } = this.now.moment;
    let next = way < 0 && done > 0 ? op : op + way;
    // Ops that take no time are passed over.
    while (next > 0 && next < ops && (starts[next] === starts[next + 1] || !this.isSelected(next))) next += way;
    this.seek(next >= ops ? this.end : starts[Math.max(0, next)]);
  }

  /**
   * Goes to where the next cut begins, or the one before.
   * @param {1 | -1} way
   */
  stepCut(way) {
    const { starts } = this.program;
    const begins = this.timeline.cuts.filter(({ op }) => this.isSelected(op)).map(({ op }) => starts[op]);
    const next = way > 0 ? begins.find((time) => time > this.time + 1e-9) : begins.findLast((time) => time < this.time - 1e-9);
    if (next !== undefined) this.seek(next);
    else this.seek(way > 0 ? this.end : this.begin);
  }

  /**
   * Goes to where a layer begins.
   * @param {number} layer counted from 1 in the order of work
   */
  goToLayer(layer) {
    const op = this.timeline.layerOf.indexOf(layer);
    if (op >= 0) this.seek(this.program.starts[op]);
  }

  /**
   * What is being done. At the end of what is shown it is the op that ends there, not the one that begins.
   * @returns {Moment}
   */
  moment() {
    const moment = this.timeline.at(this.time);
    let { op } = moment;
    while (op > 0 && !this.isSelected(op) && this.program.starts[op] >= this.time) op -= 1;
    return op === moment.op ? moment : { op, done: 1 };
  }

  /** @returns {Picture} */
  picture() {
    const { program, timeline } = this;
    const moment = this.moment();
    const { op, done } = moment;
    const { cell } = program;
    const axes = cell === null ? [] : axesDuring(cell.track, op, done);
    const tool = timeline.toolAt(op);
    const machine = cell === null ? null : posed(cell, axes, tool);
    const workpiece = machine === null ? identity() : product(this.scene, machine.workpiece);
    const known = timeline.bladeAt(moment);
    const inWork = known || (machine ? product(inverse(machine.workpiece), machine.blade) : timeline.nearestBlade(op));
    return {
      scene: this.scene,
      workpiece,
      blade: product(workpiece, inWork),
      tip: origin(inWork),
      axes,
      machine,
      kerfs: this.kerfs(moment, origin(inWork)[1]),
      slits: this.slits(moment, origin(inWork)[1]),
      layer: timeline.layerOf[op],
      tool,
      moment,
    };
  }

  /**
   * The flanks that are cut while their chips are there, and the one that is being cut.
   * @param {Moment} moment
   * @param {number} y where the tip is
   */
  kerfs({ op, done }, y) {
    const { kinds, stock, ops } = this.program;
    const whole = this.timeline.kerfsAt(this.time).map((kerf) => ({ kerf, from: 0, to: stock[1] }));
    const cuts = kinds[op] === CUT_LEFT || kinds[op] === CUT_RIGHT;
    if (op === 0 || op >= ops || !cuts || done >= 1 || this.timeline.slits.some((slit) => slit.op === op)) return whole;
    return whole.concat([{ kerf: this.timeline.kerfOf(op), ...this.come(op, y) }]);
  }

  /**
   * The slits that are cut, and the one that is being cut.
   * @param {Moment} moment
   * @param {number} y where the tip is
   */
  slits({ op, done }, y) {
    const { stock } = this.program;
    const whole = this.timeline.slitsAt(this.time).map((slit) => ({ slit, from: 0, to: stock[1] }));
    const slit = this.timeline.slits.find((slit) => slit.op === op);
    if (op === 0 || slit === undefined || done >= 1) return whole;
    return whole.concat([{ slit, ...this.come(op, y) }]);
  }

  /**
   * From where to where a cut has come.
   * @param {number} op
   * @param {number} y where the tip is
   */
  come(op, y) {
    const { stock } = this.program;
    const forward = tipAfter(this.program, op)[1] >= tipAfter(this.program, op - 1)[1];
    return { from: forward ? 0 : stock[1], to: Math.max(0, Math.min(stock[1], y)) };
  }

  /** Brings the stock to the time that is shown. Tells whether it changed. */
  cut() {
    return this.workpiece.goTo(this.timeline.chipsFreeAt(this.time), this.timeline.at(this.time));
  }

  /**
   * What is done at a time, for pictures that show it too. While only the axes know where the tip is, `x` is not a number.
   * @param {number} time
   * @returns {{time: number, x: number, layer: string, words: string}}
   */
  momentAt(time) {
    const { program, timeline } = this;
    const { op, done } = timeline.at(time);
    const blade = timeline.bladeAt({ op, done });
    const x = blade === null ? NaN : origin(blade)[0];
    const layer = this.nameOfLayer(program.operations[op], program.layers[op]);
    const parts = [clock(time)];
    if (layer !== "") parts.push(`layer ${layer}`);
    if (program.cuts[op] > 0) parts.push(`cut ${program.cuts[op]}`);
    parts.push(CALLED[program.names[program.kinds[op]]]);
    return { time, x, layer, words: parts.join(" · ") };
  }

  /**
   * A layer as tables and pictures name it; none is nothing.
   * @param {number} operation
   * @param {number} layer
   */
  nameOfLayer(operation, layer) {
    if (layer === 0) return "";
    return this.program.several ? `${operation}.${layer}` : String(layer);
  }

  /**
   * When the cut begins whose tip is nearest to a place; of equally near ones the last, which leaves what is there.
   * @param {number} x
   * @returns {number | null}
   */
  timeOfCutAt(x) {
    let [best, distance] = [/** @type {{op: number} | null} */ (null), Infinity];
    for (const cut of this.timeline.cuts) {
      const away = Math.abs(cut.x - x);
      if (away <= distance + 1e-6) [best, distance] = [cut, Math.min(away, distance)];
    }
    return best === null ? null : this.program.starts[best.op];
  }

  /**
   * When the first of these layers begins.
   * @param {string[]} names
   * @returns {number | null}
   */
  timeOfLayers(names) {
    const { program, timeline } = this;
    const number = timeline.layers.findIndex(({ operation, layer }) => names.includes(this.nameOfLayer(operation, layer))) + 1;
    return number === 0 ? null : program.starts[timeline.layerOf.indexOf(number)];
  }

  /** The present axes in deg and mm. */
  shownAxes() {
    const { cell } = this.program;
    if (cell === null) return [];
    return this.now.axes.map((value, axis) => (cell.axes[axis].kind === "rotary" ? (value * 180) / Math.PI : value));
  }

  /** A line of text about the present. */
  words() {
    const { program, timeline, now } = this;
    const { op } = now.moment;
    const { several } = program;
    const parts = [
      `${clock(this.time)} of ${clock(timeline.duration)} (${this.time.toFixed(2)} s)`,
      `motion ${op} of ${program.ops}: ${CALLED[program.names[program.kinds[op]]]}`,
    ];
    if (several && program.operations[op] > 0) parts.push(`operation ${program.operations[op]}`);
    if (program.layers[op] > 0) parts.push(`layer ${program.layers[op]}`);
    if (program.cuts[op] > 0) parts.push(`cut ${program.cuts[op]}`);
    const [x, y, z] = now.tip.map(hundredths);
    parts.push(`tip ${x}, ${y}, ${z} mm`);
    return parts.join(" · ");
  }

  /** The axes as text. */
  axisWords() {
    const { cell } = this.program;
    if (cell === null) return "";
    const shown = this.shownAxes();
    return cell.axes
      .map(({ name, kind }, axis) => `${name}\u00a0${hundredths(shown[axis])}\u00a0${kind === "rotary" ? "deg" : "mm"}`)
      .join("   ");
  }
}

/**
 * An element of the section.
 * @param {string} name
 * @returns {any}
 */
function element(name) {
  return document.getElementById(`vcut-playback-${name}`);
}

/**
 * Ties buttons and fields to a player. `changed` is told when something else is to be seen.
 * @param {Player} player
 * @param {() => void} changed
 */
function bindControls(player, changed) {
  const click = (/** @type {string} */ name, /** @type {() => void} */ act) => {
    element(name).addEventListener("click", () => {
      act();
      changed();
    });
  };
  click("play", () => toggle(player));
  click("back", () => step(player, -1));
  click("forth", () => step(player, 1));
  click("cut-back", () => stepCut(player, -1));
  click("cut-forth", () => stepCut(player, 1));
  listLayers(player);
  element("layer").addEventListener("change", () => {
    player.playing = false;
    player.goToLayer(Number(element("layer").value));
    changed();
  });
  element("time").addEventListener("input", () => {
    player.seek(Number(element("time").value));
    changed();
  });
  element("speed").addEventListener("change", () => {
    player.speed = Number(element("speed").value);
  });
  for (const name of ["from", "to"]) {
    element(name).max = player.timeline.layers.length;
    element(name).addEventListener("change", () => {
      chooseLayers(player, Number(element("from").value), Number(element("to").value));
      changed();
    });
  }
}

/** @param {Player} player */
function toggle(player) {
  player.playing = !player.playing;
  if (player.playing && player.time >= player.end) player.seek(player.begin);
}

/**
 * @param {Player} player
 * @param {1 | -1} way
 */
function step(player, way) {
  player.playing = false;
  player.step(way);
}

/**
 * @param {Player} player
 * @param {1 | -1} way
 */
function stepCut(player, way) {
  player.playing = false;
  player.stepCut(way);
}

/**
 * The layers to go to, each with the time when it begins.
 * @param {Player} player
 */
function listLayers(player) {
  const { layers, layerOf } = player.timeline;
  const { several } = player.program;
  const firsts = new Map();
  layerOf.forEach((layer, op) => firsts.has(layer) || firsts.set(layer, op));
  layers.forEach(({ operation, layer }, i) => {
    const option = document.createElement("option");
    option.value = String(i + 1);
    const start = clock(player.program.starts[firsts.get(i + 1)]);
    option.textContent = several ? `operation ${operation}, layer ${layer} (${start})` : `layer ${layer} (${start})`;
    element("layer").append(option);
  });
}

/**
 * A time as minutes and seconds, with hours where there are any.
 * @param {number} seconds
 */
function clock(seconds) {
  const whole = Math.floor(seconds);
  const two = (/** @type {number} */ value) => String(value).padStart(2, "0");
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
  return hours > 0 ? `${hours}:${two(minutes)}:${two(whole % 60)}` : `${minutes}:${two(whole % 60)}`;
}

/**
 * @param {Player} player
 * @param {number} from
 * @param {number} to
 */
function chooseLayers(player, from, to) {
  player.selectLayers(Math.round(from) || 1, Math.round(to) || player.timeline.layers.length);
  player.seek(player.time);
}

/**
 * Brings the controls up to date.
 * @param {Player} player
 */
function showState(player) {
  const play = element("play");
  play.textContent = player.playing ? "Pause" : "Play";
  element("now").setAttribute("aria-live", player.playing ? "off" : "polite");
  element("now").textContent = player.words();
  element("axes").textContent = player.axisWords();
  const time = element("time");
  time.min = player.begin;
  time.max = player.end;
  time.value = player.time;
  time.setAttribute("aria-valuetext", `${player.time.toFixed(2)} s`);
  element("speed").value = player.speed;
  if (player.now.layer > 0) element("layer").value = player.now.layer;
  element("from").value = player.from;
  element("to").value = player.to;
}

