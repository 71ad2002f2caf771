/** What is drawn above the squares of a board: visits, paths, arrows, figures. Lengths are device pixels. */

import { drawPaths } from "#js/board/paths.js";
import { strokeInks } from "#js/board/render.js";
import { colourOf, DELTAS, placeOf, rewardOf } from "#js/board/state.js";
import { number } from "#js/lib/format.js";

/** @typedef {import("#js/board/render.js").Scene} Scene */
/** @typedef {import("#js/board/render.js").Look} Look */
/** @typedef {import("#js/board/theme.js").Theme} Theme */

const SMALLEST_ARROWS = 5;
const SMALLEST_HEADS = 18;
/** Below this side (CSS pixels) a square has no room for its figure: `board/tags.js` shows the few that matter. */
export const SMALLEST_FIGURES = 17;
/** Below this side a square has room for its arrows or its figure, not for both; figures, asked for, come first. */
const SMALLEST_BOTH = 30;
const SMALLEST_TYPE = 8.5;
const FAINTEST_ARROW = 0.03;

/** @param {Scene} scene */
export function drawInk(scene) {
  const { context, view } = scene;
  context.clearRect(0, 0, context.canvas.width, context.canvas.height);
  if (view.visits) drawVisits(scene);
  drawPaths(scene);
  if (view.arrows && !(view.numbers && isTight(scene))) drawArrows(scene);
  drawFigures(scene, figuredStates(scene));
}

/** Too small for arrows and figures together. @param {Scene} scene */
function isTight({ geometry: { cell, ratio } }) {
  return cell >= SMALLEST_FIGURES * ratio && cell < SMALLEST_BOTH * ratio;
}

/** Discs whose area is proportional to the visits. @param {Scene} scene */
function drawVisits({ context, newPath, geometry, world, view, theme }) {
  const visits = view.visits ?? [];
  const { cell, ratio } = geometry;
  let largest = 0;
  for (let i = 0; i < visits.length; i++) largest = Math.max(largest, visits[i] ?? 0);
  if (!(largest > 0)) return;
  const path = newPath();
  for (let state = 0; state < visits.length; state++) {
    const radius = 0.42 * cell * Math.sqrt(Math.max(0, visits[state] ?? 0) / largest);
    if (radius < 0.35 * ratio) continue;
    const [row, col] = placeOf(world, state);
    const [x, y] = [(col + 0.5) * cell, (row + 0.5) * cell];
    path.moveTo(x + radius, y);
    path.arc(x, y, radius, 0, 2 * Math.PI);
  }
  context.fillStyle = theme.accent;
  context.globalAlpha = 0.5;
  context.fill(path);
  context.globalAlpha = 1;
  context.lineWidth = Math.max(ratio * 0.75, cell * 0.02);
  context.strokeStyle = theme.canvas;
  context.stroke(path);
}

/** Four arrows a square, length ∝ probability, all of one ink in one path. Above a figure they stand higher and smaller. @param {Scene} scene */
function drawArrows({ context, newPath, geometry, world, view, look, theme }) {
  const { cell, ratio } = geometry;
  const arrows = view.arrows;
  if (cell < SMALLEST_ARROWS * ratio || !arrows) return;
  const hasHeads = cell >= SMALLEST_HEADS * ratio;
  const hasFigures = view.numbers && cell >= SMALLEST_FIGURES * ratio;
  const [reach, middle] = hasFigures ? [0.25, 0.36] : [0.42, 0.5];
  const lines = [newPath(), newPath()];
  const solids = [newPath(), newPath()];
  for (let state = 0; state < arrows.length; state++) {
    if (world.goals.includes(state) || colourOf(world, state) === "wall") continue;
    const [row, col] = placeOf(world, state);
    const ink = look.isDark[state] ?? 0;
    for (let action = 0; action < 4; action++) {
      const probability = arrows[state]?.[action] ?? 0;
      if (!(probability > FAINTEST_ARROW)) continue;
      const [dy, dx] = DELTAS[action] ?? [0, 0];
      const [x, y] = [(col + 0.5) * cell, (row + middle) * cell];
      const length = reach * cell * Math.min(1, probability);
      if (!hasHeads) {
        dart(solids[ink], { x, y, dx, dy, length: length * 1.1, width: Math.max(1.1 * ratio, cell * 0.13) });
        continue;
      }
      const [tipX, tipY] = [x + dx * length, y + dy * length];
      lines[ink]?.moveTo(x, y);
      lines[ink]?.lineTo(tipX, tipY);
      arrowHead(solids[ink], { tipX, tipY, dx, dy, size: Math.min(cell * 0.11, length * 0.6) });
    }
  }
  context.lineCap = "round";
  context.lineWidth = Math.max(ratio, cell * 0.04);
  strokeInks(context, theme, lines, 0.9);
  fillInks(context, theme, solids, 0.9);
}

