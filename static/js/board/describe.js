/** A position in words: what stands around the agent, for whoever does not see the board. */

import { colourOf, DIRECTIONS, nextState, placeOf, rewardOf } from "#js/board/state.js";
import { number } from "#js/lib/format.js";

/** @typedef {import("#js/board/state.js").World} World */

/** "Row 2, column 3." with its four neighbours. @param {World} world @param {number} state */
export function describePosition(world, state) {
  const [row, col] = placeOf(world, state);
  const around = DIRECTIONS.map((direction, action) => `${direction}: ${describeNeighbour(world, state, action)}`);
  return `Row ${row + 1}, column ${col + 1}. ${capital(around.join("; "))}.`;
}

/** @param {World} world @param {number} state @param {number} action */
function describeNeighbour(world, state, action) {
  const next = nextState(world, state, action);
  if (next === state) return leadsToWall(world, state, action) ? "a wall" : "the edge";
  const colour = colourOf(world, next);
  return colour === "goal"
    ? `the goal, plus ${number(rewardOf(world, next), 0)}`
    : `${colour} ${number(rewardOf(world, next))}`;
}

/** @param {World} world @param {number} state @param {number} action */
function leadsToWall(world, state, action) {
  return nextState({ ...world, walls: [] }, state, action) !== state;
}

/** @param {string} text */
function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
