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
  }

  /**
   * Goes to where so many chips are out. Tells whether anything changed.
   * @param {number} count
   */
  goTo(count) {
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

