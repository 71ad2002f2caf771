/**
 * Good and bad stretches: runs of steps of one attempt, and the order that follows. Plain data, no page.
 * `irl_core/preferences/stretches.py` is the twin; tests/core/gap_and_stretch_vectors.json holds both to one table.
 */

import { facingOf } from "#js/board/facing.js";
import { colourOf, DIRECTIONS, rewardOf } from "#js/board/state.js";
import { plural } from "#js/lib/format.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Stretch} Stretch */
/** @typedef {"good" | "bad"} Kind */
/** @typedef {{states: readonly number[], actions: readonly number[]}} Walk */
/** @typedef {{anchor: number, head: number}} Selection   steps counted from 1; the head is the end that moves */
/** @typedef {{n: number, state: number, moved: string, colour: string, sign: string}} Step */

/** (good − bad) / steps; an attempt without any step has 0. @param {readonly Stretch[]} stretches @param {number} nSteps */
export function scoreOf(stretches, nSteps) {
  const { good, bad } = stepsMarked(stretches);
  return nSteps > 0 ? (good - bad) / nSteps : 0;
}

/**
 * Successes from the highest score, failures from the lowest; equal scores tie, in the order of `ids`.
 * @param {readonly string[]} ids @param {(id: string) => number} score @param {Outcome} outcome @returns {string[][]}
 */
export function orderFromScores(ids, score, outcome) {
  const sign = outcome === "success" ? -1 : 1;
  const scored = ids.map((id) => ({ id, score: score(id) })).sort((a, b) => sign * (a.score - b.score));
  /** @type {string[][]} */
  const groups = [];
  for (const [i, one] of scored.entries()) {
    if (i > 0 && scored[i - 1]?.score === one.score) groups.at(-1)?.push(one.id);
    else groups.push([one.id]);
  }
  return groups;
}

/** Whether both hold the same groups; who stands first in a tie does not matter. @param {Order} a @param {Order} b */
export function isSameOrder(a, b) {
  const plain = (/** @type {Order} */ order) => JSON.stringify(order.map((group) => [...group].sort()));
  return plain(a) === plain(b);
}

/** How many steps are marked good and bad. @param {readonly Stretch[]} stretches */
export function stepsMarked(stretches) {
  const count = (/** @type {Kind} */ kind) =>
    stretches.reduce((sum, { from, to, kind: its }) => sum + (its === kind ? to - from + 1 : 0), 0);
  return { good: count("good"), bad: count("bad") };
}

/** @param {readonly Stretch[]} stretches @param {number} step @returns {Kind | null} */
export function kindOf(stretches, step) {
  return stretches.find(({ from, to }) => from <= step && step <= to)?.kind ?? null;
}

/** The n-th step leads from the n-th square of the walk to the next. @param {World} world @param {Walk} walk @returns {Step[]} */
export function stepsOf(world, walk) {
  return walk.actions.map((_, i) => {
    const state = walk.states[i + 1] ?? 0;
    const stayed = state === walk.states[i];
    const facing = facingOf(world, walk, i + 1);
    const moved = stayed || facing === null ? "stays" : (DIRECTIONS[facing] ?? "stays");
    return { n: i + 1, state, moved, colour: colourOf(world, state), sign: signOf(rewardOf(world, state)) };
  });
}

/** Go to a step: the selection reaches there from its anchor, or begins anew. @param {Selection | null} selection @param {number} step @param {{extends: boolean, nSteps: number}} how @returns {Selection | null} */
export function select(selection, step, { extends: reaches, nSteps }) {
  if (nSteps < 1) return null;
  const head = Math.min(nSteps, Math.max(1, step));
  return { anchor: reaches && selection ? selection.anchor : head, head };
}

/** @param {Selection} selection @returns {{from: number, to: number}} */
export function endsOf({ anchor, head }) {
  return { from: Math.min(anchor, head), to: Math.max(anchor, head) };
}

/** "step 4", "steps 3 to 7". @param {{from: number, to: number}} run */
export function runWords({ from, to }) {
  return from === to ? `step ${from}` : `steps ${from} to ${to}`;
}

/** "2 good stretches, 1 bad one", "nothing marked yet". @param {readonly Stretch[]} stretches */
export function markedWords(stretches) {
  const n = (/** @type {Kind} */ kind) => stretches.filter((one) => one.kind === kind).length;
  const [good, bad] = [n("good"), n("bad")];
  if (good + bad === 0) return "nothing marked yet";
  if (bad === 0) return plural(good, "good stretch", "good stretches");
  if (good === 0) return plural(bad, "bad stretch", "bad stretches");
  return `${good} good, ${plural(bad, "bad stretch", "bad stretches")}`;
}

/** @param {number} reward */
function signOf(reward) {
  if (reward === 0) return "0";
  return reward > 0 ? "+" : "−";
}
