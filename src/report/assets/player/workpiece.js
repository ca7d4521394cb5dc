// The stock's section as time goes on and back: chips are taken out one by one, with the surface kept at times on the way.

/** How many chips lie between two surfaces that are kept. */
const BETWEEN_KEPT = 256;

class Workpiece {
  /** @param {Timeline} timeline */
  constructor(timeline) {
    const [width, , height] = timeline.program.stock;
    this.chips = timeline.chips;
    this.surface = new Surface(width, height);
    this.taken = 0;
    this.kept = [this.surface.clone()];
    const { pockets, spine } = timeline.program;
    /** over the plan, where regions of it are cleared and sections are the same at every y */
    this.ground = pockets.size > 0 && spine.every(([, rise]) => rise === 0) ? new Ground(timeline) : null;
  }

  /**
   * Goes to a time, when so many chips are out. Tells whether anything changed.
   * @param {number} count
   * @param {Moment} moment
   */
  goTo(count, moment) {
    const isOtherGround = this.ground !== null && this.ground.goTo(moment);
    return this.takeOut(count) || isOtherGround;
  }

  /**
   * The stock as it is, as triangles.
   * @param {Program} program
   */
  mesh({ spine, stock }) {
    if (this.ground !== null) return this.ground.mesh(this.surface);
    return swept(this.surface.corners(), spine, stock[2]);
  }

  /**
   * How high the stock stands over a place of the plan, without what it rises along y.
   * @param {number} x
   * @param {number} y
   */
  heightAt(x, y) {
    const section = Math.min(...this.surface.sides(x));
    return this.ground === null ? section : Math.min(section, this.ground.heightAt(x, y));
  }

  /**
   * Goes to where so many chips are out. Tells whether anything changed.
   * @param {number} count
   */
  takeOut(count) {
    if (count === this.taken) return false;
    const kept = Math.min(Math.floor(count / BETWEEN_KEPT), this.kept.length - 1);
    if (count < this.taken || kept * BETWEEN_KEPT > this.taken) {
      this.surface = this.kept[kept].clone();
      this.taken = kept * BETWEEN_KEPT;
    }
    while (this.taken < count) {
      const { vee, floor } = this.chips[this.taken];
      if (floor !== undefined) this.surface.lower(floor);
      else this.surface.release(vee);
      this.taken += 1;
      if (this.taken === this.kept.length * BETWEEN_KEPT) this.kept.push(this.surface.clone());
    }
    return true;
  }
}

