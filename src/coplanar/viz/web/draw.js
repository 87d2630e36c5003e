// Draws a scene (see scene.py) on a canvas. No dependencies; colours come from CSS custom properties.

import { drawGrid } from "./grid.js";
import { grouped, momentAt, rowAt, View } from "./view.js";

/**
 * @typedef {import("./view.js").Layer} Layer
 * @typedef {import("./view.js").SceneData} SceneData
 * @typedef {import("./view.js").Moment} Moment
 */

/**
 * What a layer is drawn with.
 * @typedef {object} Pen
 * @property {CanvasRenderingContext2D} ctx
 * @property {View} view
 * @property {Moment} at
 * @property {string} colour
 * @property {number} opacity
 * @property {string} surface
 */

const TINT = 0.14; // of the inside of what is filled

/**
 * Draw the scene at time t, and say how metres became pixels.
 * @param {HTMLCanvasElement} canvas
 * @param {SceneData} scene
 * @param {number} t
 * @param {View} [wanted] What is shown; everything, by default.
 */
export function drawScene(canvas, scene, t, wanted) {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const view = wanted ?? new View(scene.bounds, width, height);
  const ctx = canvas.getContext("2d");
  if (!ctx) return view;
  const style = getComputedStyle(canvas);
  /** @param {string} role */
  const colourOf = (role) => style.getPropertyValue(`--${role}`).trim() || "#888";
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, width, height);
  ctx.lineJoin = ctx.lineCap = "round";
  drawGrid(ctx, view, scene.unit, colourOf);
  ctx.save();
  ctx.beginPath();
  ctx.rect(view.left, view.top, view.right - view.left, view.bottom - view.top);
  ctx.clip();
  const at = momentAt(scene.times, t);
  const surface = colourOf("surface");
  for (const layer of scene.layers) {
    const colour = colourOf(layer.role);
    const opacity = layer.opacity ?? 1;
    ctx.globalAlpha = opacity;
    ctx.strokeStyle = ctx.fillStyle = colour;
    ctx.setLineDash(layer.dashed ? [5, 4] : []);
    DRAW[layer.kind]?.({ ctx, view, at, colour, opacity, surface }, layer);
  }
  ctx.restore();
  return view;
}

/**
 * One way of drawing for each kind of layer.
 * @type {Record<string, (pen: Pen, layer: Layer) => void>}
 */
const DRAW = {
  curve(pen, layer) {
    trace(pen, layer.points ?? []);
    if (layer.fill) tint(pen);
    stroke(pen, 1.5);
  },
  region(pen, layer) {
    pen.ctx.beginPath();
    for (const ring of layer.rings ?? []) closed(pen, ring);
    tint(pen, 0.08);
    stroke(pen, 1.2);
  },
  trail(pen, layer) {
    const points = layer.points ?? [];
    trace(pen, [...points.slice(0, pen.at.index + 1), rowAt(points, pen.at)]);
    stroke(pen, 2.2);
  },
  point(pen, layer) {
    for (const [x, y] of grouped(rowAt(layer.points ?? [], pen.at), 2)) {
      disc(pen, pen.view.x(x), pen.view.y(y), layer.size ?? 5, pen.colour);
    }
  },
  cross(pen, layer) {
    const r = layer.size ?? 6;
    for (const [x, y] of grouped(rowAt(layer.points ?? [], pen.at), 2)) cross(pen, pen.view.x(x), pen.view.y(y), r);
  },
  discs(pen, layer) {
    for (const [x, y, radius] of grouped(rowAt(layer.circles ?? [], pen.at), 3)) {
      pen.ctx.beginPath();
      pen.ctx.arc(pen.view.x(x), pen.view.y(y), Math.max(0, pen.view.scale * radius), 0, 2 * Math.PI);
      if (layer.fill) tint(pen);
      stroke(pen, 1.5);
    }
  },
  outline(pen, layer) {
    pen.ctx.beginPath();
    closed(pen, grouped(rowAt(layer.points ?? [], pen.at), 2));
    if (layer.fill) tint(pen);
    stroke(pen, 1.6);
  },
  segments(pen, layer) {
    for (const piece of grouped(rowAt(/** @type {number[][]} */ (layer.ends ?? []), pen.at), 4)) {
      trace(pen, grouped(piece, 2));
      stroke(pen, layer.width ?? 1.8);
    }
  },
  arrows(pen, layer) {
    for (const [x, y, dx, dy] of grouped(rowAt(layer.vectors ?? [], pen.at), 4)) arrow(pen, [x, y], [x + dx, y + dy]);
    if (!layer.crossed) return;
    for (const [x, y, dx, dy] of grouped(rowAt(layer.vectors ?? [], pen.at), 4)) {
      cross(pen, pen.view.x(x + dx / 2), pen.view.y(y + dy / 2), 7);
    }
  },
  text(pen, layer) {
    const { ctx, view } = pen;
    const [x, y] = rowAt(layer.points ?? [], pen.at);
    const [right, down] = layer.shift ?? [0, 0];
    ctx.font = "12px system-ui, sans-serif";
    ctx.textAlign = /** @type {CanvasTextAlign} */ (layer.align ?? "center");
    ctx.textBaseline = "middle";
    ctx.strokeStyle = pen.surface;
    ctx.lineWidth = 4;
    ctx.strokeText(layer.text ?? "", view.x(x) + right, view.y(y) + down);
    ctx.fillText(layer.text ?? "", view.x(x) + right, view.y(y) + down);
  },
  linkage(pen, layer) {
    const joints = grouped(rowAt(layer.joints ?? [], pen.at), 2);
    trace(pen, joints);
    stroke(pen, layer.dashed ? 2 : 7);
    for (const [x, y] of joints) disc(pen, pen.view.x(x), pen.view.y(y), 4.5, pen.surface, pen.colour);
  },
  body(pen, layer) {
    const outline = layer.outline ?? [];
    const place = placing(rowAt(layer.poses ?? [], pen.at));
    pen.ctx.beginPath();
    closed(pen, outline.map(place));
    tint(pen, 0.22);
    stroke(pen, 1.8);
    const nose = Math.max(...outline.map((p) => p[0]));
    trace(pen, [place([0, 0]), place([nose, 0])]);
    stroke(pen, 1.8);
  },
  carried(pen, layer) {
    const place = placing(rowAt(layer.poses ?? [], pen.at));
    for (const piece of grouped(/** @type {number[]} */ (layer.ends ?? []), 4)) {
      trace(pen, grouped(piece, 2).map(place));
      stroke(pen, layer.width ?? 3);
    }
  },
};

