// Puts everything together, and lets it be driven from outside.

/** Sides to look from: yaw and pitch in radians. */
const SIDES = {
  front: [0, 0],
  side: [Math.PI / 2, 0],
  top: [0, Math.PI / 2],
  iso: [0.6, 0.5],
};

/**
 * The ball around the work, or around the machine as well.
 * @param {Player} player
 * @param {boolean} whole
 * @returns {{target: Vector, radius: number}}
 */
function ballAround(player, whole) {
  const { stock, cell } = player.program;
  const target = /** @type {Vector} */ (stock.map((length) => length / 2));
  const radius = Math.hypot(...target) * 0.95;
  if (!whole || cell === null) return { target, radius };
  const ends = cell.bodies.flatMap((body) => {
    const frame = product(player.scene, player.now.machine[body.chain][body.joints]);
    return [moved(frame, body.from), moved(frame, body.to)];
  });
  const points = ends.concat([target]);
  const low = [0, 1, 2].map((i) => Math.min(...points.map((point) => point[i])));
  const high = [0, 1, 2].map((i) => Math.max(...points.map((point) => point[i])));
  const middle = /** @type {Vector} */ (low.map((part, i) => (part + high[i]) / 2));
  return { target: middle, radius: Math.hypot(...minus(/** @type {Vector} */ (high), /** @type {Vector} */ (low))) * 0.55 };
}

/**
 * @param {Player} player
 * @param {Camera} camera
 * @param {string} name
 */
function lookFrom(player, camera, name) {
  const { clientWidth, clientHeight } = element("canvas");
  const whole = ballAround(player, true);
  const { target, radius } = name === "whole" ? whole : ballAround(player, false);
  const [yaw, pitch] = SIDES[name] || SIDES.iso;
  // A machine stands behind its work, not before it.
  const behind = (name === "iso" || name === "whole") && whole.target[0] > target[0] ? -yaw : yaw;
  camera.lookAt(behind, pitch, target, radius, clientWidth / Math.max(1, clientHeight));
  camera.near = camera.distanceTo(ballAround(player, false).radius, clientWidth / Math.max(1, clientHeight));
  camera.far = camera.distanceTo(whole.radius, clientWidth / Math.max(1, clientHeight));
  camera.farthest = 4 * whole.radius + Math.hypot(...minus(whole.target, target));
}

/**
 * Keys on the picture.
 * @param {Player} player
 * @param {Camera} camera
 * @param {() => void} changed
 */
function bindKeys(player, camera, changed) {
  const plain = {
    " ": () => toggle(player),
    ",": () => step(player, -1),
    ".": () => step(player, 1),
    PageUp: () => stepCut(player, -1),
    PageDown: () => stepCut(player, 1),
    1: () => lookFrom(player, camera, "front"),
    2: () => lookFrom(player, camera, "side"),
    3: () => lookFrom(player, camera, "top"),
    4: () => lookFrom(player, camera, "iso"),
    5: () => lookFrom(player, camera, "whole"),
  };
  element("canvas").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (plain[event.key] !== undefined) plain[event.key]();
    else if (!lookByKey(camera, event)) return;
    event.preventDefault();
    changed();
  });
}

/**
 * The picture, or null where the browser has no WebGL 2.
 * @param {Player} player
 */
function makeScene(player) {
  const canvas = element("canvas");
  const gl = canvas.getContext("webgl2", { antialias: true, alpha: true });
  if (gl === null) return null;
  const scene = new Scene(new Canvas(canvas, gl), player.timeline, player.workpiece);
  return scene;
}

/** Without WebGL 2 the times and the text are there, the picture is not. */
function tellMissing() {
  element("missing").hidden = false;
  element("canvas").hidden = true;
  element("looks").hidden = true;
}

