/**
 * Films of walks: everybody's way through the world in step, as on the stage. `walksFilm({ world, walks })` is the `film` of a
 * `<save-menu>`, for one board or several.
 *
 * The squares are painted once; each step adds what is above them. At most 640 pixels wide and 12 seconds long.
 */

import { themeIn } from "#js/board/theme.js";
import { figure } from "#js/charts/figures.js";
import { momentAt } from "#js/comparisons/rollouts.js";
import { boardFigure } from "#js/pictures/board.js";
import { imageOf } from "#js/pictures/files.js";
import { encodeGif } from "#js/pictures/gif.js";
import { markerSign } from "#js/pictures/legend.js";
import { ink } from "#js/pictures/pen.js";
import { place, svgDocument, text } from "#js/pictures/svg.js";
import { fittedInto, textWidth } from "#js/pictures/text-width.js";
import { canWebm, encodeWebm } from "#js/pictures/webm.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/theme.js").Theme} Theme */
/** @typedef {import("#js/pictures/comparison.js").Walk} Walk */
/** @typedef {import("#js/pictures/save-menu.js").Film} Film */
/** @typedef {{width: number, height: number, times: number[], frame: (index: number) => Promise<ImageData>}} Reel   `times`: how long each frame stays, ms */

const WIDEST = 640;
const LONGEST_MS = 12_000;
const STEP_MS = 250;
const REST_MS = 1600;
const MOST_FRAMES = 120;
const [GAP, MARGIN, TYPE] = [12, 10, 11.5];
const MOST_IN_A_ROW = 4;

/** @param {{world: World, walks: Walk[]}} data @returns {Promise<Film>} */
export async function walksFilm({ world, walks }) {
  return {
    kinds: (await canWebm()) ? ["gif", "webm"] : ["gif"],
    make: async (kind, watch) => {
      const reel = await reelOf(world, walks);
      return kind === "gif" ? encodeGif(reel, watch) : encodeWebm(reel, watch);
    },
  };
}

/** @param {World} world @param {Walk[]} walks @returns {Promise<Reel>} */
async function reelOf(world, walks) {
  const theme = themeIn("light");
  const plan = layOut(world, walks.length);
  const steps = stepsShown(Math.max(0, ...walks.map(({ episode }) => episode.states.length - 1)));
  const canvas = new OffscreenCanvas(plan.width, plan.height);
  const context = /** @type {OffscreenCanvasRenderingContext2D} */ (
    canvas.getContext("2d", { willReadFrequently: true })
  );
  const ground = await imageOf(groundSvg(world, walks, plan, theme));
  const stay = Math.max(20, Math.min(STEP_MS, (LONGEST_MS - REST_MS) / Math.max(1, steps.length - 1)));
  return {
    width: plan.width,
    height: plan.height,
    times: steps.map((_, i) => (i === steps.length - 1 ? REST_MS : stay)),
    frame: async (index) => {
      const above = await imageOf(stepSvg(world, walks, { plan, theme, step: steps[index] ?? 0 }));
      context.drawImage(ground, 0, 0);
      context.drawImage(above, 0, 0);
      return context.getImageData(0, 0, plan.width, plan.height);
    },
  };
}

/** Every step, or as many of them as a film has room for; the last one always. @param {number} longest */
export function stepsShown(longest) {
  const stride = Math.max(1, Math.ceil(longest / (MOST_FRAMES - 1)));
  const steps = Array.from({ length: Math.floor(longest / stride) + 1 }, (_, i) => i * stride);
  return steps.at(-1) === longest ? steps : [...steps, longest];
}

/** @typedef {{width: number, height: number, columns: number, cell: number, board: {width: number, height: number}}} Plan */

/** Even sizes, which films ask for. @param {World} world @param {number} count @returns {Plan} */
function layOut(world, count) {
  const columns = Math.min(count, Math.ceil(count / Math.ceil(count / MOST_IN_A_ROW)));
  const room = (WIDEST - 2 * MARGIN - (columns - 1) * GAP) / columns;
  const exact = (room - 2) / Math.max(world.cols, world.rows);
  const cell = Math.min(48, exact >= 4 ? Math.floor(exact) : exact);
  const board = { width: cell * world.cols + 2, height: cell * world.rows + 2 };
  const rows = Math.ceil(count / columns);
  const width = 2 * MARGIN + columns * board.width + (columns - 1) * GAP;
  const height = 2 * MARGIN + rows * (board.height + TYPE * 1.6) + (rows - 1) * GAP;
  return { width: even(width), height: even(height), columns, cell, board };
}

/** @param {World} world @param {Walk[]} walks @param {Plan} plan @param {Theme} theme */
function groundSvg(world, walks, plan, theme) {
  const board = boardFigure(world, {}, { cell: plan.cell, theme, layers: "squares" });
  const fill = ink(theme.ink)[0];
  const last = Number.POSITIVE_INFINITY;
  const panels = walks.map(({ who, title, episode }, i) => {
    const sign = markerSign(who, theme, TYPE);
    const room =
      plan.board.width - sign.width - 4 - textWidth(totalWords(momentAt(world, episode, last)), TYPE, 600) - 6;
    const name = fittedInto(
      title.replace(/^Player, (.)/, (_, letter) => letter.toUpperCase()),
      room,
      TYPE,
      600,
    );
    const named = text(name, sign.width + 4, TYPE, { size: TYPE, weight: 600, fill });
    return inPlace(place(sign, 0, TYPE * 0.64 - sign.height / 2) + named + place(board, 0, TYPE * 1.6), i, plan);
  });
  return whole(panels.join(""), plan, ink(theme.canvas)[0]);
}

/** @param {World} world @param {Walk[]} walks @param {{plan: Plan, theme: Theme, step: number}} at */
function stepSvg(world, walks, { plan, theme, step }) {
  const fill = ink(theme.ink)[0];
  const panels = walks.map(({ who, episode }, i) => {
    const moment = momentAt(world, episode, step);
    const view = {
      paths: [{ states: moment.trail, who, width: 0.5, opacity: 0.8 }],
      agents: [{ state: moment.state, who, facing: moment.facing }],
    };
    const board = boardFigure(world, view, { cell: plan.cell, theme, layers: "above" });
    const look = /** @type {const} */ ({ size: TYPE, weight: 600, fill, anchor: "end" });
    const total = text(totalWords(moment), plan.board.width, TYPE, look);
    return inPlace(total + place(board, 0, TYPE * 1.6), i, plan);
  });
  return whole(panels.join(""), plan, null);
}

/** @param {import("#js/comparisons/rollouts.js").Moment} moment */
function totalWords({ reachedGoal, total }) {
  return `${reachedGoal ? "⚑ " : ""}${figure(total)}`;
}

/** @param {string} markup @param {number} index @param {Plan} plan */
function inPlace(markup, index, { columns, board }) {
  const x = MARGIN + (index % columns) * (board.width + GAP);
  const y = MARGIN + Math.floor(index / columns) * (board.height + TYPE * 1.6 + GAP);
  return place(markup, x, y);
}

/** @param {string} markup @param {Plan} plan @param {string | null} ground */
function whole(markup, { width, height }, ground) {
  return svgDocument({ markup, width, height }, { title: "Walks", ground });
}

/** @param {number} size */
function even(size) {
  return 2 * Math.ceil(size / 2);
}
