// Plays a scene: a clock, and a canvas with buttons of its own.

import { drawScene } from "./draw.js";

/** @typedef {import("./view.js").SceneData} SceneData */

/** The time of an animation: play, pause, step, seek, speed. */
export class Clock {
  /** @param {(clock: Clock) => void} changed Called whenever the time or the playing changes. */
  constructor(changed) {
    this.changed = changed;
    this.start = 0;
    this.end = 0;
    this.time = 0;
    this.speed = 1;
    this.playing = false;
    /** @type {number | undefined} */
    this.last = undefined;
  }

  /** The part of the way from start to end, 0 to 1. */
  get part() {
    return this.end > this.start ? (this.time - this.start) / (this.end - this.start) : 1;
  }

  /**
   * Take another interval, keeping the part of the way.
   * @param {number[]} times
   */
  span(times) {
    const part = this.part;
    this.start = times[0];
    this.end = times[times.length - 1];
    this.time = this.start + part * (this.end - this.start);
    if (this.end <= this.start) this.playing = false;
  }

  /** @param {number} t */
  seek(t) {
    this.time = Math.min(this.end, Math.max(this.start, t));
    this.changed(this);
  }

  /** @param {number} steps Hundredths of the interval. */
  step(steps) {
    this.pause();
    this.seek(this.time + (steps / 100) * (this.end - this.start));
  }

  play() {
    if (this.playing || this.end <= this.start) return;
    this.playing = true;
    this.last = undefined;
    if (this.time >= this.end) this.time = this.start;
    this.changed(this);
    requestAnimationFrame((now) => this.#tick(now));
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    this.changed(this);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  /** @param {number} now */
  #tick(now) {
    if (!this.playing) return;
    const elapsed = this.last === undefined ? 0 : Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    const next = this.time + elapsed * this.speed;
    this.seek(next > this.end ? this.start : next);
    requestAnimationFrame((later) => this.#tick(later));
  }
}

/**
 * The element of that kind inside another.
 * @template {Element} E
 * @param {ParentNode} root
 * @param {string} selector
 * @param {new () => E} kind
 * @returns {E}
 */
function part(root, selector, kind) {
  const found = root.querySelector(selector);
  if (!(found instanceof kind)) throw new Error(`no ${selector}`);
  return found;
}

/** A canvas with play, pause, step, scrub and speed; space and the arrow keys do the same. */
export class Player {
  /**
   * @param {HTMLElement} root Holds a canvas, a button, a range, a select and an output.
   * @param {SceneData} scene
   */
  constructor(root, scene) {
    this.scene = scene;
    this.visible = false;
    this.canvas = part(root, "canvas", HTMLCanvasElement);
    this.button = part(root, "button", HTMLButtonElement);
    this.slider = part(root, "input", HTMLInputElement);
    this.output = part(root, "output", HTMLOutputElement);
    this.clock = new Clock(() => this.show());
    this.clock.span(scene.times);
    this.clock.time = this.clock.start;
    this.listen(root);
    this.show();
  }

  /** @param {HTMLElement} root */
  listen(root) {
    const { clock, slider } = this;
    const speed = part(root, "select", HTMLSelectElement);
    this.button.addEventListener("click", () => clock.toggle());
    slider.addEventListener("input", () => {
      clock.pause();
      clock.seek(clock.start + (Number(slider.value) / 1000) * (clock.end - clock.start));
    });
    speed.addEventListener("change", () => {
      clock.speed = Number(speed.value);
    });
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.show()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.show());
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    new IntersectionObserver(([entry]) => {
      const entered = entry.isIntersecting && !this.visible;
      this.visible = entry.isIntersecting;
      if (!this.visible) clock.pause();
      else if (entered && !calm) clock.play();
    }).observe(this.canvas);
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    if (event.key === " ") this.clock.toggle();
    else if (event.key === "ArrowRight") this.clock.step(1);
    else if (event.key === "ArrowLeft") this.clock.step(-1);
    else return;
    event.preventDefault();
  }

  show() {
    const { clock } = this;
    this.button.textContent = clock.playing ? "Pause" : "Play";
    this.slider.value = String(Math.round(1000 * clock.part));
    this.output.textContent = `${clock.time.toFixed(2)} s`;
    drawScene(this.canvas, this.scene, clock.time);
  }
}

/**
 * Start a player in every element that holds a scene.
 * @param {ParentNode} root
 */
export function startPlayers(root) {
  for (const element of root.querySelectorAll(".player")) {
    const data = element.querySelector("script[type='application/json']");
    if (element instanceof HTMLElement && data) new Player(element, JSON.parse(data.textContent ?? ""));
  }
}
