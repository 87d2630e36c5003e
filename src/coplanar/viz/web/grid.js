// The grid behind a drawing, and the numbers at its edges.

import { gridStep } from "./view.js";

/** @typedef {import("./view.js").View} View */

/**
 * @param {CanvasRenderingContext2D} ctx
 * @param {View} view
 * @param {string} unit
 * @param {(role: string) => string} colourOf
 */
export function drawGrid(ctx, view, unit, colourOf) {
  const { left, right, top, bottom } = view;
  const step = gridStep((right - left) / view.scale, Math.max(3, Math.min(10, (right - left) / 62)));
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const label = (/** @type {number} */ k) => (k === 0 ? "0" : (k * step).toFixed(digits).replace("-", "\u2212"));
  const rule = (/** @type {number} */ k) => {
    ctx.strokeStyle = colourOf(k === 0 ? "axis" : "grid");
    ctx.beginPath();
  };
  ctx.font = "11px system-ui, sans-serif";
  ctx.fillStyle = colourOf("muted");
  ctx.lineWidth = 1;
  ctx.textAlign = "center";
  ctx.textBaseline = "alphabetic";
  for (let k = Math.ceil((left - view.cx) / view.scale / step); view.x(k * step) <= right; k++) {
    rule(k);
    ctx.moveTo(view.x(k * step), top);
    ctx.lineTo(view.x(k * step), bottom);
    ctx.stroke();
    ctx.fillText(label(k), view.x(k * step), bottom + 15);
  }
  ctx.textAlign = "right";
  for (let k = Math.ceil((view.cy - bottom) / view.scale / step); view.y(k * step) >= top; k++) {
    rule(k);
    ctx.moveTo(left, view.y(k * step));
    ctx.lineTo(right, view.y(k * step));
    ctx.stroke();
    ctx.fillText(label(k), left - 6, view.y(k * step) + 4);
  }
  if (unit) ctx.fillText(`[${unit}]`, right, bottom + 27);
}
