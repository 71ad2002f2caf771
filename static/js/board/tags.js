/** Figures on boards whose squares are too small to hold their own: those beside the agent, and the one pointed at. */

import { SMALLEST_FIGURES } from "#js/board/ink.js";
import { DELTAS, nextState, placeOf, rewardOf } from "#js/board/state.js";
import { number } from "#js/lib/format.js";

/** How far a tag stands from the middle of the agent, in CSS pixels. */
const [ASIDE, ABOVE] = [34, 22];

/** @typedef {{x: number, y: number, text: string}} Tag   x and y in CSS pixels from the board's corner */

/**
 * @param {import("#js/board/state.js").World} world
 * @param {import("#js/board/state.js").View} view
 * @param {{cell: number, pointed: number | null}} at   side of a square in CSS pixels; the square under the pointer
 * @returns {Tag[]}
 */
export function figureTags(world, view, { cell, pointed }) {
  if (!view.numbers || cell >= SMALLEST_FIGURES) return [];
  const middle = (/** @type {number} */ state) => {
    const [row, col] = placeOf(world, state);
    return { x: (col + 0.5) * cell, y: (row + 0.5) * cell };
  };
  const text = (/** @type {number} */ state) =>
    number(view.values ? (view.values[state] ?? 0) : rewardOf(world, state));
  if (pointed !== null && !world.walls.includes(pointed)) {
    const { x, y } = middle(pointed);
    return [{ x, y: y - ABOVE, text: text(pointed) }];
  }
  const here = view.agents[0]?.state;
  if (here === undefined) return [];
  return DELTAS.flatMap(([down, right], action) => {
    const next = nextState(world, here, action);
    if (next === here) return [];
    const { x, y } = middle(here);
    return [{ x: x + right * ASIDE, y: y + down * ABOVE, text: text(next) }];
  });
}
