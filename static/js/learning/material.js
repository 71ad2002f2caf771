/**
 * What a run learns from: the ranked demonstrations with their weights, and the squares they touched.
 * @import {Demonstration, LearnerInfo, Ranking, Rankings, Run, World} from "#js/learning/types.js"
 */
import { plural } from "#js/lib/format.js";

/** @typedef {{ demonstration: Demonstration, weight: number }} Weighted weight θ, 0…1 */

/** What is learned from. @typedef {{ demonstrations: Demonstration[], rankings: Rankings }} Material */

/**
 * What a run learned from, out of its demonstration file.
 * @param {string} text JSON lines
 * @returns {Material}
 */
export function snapshotOf(text) {
  const lines = text
    .split("\n")
    .filter(Boolean)
    .map((line) => JSON.parse(line));
  const rankingOf = (/** @type {string} */ outcome) =>
    lines.find((line) => line.kind === "ranking" && line.outcome === outcome) ?? null;
  return {
    demonstrations: lines.filter(({ kind }) => kind === "demonstration").map((one) => ({ ...one, discarded: false })),
    rankings: { success: rankingOf("success"), failure: rankingOf("failure") },
  };
}

/**
 * True where what stands there now is not what the run learned from: something was played, ranked, discarded or restored.
 * @param {Run} run
 * @param {Material} material
 */
export function isOtherMaterial(run, { demonstrations, rankings }) {
  const nKept = demonstrations.filter((one) => !one.discarded).length;
  return isOutdated(run, demonstrations, rankings) || (run.n_demonstrations ?? nKept) !== nKept;
}

/**
 * The demonstrations that count, with θ: from the ranking of their outcome, else all alike.
 * @param {Demonstration[]} demonstrations
 * @param {Rankings} rankings
 * @param {"success" | "failure"} outcome
 * @returns {Weighted[]} heaviest first
 */
export function weighted(demonstrations, rankings, outcome) {
  const kept = keptOf(demonstrations, outcome);
  const weights = fits(rankings[outcome], kept) ? rankings[outcome]?.weights : undefined;
  return kept
    .map((demonstration) => ({ demonstration, weight: weights?.[demonstration.id] ?? 1 / kept.length }))
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
 * "To learn from: 3 successes and 3 failures, in your order."
 * @param {Demonstration[]} demonstrations
 * @param {Rankings} rankings
 */
export function describeMaterial(demonstrations, rankings) {
  const successes = keptOf(demonstrations, "success");
  const failures = keptOf(demonstrations, "failure");
  if (successes.length + failures.length === 0)
    return "There is nothing to learn from yet: play first, then put your attempts in order.";
  const counts = `${plural(successes.length, "success", "successes")} and ${plural(failures.length, "failure")}`;
  return `To learn from: ${counts}, ${orderInWords(successes, failures, rankings)}.`;
}

/**
 * @param {Demonstration[]} successes
 * @param {Demonstration[]} failures
 * @param {Rankings} rankings
 */
function orderInWords(successes, failures, rankings) {
  const isOrdered = {
    success: successes.length < 2 || fits(rankings.success, successes),
    failure: failures.length < 2 || fits(rankings.failure, failures),
  };
  if (isOrdered.success && isOrdered.failure)
    return successes.length + failures.length > 2 ? "in your order" : "nothing to order";
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

/**
 * True when a learner could start if only a failure had reached the goal: there are failures, all ended elsewhere.
 * @param {Demonstration[]} demonstrations
 * @param {Pick<LearnerInfo, "uses_failures">} learner
 */
export function lacksFinished(demonstrations, { uses_failures }) {
  const failures = keptOf(demonstrations, "failure");
  const isStuck = failures.length > 0 && failures.every((one) => one.ending !== "goal");
  return uses_failures && isStuck && keptOf(demonstrations, "success").length > 0;
}

/**
 * What a learner misses once the setting "unfinished failures" is taken into account; null when it can start. (The page
 * was made with the default, to leave them out.)
 * @param {Pick<LearnerInfo, "title" | "uses_failures" | "uses_ranking" | "takes_anything" | "missing">} learner
 * @param {Demonstration[]} demonstrations
 * @param {Rankings} rankings
 * @param {string} unfinished "leave_out" or "include"
 * @returns {string | null}
 */
export function missingWith(learner, demonstrations, rankings, unfinished) {
  const { missing, takes_anything } = learner;
  if (missing === null || takes_anything || !lacksFinished(demonstrations, learner)) return missing;
  if (unfinished !== "include")
    return `${learner.title} needs a failure that reaches the goal with a total below 0. Yours ended elsewhere: play one, or include them.`;
  const isOrdered = /** @type {const} */ (["success", "failure"]).every((outcome) => {
    const kept = keptOf(demonstrations, outcome);
    return kept.length < 2 || fits(rankings[outcome], kept);
  });
  return learner.uses_ranking && !isOrdered ? `${learner.title} needs your attempts in order.` : null;
}

/**
 * Where a person goes to give a learner what it misses: to the order if there are attempts of every kind it needs.
 * @param {World} world
 * @param {Demonstration[]} demonstrations
 * @param {Pick<LearnerInfo, "uses_failures">} learner
 * @param {string} [unfinished] the setting: "leave_out" or "include"
 * @returns {{ href: string, text: string }}
 */
export function wayThere(world, demonstrations, learner, unfinished = "leave_out") {
  if (unfinished !== "include" && lacksFinished(demonstrations, learner))
    return { href: `/worlds/${world.id}`, text: "Play →" };
  const hasAll =
    keptOf(demonstrations, "success").length > 0 &&
    (!learner.uses_failures || keptOf(demonstrations, "failure").length > 0);
  return hasAll
    ? { href: `/worlds/${world.id}/rank`, text: "Rank your attempts →" }
    : { href: `/worlds/${world.id}`, text: "Play →" };
}

/**
 * @param {Demonstration[]} demonstrations
 * @param {"success" | "failure"} outcome
 */
function keptOf(demonstrations, outcome) {
  return demonstrations.filter((one) => one.outcome === outcome && !one.discarded);
}

/**
 * True when a ranking still speaks of exactly these demonstrations.
 * @param {Ranking | null} ranking
 * @param {Demonstration[]} kept
 */
function fits(ranking, kept) {
  const ids = new Set(ranking?.order.flat());
  return ranking !== null && ids.size === kept.length && kept.every((one) => ids.has(one.id));
}
