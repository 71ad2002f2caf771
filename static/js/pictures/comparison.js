/**
 * A comparison as the figure of a paper, 183 mm wide: who walked how (a), what everybody earned (b), what the learners
 * believe (c), what the colours mean, and below it all that is needed to make it again.
 */

import { EMPTY_VIEW } from "#js/board/state.js";
import { layOutDotPlot } from "#js/charts/dot-plot-layout.js";
import { figure } from "#js/charts/figures.js";
import { boardFigure, paletteOf } from "#js/pictures/board.js";
import { captionOf, figureSentence, titleOf } from "#js/pictures/comparison-words.js";
import { dotPlot } from "#js/pictures/dot-plot.js";
import { flow, inkItems, learnedScales, markerSign, trueItems } from "#js/pictures/legend.js";
import { ink } from "#js/pictures/pen.js";
import { place, svgDocument, text } from "#js/pictures/svg.js";
import { brokenInto, fittedInto, sizeFor, textWidth } from "#js/pictures/text-width.js";

/** @typedef {import("#js/pictures/svg.js").Figure} Figure */
/** @typedef {import("#js/board/theme.js").Theme} Theme */
/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/comparisons/types.js").Entry} Entry */
/** @typedef {import("#js/comparisons/types.js").Episode} Episode */

/**
 * @typedef {object} Walk            one board of (a)
 * @property {string} who
 * @property {string} title
 * @property {Episode} episode
 *
 * @typedef {object} Belief          one board of (c)
 * @property {string} who
 * @property {string} title
 * @property {number[]} reward       (S,)
 * @property {number[][]} policy     (S, 4)
 * @property {boolean[]} unknown     (S,)
 *
 * @typedef {object} ComparisonData
 * @property {World} world
 * @property {Entry[]} entries       by place
 * @property {Walk[]} walks          in the order of the stage
 * @property {Belief[]} beliefs
 * @property {number} episode        which of the learners' episodes, 1, 2, …
 * @property {number[]} attempts     totals of the person's attempts
 * @property {import("#js/learning/types.js").Run & {versions?: Record<string, string>}} run
 * @property {number} seed           of the episodes
 * @property {string[]} citations    "Ziebart et al. 2008", …
 */

/** One unit is 1/96 inch, so that 692 of them are 183 mm, the width of two columns, with a narrow margin around. */
const MM = 25.4 / 96;
const MARGIN = 7;
const WIDTH = 691.65 - 2 * MARGIN;
const GAP = 14;
/** Three sizes of type: 9.5, 7.5 and 7 points. */
const [TITLE, NAME, SMALL] = [12.7, 10, 9.33];
const MOST_IN_A_ROW = 5;
const WIDEST_BOARD = 200;
/**
 * Boards are drawn larger than they stand and then scaled, so that their lines are as fine as print allows; where squares are
 * too many for hatch and arrows to be seen, smaller, and without them.
 */
const LARGEST_CELL = 28;
const ENLARGED = 2.3;

/** @param {ComparisonData} data @param {{theme?: "light" | "dark" | Theme}} [options] */
export function comparisonSvg(data, { theme = "light" } = {}) {
  const palette = paletteOf(theme);
  const column = new Column(palette);
  column.words(figureSentence(data), { size: TITLE, weight: 600, colour: palette.ink });
  column.gap(4);
  column.letter("a");
  column.add(walksFigure(data, palette));
  column.gap(6);
  column.letter("b");
  const plotted = plotFigure(data, palette);
  column.beside(plotted, "c", beliefsFigure(data, WIDTH - plotted.width - 2 * GAP, plotted.height, palette));
  column.gap(6);
  column.add(legendOf(data, palette));
  column.gap(2);
  for (const paragraph of captionOf(data)) {
    column.words(paragraph, { size: SMALL, colour: palette.inkSoft });
    column.gap(2);
  }
  const about = { title: titleOf(data), description: captionOf(data).join(" "), ground: ink(palette.canvas)[0] };
  return svgDocument(column.figure, { ...about, unit: "mm", scale: MM });
}

/** What stands below each other. */
class Column {
  #drawn = "";
  #y = 0;
  #theme;

  /** @param {Theme} theme */
  constructor(theme) {
    this.#theme = theme;
  }

