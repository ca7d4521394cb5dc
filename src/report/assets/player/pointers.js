// A camera in the hands of a reader: mouse, fingers, wheel and keys on a picture in space.

/** How long, in ms, a page is still before the wheel is the picture's. */
const STILL = 300;

/**
 * Mouse, fingers and wheel.
 * @param {HTMLCanvasElement} canvas
 * @param {Camera} camera
 * @param {() => void} changed
 */
function bindPointers(canvas, camera, changed) {
  /** @type {Map<number, {x: number, y: number}>} */
  const fingers = new Map();
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => {
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({ preventScroll: true });
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, (/** @type {PointerEvent} */ event) => fingers.delete(event.pointerId));
  }
  canvas.addEventListener("pointermove", (/** @type {PointerEvent} */ event) => {
    const before = fingers.get(event.pointerId);
    if (before === undefined) return;
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    const apart = fingers.size === 2 ? spread() : 0;
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const height = Math.max(1, canvas.clientHeight);
    if (fingers.size === 2) {
      // Each finger moves the scene by half of its own way.
      camera.pan(dx / height / 2, dy / height / 2);
      camera.zoom(apart / Math.max(1, spread()));
    } else if (event.shiftKey || event.buttons & 6) {
      camera.pan(dx / height, dy / height);
    } else {
      camera.orbit((-dx / height) * 4, (dy / height) * 4);
    }
    changed();
  });
  canvas.addEventListener("contextmenu", (/** @type {Event} */ event) => event.preventDefault());
  // Who scrolls past the picture goes on scrolling: the wheel is the picture's when the page has been still for a moment.
  let scrolled = -Infinity;
  addEventListener("scroll", () => {
    scrolled = performance.now();
  }, { passive: true });
  canvas.addEventListener("wheel", (/** @type {WheelEvent} */ event) => {
    if (performance.now() - scrolled < STILL && !event.ctrlKey) return;
    event.preventDefault();
    camera.zoom(Math.exp(Math.max(-100, Math.min(100, event.deltaY)) * 0.002));
    changed();
  }, { passive: false });
}

/** Where arrows lead. */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * Turns, moves or zooms by a key; false where the key stands for something else.
 * @param {Camera} camera
 * @param {KeyboardEvent} event
 */
function lookByKey(camera, event) {
  const way = ARROWS[event.key];
  const zoom = { "+": 0.85, "=": 0.85, "-": 1 / 0.85 }[event.key];
  if (way !== undefined && event.shiftKey) camera.pan(way[0] * 0.05, -way[1] * 0.05);
  else if (way !== undefined) camera.orbit(way[0] * 0.1, way[1] * 0.1);
  else if (zoom !== undefined) camera.zoom(zoom);
  else return false;
  return true;
}
