// The pictures of a tab: a canvas each, the handles over it, and the line that is drawn by hand.

import { drawScene } from "./draw.js";
import { make, write } from "./elements.js";
import { Framing } from "./framing.js";
import { Handles } from "./handles.js";
import { Ink } from "./ink.js";
import { Legend } from "./legend.js";
import { View } from "./view.js";

/**
 * @typedef {import("./types.js").Shown} Shown
 * @typedef {import("./types.js").SceneData} SceneData
 * @typedef {import("./types.js").Handle} Handle
 * @typedef {{name: string, figure: HTMLElement, canvas: HTMLCanvasElement, handles: Handles, ink: Ink,
 *   framing: Framing, legend: Legend, scene: SceneData}} Picture
 */

export class Stage {
  /**
   * @param {HTMLElement} main Holds the first picture.
   * @param {HTMLElement} extras Holds the others.
   * @param {import("./handles.js").Moves} moves
   * @param {() => number} time
   */
  constructor(main, extras, moves, time) {
    this.main = main;
    this.extras = extras;
    this.moves = moves;
    this.time = time;
    /** @type {Map<string, Picture>} */
    this.pictures = new Map();
    /** @type {Handle[]} */
    this.handles = [];
    this.asked = false;
    this.frames = 0;
    this.sizes = new ResizeObserver(() => this.redraw());
  }

  /**
   * Take new pictures; they are drawn with the next frame.
   * @param {Shown} shown
   * @param {string} about What the first picture is, for those who do not see it.
   */
  show(shown, about) {
    for (const [name, picture] of this.pictures) {
      if (!(name in shown.pictures)) this.#remove(picture);
    }
    for (const [name, scene] of Object.entries(shown.pictures)) {
      const picture = this.pictures.get(name) ?? this.#add(name, scene);
      picture.scene = scene;
      const places = shown.handles.filter((handle) => handle.picture === name).map((handle) => handle.at);
      picture.framing.take(scene, places, this.held() || picture.ink.wanted !== undefined);
      picture.legend.show(shown.legends[name] ?? []);
      picture.canvas.setAttribute("aria-label", name === "main" ? about : captioned(name));
    }
    this.handles = shown.handles;
    this.redraw();
  }

  /** Whether a handle is in the hand. */
  held() {
    return [...this.pictures.values()].some((picture) => picture.handles.taken);
  }

  /** The hand rests. */
  rest() {
    if (this.held()) return;
    for (const picture of this.pictures.values()) {
      if (!picture.ink.wanted) picture.framing.rest();
    }
  }

  /** Another tab: nothing of the old pictures stays. */
  clear() {
    for (const picture of this.pictures.values()) this.#remove(picture);
  }

  /** Draw everything with the next frame. */
  redraw() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.frames += 1;
      for (const picture of this.pictures.values()) this.#draw(picture);
    });
  }

  /**
   * Let a line be drawn on a picture, or no longer.
   * @param {string} name
   * @param {import("./ink.js").Wanted | undefined} wanted
   */
  draw(name, wanted) {
    for (const picture of this.pictures.values()) {
      picture.ink.wait(picture.name === name ? wanted : undefined);
      if (picture.ink.wanted) picture.framing.open(picture.scene);
    }
  }

  /** @param {Picture} picture */
  #draw(picture) {
    const { canvas, scene } = picture;
    const view = new View(picture.framing.bounds, canvas.clientWidth, canvas.clientHeight, 0);
    drawScene(canvas, scene, this.time(), view);
    picture.ink.over(view);
    const here = this.handles.filter((handle) => handle.picture === picture.name);
    picture.handles.place(here, view);
  }

  /**
   * @param {string} name
   * @param {SceneData} scene
   * @returns {Picture}
   */
  #add(name, scene) {
    const canvas = make("canvas", { role: "img" });
    const over = make("div", { class: "handles" });
    const caption = make("figcaption");
    const legend = new Legend();
    const figure = make("figure", { class: "picture" }, canvas, over, caption, legend.root);
    figure.dataset.picture = name;
    write(caption, name === "main" ? "" : captioned(name));
    caption.hidden = name === "main";
    const ink = new Ink(canvas, over, () => this.redraw());
    const handles = new Handles(over, {
      drag: (id, to) => this.moves.drag(id, to),
      nudge: (id, by) => this.moves.nudge(id, by),
      leave: () => this.moves.leave(),
    });
    const framing = new Framing(() => this.redraw());
    const picture = { name, figure, canvas, handles, ink, framing, legend, scene };
    this.pictures.set(name, picture);
    (name === "main" ? this.main : this.extras).append(figure);
    this.sizes.observe(canvas);
    return picture;
  }

  /** @param {Picture} picture */
  #remove(picture) {
    this.sizes.unobserve(picture.canvas);
    picture.figure.remove();
    this.pictures.delete(picture.name);
  }
}

/** @param {string} name */
function captioned(name) {
  return name.charAt(0).toUpperCase() + name.slice(1).replaceAll("_", " ");
}