/**
 * From a body's frame to the plane.
 * @param {number[]} pose
 */
function placing([x, y, theta]) {
  const c = Math.cos(theta);
  const s = Math.sin(theta);
  return (/** @type {number[]} */ p) => [x + c * p[0] - s * p[1], y + s * p[0] + c * p[1]];
}

/**
 * @param {Pen} pen
 * @param {number[][]} points
 */
function trace({ ctx, view }, points) {
  ctx.beginPath();
  for (const [x, y] of points) ctx.lineTo(view.x(x), view.y(y));
}

/**
 * @param {Pen} pen
 * @param {number[][]} points
 */
function closed({ ctx, view }, points) {
  points.forEach(([x, y], i) => {
    if (i === 0) ctx.moveTo(view.x(x), view.y(y));
    else ctx.lineTo(view.x(x), view.y(y));
  });
  ctx.closePath();
}

/**
 * @param {Pen} pen
 * @param {number} [share]
 */
function tint({ ctx, colour, opacity }, share = TINT) {
  ctx.globalAlpha = share * opacity;
  ctx.fillStyle = colour;
  ctx.fill("evenodd");
  ctx.globalAlpha = opacity;
}

/**
 * @param {Pen} pen
 * @param {number} width
 */
function stroke({ ctx }, width) {
  ctx.lineWidth = width;
  ctx.stroke();
}

/**
 * @param {Pen} pen
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 * @param {string} fill
 * @param {string} [edge]
 */
function disc({ ctx }, x, y, radius, fill, edge) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.fillStyle = fill;
  ctx.fill();
  if (!edge) return;
  ctx.setLineDash([]);
  ctx.strokeStyle = edge;
  ctx.lineWidth = 2;
  ctx.stroke();
}

/**
 * @param {Pen} pen
 * @param {number} x
 * @param {number} y
 * @param {number} half
 */
function cross({ ctx }, x, y, half) {
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.moveTo(x - half, y - half);
  ctx.lineTo(x + half, y + half);
  ctx.moveTo(x - half, y + half);
  ctx.lineTo(x + half, y - half);
  ctx.lineWidth = 2.2;
  ctx.stroke();
}

/**
 * @param {Pen} pen
 * @param {number[]} tail
 * @param {number[]} head
 */
function arrow(pen, tail, head) {
  const { ctx, view } = pen;
  const x = view.x(head[0]);
  const y = view.y(head[1]);
  const dx = x - view.x(tail[0]);
  const dy = y - view.y(tail[1]);
  const length = Math.hypot(dx, dy);
  if (length < 1) return;
  const barb = Math.min(9, 0.6 * length) / length;
  trace(pen, [tail, head]);
  stroke(pen, 2);
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.moveTo(x - barb * (dx + 0.5 * dy), y - barb * (dy - 0.5 * dx));
  ctx.lineTo(x, y);
  ctx.lineTo(x - barb * (dx - 0.5 * dy), y - barb * (dy + 0.5 * dx));
  stroke(pen, 2);
}
