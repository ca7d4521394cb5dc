// Puts the view together with what a reader chooses and points at. Without WebGL 2 the figure stays hidden.

/**
 * An element of the figure.
 * @param {string} name
 * @returns {any}
 */
function part(name) {
  return document.getElementById(`vcut-space-${name}`);
}

/**
 * The classes of a map with their colours, the highest first, as beside the map from above.
 * @param {PlanMap} map
 * @param {Relief} relief
 */
function showLegend(map, relief) {
  const cells = Array.from({ length: relief.columns * relief.rows }, (_, cell) => cell);
  const rows = map.classes.map(([colour, words]) => row(colour, words)).reverse();
  if (cells.some((cell) => map.classOf(cell) === null)) {
    const none = row(NEUTRAL, "no value");
    none.className = "vcut-apart";
    rows.push(none);
  }
  part("legend").replaceChildren(...rows);
  part("limit").textContent = map.limit ?? "";
  part("figures").textContent = `The ${map.what}: ${map.figures}.`;
}

/**
 * @param {string} colour
 * @param {string} words
 */
function row(colour, words) {
  const item = document.createElement("li");
  item.style.setProperty("--c", colour);
  item.textContent = words;
  return item;
}

/**
 * A place and its value, in words.
 * @param {Relief} relief
 * @param {PlanMap} map
 * @param {Vector | null} place
 */
function wordsOf(relief, map, place) {
  if (place === null) return "\u00a0";
  const [column, row] = relief.cellAt(place[0], place[1]);
  const cell = row * relief.columns + column;
  const at = ["x", "y", "z"].map((axis, i) => `${axis} ${place[i].toFixed(1)} mm`).join(", ");
  return `${at}: ${map.what} ${valueInWords(map, cell)}`;
}

/**
 * The value of a cell, or the name of its class.
 * @param {PlanMap} map
 * @param {number} cell
 */
function valueInWords(map, cell) {
  const [value, number] = [map.valueOf(cell), map.classOf(cell)];
  if (value === null || number === null) return "no value";
  if (map.decimals === null) return map.classes[number][1];
  return `${value.toFixed(map.decimals).replace(/^-(0\.?0*)$/, "$1")} ${map.unit}`;
}

function start() {
  const canvas = /** @type {HTMLCanvasElement} */ (part("canvas"));
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: true });
  if (gl === null) return;
  const figure = /** @type {HTMLElement} */ (document.getElementById("vcut-space"));
  figure.hidden = false;
  const relief = new Relief(JSON.parse(part("data").textContent));
  const camera = new Camera();
  const letters = /** @type {HTMLElement[]} */ ([...figure.querySelectorAll("i")]);
  let view = new View(new Canvas(canvas, gl), relief, camera, letters);
  let map = relief.maps[0];
  /** @type {[number, number] | null} where the pointer is in the picture */
  let pointer = null;
  let isDue = false;

  const draw = () => {
    isDue = false;
    view.draw();
    part("here").textContent = wordsOf(relief, map, pointer && view.pointed(...pointer));
  };
  const changed = () => {
    if (!isDue) requestAnimationFrame(draw);
    isDue = true;
  };
  const choose = () => {
    map = relief.maps[part("map").selectedIndex] ?? map;
    view.show(map);
    showLegend(map, relief);
    changed();
  };
  const lookFrom = (/** @type {string} */ name) => {
    view.lookFrom(name);
    changed();
  };

  part("map").append(...relief.maps.map(({ what }) => new Option(what)));
  part("map").addEventListener("change", choose);
  for (const button of figure.querySelectorAll("[data-look]")) {
    const { look } = /** @type {HTMLElement} */ (button).dataset;
    button.addEventListener("click", () => lookFrom(look));
  }
  bindPointers(canvas, camera, changed);
  for (const name of ["pointermove", "pointerdown", "pointerleave"]) {
    canvas.addEventListener(name, (/** @type {PointerEvent} */ event) => {
      // A finger that goes up leaves too, and what it has touched is still to be read.
      if (name === "pointerleave" && event.pointerType === "touch") return;
      pointer = name === "pointerleave" ? null : [event.offsetX, event.offsetY];
      changed();
    });
  }
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const side = Object.keys(LOOKS_FROM)[Number(event.key) - 1];
    if (side !== undefined) lookFrom(side);
    else if (!lookByKey(camera, event)) return;
    event.preventDefault();
    changed();
  });
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  canvas.addEventListener("webglcontextrestored", () => {
    view = new View(new Canvas(canvas, gl), relief, camera, letters);
    choose();
  });
  // At once, so that no frame shows the picture at another size.
  new ResizeObserver(draw).observe(canvas);
  // What scripts may do with the view.
  Object.assign(window, {
    vcutSpace: {
      draw,
      looks: () => [camera.yaw, camera.pitch, camera.distance],
      /** the place of the surface, in mm, at a place of the picture */
      pointed: (/** @type {number} */ x, /** @type {number} */ y) => view.pointed(x, y),
    },
  });
  choose();
  view.lookFrom("iso");
  draw();
}

start();
