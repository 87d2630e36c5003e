// Draws a scene (see scene.py) on a canvas and plays it. No dependencies; colours come from CSS custom properties.
"use strict";

/**
 * @typedef {{kind: string, role: string, points?: number[][], joints?: number[][], poses?: number[][],
 *   outline?: number[][], dashed?: boolean, fill?: boolean, size?: number}} Layer
 * @typedef {{times: number[], bounds: [number, number, number, number], unit: string, layers: Layer[]}} SceneData
 */

/** Index of the frame at or before time t, and the fraction of the way to the next. */
function frameAt(/** @type {number[]} */ times, /** @type {number} */ t) {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle;
  }
  const part = (t - times[low]) / (times[high] - times[low]);
  return { index: low, part: Math.min(1, Math.max(0, part)) };
}

/** The row between two frames. */
function between(/** @type {number[][]} */ rows, /** @type {{index: number, part: number}} */ at) {
  const a = rows[at.index];
  const b = rows[Math.min(at.index + 1, rows.length - 1)];
  return a.map((value, i) => value + at.part * (b[i] - value));
}

/** Spacing of grid lines: 1, 2 or 5 times a power of ten, about `count` of them. */
function gridStep(/** @type {number} */ span, /** @type {number} */ count) {
  const rough = span / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= rough) ?? 10 * power;
}

/** Metres to pixels with equal axes, and the frame around the drawing. */
class View {
  constructor(/** @type {SceneData} */ scene, /** @type {number} */ width, /** @type {number} */ height) {
    const [xmin, xmax, ymin, ymax] = scene.bounds;
    const pad = 0.08 * Math.max(xmax - xmin, ymax - ymin, 1e-9);
    const margin = { left: 44, right: 14, top: 14, bottom: 30 };
    this.width = width;
    this.height = height;
    this.margin = margin;
    this.scale = Math.min(
      (width - margin.left - margin.right) / (xmax - xmin + 2 * pad),
      (height - margin.top - margin.bottom) / (ymax - ymin + 2 * pad),
    );
    this.cx = 0.5 * (margin.left + width - margin.right) - (0.5 * this.scale) * (xmin + xmax);
    this.cy = 0.5 * (margin.top + height - margin.bottom) + (0.5 * this.scale) * (ymin + ymax);
  }

  x(/** @type {number} */ metres) {
    return this.cx + this.scale * metres;
  }

  y(/** @type {number} */ metres) {
    return this.cy - this.scale * metres;
  }
}

/** One way of drawing for each kind of layer. */
const DRAW = {
  curve(ctx, view, layer, colour) {
    polyline(ctx, view, layer.points);
    if (layer.fill) {
      ctx.globalAlpha = 0.12;
      ctx.fillStyle = colour;
      ctx.fill();
      ctx.globalAlpha = 1;
    }
    ctx.setLineDash(layer.dashed ? [5, 4] : []);
    ctx.lineWidth = 1.5;
    ctx.stroke();
    ctx.setLineDash([]);
  },
  trail(ctx, view, layer, _colour, at) {
    polyline(ctx, view, [...layer.points.slice(0, at.index + 1), between(layer.points, at)]);
    ctx.lineWidth = 2.2;
    ctx.stroke();
  },
  point(ctx, view, layer, colour, at) {
    const [x, y] = between(layer.points, at);
    disc(ctx, view.x(x), view.y(y), layer.size, colour);
  },
  linkage(ctx, view, layer, colour, at) {
    const flat = between(layer.joints, at);
    const joints = [];
    for (let i = 0; i < flat.length; i += 2) joints.push([flat[i], flat[i + 1]]);
    polyline(ctx, view, joints);
    ctx.lineWidth = 7;
    ctx.stroke();
    for (const [x, y] of joints) disc(ctx, view.x(x), view.y(y), 4.5, css(ctx, "--surface"), colour);
  },
  body(ctx, view, layer, colour, at) {
    const [x, y, theta] = between(layer.poses, at);
    const c = Math.cos(theta);
    const s = Math.sin(theta);
    const place = (/** @type {number[]} */ p) => [x + c * p[0] - s * p[1], y + s * p[0] + c * p[1]];
    polyline(ctx, view, layer.outline.map(place));
    ctx.closePath();
    ctx.globalAlpha = 0.25;
    ctx.fillStyle = colour;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.lineWidth = 1.8;
    ctx.stroke();
    const nose = Math.max(...layer.outline.map((p) => p[0]));
    polyline(ctx, view, [[x, y], place([nose, 0])]);
    ctx.stroke();
  },
};

function css(ctx, name) {
  return getComputedStyle(ctx.canvas).getPropertyValue(name).trim() || "#888";
}

function polyline(ctx, view, points) {
  ctx.beginPath();
  for (const [x, y] of points) ctx.lineTo(view.x(x), view.y(y));
}

function disc(ctx, x, y, radius, fill, edge) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.fillStyle = fill;
  ctx.fill();
  if (edge) {
    ctx.strokeStyle = edge;
    ctx.lineWidth = 2;
    ctx.stroke();
  }
}

