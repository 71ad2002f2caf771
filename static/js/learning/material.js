/**
 * What a run learns from: the ranked demonstrations with their weights, and the squares they touched.
 * @import {Demonstration, LearnerInfo, Rankings, Run, World} from "#js/learning/types.js"
 */
import { plural } from "#js/lib/format.js";

/** @typedef {{ demonstration: Demonstration, weight: number }} Weighted weight θ, 0…1 */

/**
 * The demonstrations that count, with θ: from the ranking of their outcome, else all alike.
 * @param {Demonstration[]} demonstrations
 * @param {Rankings} rankings
 * @param {"success" | "failure"} outcome
 * @returns {Weighted[]} heaviest first
 */
export function weighted(demonstrations, rankings, outcome) {
  const kept = demonstrations.filter((one) => one.outcome === outcome && !one.discarded);
  const weights = rankings[outcome]?.weights;
  return kept
    .map((demonstration) => ({ demonstration, weight: weights ? (weights[demonstration.id] ?? 0) : 1 / kept.length }))
    .sort((a, b) => b.weight - a.weight);
}

/**
 * Which squares no demonstration that this learner uses came to. Shape (S,).
 * @param {World} world
 * @param {Demonstration[]} demonstrations
 * @param {Pick<LearnerInfo, "uses_failures">} learner
 */
export function untouched(world, demonstrations, learner) {
  /** @type {boolean[]} */
  const unknown = new Array(world.rows * world.cols).fill(true);
  for (const one of demonstrations) {
    if (one.discarded || (one.outcome === "failure" && !learner.uses_failures)) continue;
    for (const state of one.states) unknown[state] = false;
  }
  for (const wall of world.walls) unknown[wall] = false;
  return unknown;
}

/**
 * "3 successes and 3 failures, both in your order".
 * @param {Demonstration[]} demonstrations
 * @param {Rankings} rankings
 */
export function describeMaterial(demonstrations, rankings) {
  const successes = weighted(demonstrations, rankings, "success").length;
  const failures = weighted(demonstrations, rankings, "failure").length;
  if (successes + failures === 0) return "Nothing to learn from yet.";
  const counts = `${plural(successes, "success", "successes")} and ${plural(failures, "failure")}`;
  return `${counts}, ${orderInWords(successes, failures, rankings)}.`;
}

/**
 * @param {number} successes
 * @param {number} failures
 * @param {Rankings} rankings
 */
function orderInWords(successes, failures, rankings) {
  const isOrdered = { success: successes < 2 || !!rankings.success, failure: failures < 2 || !!rankings.failure };
  if (isOrdered.success && isOrdered.failure) return successes + failures > 2 ? "in your order" : "nothing to order";
  if (isOrdered.success) return "the failures not in order yet";
  if (isOrdered.failure) return "the successes not in order yet";
  return "not in order yet";
}

/**
 * True when the person played or ranked after the run took its snapshot.
 * @param {Run} run
 * @param {Demonstration[]} demonstrations
 * @param {Rankings} rankings
 */
export function isOutdated(run, demonstrations, rankings) {
  const taken = Date.parse(run.created_at);
  const changes = [
    ...demonstrations.map((one) => one.created_at),
    rankings.success?.created_at,
    rankings.failure?.created_at,
  ];
  return changes.some((at) => at !== undefined && Date.parse(at) > taken);
}
