// Curves under the drawing, with a cursor in step with the player.

import { make, raised } from "./elements.js";
import uPlot from "./uPlot.esm.js";

/**
 * @typedef {import("./types.js").Series} Series
 * @typedef {import("./player.js").Clock} Clock
 * @typedef {{plot: uPlot, shape: string, timed: boolean, x: (number | null)[], box: HTMLElement}} Chart
 */

const COLOURS = ["first", "second", "third", "fourth", "fifth", "sixth"];
const HEIGHT = 132;

export class Charts {
  /**
   * @param {HTMLElement} root
   * @param {Clock} clock
   */
  constructor(root, clock) {
    this.root = root;
    this.clock = clock;
    /** @type {Chart[]} */
    this.charts = [];
    /** @type {Series[]} */
    this.series = [];
    new ResizeObserver(() => this.#fit()).observe(root);
  }

  /** @param {Series[]} series */
  show(series) {
    this.series = series;
    for (const chart of this.charts.splice(series.length)) this.#remove(chart);
    series.forEach((one, i) => {
      const old = this.charts[i];
      if (old && old.shape === shapeOf(one)) {
        old.x = one.x.values;
        old.timed = this.#isTimed(one);
        old.plot.setData(dataOf(one));
      } else {
        if (old) this.#remove(old);
        this.charts[i] = this.#build(one);
      }
    });
    const boxes = this.charts.map((chart) => chart.box);
    if (boxes.some((box, i) => box !== this.root.children[i]) || boxes.length !== this.root.children.length) {
      this.root.replaceChildren(...boxes);
      this.#fit();
    }
    queueMicrotask(() => this.follow()); // after uPlot's own, which lays the plots out
  }

  /** Draw again in other colours. */
  recolour() {
    for (const chart of this.charts.splice(0)) this.#remove(chart);
    this.show(this.series);
  }

  /** Put the cursors at the player's time. */
  follow() {
    for (const { plot, timed, x } of this.charts) {
      if (!timed || plot.over.matches(":hover")) continue;
      const i = nearest(x, this.clock.time);
      const left = plot.valToPos(this.clock.time, "x");
      plot.setCursor({ left, top: -10 }, false);
      plot.setLegend({ idx: i }, false);
    }
  }

  /** @param {Series} series */
  #isTimed({ x }) {
    const { start, end } = this.clock;
    const last = x.values[x.values.length - 1] ?? Number.NaN;
    return end > start && Math.abs(last - end) <= 1e-3 * (end - start) && x.label.startsWith("t");
  }

  /**
   * @param {Series} series
   * @returns {Chart}
   */
  #build(series) {
    const plot = new uPlot(options(series, 300), dataOf(series));
    const timed = this.#isTimed(series);
    const caption = make("figcaption", {}, titled(series));
    const box = make("figure", { class: "chart", role: "group", "aria-label": titled(series) }, caption, plot.root);
    const chart = { plot, shape: shapeOf(series), timed, x: series.x.values, box };
    const seek = (/** @type {PointerEvent} */ event) => {
      if (event.buttons !== 1 || !chart.timed) return;
      this.clock.pause();
      this.clock.seek(plot.posToVal(event.offsetX, "x"));
    };
    plot.over.addEventListener("pointerdown", seek);
    plot.over.addEventListener("pointermove", seek);
    plot.over.addEventListener("pointerleave", () => requestAnimationFrame(() => this.follow()));
    return chart;
  }

  /** @param {Chart} chart */
  #remove({ plot, box }) {
    plot.destroy();
    box.remove();
  }

  #fit() {
    for (const { plot, box } of this.charts) plot.setSize({ width: box.clientWidth, height: HEIGHT });
  }
}

/** @param {Series} series */
function titled({ title, unit, x }) {
  const over = x.label.startsWith("t") ? "" : ` against ${x.label}`;
  return `${title}${unit && ` [${raised(unit)}]`}${over}`;
}

const EXPONENT = "\u207b";
const DIGITS = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";

/**
 * Whole powers of ten in an interval, at most six of them.
 * @param {number} low
 * @param {number} high
 */