/** @param {Path2D | undefined} path @param {{tipX: number, tipY: number, dx: number, dy: number, size: number}} arrow */
function arrowHead(path, { tipX, tipY, dx, dy, size }) {
  const [baseX, baseY] = [tipX - dx * size * 0.6, tipY - dy * size * 0.6];
  path?.moveTo(tipX + dx * size, tipY + dy * size);
  path?.lineTo(baseX - dy * size, baseY + dx * size);
  path?.lineTo(baseX + dy * size, baseY - dx * size);
  path?.closePath();
}

/** Where a head would be a speck, the whole arrow is one: broad at the square's middle, pointed at its tip. @param {Path2D | undefined} path @param {{x: number, y: number, dx: number, dy: number, length: number, width: number}} arrow */
function dart(path, { x, y, dx, dy, length, width }) {
  path?.moveTo(x + dx * length, y + dy * length);
  path?.lineTo(x - dy * width, y + dx * width);
  path?.lineTo(x + dy * width, y - dx * width);
  path?.closePath();
}

/** Squares that show their figure: all where it is asked for, else goals of which one pays more than another. @param {Scene} scene */
function figuredStates({ world, view }) {
  if (view.numbers) return Array(world.rows * world.cols).keys();
  const pays = new Set(view.values ? [] : world.goals.map((goal) => rewardOf(world, goal)));
  return pays.size > 1 ? world.goals : [];
}

/** @param {Scene} scene @param {Iterable<number>} states */
function drawFigures(scene, states) {
  const { context, geometry, world, view, look, theme } = scene;
  const { cell, ratio } = geometry;
  if (cell < SMALLEST_FIGURES * ratio) return;
  const isShared = view.arrows !== null && !isTight(scene);
  const size = Math.min(Math.max(cell * (isShared ? 0.22 : 0.3), SMALLEST_TYPE * ratio), 20 * ratio);
  context.font = `600 ${size}px ${theme.font}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const state of states) {
    if (colourOf(world, state) === "wall") continue;
    const [row, col] = placeOf(world, state);
    const value = view.values ? (view.values[state] ?? 0) : rewardOf(world, state);
    const isBelow = isShared || world.goals.includes(state);
    const text = number(value, Math.abs(value) >= 10 ? 0 : 1);
    context.fillStyle = look.isDark[state] ? theme.inkDark : theme.inkLight;
    plate(context, look, state, {
      x: (col + 0.5) * cell,
      y: (row + (isBelow ? 0.82 : 0.5)) * cell,
      width: context.measureText(text).width,
      size,
    });
    context.fillText(text, (col + 0.5) * cell, (row + (isBelow ? 0.84 : 0.52)) * cell);
  }
}

/** The square's own colour behind its figure, so that hatch and paths do not cross it. @param {CanvasRenderingContext2D} context @param {Look} look @param {number} state @param {{x: number, y: number, width: number, size: number}} box */
function plate(context, look, state, { x, y, width, size }) {
  const ink = context.fillStyle;
  const [r, g, b] = look.pixels.data.subarray(4 * state, 4 * state + 3);
  context.fillStyle = `rgb(${r} ${g} ${b} / 0.85)`;
  context.fillRect(x - width / 2 - size * 0.15, y - size * 0.6, width + size * 0.3, size * 1.2);
  context.fillStyle = ink;
}

/** @param {CanvasRenderingContext2D} context @param {Theme} theme @param {Path2D[]} inks light, dark @param {number} alpha */
function fillInks(context, theme, [light, dark], alpha) {
  context.globalAlpha = alpha;
  context.fillStyle = theme.inkLight;
  if (light) context.fill(light);
  context.fillStyle = theme.inkDark;
  if (dark) context.fill(dark);
  context.globalAlpha = 1;
}
