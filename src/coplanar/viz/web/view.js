// Metres to pixels, and frames to moments between them.

/**
 * @typedef {object} Layer One set of shapes; see scene.py for what each kind holds.
 * @property {string} kind
 * @property {string} role
 * @property {number} [opacity]
 * @property {boolean} [dashed]
 * @property {boolean} [fill]
 * @property {boolean} [crossed]
 * @property {number} [size]
 * @property {number} [width]
 * @property {string} [text]
 * @property {string} [align]
 * @property {number[]} [shift]
 * @property {number[][]} [points]
 * @property {number[][][]} [rings]
 * @property {number[][]} [circles]
 * @property {number[][]} [vectors]
 * @property {number[][]} [joints]
 * @property {number[][]} [poses]
 * @property {number[][] | number[]} [ends]
 * @property {number[][]} [outline]
 */

/**
 * @typedef {object} SceneData What scene.py sends.
 * @property {number[]} times
 * @property {number[]} bounds xmin, xmax, ymin, ymax
 * @property {string} unit
 * @property {Layer[]} layers
 */

/** @typedef {{index: number, part: number}} Moment */

/**
 * The frame at or before time t, and the fraction of the way to the next.
 * @param {number[]} times
 * @param {number} t
 * @returns {Moment}
 */
export function momentAt(times, t) {
  let low = 0;
  let high = times.length - 1;
  if (high < 1) return { index: 0, part: 0 };
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  const part = (t - times[low]) / (times[high] - times[low]);
  return { index: low, part: Math.min(1, Math.max(0, part)) };
}

/**
 * The row of a framed field at a moment; a single row holds for all of them.
 * @param {number[][]} rows
 * @param {Moment} at
 */
export function rowAt(rows, at) {
  const a = rows[Math.min(at.index, rows.length - 1)];
  if (rows.length < 2 || at.part === 0) return a;
  const b = rows[Math.min(at.index + 1, rows.length - 1)];
  return a.map((value, i) => value + at.part * (b[i] - value));
}

/**
 * A row [x, y, x, y, ...] as groups of `width` numbers.
 * @param {number[]} row
 * @param {number} width
 */
export function grouped(row, width) {
  const groups = [];
  for (let i = 0; i < row.length; i += width) groups.push(row.slice(i, i + width));
  return groups;
}

/**
 * Spacing of grid lines: 1, 2 or 5 times a power of ten, about `count` of them.
 * @param {number} span
 * @param {number} count
 */
export function gridStep(span, count) {
  const rough = span / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= rough) ?? 10 * power;
}

/** Equal axes with a margin for their numbers. */
export class View {
  /**
   * @param {number[]} bounds
   * @param {number} width of the canvas [px]
   * @param {number} height
   * @param {number} [room] around them, over their larger side
   */
  constructor(bounds, width, height, room = 0.06) {
    const [xmin, xmax, ymin, ymax] = bounds;
    const pad = room * Math.max(xmax - xmin, ymax - ymin, 1e-9);
    this.width = width;
    this.height = height;
    this.left = 44;
    this.right = width - 14;
    this.top = 14;
    this.bottom = height - 30;
    this.scale = Math.max(
      Math.min((this.right - this.left) / (xmax - xmin + 2 * pad), (this.bottom - this.top) / (ymax - ymin + 2 * pad)),
      1e-9,
    );
    this.cx = 0.5 * (this.left + this.right) - 0.5 * this.scale * (xmin + xmax);
    this.cy = 0.5 * (this.top + this.bottom) + 0.5 * this.scale * (ymin + ymax);
  }

  /** @param {number} metres */
  x(metres) {
    return this.cx + this.scale * metres;
  }

  /** @param {number} metres */
  y(metres) {
    return this.cy - this.scale * metres;
  }

  /**
   * The place under a pixel [m].
   * @param {number} x
   * @param {number} y
   */
  place(x, y) {
    return [(x - this.cx) / this.scale, (this.cy - y) / this.scale];
  }
}
