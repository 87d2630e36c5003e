// A line drawn by hand on a canvas: by mouse, finger or pen, or by the arrow keys.

import { make, write } from "./elements.js";

/**
 * @typedef {import("./view.js").View} View
 * @typedef {{most: number, reach: number, eager: boolean, done: (points: number[][], byKeys: boolean) => void}} Wanted
 *   eager: the pen of the keyboard takes the focus.
 */

const APART = 3; // [px] between neighbours
const FEWEST = 4; // points of a line that can be followed
const DIGITS = 1e4; // a tenth of a millimetre
const STEP = 6; // [px] that an arrow key moves the pen
const STRIDE = 5; // steps with the shift key
/** @type {Record<string, number[]>} */
const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const LABEL = "Pen: the arrow keys move it, Space or Enter puts it down and lifts it, Escape takes the line away";

export class Ink {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {HTMLElement} over Lies over the canvas, with the same corner.
   * @param {() => void} changed
   */
  constructor(canvas, over, changed) {
    this.canvas = canvas;
    this.changed = changed;
    /** @type {Wanted | undefined} */
    this.wanted = undefined;
    /** @type {View | undefined} */
    this.view = undefined;
    /** @type {number[][]} Places in pixels. */
    this.line = [];
    this.drawing = false;
    /** @type {number[] | undefined} Where the pen of the keyboard is [px]. */
    this.tip = undefined;
    this.pen = make("div", { class: "pen", role: "application", tabindex: 0, "aria-label": LABEL, title: "Pen" });
    this.said = make("div", { class: "unseen", "aria-live": "polite" });
    this.pen.hidden = true;
    over.append(this.pen, this.said);
    canvas.addEventListener("pointerdown", (event) => this.#begin(event));
    canvas.addEventListener("pointermove", (event) => this.#go(event.offsetX, event.offsetY));
    canvas.addEventListener("pointerup", () => this.#end());
    canvas.addEventListener("pointercancel", () => this.#end());
    this.pen.addEventListener("keydown", (event) => this.#key(event));
  }

  /**
   * Wait for a line, or no longer.
   * @param {Wanted | undefined} wanted
   */
  wait(wanted) {
    this.wanted = wanted;
    this.canvas.classList.toggle("drawing", wanted !== undefined);
    this.pen.hidden = wanted === undefined;
    if (wanted?.eager) this.pen.focus({ preventScroll: true });
    if (wanted) return;
    this.tip = undefined;
    this.drawing = false;
    this.pen.classList.remove("down");
  }

  /**
   * Draw the line so far over the picture, and put the pen where it is.
   * @param {View} view
   */
  over(view) {
    this.view = view;
    if (this.wanted) this.#put();
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
    this.pen.classList.remove("down");
    this.drawing = true;
    this.line = [[event.offsetX, event.offsetY]];
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  #go(x, y) {
    if (!this.drawing) return;
    const [lastX, lastY] = this.line[this.line.length - 1];
    if (Math.hypot(x - lastX, y - lastY) < APART) return;
    this.line.push([x, y]);
    this.changed();
  }

  #end() {
    if (!this.drawing) return;
    this.drawing = false;
    const { wanted, view, line } = this;
    this.changed();
    if (!wanted || !view || line.length < FEWEST) return;
    const stride = Math.ceil(line.length / wanted.most);
    const kept = line.filter((_, i) => i % stride === 0);
    const bounded = (/** @type {number} */ v) =>
      Math.round(Math.max(-wanted.reach, Math.min(wanted.reach, v)) * DIGITS) / DIGITS;
    const points = kept.map(([x, y]) => view.place(x, y).map(bounded));
    wanted.done(points, document.activeElement === this.pen);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const by = ARROWS[event.key];
    if (!by && ![" ", "Enter", "Escape"].includes(event.key)) return;
    event.preventDefault();
    if (event.key === "Escape") this.#drop();
    else if (by) this.#move(by, event.shiftKey ? STRIDE : 1);
    else if (this.drawing) this.#lift();
    else this.#lower();
  }

  #lower() {
    this.drawing = true;
    this.line = [this.#place()];
    this.pen.classList.add("down");
    this.#say("Pen down");
    this.changed();
  }

  #lift() {
    this.pen.classList.remove("down");
    this.#say(this.line.length < FEWEST ? "Pen up, the line is too short" : "Pen up, the line is drawn");
    this.#end();
  }

  /** Without a line. */
  #drop() {
    if (!this.pen.classList.contains("down")) return;
    this.drawing = false;
    this.pen.classList.remove("down");
    this.changed();
  }

  /**
   * @param {number[]} by
   * @param {number} steps
   */
  #move([right, down], steps) {
    const { left, right: end, top, bottom } = /** @type {View} */ (this.view);
    for (let i = 0; i < steps; i++) {
      const [x, y] = this.#place();
      this.tip = [Math.min(end, Math.max(left, x + STEP * right)), Math.min(bottom, Math.max(top, y + STEP * down))];
      this.#go(this.tip[0], this.tip[1]);
    }
    this.#say("");
    this.changed();
  }

  /** Where the pen is; in the middle at first. */
  #place() {
    const view = /** @type {View} */ (this.view);
    return this.tip ?? [0.5 * (view.left + view.right), 0.5 * (view.top + view.bottom)];
  }

  #put() {
    const [x, y] = this.#place();
    this.pen.style.transform = `translate(${x}px, ${y}px)`;
  }

  /** @param {string} words */
  #say(words) {
    const view = /** @type {View} */ (this.view);
    const [right, down] = this.#place();
    const [x, y] = view.place(right, down);
    write(this.said, `${words && `${words}. `}x ${x.toFixed(2)}, y ${y.toFixed(2)}`);
  }
}