function grid(ctx, view, unit) {
  const { margin, width, height } = view;
  const step = gridStep((width - margin.left - margin.right) / view.scale, 6);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  ctx.font = "11px system-ui, sans-serif";
  ctx.fillStyle = css(ctx, "--muted");
  ctx.strokeStyle = css(ctx, "--grid");
  ctx.lineWidth = 1;
  const label = (/** @type {number} */ k) => (k * step).toFixed(digits);
  ctx.textAlign = "center";
  for (let k = Math.ceil((margin.left - view.cx) / view.scale / step); view.x(k * step) <= width - margin.right; k++) {
    line(ctx, view.x(k * step), margin.top, view.x(k * step), height - margin.bottom);
    ctx.fillText(label(k), view.x(k * step), height - margin.bottom + 15);
  }
  ctx.textAlign = "right";
  for (let k = Math.ceil((view.cy - height + margin.bottom) / view.scale / step); view.y(k * step) >= margin.top; k++) {
    line(ctx, margin.left, view.y(k * step), width - margin.right, view.y(k * step));
    ctx.fillText(label(k), margin.left - 6, view.y(k * step) + 4);
  }
  ctx.fillText(`[${unit}]`, width - margin.right, height - 3);
}

function line(ctx, x0, y0, x1, y1) {
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1, y1);
  ctx.stroke();
}

/** Draw the scene at time t. */
function drawScene(/** @type {HTMLCanvasElement} */ canvas, /** @type {SceneData} */ scene, /** @type {number} */ t) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const ctx = canvas.getContext("2d");
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  ctx.lineJoin = ctx.lineCap = "round";
  const view = new View(scene, width, height);
  grid(ctx, view, scene.unit);
  const at = frameAt(scene.times, t);
  for (const layer of scene.layers) {
    const colour = css(ctx, `--${layer.role}`);
    ctx.strokeStyle = colour;
    DRAW[layer.kind](ctx, view, layer, colour, at);
  }
}

/** A canvas with play, pause, step, scrub and speed; space and the arrow keys do the same. */
class Player {
  constructor(/** @type {HTMLElement} */ root, /** @type {SceneData} */ scene) {
    this.scene = scene;
    this.start = scene.times[0];
    this.end = scene.times[scene.times.length - 1];
    this.time = this.start;
    this.speed = 1;
    this.playing = false;
    this.visible = false;
    this.canvas = root.querySelector("canvas");
    this.button = root.querySelector("button");
    this.slider = root.querySelector("input");
    this.clock = root.querySelector("output");
    this.button.addEventListener("click", () => this.play(!this.playing));
    this.slider.addEventListener("input", () => {
      this.play(false);
      this.seek(this.start + (Number(this.slider.value) / 1000) * (this.end - this.start));
    });
    root.querySelector("select").addEventListener("change", (event) => {
      this.speed = Number(event.target.value);
    });
    root.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.seek(this.time)).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.seek(this.time));
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    new IntersectionObserver(([entry]) => {
      const entered = entry.isIntersecting && !this.visible;
      this.visible = entry.isIntersecting;
      if (!this.visible) this.play(false);
      else if (entered && !calm) this.play(true);
    }).observe(this.canvas);
    this.seek(this.start);
  }

  key(/** @type {KeyboardEvent} */ event) {
    if (event.target !== this.canvas) return;
    const step = (this.end - this.start) / 100;
    if (event.key === " ") this.play(!this.playing);
    else if (event.key === "ArrowRight") this.seek(Math.min(this.end, this.time + step));
    else if (event.key === "ArrowLeft") this.seek(Math.max(this.start, this.time - step));
    else return;
    event.preventDefault();
  }

  play(/** @type {boolean} */ on) {
    if (on === this.playing) return;
    this.playing = on;
    this.button.textContent = on ? "Pause" : "Play";
    this.last = undefined;
    if (on) requestAnimationFrame((now) => this.tick(now));
  }

  tick(/** @type {number} */ now) {
    if (!this.playing) return;
    const elapsed = this.last === undefined ? 0 : (now - this.last) / 1000;
    this.last = now;
    const next = this.time + elapsed * this.speed;
    this.seek(next > this.end ? this.start : next);
    requestAnimationFrame((later) => this.tick(later));
  }

  seek(/** @type {number} */ t) {
    this.time = t;
    this.slider.value = String(Math.round((1000 * (t - this.start)) / (this.end - this.start)));
    this.clock.textContent = `${t.toFixed(2)} s`;
    drawScene(this.canvas, this.scene, t);
  }
}

/** Start a player in every element that holds a scene. */
function startPlayers(/** @type {ParentNode} */ root) {
  for (const element of root.querySelectorAll(".player")) {
    const data = element.querySelector("script[type='application/json']");
    new Player(/** @type {HTMLElement} */ (element), JSON.parse(data.textContent));
  }
}

startPlayers(document);
