/**
 * How often somebody comes by each square: the attempts, weighted as a learner weighs them, and what its policy does
 * more or less than they did. Shape (S,).
 * @import {Demonstration, LearnerInfo, Rankings, World} from "#js/learning/types.js"
 */
import { weighted } from "#js/learning/material.js";

/**
 * μ̃ of the successes: what a learner that seeks visits draws near to. Weighted by the order where it looks at the order.
 * @param {World} world
 * @param {Demonstration[]} demonstrations
 * @param {Rankings} rankings
 * @param {Pick<LearnerInfo, "uses_ranking">} learner
 * @returns {number[]}
 */
export function visitsOfAttempts(world, demonstrations, rankings, { uses_ranking }) {
  const orders = uses_ranking ? rankings : { success: null, failure: null };
  /** @type {number[]} */
  const visits = new Array(world.rows * world.cols).fill(0);
  for (const { demonstration, weight } of weighted(demonstrations, orders, "success")) {
    for (const state of demonstration.states) visits[state] = (visits[state] ?? 0) + weight;
  }
  return visits;
}

/**
 * Above 0 where the policy comes more often than the attempts did.
 * @param {number[]} learned
 * @param {number[]} played
 */
export function differenceOf(learned, played) {
  return learned.map((visits, state) => visits - (played[state] ?? 0));
}

/** The largest size, where it is a number. @param {number[]} values */
export function largestSize(values) {
  let largest = 0;
  for (const value of values) if (Number.isFinite(value)) largest = Math.max(largest, Math.abs(value));
  return largest;
}
