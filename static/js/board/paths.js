/** Draws paths through the middles of squares. Lengths are device pixels. */

import { traceMarker, walker } from "#js/board/colours.js";
import { placeOf } from "#js/board/state.js";
import { edgesOf, FAINTEST, strengthOf } from "#js/board/trail.js";

/** @typedef {import("#js/board/render.js").Scene} Scene */
/** @typedef {import("#js/board/state.js").Path} Path */
/** @typedef {import("#js/board/trail.js").Box} Box */
/** @typedef {import("#js/board/trail.js").Edge} Edge */
/** @typedef {(state: number) => [number, number]} At   where the path crosses a square */
/** @typedef {{colour: string, halo: string, width: number, opacity: number}} Stroke */

/** All paths of a view, side by side rather than on top of each other, within a third of a square. @param {Scene} scene */
export function drawPaths(scene) {
  const { paths } = scene.view;
  const gap = Math.min(0.1, 0.34 / Math.max(1, paths.length));
  paths.forEach((path, index) => {
    drawPath(scene, path, { shift: (index - (paths.length - 1) / 2) * gap, box: null });
  });
}

/** Draw anew what of one path lies on some squares. @param {Scene} scene @param {Path | null} path @param {Box} box */
export function redrawPath(scene, path, box) {
  const { context, geometry } = scene;
  const { cell } = geometry;
  const [x, y] = [Math.floor((box.left - 0.5) * cell), Math.floor((box.top - 0.5) * cell)];
  const [right, bottom] = [Math.ceil((box.right + 1.5) * cell), Math.ceil((box.bottom + 1.5) * cell)];
  context.save();
  context.beginPath();
  context.rect(x, y, right - x, bottom - y);
  context.clip();
  context.clearRect(x, y, right - x, bottom - y);
  if (path) drawPath(scene, path, { shift: 0, box });
  context.restore();
}

/** @param {Scene} scene @param {Path} path @param {{shift: number, box: Box | null}} where */
function drawPath(scene, path, { shift, box }) {
  if (path.states.length < 2) return;
  const { context, geometry, world, theme } = scene;
  const { cell, ratio } = geometry;
  const width = Math.max(1.75 * ratio, cell * (0.05 + 0.12 * (path.width ?? 0.4)));
  const colour = theme.who[path.who] ?? theme.inkDark;
  const stroke = { colour, halo: theme.canvas, width, opacity: path.opacity ?? 1 };
  /** @type {At} */
  const at = (state) => {
    const [row, col] = placeOf(world, state);
    return [(col + 0.5 + shift) * cell, (row + 0.5 + shift) * cell];
  };
  context.lineCap = "round";
  context.lineJoin = "round";
  drawLines(scene, path, { at, stroke, box });
  if (!path.fade && cell > 5 * ratio) drawEnd(scene, path, { at, stroke });
  context.globalAlpha = 1;
}

/** First all halos, then all lines; the older a step of a fading path, the paler, never wholly gone. @param {Scene} scene @param {Path} path @param {{at: At, stroke: Stroke, box: Box | null}} how */
function drawLines({ context, newPath, world }, path, { at, stroke, box }) {
  const { settled, fading } = edgesOf(world, path, box);
  for (const [paint, size] of /** @type {const} */ ([
    [stroke.halo, path.fade ? 1.8 : 1.9],
    [stroke.colour, 1],
  ])) {
    context.strokeStyle = paint;
    context.lineWidth = stroke.width * size;
    context.globalAlpha = stroke.opacity * (path.fade ? FAINTEST : 1);
    context.stroke(trace(newPath(), settled, at));
    context.lineCap = "butt";
    for (const [i, edge] of fading.entries()) {
      context.globalAlpha = stroke.opacity * strengthOf(edge.age);
      context.stroke(traceBend(newPath(), edge, { before: fading[i - 1], after: fading[i + 1], at }));
    }
    context.lineCap = "round";
  }
}

/**
 * From the middle of a line to the middle of the one that follows: where translucent lines met at the corners they
 * would overlap there, and each square would have its dot.
 * @param {Path2D} line @param {Edge} edge @param {{before: Edge | undefined, after: Edge | undefined, at: At}} beside
 */
function traceBend(line, { from, to }, { before, after, at }) {
  const middle = (/** @type {number} */ a, /** @type {number} */ b) => {
    const [[x, y], [toX, toY]] = [at(a), at(b)];
    return /** @type {const} */ ([(x + toX) / 2, (y + toY) / 2]);
  };
  line.moveTo(...(before?.to === from ? middle(from, to) : at(from)));
  line.lineTo(...at(to));
  if (after?.from === to) line.lineTo(...middle(to, after.to));
  return line;
}

/** @param {Path2D} line @param {Edge[]} edges @param {At} at */
function trace(line, edges, at) {
  for (const { from, to } of edges) {
    line.moveTo(...at(from));
    line.lineTo(...at(to));
  }
  return line;
}

/** Who walked here, by the shape at the end. @param {Scene} scene @param {Path} path @param {{at: At, stroke: Stroke}} how */
function drawEnd({ context, geometry: { cell, ratio }, theme }, path, { at, stroke: { colour, width, opacity } }) {
  const [x, y] = at(path.states.at(-1) ?? 0);
  context.globalAlpha = opacity;
  context.fillStyle = colour;
  context.strokeStyle = theme.canvas;
  context.lineWidth = Math.max(ratio, width * 0.35);
  context.beginPath();
  traceMarker(context, walker(path.who).shape, x, y, Math.max(width * 1.15, cell * 0.14));
  context.fill();
  context.stroke();
}
