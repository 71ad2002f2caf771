/**
 * A board of "Why" as a picture that stands alone: the board with its frames, the scale in the words of the page, and what
 * it is about.
 * @import {View, World} from "#js/board/state.js"
 */
import { symmetricRange } from "#js/board/colours.js";
import { framePath, squarePath } from "#js/comparisons/why/marks.js";
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
 * @param {{ view: Partial<View>, framed: readonly number[], dimmed: readonly number[], ends: [string, string] | null }} shown
 * @param {{ title: string, note: string }} about
 */
export function whyPicture(world, { view, framed: states, dimmed, ends }, { title, note }) {
  const theme = paletteOf("light");
  const board = boardFigure(world, view, { theme, layers: "squares" });
  const ink = boardFigure(world, view, { theme, layers: "above" });
  const width = Math.max(NARROWEST, board.width);
  const parts = [{ ...board, markup: board.markup + marks(world, { framed: states, dimmed }, theme) + ink.markup }];
  if (ends) {
    const sign = diverging(view.scale ?? symmetricRange(view.values ?? []), { theme, size: SIZE });
    parts.push(flow([{ before: ends[0], sign, words: ends[1] }], { width, theme, size: SIZE }));
  }
  return framed(parts, { title, note: `${note} ${worldSentence(world)}`.trim(), theme, width });
}

/**
 * What `marks.js` lays between the squares and their arrows, in the inks of paper.
 * @param {World} world
 * @param {{ framed: readonly number[], dimmed: readonly number[] }} states
 * @param {import("#js/board/theme.js").Theme} theme
 */
function marks(world, { framed: states, dimmed }, { inkLight, inkDark, unknown }) {
  const [frames, squares] = [framePath(world, states), squarePath(world, dimmed)];
  const lines = [
    { d: squares, fill: unknown, "fill-opacity": 0.28 },
    { d: frames, stroke: inkLight, "stroke-width": 0.13, fill: "none" },
    { d: frames, stroke: inkDark, "stroke-width": 0.06, fill: "none" },
  ].filter(({ d }) => d !== "");
  return lines.length > 0 ? place(lines.map((line) => tag("path", line)).join(""), EDGE, EDGE, cellFor(world)) : "";
}
