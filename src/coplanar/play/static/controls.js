// The panel of controls of a tab.

import { make, write } from "./elements.js";
import { widget } from "./widgets.js";

/**
 * @typedef {import("./types.js").Control} Control
 * @typedef {import("./types.js").State} State
 * @typedef {import("./widgets.js").Widget} Widget
 * @typedef {(key: string, value: any, live: boolean) => void} Edit
 */

/**
 * Whether a control matters in a state.
 * @param {Control} control
 * @param {State} state
 */
export function matters(control, state) {
  return Object.entries(control.only ?? {}).every(([key, values]) => values.includes(state[key]));
}

/**
 * @param {any} a
 * @param {any} b
 */
function same(a, b) {
  return a === b || (typeof a === "object" && JSON.stringify(a) === JSON.stringify(b));
}

/** Controls by group, shown where they matter. */
export class Panel {
  /**
   * @param {HTMLElement} root
   * @param {Edit} edit
   */
  constructor(root, edit) {
    this.root = root;
    this.edit = edit;
    /** @type {{control: Control, widget: Widget}[]} */
    this.parts = [];
    /** @type {State} */
    this.state = {};
  }

  /**
   * @param {Control[]} controls
   * @param {() => void} reset Puts everything back.
   */
  build(controls, reset) {
    this.parts = controls.map((control) => ({ control, widget: this.#part(control) }));
    const groups = [...new Set(controls.map((control) => control.group))].map((group) => {
      const inside = this.parts.filter((part) => part.control.group === group).map((part) => part.widget.element);
      return make("details", { open: true }, make("summary", {}, group || "Settings"), ...inside);
    });
    const again = make("button", { type: "button", class: "wide" }, "Reset everything");
    again.addEventListener("click", reset);
    this.root.replaceChildren(...groups, again);
  }

  /**
   * @param {State} state
   * @param {boolean} held A hand moves the picture: what is as it was stays untouched.
   */
  update(state, held) {
    const changed = this.parts.filter(({ control: { key } }) => !same(state[key], this.state[key]));
    this.state = state;
    if (held && changed.every(({ control }) => control.kind === "slider")) {
      for (const { control, widget: part } of changed) part.set(state[control.key]);
      return;
    }
    for (const { control, widget: part } of this.parts) {
      part.element.hidden = !matters(control, state);
      part.set(state[control.key]);
    }
    for (const group of this.root.querySelectorAll("details")) {
      group.hidden = !group.querySelector(":scope > .control:not([hidden])");
    }
  }

  /**
   * @param {Control} control
   * @returns {Widget}
   */
  #part(control) {
    const { key } = control;
    if (control.kind === "list") return rows(control, (value, live) => this.edit(key, value, live));
    return widget(control, `control-${key}`, (value, live) => this.edit(key, value, live));
  }
}

/**
 * A list of rows of the same fields, with rows added and taken away.
 * @param {Control} control
 * @param {(value: any, live: boolean) => void} report
 * @returns {Widget}
 */
function rows(control, report) {
  /** @type {State[]} */
  let values = [];
  /** @type {{control: Control, widget: Widget}[][]} */
  let parts = [];
  const { fields = [], row = "row", first = 1, min = 1, max = 8 } = control;
  const list = make("div", { class: "rows" });
  const add = make("button", { type: "button", class: "wide" }, `Add a ${row}`);
  const count = make("p", { class: "help" });
  add.addEventListener("click", () => report([...values, { ...values[values.length - 1] }], false));

  /** @param {number} i */
  const build = (i) => {
    const take = make("button", { type: "button", class: "reset" }, "\u00d7");
    const called = `${row} ${i + first}`;
    take.setAttribute("aria-label", `Take away ${called}`);
    take.title = `Take away ${called}`;
    take.addEventListener("click", () => report([...values.slice(0, i), ...values.slice(i + 1)], false));
    take.classList.toggle("idle", values.length <= min);
    const inside = fields.map((field) => ({
      control: field,
      widget: widget(field, `control-${control.key}-${i}-${field.key}`, (value, live) => {
        const changed = { ...values[i], [field.key]: value };
        report([...values.slice(0, i), changed, ...values.slice(i + 1)], live);
      }),
    }));
    const head = make("div", { class: "row" }, make("h4", {}, called), take);
    const name = { class: "one", role: "group", "aria-label": called };
    return { inside, element: make("div", name, head, ...inside.map((part) => part.widget.element)) };
  };

  return {
    element: make("div", { class: "control list" }, list, add, count),
    set(/** @type {State[]} */ value) {
      const other = value.length !== values.length;
      values = value;
      if (other) {
        const built = value.map((_, i) => build(i));
        parts = built.map(({ inside }) => inside);
        list.replaceChildren(...built.map(({ element }) => element));
      }
      parts.forEach((inside, i) => {
        for (const { control: field, widget: part } of inside) {
          part.element.hidden = !matters(field, values[i]);
          part.set(values[i][field.key]);
        }
      });
      add.disabled = values.length >= max;
      write(count, `${values.length} of at most ${max}`);
    },
  };
}
