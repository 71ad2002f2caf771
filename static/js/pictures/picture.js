/** One board as a picture that stands alone: what it shows above it, what its colours mean and where it comes from below. */

import { boardFigure, paletteOf } from "#js/pictures/board.js";
import { legendFigure } from "#js/pictures/legend.js";
import { ink } from "#js/pictures/pen.js";
import { place, svgDocument, text } from "#js/pictures/svg.js";
import { brokenInto } from "#js/pictures/text-width.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */
/** @typedef {import("#js/pictures/svg.js").Figure} Figure */
/** @typedef {import("#js/board/theme.js").Theme} Theme */

const MARGIN = 16;
const NARROWEST = 320;
const TITLE = 17;
const NOTE = 12;

/**
 * @param {World} world @param {Partial<View>} view
 * @param {{title: string, note?: string, values?: string, theme?: "light" | "dark" | Theme}} about
 *   `note`: a sentence below, beside the world's; `values`: what they are, where they are not a learned reward
 */
export function boardPicture(world, view, { title, note = "", values = "", theme = "light" }) {
  const palette = paletteOf(theme);
  const board = boardFigure(world, view, { theme: palette });
  const width = Math.max(NARROWEST, board.width);
  const legend = legendFigure(world, view, { width, theme: palette, size: NOTE, values });
  return framed([board, legend], { title, note: `${note} ${worldSentence(world)}`.trim(), theme: palette, width });
}

/**
 * Parts below each other, between a title and a note.
 * @param {Figure[]} parts @param {{title: string, note: string, theme: Theme, width: number}} about
 */
export function framed(parts, { title, note, theme, width }) {
  const [fill] = ink(theme.ink);
  const [soft] = ink(theme.inkSoft);
  let y = MARGIN;
  const drawn = [];
  for (const line of brokenInto(title, width, TITLE, 600)) {
    drawn.push(text(line, 0, y + TITLE * 0.8, { size: TITLE, weight: 600, fill }));
    y += TITLE * 1.3;
  }
  y += 4;
  for (const part of parts) {
    drawn.push(place(part, 0, y));
    y += part.height + 10;
  }
  for (const line of brokenInto(note, width, NOTE)) {
    drawn.push(text(line, 0, y + NOTE * 0.8, { size: NOTE, fill: soft }));
    y += NOTE * 1.45;
  }
  const whole = { markup: place(drawn.join(""), MARGIN, 0), width: width + 2 * MARGIN, height: y + MARGIN };
  return svgDocument(whole, { title, description: note, ground: ink(theme.canvas)[0] });
}

/** Which world this is, so that anybody can draw it again. @param {World} world */
export function worldSentence({ rows, cols, seed, walls }) {
  const size = `World of ${rows} × ${cols} squares`;
  if (seed === null) return `${size}, made by hand.`;
  return `${size}, seed ${seed}${walls.length > 0 ? ", with walls" : ""}.`;
}
