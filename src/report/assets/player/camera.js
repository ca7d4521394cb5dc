// From where the scene is seen: round a target, at a distance.

/** Half the angle of view from bottom to top. */
const HALF_VIEW = Math.PI / 12;

/** Opacity of a machine that is seen from near. */
const FAINT = 0.14;

class Camera {
  constructor() {
    this.yaw = 0;
    this.pitch = 0;
    this.distance = 1000;
    /** @type {Vector} */
    this.target = [0, 0, 0];
    /** Beyond this nothing is drawn. */
    this.farthest = 1e4;
    /** From where the work, and the whole machine, fill the picture. */
    this.near = 1000;
    this.far = 1e4;
  }

  /**
   * Looks at a ball from a side. Yaw 0 looks along +y, positive yaw comes from +x, pitch from above.
   * @param {number} yaw
   * @param {number} pitch
   * @param {Vector} target
   * @param {number} radius
   * @param {number} aspect width by height of the picture
   */
  lookAt(yaw, pitch, target, radius, aspect) {
    [this.yaw, this.pitch, this.target] = [yaw, pitch, target];
    this.distance = this.distanceTo(radius, aspect);
  }

  /**
   * From how far a ball fills the picture.
   * @param {number} radius
   * @param {number} aspect width by height of the picture
   */
  distanceTo(radius, aspect) {
    return (radius * 1.05) / (Math.sin(HALF_VIEW) * Math.min(1, aspect));
  }

  /** A machine is solid from where it is seen as a whole, and faint from near, where it would hide the work. */
  opacityOfMachine() {
    const whole = this.far * 0.9;
    const close = Math.min(this.near * 1.5, whole * 0.8);
    const share = Math.max(0, Math.min(1, (this.distance - close) / (whole - close)));
    return FAINT + (1 - FAINT) * share;
  }

  /** Direction to the camera, and what is right and up in the picture. */
  axes() {
    const [sy, cy, sp, cp] = [Math.sin(this.yaw), Math.cos(this.yaw), Math.sin(this.pitch), Math.cos(this.pitch)];
    return {
      eye: /** @type {Vector} */ ([sy * cp, -cy * cp, sp]),
      right: /** @type {Vector} */ ([cy, sy, 0]),
      up: /** @type {Vector} */ ([-sy * sp, cy * sp, cp]),
    };
  }

  /**
   * @param {number} yaw
   * @param {number} pitch
   */
  orbit(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, this.pitch + pitch));
  }

  /** @param {number} factor */
  zoom(factor) {
    this.distance = Math.max(1, Math.min(this.farthest * 2, this.distance * factor));
  }

  /**
   * Moves the scene in the picture by shares of the picture's height.
   * @param {number} x
   * @param {number} y
   */
  pan(x, y) {
    const { right, up } = this.axes();
    const scale = 2 * this.distance * Math.tan(HALF_VIEW);
    this.target = /** @type {Vector} */ (this.target.map((at, i) => at - (right[i] * x - up[i] * y) * scale));
  }

  /**
   * The matrix from the scene to the picture.
   * @param {number} aspect
   * @returns {Matrix}
   */
  view(aspect) {
    const { eye, right, up } = this.axes();
    const at = this.target.map((part, i) => part + eye[i] * this.distance);
    const dot = (/** @type {Vector} */ a) => -(a[0] * at[0] + a[1] * at[1] + a[2] * at[2]);
    const looked = [
      right[0], up[0], eye[0], 0, right[1], up[1], eye[1], 0, right[2], up[2], eye[2], 0,
      dot(right), dot(up), dot(eye), 1,
    ];
    const near = Math.max(this.distance * 0.02, 0.05);
    const far = this.distance + this.farthest;
    const f = 1 / Math.tan(HALF_VIEW);
    const flat = [
      f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (near + far) / (near - far), -1, 0, 0, (2 * near * far) / (near - far), 0,
    ];
    return product(flat, looked);
  }
}

