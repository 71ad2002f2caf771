/**
 * One square of a board of "Why" in words.
 * @import {Uncertainty} from "#js/comparisons/why/types.js"
 * @import {World} from "#js/board/state.js"
 */
import { colourOf, DIRECTIONS, placeOf } from "#js/board/state.js";
import { percent, significant } from "#js/charts/figures.js";

/** Chances that differ by less are equals. */
const EQUALS = 1e-9;

/** @typedef {{ reward: number[], policy: number[][] }} Belief */

/** "Row 1, column 2: goes right, went up before; reward 0.11 → 0.31." @param {World} world @param {number} state @param {Belief} before @param {Belief} after */
export function changeWords(world, state, before, after) {
  const [from, to] = [before.reward[state], after.reward[state]].map(significant);
  const reward = from === to ? `reward ${to}` : `reward ${from} → ${to}`;
  return inPlace(world, state, () => stepWords(before.policy[state], after.policy[state]), reward);
}

/** @param {number[] | undefined} before @param {number[] | undefined} after chances of the four steps */
function stepWords(before, after) {
  const [then, now] = [likeliest(before), likeliest(after)];
  const went = now.some((step) => then.includes(step)) ? "" : `, went ${inWords(then)} before`;
  return `goes ${inWords(now)}${went}`;
}

/** "Row 1, column 2: goes right, as in 64 % of the draws; reward −0.3 to 0.8." @param {World} world @param {number} state @param {Belief} belief @param {Uncertainty} found */
export function doubtWords(world, state, { policy }, { policy_agreement, reward_low, reward_high }) {
  const step = () =>
    `goes ${inWords(likeliest(policy[state]))}, as in ${percent(policy_agreement[state])} of the draws`;
  return inPlace(world, state, step, `reward ${significant(reward_low[state])} to ${significant(reward_high[state])}`);
}

/** The likeliest steps, several where they are equals. @param {number[] | undefined} row */
function likeliest(row = []) {
  const most = Math.max(...row);
  return DIRECTIONS.filter((_, action) => (row[action] ?? 0) >= most - EQUALS);
}

/** "up", "up or right"; who goes everywhere alike goes "anywhere". @param {readonly string[]} steps */
function inWords(steps) {
  if (steps.length === DIRECTIONS.length) return "anywhere";
  return `${steps.slice(0, -1).join(", ")}${steps.length > 1 ? " or " : ""}${steps.at(-1)}`;
}

/** Where it is, what is done there, what it is held worth. @param {World} world @param {number} state @param {() => string} step @param {string} reward */
function inPlace(world, state, step, reward) {
  const [row, col] = placeOf(world, state);
  const place = `Row ${row + 1}, column ${col + 1}`;
  if (colourOf(world, state) === "wall") return `${place}: a wall.`;
  return `${place}: ${world.goals.includes(state) ? "the goal" : step()}; ${reward}.`;
}
