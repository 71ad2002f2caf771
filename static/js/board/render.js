/**
 * Draws a board on two canvases, the same way at every size: the squares below (a rows × cols image drawn scaled, then
 * hatch, grid, goal, start, walls), the ink above (ink.js). Lengths are device pixels.
 */

import { shade, symmetricRange, valueDepth, wantsDarkInk, worldDepth } from "#js/board/colours.js";
import { colourOf, placeOf } from "#js/board/state.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */
/** @typedef {import("#js/board/theme.js").Theme} Theme */
/** @typedef {{cell: number, ratio: number}} Geometry   side of a square in device pixels; device pixels per CSS pixel */
/** @typedef {{data: Uint8ClampedArray<ArrayBuffer>, width: number, height: number}} Pixels   one a square, as ImageData has them */
/** @typedef {{pixels: Pixels, isDark: Uint8Array, loss: Float32Array}} Look   colours, where dark ink reads, 0…1 how red */
/**
 * What all drawing gets. A picture for paper hands in a pen that writes SVG in place of the canvas (`pictures/pen.js`), with
 * traces of its own, so that both are drawn by the same lines: draw with `context` and `newPath`, never with `new Path2D`.
 * @typedef {object} Scene
 * @property {CanvasRenderingContext2D} context
 * @property {() => Path2D} newPath
 * @property {Geometry} geometry
 * @property {World} world
 * @property {View} view
 * @property {Theme} theme
 * @property {Look} look
 */

const SMALLEST_HATCHED = 5;
const SMALLEST_GRID = 6;

/** The colour of every square, and the ink that reads on it. @param {World} world @param {View} view @param {Theme} theme @returns {Look} */
export function lookOf(world, view, theme) {
  const n = world.rows * world.cols;
  const pixels = { data: new Uint8ClampedArray(4 * n), width: world.cols, height: world.rows };
  const look = { pixels, isDark: new Uint8Array(n), loss: new Float32Array(n) };
  const range = view.values ? (view.scale ?? symmetricRange(view.values)) : null;
  const { data } = look.pixels;
  for (let row = 0, state = 0; row < world.rows; row++) {
    const colours = world.colours[row] ?? [];
    for (let col = 0; col < world.cols; col++, state++) {
      const colour = colours[col] ?? "blue";
      let rgb = colour === "wall" ? theme.wall : theme.goal;
      if (colour !== "wall" && (range !== null || colour !== "goal")) {
        const { arm, depth } =
          range && view.values
            ? valueDepth(view.values[state] ?? 0, range)
            : worldDepth(colour, world.rewards[row]?.[col] ?? 0);
        rgb = shade(theme.scale, arm, depth);
        if (arm === "red") look.loss[state] = depth;
      }
      data[4 * state] = rgb[0];
      data[4 * state + 1] = rgb[1];
      data[4 * state + 2] = rgb[2];
      data[4 * state + 3] = 255;
      look.isDark[state] = wantsDarkInk(rgb) ? 1 : 0;
    }
  }
  return look;
}

/** @param {Scene} scene */
export function drawSquares(scene) {
  const { context, geometry, world, look } = scene;
  context.clearRect(0, 0, context.canvas.width, context.canvas.height);
  context.imageSmoothingEnabled = geometry.cell < 1;
  context.drawImage(bitmap(look.pixels), 0, 0, geometry.cell * world.cols, geometry.cell * world.rows);
  drawOnSquares(scene);
}

/** What lies on the colours of the squares: hatch, grid, walls, start, goals. @param {Scene} scene */
export function drawOnSquares(scene) {
  const { geometry, world } = scene;
  drawLossHatch(scene);
  if (scene.view.unknown) drawUnknownHatch(scene);
  drawGrid(scene, geometry.cell * world.cols, geometry.cell * world.rows);
  drawWalls(scene);
  drawStart(scene);
  for (const goal of world.goals) drawFlag(scene, goal);
}

/** @param {Pixels} pixels */
function bitmap(pixels) {
  const canvas = document.createElement("canvas");
  canvas.width = pixels.width;
  canvas.height = pixels.height;
  canvas.getContext("2d")?.putImageData(new ImageData(pixels.data, pixels.width, pixels.height), 0, 0);
  return canvas;
}

/** Red squares: diagonals, the more the greater the loss, so that colour never speaks alone. @param {Scene} scene */
function drawLossHatch({ context, newPath, geometry, world, look, theme }) {
  const { cell, ratio } = geometry;
  if (cell < SMALLEST_HATCHED) return;
  const most = Math.max(1, Math.min(6, Math.floor(cell / (5 * ratio))));
  const inks = [newPath(), newPath()];
  look.loss.forEach((loss, state) => {
    const n = Math.round(loss * most);
    if (n < 1) return;
    const [row, col] = placeOf(world, state);
    diagonals(/** @type {Path2D} */ (inks[look.isDark[state] ?? 0]), col * cell, row * cell, cell, cell / n);
  });
  context.lineWidth = Math.max(0.75 * ratio, cell * 0.018);
  strokeInks(context, theme, inks, 0.34);
}

