/**
 * What can happen to an attempt: step, undo, give up. The twin of `irl_core.gridworld.simulate`: the browser shows at
 * once what the server will find when it walks the same actions. Attempts are values; each function returns a new one.
 */

import { nextState, rewardOf } from "#js/board/state.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {"goal" | "gave_up" | "out_of_steps"} Ending */

/**
 * @typedef {object} Attempt
 * @property {string} id              UUID, made when the attempt begins
 * @property {readonly number[]} states     T + 1
 * @property {readonly number[]} actions    T, as intended
 * @property {readonly number[]} rewards    T
 * @property {readonly number[]} stepMs     T, time before each step
 * @property {Ending | null} ending
 */

/** @param {World} world @param {string} id @returns {Attempt} */
export function beginAttempt(world, id) {
  return { id, states: [world.start], actions: [], rewards: [], stepMs: [], ending: null };
}

/** One action; after the end nothing moves. @param {World} world @param {Attempt} attempt @param {number} action @param {number} ms @returns {Attempt} */
export function step(world, attempt, action, ms) {
  if (attempt.ending !== null) return attempt;
  const taken = slipDirection(attempt.id, attempt.actions.length, action, world.slip);
  const reached = nextState(world, stateOf(attempt), taken);
  const actions = [...attempt.actions, action];
  return {
    ...attempt,
    actions,
    states: [...attempt.states, reached],
    rewards: [...attempt.rewards, rewardOf(world, reached)],
    stepMs: [...attempt.stepMs, ms],
    ending: world.goals.includes(reached) ? "goal" : actions.length >= world.horizon ? "out_of_steps" : null,
  };
}

/** Take the last action back. @param {Attempt} attempt @returns {Attempt} */
export function undo(attempt) {
  if (attempt.actions.length === 0 || attempt.ending !== null) return attempt;
  return {
    ...attempt,
    states: attempt.states.slice(0, -1),
    actions: attempt.actions.slice(0, -1),
    rewards: attempt.rewards.slice(0, -1),
    stepMs: attempt.stepMs.slice(0, -1),
  };
}

/** Stop here; an attempt without a step is none. @param {Attempt} attempt @returns {Attempt} */
export function giveUp(attempt) {
  return attempt.actions.length === 0 || attempt.ending !== null ? attempt : { ...attempt, ending: "gave_up" };
}

/** Walk known actions again (a checkpoint). @param {World} world @param {string} id @param {readonly number[]} actions @param {readonly number[]} stepMs */
export function replayActions(world, id, actions, stepMs) {
  return actions.reduce((attempt, action, i) => step(world, attempt, action, stepMs[i] ?? 0), beginAttempt(world, id));
}

/** The direction the last step really took, which a slip may have turned. @param {World} world @param {Attempt} attempt @returns {{taken: number, isSlip: boolean}} */
export function lastStep(world, { id, actions }) {
  const intended = actions.at(-1) ?? 0;
  const taken = slipDirection(id, actions.length - 1, intended, world.slip);
  return { taken, isSlip: taken !== intended };
}

/** @param {Attempt} attempt */
export function stateOf(attempt) {
  return attempt.states.at(-1) ?? 0;
}

/** @param {Attempt} attempt */
export function totalOf(attempt) {
  return attempt.rewards.reduce((sum, reward) => sum + reward, 0);
}

/** @param {Attempt} attempt @returns {"success" | "failure"} */
export function outcomeOf(attempt) {
  return attempt.ending === "goal" && totalOf(attempt) >= 0 ? "success" : "failure";
}

/**
 * The direction a step really takes. Drawn by a counter-based hash, so that browser and server agree on it without
 * talking: FNV-1a over "id:step", murmur3's finaliser, u = h / 2³².
 * @param {string} attemptId
 * @param {number} stepNumber counted from 0
 * @param {number} intended
 * @param {number} slip
 */
export function slipDirection(attemptId, stepNumber, intended, slip) {
  if (!(slip > 0)) return intended;
  const u = hash32(`${attemptId}:${stepNumber}`) / 2 ** 32;
  if (u >= slip) return intended;
  return (intended + 1 + Math.min(2, Math.floor((u / slip) * 3))) % 4;
}

/** @param {string} text */
function hash32(text) {
  let h = 0x811c9dc5;
  for (const byte of new TextEncoder().encode(text)) h = Math.imul(h ^ byte, 0x01000193);
  h = Math.imul(h ^ (h >>> 16), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return (h ^ (h >>> 16)) >>> 0;
}
