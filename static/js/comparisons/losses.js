/**
 * Where it goes wrong: how much less than the best plan a learner earns from each square on, as a layer of the board and in
 * words. One scale for all boards, so that they can be held against each other.
 * @import {Comparison} from "#js/comparisons/types.js"
 * @import {World} from "#js/board/state.js"
 */
import { placeOf } from "#js/board/state.js";
import { figure } from "#js/charts/figures.js";

/** Less than this is rounding, or too little to show. */
const NOTHING = 0.05;

/**
 * The layer of a board, or null for who has no policy: the red arm of the scale, hatched as all that is lost.
 * @param {Comparison} comparison
 * @param {string} who
 */
export function lossLayer(comparison, who) {
  const { value_lost_scale } = comparison;
  const lost = lossesOf(comparison, who);
  if (!lost) return null;
  const end = value_lost_scale || 1;
  return { values: lost.map((value) => -value), scale: /** @type {[number, number]} */ ([-end, end]) };
}

/**
 * "Loses most at row 3, column 5: 4.2.", and the same in the width of a board.
 * @param {World} world
 * @param {Comparison} comparison
 * @param {string} who
 * @returns {{ sentence: string, short: string }}
 */
export function worstOf(world, comparison, who) {
  if (who === "human") return alike("An attempt is no policy.");
  const lost = lossesOf(comparison, who);
  if (!lost) return alike("");
  const most = Math.max(...lost);
  if (most < NOTHING) return alike("Loses nothing anywhere.");
  const [row, col] = placeOf(world, lost.indexOf(most));
  const place = `at row ${row + 1}, column ${col + 1}`;
  return { sentence: `Loses most ${place}: ${figure(most)}.`, short: `Worst ${place}: ${figure(-most)}` };
}

/** @param {string} sentence */
function alike(sentence) {
  return { sentence, short: sentence };
}

/** The optimum is the measure: it loses nothing anywhere. @param {Comparison} comparison @param {string} who */
function lossesOf({ value_lost }, who) {
  const [some] = Object.values(value_lost ?? {});
  return who === "optimal" ? some?.map(() => 0) : value_lost?.[who];
}

/** What stands at both ends of the legend. @param {Comparison} comparison */
export function lossEnds({ value_lost, value_lost_scale }) {
  const most = Math.max(0, ...Object.values(value_lost ?? {}).map((lost) => Math.max(...lost)));
  const end = value_lost_scale ?? 0;
  return { none: "0", all: figure(end) + (most > end + NOTHING ? " or more" : "") };
}
