/**
 * What every question of "Why" is about: the run, its attempts, and whose they are.
 * @import {Attempt} from "#js/comparisons/why/types.js"
 * @import {Who} from "#js/comparisons/why/words.js"
 * @import {Parts} from "#js/elements/compare-page.js"
 * @import {Entry} from "#js/comparisons/types.js"
 * @import {Voice} from "#js/comparisons/voice.js"
 * @import {Result, World} from "#js/learning/types.js"
 */
import { voiceOf } from "#js/comparisons/voice.js";
import { attemptsOf } from "#js/comparisons/why/attempts.js";

/** @typedef {Who & { name: string, entry: Entry | null, result: Result }} Asked   the learner that is asked about */
/**
 * @typedef {object} About
 * @property {string} runId
 * @property {World} world
 * @property {Attempt[]} attempts
 * @property {Voice} voice
 * @property {boolean} isOwn seen by who played
 * @property {boolean} leavesOut failures that never reached the goal are not learned from
 * @property {Asked[]} learners
 * @property {{ human: Entry | null, optimal: Entry | null }} others
 */

/** @param {Parts} parts @returns {About} */
export function aboutOf({ data, entries }) {
  const { world, run, learners, is_own } = data;
  const entryOf = (/** @type {string} */ who) => entries.find((entry) => entry.who === who) ?? null;
  return {
    runId: run.id,
    world,
    attempts: attemptsOf(data),
    voice: voiceOf(is_own),
    isOwn: is_own !== false,
    leavesOut: run.settings.unfinished_failures !== "include",
    learners: learners
      .filter(({ name }) => run.learners[name]?.policy)
      .map((learner) => ({ ...learner, entry: entryOf(learner.name), result: run.learners[learner.name] ?? empty() })),
    others: { human: entryOf("human"), optimal: entryOf("optimal") },
  };
}

/** @returns {Result} */
function empty() {
  return { outcome: null };
}
