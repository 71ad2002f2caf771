/**
 * A board of "Why" as a picture that stands alone: the board with its frames, the scale in the words of the page, and what
 * it is about.
 * @import {View, World} from "#js/board/state.js"
 */
import { symmetricRange } from "#js/board/colours.js";
import { framePath } from "#js/comparisons/why/marks.js";
import { boardFigure, cellFor, paletteOf } from "#js/pictures/board.js";
import { diverging, flow } from "#js/pictures/legend.js";
import { framed, worldSentence } from "#js/pictures/picture.js";
import { place, tag } from "#js/pictures/svg.js";

const NARROWEST = 320;
const SIZE = 12;
/** Of the board's own edge. */
const EDGE = 1;

/**
 * @param {World} world
 * @param {{ view: Partial<View>, framed: readonly number[], ends: [string, string] | null }} shown
 * @param {{ title: string, note: string }} about
 */
export function whyPicture(world, { view, framed: states, ends }, { title, note }) {
  const theme = paletteOf("light");
  const board = boardFigure(world, view, { theme });
  const width = Math.max(NARROWEST, board.width);
  const parts = [{ ...board, markup: board.markup + frames(world, states, theme) }];
  if (ends) {
    const sign = diverging(view.scale ?? symmetricRange(view.values ?? []), { theme, size: SIZE });
    parts.push(flow([{ before: ends[0], sign, words: ends[1] }], { width, theme, size: SIZE }));
  }
  return framed(parts, { title, note: `${note} ${worldSentence(world)}`.trim(), theme, width });
}

/** @param {World} world @param {readonly number[]} states @param {{ inkLight: string, inkDark: string }} theme */
function frames(world, states, { inkLight, inkDark }) {
  const d = framePath(world, states);
  const lines = /** @type {const} */ ([
    [inkLight, 0.13],
    [inkDark, 0.06],
  ]).map(([stroke, width]) => tag("path", { d, stroke, "stroke-width": width, fill: "none" }));
  return states.length > 0 ? place(lines.join(""), EDGE, EDGE, cellFor(world)) : "";
}