/** Squares no demonstration touched: the other diagonal, in grey. @param {Scene} scene */
function drawUnknownHatch({ context, newPath, geometry, world, view, theme }) {
  const { cell, ratio } = geometry;
  const path = newPath();
  for (let state = 0; state < world.rows * world.cols; state++) {
    if (!view.unknown?.[state] || colourOf(world, state) === "wall") continue;
    const [row, col] = placeOf(world, state);
    diagonals(path, col * cell, row * cell, cell, Math.max(cell / 4, 3 * ratio), true);
  }
  context.lineWidth = Math.max(0.75 * ratio, cell * 0.014);
  context.strokeStyle = theme.unknown;
  context.globalAlpha = 0.55;
  context.stroke(path);
  context.globalAlpha = 1;
}

/** @param {Path2D} path @param {number} x @param {number} y @param {number} side @param {number} gap @param {boolean} [mirrored] */
function diagonals(path, x, y, side, gap, mirrored = false) {
  for (let d = gap / 2; d < 2 * side; d += gap) {
    const [near, far] = [Math.max(0, d - side), Math.min(d, side)];
    path.moveTo(x + (mirrored ? side - near : near), y + far);
    path.lineTo(x + (mirrored ? side - far : far), y + near);
  }
}

/** @param {Scene} scene @param {number} width @param {number} height */
function drawGrid({ context, geometry, world, theme }, width, height) {
  const { cell, ratio } = geometry;
  if (cell < SMALLEST_GRID * Math.min(ratio, 1.5)) return;
  const line = Math.max(1, Math.round(cell > 40 * ratio ? 2 * ratio : cell > 14 * ratio ? ratio : 1));
  context.fillStyle = theme.grid;
  for (let col = 1; col < world.cols; col++) context.fillRect(Math.round(col * cell - line / 2), 0, line, height);
  for (let row = 1; row < world.rows; row++) context.fillRect(0, Math.round(row * cell - line / 2), width, line);
}

/** @param {Scene} scene */
function drawWalls({ context, geometry, world, theme }) {
  const { cell, ratio } = geometry;
  if (cell < 10 * ratio) return;
  context.strokeStyle = theme.wallEdge;
  context.lineWidth = Math.max(ratio, cell * 0.03);
  for (const wall of world.walls) {
    const [row, col] = placeOf(world, wall);
    const inset = cell * 0.12;
    context.strokeRect(col * cell + inset, row * cell + inset, cell - 2 * inset, cell - 2 * inset);
  }
}

/** @param {Scene} scene */
function drawStart({ context, geometry, world, look, theme }) {
  const { cell, ratio } = geometry;
  const isElsewhere = world.start < 0; // in a close-up
  if (cell < 3 || isElsewhere) return;
  const [row, col] = placeOf(world, world.start);
  context.strokeStyle = look.isDark[world.start] ? theme.inkDark : theme.inkLight;
  context.lineWidth = Math.max(ratio, cell * 0.045);
  context.beginPath();
  context.arc((col + 0.5) * cell, (row + 0.5) * cell, cell * 0.39, 0, 2 * Math.PI);
  context.stroke();
}

/** @param {Scene} scene @param {number} state */
function drawFlag({ context, geometry, world, theme, view, look }, state) {
  const { cell, ratio } = geometry;
  const [row, col] = placeOf(world, state);
  const at = (/** @type {number} */ x, /** @type {number} */ y) =>
    /** @type {const} */ ([(col + x) * cell, (row + y) * cell]);
  const gold = `rgb(${theme.goal.join(" ")})`;
  const ink = view.values && !look.isDark[state] ? theme.inkLight : theme.inkDark;
  if (view.values) {
    context.strokeStyle = gold;
    context.lineWidth = Math.max(1.5 * ratio, cell * 0.09);
    const inset = context.lineWidth / 2;
    context.strokeRect(col * cell + inset, row * cell + inset, cell - 2 * inset, cell - 2 * inset);
  }
  if (cell < 7 * ratio) return drawDot(context, at(0.5, 0.5), { gold, ink: theme.inkDark, ratio });
  context.strokeStyle = ink;
  context.fillStyle = ink;
  context.lineCap = "round";
  context.lineWidth = Math.max(ratio, cell * 0.05);
  context.beginPath();
  context.moveTo(...at(0.36, 0.8));
  context.lineTo(...at(0.36, 0.2));
  context.stroke();
  context.beginPath();
  context.moveTo(...at(0.36, 0.2));
  context.lineTo(...at(0.74, 0.335));
  context.lineTo(...at(0.36, 0.48));
  context.closePath();
  context.fill();
}

/** Where a flag would be too small to see, a gold dot larger than the square. @param {CanvasRenderingContext2D} context @param {readonly [number, number]} centre @param {{gold: string, ink: string, ratio: number}} look */
function drawDot(context, [x, y], { gold, ink, ratio }) {
  const radius = Math.min(5 * ratio, context.canvas.width / 12);
  const inside = (/** @type {number} */ at, /** @type {number} */ size) =>
    Math.min(Math.max(at, radius), size - radius);
  context.beginPath();
  context.arc(inside(x, context.canvas.width), inside(y, context.canvas.height), radius - ratio, 0, 2 * Math.PI);
  context.fillStyle = gold;
  context.fill();
  context.strokeStyle = ink;
  context.lineWidth = ratio;
  context.stroke();
}

/** @param {CanvasRenderingContext2D} context @param {Theme} theme @param {Path2D[]} inks light, dark @param {number} alpha */
export function strokeInks(context, theme, [light, dark], alpha) {
  context.globalAlpha = alpha;
  context.strokeStyle = theme.inkLight;
  if (light) context.stroke(light);
  context.strokeStyle = theme.inkDark;
  if (dark) context.stroke(dark);
  context.globalAlpha = 1;
}
