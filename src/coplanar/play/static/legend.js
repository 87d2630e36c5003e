// What the lines of a picture are.

import { make } from "./elements.js";

/** @typedef {import("./types.js").Line} Line */

export class Legend {
  constructor() {
    this.root = make("ul", { class: "legend", "aria-label": "Legend" });
    this.root.hidden = true;
    this.shape = "[]";
  }

  /** @param {Line[]} lines */
  show(lines) {
    const shape = JSON.stringify(lines);
    if (shape === this.shape) return;
    this.shape = shape;
    this.root.hidden = lines.length === 0;
    this.root.replaceChildren(
      ...lines.map(({ label, role, dashed }) => {
        const sample = make("span", { class: dashed ? "sample dashed" : "sample", "aria-hidden": "true" });
        sample.style.setProperty("--line-colour", `var(--${role})`);
        return make("li", {}, sample, label);
      }),
    );
  }
}
