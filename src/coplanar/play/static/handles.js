// What can be taken by hand: a real element over the drawing for each handle, for mouse, touch, pen and arrow keys.

import { make } from "./elements.js";

/**
 * @typedef {import("./types.js").Handle} Handle
 * @typedef {import("./view.js").View} View
 * @typedef {{drag: (handle: string, to: number[]) => void, nudge: (handle: string, by: number[]) => void,
 *   leave: () => void}} Moves
 */

/** @type {Record<string, number[]>} */
const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const STRIDE = 10; // steps with the shift key

/** The handles of one picture. */
export class Handles {
  /**
   * @param {HTMLElement} root Lies over the canvas, with the same corner.
   * @param {Moves} moves
   */
  constructor(root, moves) {
    this.root = root;
    this.moves = moves;
    /** @type {View | undefined} */
    this.view = undefined;
    /** @type {Map<string, HTMLElement>} */
    this.elements = new Map();
    this.taken = false; // one of them is in the hand
  }

  /**
   * Put the handles where Python says that they are.
   * @param {Handle[]} handles
   * @param {View} view
   */
  place(handles, view) {
    this.view = view;
    const wanted = new Set(handles.map((handle) => handle.id));
    for (const [id, element] of this.elements) {
      if (wanted.has(id)) continue;
      element.remove();
      this.elements.delete(id);
    }
    for (const handle of handles) this.#put(this.elements.get(handle.id) ?? this.#make(handle), handle, view);
  }

  /**
   * @param {HTMLElement} element
   * @param {Handle} handle
   * @param {View} view
   */
  #put(element, handle, view) {
    const [x, y] = handle.at;
    element.style.transform = `translate(${view.x(x)}px, ${view.y(y)}px)`;
    element.dataset.at = JSON.stringify(handle.at);
    element.setAttribute("aria-label", handle.label);
    element.setAttribute("aria-valuenow", String(x));
    element.setAttribute("aria-valuetext", handle.value);
    element.title = handle.label;
  }

  /** @param {Handle} handle */
  #make(handle) {
    const turns = handle.keys.unit === "rad";
    const element = make("div", { class: turns ? "handle turns" : "handle", role: "slider", tabindex: 0 });
    element.dataset.handle = handle.id;
    element.addEventListener("pointerdown", (event) => this.#take(event, element, handle.id));
    element.addEventListener("keydown", (event) => {
      const by = ARROWS[event.key];
      if (!by) return;
      event.preventDefault();
      const steps = event.shiftKey ? STRIDE : 1;
      this.moves.nudge(handle.id, [by[0] * steps, by[1] * steps]);
    });
    this.elements.set(handle.id, element);
    this.root.append(element);
    return element;
  }

  /**
   * Follow the pointer until it lets go; the distance between finger and handle stays.
   * @param {PointerEvent} event
   * @param {HTMLElement} element
   * @param {string} id
   */
  #take(event, element, id) {
    const { view } = this;
    if (event.button !== 0 || !view) return;
    event.preventDefault();
    element.focus({ preventScroll: true });
    element.setPointerCapture(event.pointerId);
    element.classList.add("taken");
    this.taken = true;
    const [x, y] = JSON.parse(element.dataset.at ?? "[0, 0]");
    const [dx, dy] = [view.x(x) - event.clientX, view.y(y) - event.clientY];
    const move = (/** @type {PointerEvent} */ moved) => {
      this.moves.drag(id, view.place(moved.clientX + dx, moved.clientY + dy));
    };
    const leave = () => {
      element.removeEventListener("pointermove", move);
      element.classList.remove("taken");
      this.taken = false;
      this.moves.leave();
    };
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", leave, { once: true });
    element.addEventListener("pointercancel", leave, { once: true });
  }
}