/** Starts. */
function start() {
  const player = new Player(unpack(JSON.parse(element("data").textContent)));
  const camera = new Camera();
  let scene = makeScene(player);
  if (scene === null) tellMissing();
  let due = false;
  let before = 0;

  const show = () => {
    if (player.cut() && scene !== null) scene.cut();
    if (element("follow").checked) camera.target = origin(player.now.blade);
    if (scene !== null) scene.draw(player.now, camera, shownNow());
    showState(player);
    document.dispatchEvent(new Event("vcut-playback"));
  };
  const frame = (/** @type {number} */ now) => {
    due = false;
    // A page that was asleep does not jump ahead.
    if (player.playing) player.advance(Math.min(0.25, (now - before) / 1000));
    before = now;
    show();
    if (player.playing) ask();
  };
  const ask = () => {
    if (due) return;
    due = true;
    requestAnimationFrame(frame);
  };
  const changed = () => {
    if (!due) before = performance.now();
    ask();
  };

  bindControls(player, changed);
  bindPointers(element("canvas"), camera, changed);
  bindKeys(player, camera, changed);
  for (const name of ["front", "side", "top", "iso", "whole"]) {
    element(name).addEventListener("click", () => {
      lookFrom(player, camera, name);
      changed();
    });
  }
  for (const name of ["robot", "part", "path", "stock"]) element(`show-${name}`).addEventListener("change", changed);
  // The part's contour does not show pockets.
  const { ground } = player.workpiece;
  for (const part of [element("show-part").parentElement, element("legend-part")]) part.hidden = ground !== null;
  element("follow").addEventListener("change", changed);
  for (const part of document.querySelectorAll("[data-vcut-machine]")) {
    /** @type {HTMLElement} */ (part).hidden = player.program.cell === null;
  }
  element("canvas").addEventListener("webglcontextlost", (/** @type {Event} */ event) => event.preventDefault());
  element("canvas").addEventListener("webglcontextrestored", () => {
    scene = makeScene(player);
    changed();
  });
  lookFrom(player, camera, "iso");
  new ResizeObserver(changed).observe(element("canvas"));
  publish(player, camera, changed);
  show();
}

/** @returns {Shown} */
function shownNow() {
  const [robot, part, path, stock] = ["robot", "part", "path", "stock"].map((name) => element(`show-${name}`).checked);
  return { robot, part, path, stock };
}

/**
 * What scripts may do with the playback.
 * @param {Player} player
 * @param {Camera} camera
 * @param {() => void} changed
 */
function publish(player, camera, changed) {
  const then = (/** @type {() => void} */ act) => {
    act();
    changed();
  };
  Object.assign(window, {
    vcutPlayback: {
      time: () => player.time,
      duration: () => player.timeline.duration,
      tip: () => [...player.now.tip],
      /** deg and mm, as they are shown */
      joints: () => player.shownAxes(),
      play: () => then(() => !player.playing && toggle(player)),
      pause: () => then(() => player.playing && toggle(player)),
      seek: (/** @type {number} */ seconds) => then(() => player.seek(seconds)),
      setSpeed: (/** @type {number} */ speed) => then(() => (player.speed = speed)),
      setLayers: (/** @type {number} */ from, /** @type {number} */ to) => then(() => chooseLayers(player, from, to)),
      stepCut: (/** @type {1 | -1} */ way) => then(() => stepCut(player, way)),
      goToLayer: (/** @type {number} */ layer) => then(() => player.goToLayer(layer)),
      /** for pictures that show the same: what is done at a time, and when what they show is done */
      momentAt: (/** @type {number} */ seconds) => player.momentAt(seconds),
      timeOfCutAt: (/** @type {number} */ x) => player.timeOfCutAt(x),
      timeOfLayers: (/** @type {string[]} */ names) => player.timeOfLayers(names),
      /** where the camera looks, in the scene, and how opaque the machine is from there */
      looksAt: () => [...camera.target],
      machineOpacity: () => camera.opacityOfMachine(),
      /** how high the stock stands over a place of the plan */
      heightAt: (/** @type {number} */ x, /** @type {number} */ y) => {
        player.cut();
        return player.workpiece.heightAt(x, y);
      },
      section: () => {
        player.cut();
        changed();
        return player.workpiece.surface.corners().map(({ x, z }) => [x, z]);
      },
    },
  });
}

start();
