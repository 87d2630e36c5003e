// One form element for each kind of control that holds a single value.

import { make, raised, write } from "./elements.js";

/**
 * @typedef {import("./types.js").Control} Control
 * @typedef {(value: any, live: boolean) => void} Report
 * @typedef {{element: HTMLElement, set: (value: any) => void}} Widget
 */

const LOG_STEPS = 1000;

/**
 * A number as it is read in a box.
 * @param {number} value
 */
function shown(value) {
  return String(Number(value.toPrecision(5)));
}

/**
 * Positions of a slider are whole numbers, so that its values are whole multiples of the step.
 * @param {Control} control
 */
function ruler({ min = 0, max = 1, step = 0.01, scale }) {
  if (scale === "log") {
    const span = Math.log(max / min);
    return {
      low: 0,
      high: LOG_STEPS,
      value: (/** @type {number} */ k) =>
        Math.min(max, Math.max(min, Number((min * Math.exp((span * k) / LOG_STEPS)).toPrecision(3)))),
      place: (/** @type {number} */ value) => Math.round((LOG_STEPS * Math.log(value / min)) / span),
    };
  }
  return {
    low: Math.ceil(min / step - 1e-9),
    high: Math.floor(max / step + 1e-9),
    value: (/** @type {number} */ k) => Number((k * step).toPrecision(12)),
    place: (/** @type {number} */ value) => Math.round(value / step),
  };
}

/**
 * @param {Control} control
 * @param {string} id
 * @param {Report} report
 * @returns {Widget}
 */
function slider(control, id, report) {
  const { label, unit = "" } = control;
  const marks = ruler(control);
  const range = make("input", { type: "range", id, min: marks.low, max: marks.high, step: 1 });
  const box = make("input", {
    type: "number",
    id: `${id}-box`,
    min: control.min,
    max: control.max,
    step: "any",
    "aria-label": `${label}${unit && ` in ${unit}`}`,
  });
  const reset = make("button", { type: "button", class: "reset", title: "Reset" }, "\u21ba");
  reset.setAttribute("aria-label", `Reset ${label} to ${shown(control.default)} ${unit}`.trim());
  const hint = control.help ? make("p", { class: "help", id: `${id}-help` }, control.help) : "";
  if (hint) range.setAttribute("aria-describedby", `${id}-help`);
  range.addEventListener("input", () => report(marks.value(Number(range.value)), true));
  range.addEventListener("change", () => report(marks.value(Number(range.value)), false));
  box.addEventListener("change", () => box.value !== "" && report(Number(box.value), false));
  reset.addEventListener("click", () => report(control.default, false));
  const head = make(
    "div",
    { class: "row" },
    make("label", { for: id }, label),
    box,
    make("span", { class: "unit" }, raised(unit)),
  );
  const element = make("div", { class: "control slider" }, head, make("div", { class: "row" }, range, reset), hint);
  return {
    element,
    set(value) {
      range.value = String(marks.place(value));
      range.setAttribute("aria-valuetext", `${shown(value)} ${unit}`.trim());
      if (document.activeElement !== box || Number(box.value) !== value) box.value = shown(value);
      reset.classList.toggle("idle", value === control.default);
    },
  };
}

/**
 * @param {Control} control
 * @param {string} id
 * @param {Report} report
 * @returns {Widget}
 */
function choice(control, id, report) {
  const options = control.options ?? [];
  const long = options.length > 4 || options.map((option) => option.label).join("").length > 30;
  return long ? menu(control, id, report) : segments(control, id, report);
}

/**
 * @param {Control} control
 * @param {string} id
 * @param {Report} report
 * @returns {Widget}
 */
function menu(control, id, report) {
  const options = (control.options ?? []).map(({ value, label }) => make("option", { value }, label));
  const select = make("select", { id }, ...options);
  select.addEventListener("change", () => report(select.value, false));
  const head = make("div", { class: "row" }, make("label", { for: id }, control.label), select);
  return {
    element: make("div", { class: "control" }, head, help(control)),
    set(value) {
      select.value = value;
    },
  };
}

/**
 * @param {Control} control
 * @param {string} id
 * @param {Report} report
 * @returns {Widget}
 */
function segments(control, id, report) {
  const radios = (control.options ?? []).map(({ value }) => make("input", { type: "radio", name: id, value }));
  const labels = (control.options ?? []).map(({ label }, i) => make("label", {}, radios[i], make("span", {}, label)));
  for (const radio of radios) radio.addEventListener("change", () => report(radio.value, false));
  const box = make("div", { class: "segments" }, ...labels);
  const legend = make("legend", {}, control.label);
  return {
    element: make("fieldset", { class: "control" }, legend, box, help(control)),
    set(value) {
      for (const radio of radios) radio.checked = radio.value === value;
    },
  };
}

/**
 * @param {Control} control
 * @param {string} id
 * @param {Report} report
 * @returns {Widget}
 */
function onOff(control, id, report) {
  const box = make("input", { type: "checkbox", role: "switch", id });
  box.addEventListener("change", () => report(box.checked, false));
  const head = make("div", { class: "row" }, make("label", { for: id }, control.label), box);
  return {
    element: make("div", { class: "control" }, head, help(control)),
    set(value) {
      box.checked = value;
    },
  };
}

/**
 * @param {Control} control
 * @param {string} id
 * @param {Report} report A list of points, or "draw" to begin.
 * @returns {Widget}
 */
function stroke(control, id, report) {
  const draw = make("button", { type: "button", id }, "Draw on the picture");
  const clear = make("button", { type: "button" }, "Clear");
  const count = make("p", { class: "help" });
  draw.addEventListener("click", () => report("draw", false));
  clear.addEventListener("click", () => report([], false));
  return {
    element: make("div", { class: "control" }, make("div", { class: "row" }, draw, clear), help(control), count),
    set(points) {
      clear.disabled = points.length === 0;
      write(count, points.length ? `${points.length} points` : "Nothing is drawn yet.");
    },
  };
}

/** @param {Control} control */
function help(control) {
  return control.help ? make("p", { class: "help" }, control.help) : "";
}

const KINDS = { slider, choice, switch: onOff, stroke };

/**
 * The widget of a control of a single value.
 * @param {Control} control
 * @param {string} id
 * @param {Report} report
 * @returns {Widget}
 */
export function widget(control, id, report) {
  return KINDS[/** @type {keyof typeof KINDS} */ (control.kind)](control, id, report);
}
