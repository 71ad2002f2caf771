/** The board in words: what stands around the agent, a square, the way to the goal; for whoever does not see the board. */

import { colourOf, DIRECTIONS, nextState, placeOf, rewardOf } from "#js/board/state.js";
import { number } from "#js/lib/format.js";

/** @typedef {import("#js/board/state.js").World} World */

/** "Row 2, column 3." with its four neighbours. @param {World} world @param {number} state */
export function describePosition(world, state) {
  const around = DIRECTIONS.map((direction, action) => `${direction}: ${describeNeighbour(world, state, action)}`);
  return `${describePlace(world, state)}. ${capital(around.join("; "))}.`;
}

/** "Row 3, column 4: red, −3.2." @param {World} world @param {number} state */
export function describeSquare(world, state) {
  const start = state === world.start ? ", the start" : "";
  return `${describePlace(world, state)}: ${describeGround(world, state, ", ")}${start}.`;
}

/** "The goal is 3 down and 2 right."; of several the nearest. @param {World} world @param {number} state */
export function describeWay(world, state) {
  if (world.goals.includes(state)) return "This is the goal.";
  const [row, col] = placeOf(world, state);
  const ways = world.goals.map((goal) => {
    const [toRow, toCol] = placeOf(world, goal);
    return { down: toRow - row, right: toCol - col };
  });
  const far = (/** @type {{down: number, right: number}} */ way) => Math.abs(way.down) + Math.abs(way.right);
  const [way] = ways.sort((a, b) => far(a) - far(b));
  if (!way) return "";
  const parts = [
    way.down > 0 ? `${way.down} down` : way.down < 0 ? `${-way.down} up` : "",
    way.right > 0 ? `${way.right} right` : way.right < 0 ? `${-way.right} left` : "",
  ];
  const which = world.goals.length > 1 ? "The nearest goal" : "The goal";
  return `${which} is ${parts.filter(Boolean).join(" and ")}.`;
}

/** "red −3.2", "goal +14", "wall": what a square is, in the fewest words. @param {World} world @param {number} state */
export function wordsOf(world, state) {
  const colour = colourOf(world, state);
  const reward = rewardOf(world, state);
  if (colour === "wall") return "wall";
  return colour === "goal" ? `goal +${payOf(reward)}` : `${colour} ${number(reward)}`;
}

/** @param {World} world @param {number} state */
function describePlace(world, state) {
  const [row, col] = placeOf(world, state);
  return `Row ${row + 1}, column ${col + 1}`;
}

/** @param {World} world @param {number} state @param {string} pause between the colour and the reward */
function describeGround(world, state, pause) {
  const colour = colourOf(world, state);
  if (colour === "wall") return "a wall";
  if (colour === "goal") return `the goal, plus ${payOf(rewardOf(world, state))}`;
  return `${colour}${pause}${number(rewardOf(world, state))}`;
}

/** "14"; a goal that was painted may pay 0.4. @param {number} reward */
function payOf(reward) {
  return number(reward, Number.isInteger(reward) ? 0 : 1);
}

/** @param {World} world @param {number} state @param {number} action */
function describeNeighbour(world, state, action) {
  const next = nextState(world, state, action);
  if (next !== state) return describeGround(world, next, " ");
  return leadsToWall(world, state, action) ? "a wall" : "the edge";
}

/** @param {World} world @param {number} state @param {number} action */
function leadsToWall(world, state, action) {
  return nextState({ ...world, walls: [] }, state, action) !== state;
}

/** @param {string} text */
function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
