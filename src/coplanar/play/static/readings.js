// What the library says of a state: sentences and numbers.

import { make, raised, write } from "./elements.js";

/**
 * @typedef {import("./types.js").Sentence} Sentence
 * @typedef {import("./types.js").Readout} Readout
 */

const MARKS = { good: "\u2713", note: "i", warn: "!", no: "\u2715" };
const WORDS = { good: "Good: ", note: "", warn: "Warning: ", no: "No: " };
const QUIET = 800; // [ms] without a change before something is said aloud

export class Readings {
  /**
   * @param {HTMLElement} sentences
   * @param {HTMLElement} readouts
   * @param {HTMLElement} spoken A live region that is not seen.
   */
  constructor(sentences, readouts, spoken) {
    this.sentences = sentences;
    this.readouts = readouts;
    this.spoken = spoken;
    this.shape = "";
    /** @type {HTMLElement[]} */
    this.values = [];
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
  }

  /** @param {Sentence[]} sentences */
  say(sentences) {
    const items = [...this.sentences.children];
    sentences.forEach(({ tone, text }, i) => {
      const item = items[i] ?? this.sentences.appendChild(sentence());
      item.className = `sentence ${tone}`;
      write(item.children[0], MARKS[tone]);
      write(item.children[1], text);
    });
    for (const item of items.slice(sentences.length)) item.remove();
    const text = sentences.map(({ tone, text: words }) => `${WORDS[tone]}${words}.`).join(" ");
    clearTimeout(this.timer);
    this.timer = setTimeout(() => write(this.spoken, text), QUIET);
  }

  /** @param {Readout[]} readouts */
  read(readouts) {
    const shape = readouts.map(({ group, key, label, unit }) => [group, key, label, unit].join()).join();
    if (shape !== this.shape) this.#build(readouts);
    this.shape = shape;
    readouts.forEach(({ value }, i) => {
      write(this.values[i], value.replace(/^-/, "\u2212"));
    });
  }

  /** @param {Readout[]} readouts */
  #build(readouts) {
    this.values = readouts.map(({ key }) => make("span", { class: "value", "data-readout": key }));
    const groups = [...new Set(readouts.map((readout) => readout.group))].map((group) => {
      const rows = readouts.flatMap((readout, i) => (readout.group === group ? [row(readout, this.values[i])] : []));
      return make("section", {}, make("h3", {}, group || "Numbers"), make("dl", {}, ...rows));
    });
    this.readouts.replaceChildren(...groups);
  }
}

function sentence() {
  return make("li", {}, make("span", { class: "mark", "aria-hidden": "true" }), make("span"));
}

/**
 * @param {Readout} readout
 * @param {HTMLElement} value
 */
function row({ label, unit }, value) {
  return make("div", {}, make("dt", {}, label), make("dd", {}, value, make("span", { class: "unit" }, raised(unit))));
}
