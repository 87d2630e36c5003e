// Play, pause, step, scrub, speed.

import { byId, write } from "./elements.js";

/** @typedef {import("./player.js").Clock} Clock */

export class Transport {
  /** @param {Clock} clock */
  constructor(clock) {
    this.clock = clock;
    this.root = byId("transport", HTMLElement);
    this.button = byId("play", HTMLButtonElement);
    this.scrub = byId("scrub", HTMLInputElement);
    this.output = byId("clock", HTMLOutputElement);
    const speed = byId("speed", HTMLSelectElement);
    this.button.addEventListener("click", () => clock.toggle());
    byId("back", HTMLButtonElement).addEventListener("click", () => clock.step(-1));
    byId("forth", HTMLButtonElement).addEventListener("click", () => clock.step(1));
    speed.addEventListener("change", () => {
      clock.speed = Number(speed.value);
    });
    this.scrub.addEventListener("input", () => {
      clock.pause();
      clock.seek(clock.start + (Number(this.scrub.value) / 1000) * (clock.end - clock.start));
    });
  }

  /** Show the clock. */
  show() {
    const { clock } = this;
    this.root.hidden = clock.end <= clock.start;
    this.root.classList.toggle("playing", clock.playing);
    this.button.setAttribute("aria-label", clock.playing ? "Pause" : "Play");
    this.scrub.value = String(Math.round(1000 * clock.part));
    const text = `${clock.time.toFixed(2)} s`;
    this.scrub.setAttribute("aria-valuetext", text);
    write(this.output, `${clock.time.toFixed(2)} / ${clock.end.toFixed(1)} s`);
  }
}
