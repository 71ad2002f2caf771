/**
 * One square of a board of "Why" in words.
 * @import {Uncertainty} from "#js/comparisons/why/types.js"
 * @import {World} from "#js/board/state.js"
 */
import { colourOf, DIRECTIONS } from "#js/board/state.js";
import { percent, significant } from "#js/charts/figures.js";

/** Chances that differ by less are equals. */
const EQUALS = 1e-9;

/** @typedef {{ reward: number[], policy: number[][] }} Belief */

/** "goes right, went up before; reward 0.31". @param {World} world @param {number} state @param {Belief} belief @param {Belief} [before] */
export function squareWords(world, state, belief, before = belief) {
  const reward = `reward ${significant(belief.reward[state])}`;
  const bare = bareWords(world, state);
  if (bare) return bare === "a wall" ? bare : `${bare}, ${reward}`;
  const [now, then] = [likeliest(belief.policy[state]), likeliest(before.policy[state])];
  const went = now.some((step) => then.includes(step)) ? "" : `, went ${inWords(then)} before`;
  return `goes ${inWords(now)}${went}; ${reward}`;
}

/** "reward +0.12, from 0.31 to 0.43". @param {World} world @param {number} state @param {Belief} before @param {Belief} after */
export function differenceWords(world, state, before, after) {
  if (bareWords(world, state) === "a wall") return "a wall";
  const [from, to] = [before.reward[state] ?? 0, after.reward[state] ?? 0];
  const sign = to > from ? "+" : "";
  return `reward ${sign}${significant(to - from)}, from ${significant(from)} to ${significant(to)}`;
}

/** "goes right in 64 % of the draws; reward −0.3 to 0.8". @param {World} world @param {number} state @param {Belief} belief @param {Uncertainty} found */
export function doubtWords(world, state, { policy }, { policy_agreement, reward_low, reward_high }) {
  const reward = `reward ${significant(reward_low[state])} to ${significant(reward_high[state])}`;
  const bare = bareWords(world, state);
  if (bare) return bare === "a wall" ? bare : `${bare}, ${reward}`;
  return `goes ${inWords(likeliest(policy[state]))}, as in ${percent(policy_agreement[state])} of the draws; ${reward}`;
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

/** Where no arrow stands. @param {World} world @param {number} state */
function bareWords(world, state) {
  if (colourOf(world, state) === "wall") return "a wall";
  return world.goals.includes(state) ? "the goal" : "";
}
