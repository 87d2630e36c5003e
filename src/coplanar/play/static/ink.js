// A line drawn by hand on a canvas.

/**
 * @typedef {import("./view.js").View} View
 * @typedef {{most: number, reach: number, done: (points: number[][]) => void}} Wanted
 */

const APART = 3; // [px] between neighbours
const DIGITS = 1e4; // a tenth of a millimetre

export class Ink {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {() => void} changed
   */
  constructor(canvas, changed) {
    this.canvas = canvas;
    this.changed = changed;
    /** @type {Wanted | undefined} */
    this.wanted = undefined;
    /** @type {View | undefined} */
    this.view = undefined;
    /** @type {number[][]} Places in pixels. */
    this.line = [];
    this.drawing = false;
    canvas.addEventListener("pointerdown", (event) => this.#begin(event));
    canvas.addEventListener("pointermove", (event) => this.#go(event));
    canvas.addEventListener("pointerup", () => this.#end());
    canvas.addEventListener("pointercancel", () => this.#end());
  }

  /**
   * Wait for a line, or no longer.
   * @param {Wanted | undefined} wanted
   */
  wait(wanted) {
    this.wanted = wanted;
    this.canvas.classList.toggle("drawing", wanted !== undefined);
  }

  /**
   * Draw the line so far over the picture.
   * @param {View} view
   */
  over(view) {
    this.view = view;
    const ctx = this.canvas.getContext("2d");
    if (!ctx || !this.drawing) return;
    ctx.strokeStyle = getComputedStyle(this.canvas).getPropertyValue("--trail");
    ctx.setLineDash([]);
    ctx.lineWidth = 2.5;
    ctx.beginPath();
    for (const [x, y] of this.line) ctx.lineTo(x, y);
    ctx.stroke();
  }

  /** @param {PointerEvent} event */
  #begin(event) {
    if (!this.wanted || event.button !== 0) return;
    event.preventDefault();
    this.canvas.setPointerCapture(event.pointerId);
    this.drawing = true;
    this.line = [[event.offsetX, event.offsetY]];
  }

  /** @param {PointerEvent} event */
  #go(event) {
    if (!this.drawing) return;
    const [x, y] = this.line[this.line.length - 1];
    if (Math.hypot(event.offsetX - x, event.offsetY - y) < APART) return;
    this.line.push([event.offsetX, event.offsetY]);
    this.changed();
  }

  #end() {
    if (!this.drawing) return;
    this.drawing = false;
    const { wanted, view, line } = this;
    this.changed();
    if (!wanted || !view || line.length < 2) return;
    const stride = Math.ceil(line.length / wanted.most);
    const kept = line.filter((_, i) => i % stride === 0);
    const bounded = (/** @type {number} */ v) =>
      Math.round(Math.max(-wanted.reach, Math.min(wanted.reach, v)) * DIGITS) / DIGITS;
    wanted.done(kept.map(([x, y]) => view.place(x, y).map(bounded)));
  }
}