  get figure() {
    const markup = place(this.#drawn, MARGIN, MARGIN);
    return { markup, width: WIDTH + 2 * MARGIN, height: this.#y + 2 * MARGIN };
  }

  /** @param {number} height */
  gap(height) {
    this.#y += height;
  }

  /** @param {Figure} part @param {number} [x] */
  add(part, x = 0) {
    this.#drawn += place(part, x, this.#y);
    this.#y += part.height;
  }

  /** The name of what follows. @param {string} letter @param {number} [x] */
  letter(letter, x = 0) {
    const fill = ink(this.#theme.ink)[0];
    this.#drawn += text(letter, x, this.#y + TITLE, { size: TITLE, weight: 700, fill });
    if (x === 0) this.#y += TITLE * 1.4;
  }

  /** @param {Figure} left @param {string} letter of the right one @param {Figure} right */
  beside(left, letter, right) {
    const x = left.width + 2 * GAP;
    if (right.width > 0) {
      this.#y -= TITLE * 1.4;
      this.letter(letter, x);
      this.#y += TITLE * 1.4;
      this.#drawn += place(right, x, this.#y);
    }
    this.#drawn += place(left, 0, this.#y);
    this.#y += Math.max(left.height, right.height);
  }

  /** @param {string} sentence @param {{size: number, weight?: number, colour: string}} look */
  words(sentence, { size, weight, colour }) {
    const fill = ink(colour)[0];
    for (const line of brokenInto(sentence, WIDTH, size, weight)) {
      this.#drawn += text(line, 0, this.#y + size * 0.85, { size, weight, fill });
      this.#y += size * 1.35;
    }
  }
}

/** Everybody's walk through the world, side by side. @param {ComparisonData} data @param {Theme} theme @returns {Figure} */
function walksFigure({ world, walks }, theme) {
  const columns = columnsFor(walks.length);
  const side = Math.min(WIDEST_BOARD, (WIDTH - (columns - 1) * GAP) / columns);
  const panels = walks.map(({ who, title, episode }) => {
    const view = { paths: [{ states: episode.states, who, width: 0.45 }] };
    const steps = episode.states.length - 1;
    const line = `${steps} ${steps === 1 ? "step" : "steps"}${episode.reached_goal ? ", reaches the goal" : ", no goal"}`;
    return panel(boardOf(world, view, side, theme), { who, title, right: figure(episode.total), line, theme });
  });
  return inGrid(panels, columns, side);
}

/** @param {ComparisonData} data @param {Theme} theme @returns {Figure} */
function plotFigure({ entries }, theme) {
  const scale = 0.78;
  const wide = layOutDotPlot(entries, (WIDTH * 0.52) / scale).width;
  const plot = dotPlot(entries, wide, theme);
  const [fill] = ink(theme.inkSoft);
  const words = text("average return of an episode (sum of rewards)", wide * scale, plot.height * scale + SMALL, {
    size: SMALL,
    fill,
    anchor: "end",
  });
  return {
    markup: place(plot, 0, 0, scale) + words,
    width: wide * scale,
    height: plot.height * scale + SMALL * 1.6,
  };
}

/** What each learner believes, as many boards as fit beside the plot. @param {ComparisonData} data @param {number} width @param {number} height @param {Theme} theme @returns {Figure} */
function beliefsFigure({ world, beliefs }, width, height, theme) {
  if (beliefs.length === 0) return { markup: "", width: 0, height: 0 };
  const { columns, side } = bestGrid(beliefs.length, { width, height, ratio: world.rows / world.cols });
  const panels = beliefs.map(({ who, title, reward, policy, unknown }) => {
    const view = { values: reward, arrows: policy, unknown };
    return panel(boardOf(world, view, side, theme), { who, title, theme });
  });
  return { ...inGrid(panels, columns, side), width };
}

/** The arrangement with the largest boards. @param {number} count @param {{width: number, height: number, ratio: number}} room */
function bestGrid(count, { width, height, ratio }) {
  let best = { columns: 1, side: 0 };
  for (let columns = 1; columns <= count; columns++) {
    const rows = Math.ceil(count / columns);
    const wide = (width - (columns - 1) * GAP) / columns;
    const high = (height / rows - NAME * 1.8 - GAP / 2) / ratio;
    const side = Math.min(wide, high);
    if (side > best.side) best = { columns, side };
  }
  return best;
}

/** @param {ComparisonData} data @param {Theme} theme @returns {Figure} */
function legendOf({ world, beliefs }, theme) {
  const room = { width: WIDTH, theme, size: SMALL };
  const [first] = beliefs;
  const view = { ...EMPTY_VIEW, ...(first ? { arrows: first.policy, unknown: first.unknown } : {}) };
  const learned = first ? [learnedScales(room)] : [];
  return flow([...trueItems(world, room), ...learned, ...inkItems(world, view, room)], room);
}

/** @param {World} world @param {object} view @param {number} side @param {Theme} theme @returns {Figure} */
function boardOf(world, view, side, theme) {
  const cell = Math.min(LARGEST_CELL, (ENLARGED * side) / world.cols);
  const board = boardFigure(world, view, { cell: cell < 4 ? cell : Math.floor(cell), ratio: 0.8, theme });
  const scale = side / board.width;
  return { markup: place(board, 0, 0, scale), width: side, height: board.height * scale };
}

/** A board below its name. @param {Figure} board @param {{who: string, title: string, right?: string, line?: string, theme: Theme}} about @returns {Figure} */
function panel(board, { who, title, right = "", line = "", theme }) {
  const [fill] = ink(theme.ink);
  const [soft] = ink(theme.inkSoft);
  const sign = markerSign(who, theme, NAME);
  const aside = right === "" ? 0 : textWidth(right, NAME, 600) + 6;
  const room = board.width - sign.width - 4 - aside;
  const size = sizeFor(title, room, NAME, 600);
  const name = fittedInto(title, room, size, 600);
  const top = NAME * 1.5;
  const parts = [
    place(sign, 0, NAME * 0.85 - NAME * 0.36 - sign.height / 2),
    text(name, sign.width + 4, NAME * 0.85, { size, weight: 600, fill }),
    right === "" ? "" : text(right, board.width, NAME * 0.85, { size: NAME, weight: 600, fill, anchor: "end" }),
    place(board, 0, top),
    line === "" ? "" : text(line, 0, top + board.height + SMALL * 1.15, { size: SMALL, fill: soft }),
  ];
  return { markup: parts.join(""), width: board.width, height: top + board.height + (line === "" ? 0 : SMALL * 1.5) };
}

/** @param {Figure[]} panels all alike @param {number} columns @param {number} side @returns {Figure} */
function inGrid(panels, columns, side) {
  const height = Math.max(...panels.map((each) => each.height)) + GAP / 2;
  const markup = panels.map((each, i) => place(each, (i % columns) * (side + GAP), Math.floor(i / columns) * height));
  const rows = Math.ceil(panels.length / columns);
  return { markup: markup.join(""), width: columns * (side + GAP) - GAP, height: rows * height };
}

/** Rows as full as they can be. @param {number} count */
function columnsFor(count) {
  return Math.ceil(count / Math.ceil(count / MOST_IN_A_ROW));
}