function decades(low, high) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const stride = Math.max(1, Math.ceil((last - first) / 5));
  const found = [];
  for (let power = first; power <= last; power += stride) found.push(10 ** power);
  return found;
}

/**
 * Numbers at an axis; with exponents where all of them are small or large.
 * @param {number[]} splits
 */
function labels(splits) {
  const most = Math.max(...splits.map(Math.abs));
  const scientific = most < 1e-3 || most >= 1e5;
  return splits.map((value) => {
    const text = scientific && value !== 0 ? value.toExponential(1).replace(".0e", "e") : String(+value.toPrecision(6));
    return text.replaceAll("-", "\u2212").replace("+", "");
  });
}

/** @param {number} value */
function asPower(value) {
  const power = Math.round(Math.log10(value));
  const digits = [...String(Math.abs(power))].map((digit) => DIGITS[Number(digit)]).join("");
  return `10${power < 0 ? EXPONENT : ""}${digits}`;
}

/** @param {Series} series */
function shapeOf({ title, unit, x, lines, log }) {
  return JSON.stringify([title, unit, x.label, lines.map((line) => line.label), log]);
}

/**
 * @param {Series} series
 * @returns {uPlot.AlignedData}
 */
function dataOf({ x, lines }) {
  return /** @type {uPlot.AlignedData} */ ([x.values, ...lines.map((line) => line.values)]);
}

/**
 * @param {(number | null)[]} values increasing
 * @param {number} wanted
 */
function nearest(values, wanted) {
  let best = 0;
  values.forEach((value, i) => {
    if (Math.abs((value ?? Infinity) - wanted) < Math.abs((values[best] ?? Infinity) - wanted)) best = i;
  });
  return best;
}

/**
 * @param {Series} series
 * @param {number} width
 * @returns {uPlot.Options}
 */
function options(series, width) {
  const style = getComputedStyle(document.documentElement);
  const colour = (/** @type {string} */ name) => style.getPropertyValue(`--${name}`).trim();
  const scale = series.log ? { distr: /** @type {3} */ (3) } : {};
  const axis = {
    stroke: colour("muted"),
    grid: { stroke: colour("grid"), width: 1 },
    ticks: { show: false },
    font: "11px system-ui, sans-serif",
    size: 46,
    values: (/** @type {uPlot} */ _, /** @type {number[]} */ splits) => labels(splits),
    ...(series.log && {
      splits: (
        /** @type {uPlot} */ _,
        /** @type {number} */ _i,
        /** @type {number} */ low,
        /** @type {number} */ high,
      ) => decades(low, high),
      filter: (/** @type {uPlot} */ _, /** @type {number[]} */ splits) => splits,
      values: (/** @type {uPlot} */ _, /** @type {number[]} */ splits) => splits.map((value) => asPower(value)),
    }),
  };
  const none = series.x.label.startsWith("t") ? "\u2013" : "";
  return {
    width,
    height: HEIGHT,
    scales: { x: { time: false, ...scale }, y: scale },
    cursor: { drag: { x: false, y: false }, y: false, points: { size: 7 } },
    legend: { live: true, markers: { width: 0, fill: (_, i) => colour(roleOf(series, i - 1)) } },
    axes: [{ ...axis, size: 26, space: 60 }, axis],
    series: [
      { label: series.x.label, value: (_, value) => readable(value, none) },
      ...series.lines.map((line, i) => ({
        label: line.label,
        stroke: colour(roleOf(series, i)),
        width: 1.6,
        pxAlign: 0,
        points: { show: series.log === true, size: 5 },
        value: (/** @type {uPlot} */ _, /** @type {number | null} */ value) => readable(value, none),
      })),
    ],
  };
}

/**
 * The colour of a line: its own, or the next.
 * @param {Series} series
 * @param {number} i
 */
function roleOf(series, i) {
  return series.lines[i]?.role || COLOURS[i % COLOURS.length];
}

/**
 * @param {number | null} value
 * @param {string} none
 */
function readable(value, none) {
  return value === null || value === undefined ? none : String(Number(value.toPrecision(4)));
}
