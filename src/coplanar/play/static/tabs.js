// The list of tabs, as assistive technology knows it: one stop for the tab key, arrow keys inside.

import { make } from "./elements.js";

/** @typedef {import("./types.js").Tab} Tab */

export class Tabs {
  /**
   * @param {HTMLElement} root
   * @param {HTMLElement} panel
   * @param {(name: string) => void} choose
   */
  constructor(root, panel, choose) {
    this.root = root;
    this.panel = panel;
    this.choose = choose;
    root.addEventListener("keydown", (event) => this.#key(event));
  }

  /** @param {Tab[]} tabs */
  build(tabs) {
    const buttons = tabs.map(({ name, title, about }) => {
      const id = `tab-${name}`;
      const attributes = { type: "button", role: "tab", id, "aria-controls": this.panel.id, title: about };
      const button = make("button", attributes, title);
      button.addEventListener("click", () => this.choose(name));
      return button;
    });
    this.root.replaceChildren(...buttons);
  }

  /** @param {string} name */
  select(name) {
    for (const tab of this.#all()) {
      const chosen = tab.id === `tab-${name}`;
      tab.setAttribute("aria-selected", String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      if (chosen) tab.scrollIntoView({ block: "nearest", inline: "nearest" });
    }
    this.panel.setAttribute("aria-labelledby", `tab-${name}`);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const all = this.#all();
    const now = all.findIndex((tab) => tab.matches(":focus"));
    const next = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: all.length - 1 }[event.key];
    if (next === undefined || now < 0) return;
    event.preventDefault();
    const tab = all[(next + all.length) % all.length];
    tab.focus();
    tab.click();
  }

  #all() {
    return [...this.root.querySelectorAll("button")];
  }
}
