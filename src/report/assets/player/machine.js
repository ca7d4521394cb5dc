// Where the axes are, and where they bring things (src/machine/kinematics/linkage.rs and src/report/playback/track.rs).

/**
 * The axes at a knot; -1 is the start of the program.
 * @param {Track} track
 * @param {number} knot
 */
function axesAt(track, knot) {
  if (knot < 0) return track.start;
  const first = knot * track.low.length;
  return track.low.map((low, axis) => low + track.values[first + axis] * track.step[axis]);
}

/**
 * The axes when so much of an op is done: on the cubic through the four nearest knots of the op, its start among them.
 * @param {Track} track
 * @param {number} op
 * @param {number} done
 * @returns {number[]}
 */
function axesDuring(track, op, done) {
  const start = track.firsts[op];
  const count = track.firsts[op + 1] - start;
  if (count === 0) return axesAt(track, start - 1);
  const doneAt = (/** @type {number} */ place) => (place === 0 ? 0 : track.done[start + place - 1] / 65535);
  let after = 0;
  while (after <= count && doneAt(after) < done) after += 1;
  const first = Math.max(0, Math.min(after - 2, count - 3));
  const places = [];
  for (let place = first; place <= Math.min(first + 3, count); place += 1) places.push(place);
  const axes = track.low.map(() => 0);
  for (const place of places) {
    const others = places.filter((other) => other !== place);
    const weight = others.reduce((all, other) => all * ((done - doneAt(other)) / (doneAt(place) - doneAt(other))), 1);
    axesAt(track, start + place - 1).forEach((value, axis) => {
      axes[axis] += weight * value;
    });
  }
  return axes;
}

/**
 * What each joint of a chain carries, moved, from the frame outwards; the first entry stands still.
 * @param {Joint[]} chain
 * @param {number[]} axes
 * @returns {Matrix[]}
 */
function carried(chain, axes) {
  const frames = [identity()];
  for (const joint of chain) frames.push(product(last(frames), motionOf(joint, axes)));
  return frames;
}

/**
 * @param {Joint} joint
 * @param {number[]} axes
 * @returns {Matrix}
 */
function motionOf(joint, axes) {
  const amount = axes.reduce((sum, value, axis) => sum + value * joint.weights[axis], 0);
  if (joint.kind === "rotary") return turnAbout(joint.point, joint.direction, amount);
  const [x, y, z] = joint.direction;
  return shift([x * amount, y * amount, z * amount]);
}

/**
 * The machine at some axis values, in its own frame.
 * @param {Cell} cell
 * @param {number[]} axes
 * @param {number} tool the blade at hand
 */
function posed(cell, axes, tool) {
  const links = carried(cell.tool, axes);
  const work = carried(cell.work, axes);
  return {
    tool: links,
    work,
    blade: product(product(last(links), cell.flangeAtZero), cell.bladesInFlange[tool]),
    workpiece: product(product(last(work), cell.mountAtZero), cell.workInMount),
  };
}

