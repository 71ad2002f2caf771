/**
 * A board as a vector picture: the same squares, hatch, arrows, paths and agents as `<irl-board>` paints, by the same lines
 * (`pen.js`). `boardSvg(board.world, board.view)` is the whole of it.
 */

import { drawInk } from "#js/board/ink.js";
import { drawOnSquares, lookOf } from "#js/board/render.js";
import { EMPTY_VIEW, placeOf } from "#js/board/state.js";
import { themeIn } from "#js/board/theme.js";
import { agentMarkup } from "#js/pictures/agent.js";
import { hex, ink, Pen } from "#js/pictures/pen.js";
import { short, svgDocument, tag } from "#js/pictures/svg.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */
/** @typedef {import("#js/board/theme.js").Theme} Theme */
/** @typedef {import("#js/board/render.js").Look} Look */
/** @typedef {import("#js/pictures/svg.js").Figure} Figure */

/**
 * @typedef {object} BoardOptions
 * @property {number} [cell]                    side of a square
 * @property {number} [ratio]                   the finest line is this wide
 * @property {"light" | "dark" | Theme} [theme] light, for paper, unless said otherwise
 * @property {"all" | "squares" | "above"} [layers] a film draws the squares once, and what is above them for each step
 */

/** A board of this side has squares as large as the page's, and no more than a screen's width. */
const SIDE = 560;
const LARGEST_CELL = 80;
const EDGE = 1;

/** @param {World} world @param {Partial<View>} view @param {BoardOptions & {title?: string}} [options] */
export function boardSvg(world, view, { title = "A board", ...options } = {}) {
  return svgDocument(boardFigure(world, view, options), { title });
}

/** The same as a part of a larger picture. @param {World} world @param {Partial<View>} view @param {BoardOptions} [options] @returns {Figure} */
export function boardFigure(world, view, options = {}) {
  const { cell = cellFor(world), ratio = 1, theme = "light", layers = "all" } = options;
  const palette = paletteOf(theme);
  const whole = { ...EMPTY_VIEW, ...view };
  const [width, height] = [cell * world.cols, cell * world.rows];
  const look = lookOf(world, whole, palette);
  const pen = new Pen(width, height);
  const geometry = { cell, ratio };
  const scene = { context: pen.context, newPath: Pen.newPath, geometry, world, view: whole, theme: palette, look };
  if (layers !== "above") drawOnSquares(scene);
  if (layers !== "squares") drawInk(scene);
  const below = layers === "above" ? "" : squares(world, look, cell) + frame(width, height, palette);
  const agents =
    layers === "squares" ? [] : whole.agents.map((agent) => agentMarkup(world, agent, { cell, theme: palette }));
  const markup = below + pen.markup + agents.join("");
  return {
    markup: tag("g", { transform: `translate(${EDGE} ${EDGE})` }, markup),
    width: width + 2 * EDGE,
    height: height + 2 * EDGE,
  };
}

/** How large the squares of a picture of one board are. @param {World} world */
export function cellFor(world) {
  return Math.min(LARGEST_CELL, Math.max(4, Math.floor(SIDE / Math.max(world.rows, world.cols))));
}

/** @param {"light" | "dark" | Theme} theme @returns {Theme} */
export function paletteOf(theme) {
  return typeof theme === "string" ? themeIn(theme) : theme;
}

/** One shape for each colour, whole pixels at its edges, so that no seam shows between neighbours. @param {World} world @param {Look} look @param {number} cell */
function squares(world, { pixels }, cell) {
  /** @type {Map<string, string>} */
  const ways = new Map();
  for (let state = 0; state < world.rows * world.cols; state++) {
    const [row, col] = placeOf(world, state);
    const colour = hex(pixels.data.subarray(4 * state, 4 * state + 3));
    const way = `M${short(col * cell)} ${short(row * cell)}h${short(cell)}v${short(cell)}h${short(-cell)}z`;
    ways.set(colour, (ways.get(colour) ?? "") + way);
  }
  const shapes = [...ways].map(([fill, d]) => tag("path", { d, fill }));
  return tag("g", { "shape-rendering": "crispEdges" }, ...shapes);
}

/** @param {number} width @param {number} height @param {Theme} theme */
function frame(width, height, theme) {
  const [stroke] = ink(theme.line);
  return tag("rect", { x: -0.5, y: -0.5, width: width + 1, height: height + 1, fill: "none", stroke });
}
