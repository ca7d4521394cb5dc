// The picture in space: the part in the colours of a map, the stock around it as lines, and the directions of x, y and z.

/** Sides and bottom of the part, and places without a value. */
const NEUTRAL = "#a3a7ad";

/** Lines of the stock. */
const STOCK = [0.5, 0.53, 0.56];

/** Sides to look from: yaw and pitch in radians. */
const LOOKS_FROM = {
  front: [0, 0],
  side: [Math.PI / 2, 0],
  top: [0, Math.PI / 2],
  iso: [0.5, 0.62],
};

/**
 * A colour as red, green, blue and opacity.
 * @param {string} colour as `#` and six digits
 */
function shares(colour) {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255).concat(1);
}

class View {
  /**
   * @param {Canvas} canvas
   * @param {Relief} relief
   * @param {Camera} camera
   * @param {HTMLElement[]} letters of the axes
   */
  constructor(canvas, relief, camera, letters) {
    this.canvas = canvas;
    this.relief = relief;
    this.camera = camera;
    this.letters = letters;
    this.sides = canvas.mesh(relief.sides());
    this.box = canvas.mesh(boxLines(relief.size));
    this.triad = canvas.mesh(triad());
    /** @type {{mesh: Mesh, colour: number[]}[]} */
    this.faces = [];
  }

  /** @param {PlanMap} map */
  show(map) {
    const colours = [...map.classes.map(([colour]) => colour), NEUTRAL];
    this.relief.faces(map).forEach((numbers, i) => {
      const mesh = this.faces[i]?.mesh ?? this.canvas.mesh(new Float32Array(0));
      this.canvas.refill(mesh, numbers);
      this.faces[i] = { mesh, colour: shares(colours[i]) };
    });
    // Another map may have had more classes.
    for (const { mesh } of this.faces.slice(colours.length)) this.canvas.refill(mesh, new Float32Array(0));
  }

  aspect() {
    const { clientWidth, clientHeight } = this.canvas.element;
    return clientWidth / Math.max(1, clientHeight);
  }

  /** @param {string} name */
  lookFrom(name) {
    const [yaw, pitch] = LOOKS_FROM[name] || LOOKS_FROM.iso;
    const target = /** @type {Vector} */ (this.relief.size.map((length) => length / 2));
    // Upright pictures need room for the letters at both sides.
    const radius = Math.hypot(...target) * (this.aspect() < 1 ? 1 : 0.9);
    this.camera.lookAt(yaw, pitch, target, radius, this.aspect());
    this.camera.farthest = 8 * radius;
  }

  draw() {
    const { canvas, camera } = this;
    const view = camera.view(this.aspect());
    canvas.begin(view, camera.axes().eye);
    // Pushed back, so that lines on the sides are seen.
    canvas.body(this.sides, identity(), shares(NEUTRAL), 1);
    for (const { mesh, colour } of this.faces) if (mesh.count > 0) canvas.body(mesh, identity(), colour, 1);
    canvas.lines(this.box, identity(), 0.6);
    const ends = this.ends(0.06);
    canvas.lines(this.triad, boxed([0, 0, 0], ends));
    this.placeLetters(view, this.ends(0.09));
  }

  /**
   * How far the axes go: past the stock, so that their ends are seen beside the part.
   * @param {number} share of the longest side
   */
  ends(share) {
    const { size } = this.relief;
    return /** @type {Vector} */ (size.map((length) => length + Math.max(...size) * share));
  }

  /**
   * Puts the letters of x, y and z at the ends of their lines.
   * @param {Matrix} view
   * @param {Vector} ends
   */
  placeLetters(view, ends) {
    const { clientWidth, clientHeight } = this.canvas.element;
    this.letters.forEach((letter, axis) => {
      const end = [0, 1, 2].map((i) => (i === axis ? ends[axis] : 0));
      const [x, y, , w] = [0, 1, 2, 3].map((row) => view[row] * end[0] + view[4 + row] * end[1] + view[8 + row] * end[2] + view[12 + row]);
      letter.style.transform = `translate(${((x / w + 1) / 2) * clientWidth}px, ${((1 - y / w) / 2) * clientHeight}px)`;
    });
  }

  /**
   * The place of the surface at a place of the picture, or null.
   * @param {number} x in pixels from the left
   * @param {number} y in pixels from the top
   * @returns {Vector | null}
   */
  pointed(x, y) {
    const { clientWidth, clientHeight } = this.canvas.element;
    const { eye, right, up } = this.camera.axes();
    const tangent = Math.tan(HALF_VIEW);
    const across = ((2 * x) / Math.max(1, clientWidth) - 1) * tangent * this.aspect();
    const upwards = (1 - (2 * y) / Math.max(1, clientHeight)) * tangent;
    const from = /** @type {Vector} */ (this.camera.target.map((at, i) => at + eye[i] * this.camera.distance));
    const along = /** @type {Vector} */ ([0, 1, 2].map((i) => right[i] * across + up[i] * upwards - eye[i]));
    return this.relief.met(from, along);
  }
}

/**
 * The edges of a box from the origin.
 * @param {Vector} size
 */
function boxLines(size) {
  /** @type {number[]} */
  const numbers = [];
  for (const axis of [0, 1, 2]) {
    const [other, last] = [(axis + 1) % 3, (axis + 2) % 3];
    for (const [i, j] of [[0, 0], [0, 1], [1, 0], [1, 1]]) {
      for (const end of [0, size[axis]]) {
        const at = [0, 0, 0];
        [at[axis], at[other], at[last]] = [end, i * size[other], j * size[last]];
        numbers.push(...at, ...STOCK);
      }
    }
  }
  return new Float32Array(numbers);
}
