// Which part of the plane a picture shows: what is there, in view, without jumping under the hand.

import { grouped } from "./view.js";

/**
 * @typedef {import("./view.js").SceneData} SceneData
 * @typedef {import("./view.js").Layer} Layer
 * @typedef {number[]} Bounds xmin, xmax, ymin, ymax
 */

const ROOM = 0.07; // around what is drawn, over its larger side
const LEAST = 0.2; // of Python's own bounds: nothing is shown larger
const SMALL = 0.72; // of the view: what is smaller than this comes closer when the hand rests
const GLIDE = 220; // [ms]

/**
 * The box around everything in a scene.
 * @param {SceneData} scene
 * @param {number[][]} places Others to be seen.
 * @returns {Bounds}
 */
export function extentOf(scene, places) {
  const box = [Infinity, -Infinity, Infinity, -Infinity];
  for (const [x, y] of places) include(box, x, y, 0);
  for (const layer of scene.layers) includeLayer(box, layer);
  return box;
}

/**
 * What a layer covers, as circles of the plane: x, y, radius.
 * @type {Record<string, (layer: Layer) => number[][]>}
 */
const COVERS = {
  region: ({ rings = [] }) => rings.flat().map(([x, y]) => [x, y, 0]),
  discs: ({ circles = [] }) => circles.flatMap((row) => grouped(row, 3)),
  arrows: ({ vectors = [] }) =>
    vectors.flatMap((row) =>
      grouped(row, 4).flatMap(([x, y, dx, dy]) => [
        [x, y, 0],
        [x + dx, y + dy, 0],
      ]),
    ),
  segments: ({ ends = [] }) => dots(/** @type {number[][]} */ (ends)),
  linkage: ({ joints = [] }) => dots(joints),
  body: ({ poses = [], outline = [] }) => around(poses, outline.flat()),
  carried: ({ poses = [], ends = [] }) => around(poses, ends.flat()),
};

/** @param {number[][]} rows of x, y, x, y, ... */
function dots(rows) {
  return rows.flatMap((row) => grouped(row, 2).map(([x, y]) => [x, y, 0]));
}

/**
 * @param {number[][]} poses
 * @param {number[]} shape numbers in the body's frame
 */
function around(poses, shape) {
  const reach = Math.max(0, ...shape.map(Math.abs));
  return poses.map(([x, y]) => [x, y, reach]);
}

/**
 * @param {Bounds} box
 * @param {Layer} layer
 */
function includeLayer(box, layer) {
  const covered = COVERS[layer.kind]?.(layer) ?? dots(layer.points ?? []);
  for (const [x, y, radius] of covered) include(box, x, y, radius);
}

/**
 * @param {Bounds} box
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 */
function include(box, x, y, radius) {
  box[0] = Math.min(box[0], x - radius);
  box[1] = Math.max(box[1], x + radius);
  box[2] = Math.min(box[2], y - radius);
  box[3] = Math.max(box[3], y + radius);
}

/** The bounds of one picture, from answer to answer. */
export class Framing {
  /** @param {() => void} changed Asks for another drawing. */
  constructor(changed) {
    this.changed = changed;
    /** @type {Bounds} */
    this.bounds = [];
    /** @type {Bounds} */
    this.wanted = [];
    this.extent = /** @type {Bounds} */ ([]);
    this.gliding = 0;
  }

  /**
   * Take what is drawn now.
   * @param {SceneData} scene
   * @param {number[][]} places
   * @param {boolean} held A handle is in the hand: the view stands still.
   */
  take(scene, places, held) {
    const [left, right, low, high] = scene.bounds;
    const largest = Math.max(right - left, high - low);
    const found = extentOf(scene, places);
    const seen = [
      Math.max(found[0], left),
      Math.min(found[1], right),
      Math.max(found[2], low),
      Math.min(found[3], high),
    ];
    for (const [x, y] of places) include(seen, x, y, 0);
    const side = Math.max(seen[1] - seen[0], seen[3] - seen[2], LEAST * largest);
    this.extent = seen;
    this.wanted = [...padded(seen[0], seen[1], side), ...padded(seen[2], seen[3], side)];
    if (this.bounds.length === 0) this.bounds = this.wanted;
    else if (!held && this.#leaves()) this.#go(union(this.bounds, this.wanted), false);
  }

  /**
   * Show all that Python would: there is room to draw in.
   * @param {SceneData} scene
   */
  open(scene) {
    if (this.bounds.some((value, i) => value !== scene.bounds[i])) this.#go(scene.bounds, false);
  }

  /** The hand rests: come closer, or step back, where that shows more. */
  rest() {
    if (this.bounds.length === 0) return;
    const smaller = Math.max(span(this.wanted, 0) / span(this.bounds, 0), span(this.wanted, 2) / span(this.bounds, 2));
    if (this.#leaves() || smaller < SMALL) this.#go(this.wanted, true);
  }

  #leaves() {
    const [a, b] = [this.extent, this.bounds];
    return a[0] < b[0] || a[1] > b[1] || a[2] < b[2] || a[3] > b[3];
  }

  /**
   * @param {Bounds} to
   * @param {boolean} gently
   */
  #go(to, gently) {
    this.gliding += 1;
    if (!gently || matchMedia("(prefers-reduced-motion: reduce)").matches) {
      this.bounds = to;
      this.changed();
      return;
    }
    const turn = this.gliding;
    const from = this.bounds;
    const start = performance.now();
    const step = (/** @type {number} */ now) => {
      if (turn !== this.gliding) return;
      const part = Math.min(1, Math.max(0, (now - start) / GLIDE));
      const eased = part * part * (3 - 2 * part);
      this.bounds = from.map((value, i) => value + eased * (to[i] - value));
      this.changed();
      if (part < 1) requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }
}

/**
 * @param {number} low
 * @param {number} high
 * @param {number} side At least half of it is shown, and some room.
 */
function padded(low, high, side) {
  const half = Math.max(0.5 * (high - low), 0.25 * side) + ROOM * side;
  return [0.5 * (low + high) - half, 0.5 * (low + high) + half];
}

/**
 * @param {Bounds} a
 * @param {Bounds} b
 */
function union(a, b) {
  return a.map((value, i) => (i % 2 === 0 ? Math.min(value, b[i]) : Math.max(value, b[i])));
}

/**
 * @param {Bounds} bounds
 * @param {number} i
 */
function span(bounds, i) {
  return bounds[i + 1] - bounds[i];
}
