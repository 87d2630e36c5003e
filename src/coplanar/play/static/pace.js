// Work that need not be done at every frame: the newest of it, once in a while, and never none of it.

export class Pace {
  /** @param {number} pause At least so long from one time to the next [ms]. */
  constructor(pause) {
    this.pause = pause;
    this.last = Number.NEGATIVE_INFINITY;
    /** @type {(() => void) | undefined} */
    this.work = undefined;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
  }

  /**
   * Do it when the pause is over, unless there is something newer by then.
   * @param {() => void} work
   */
  soon(work) {
    this.work = work;
    if (this.timer !== undefined) return;
    const wait = this.last + this.pause - performance.now();
    if (wait <= 0) this.now(work);
    else this.timer = setTimeout(() => this.work && this.now(this.work), wait);
  }

  /**
   * Do it at once, in place of what waits.
   * @param {() => void} work
   */
  now(work) {
    clearTimeout(this.timer);
    this.timer = undefined;
    this.work = undefined;
    this.last = performance.now();
    work();
  }
}
