/**
 * Who stands on the stage: the person with two of their attempts, the learners as they were asked for, the optimum.
 * @import {ComparePageData, Entry, Episode} from "#js/comparisons/types.js"
 */
import { figure, withError } from "#js/charts/figures.js";
import { onStage } from "#js/comparisons/sentences.js";
import { voiceOf } from "#js/comparisons/voice.js";
import { plural } from "#js/lib/format.js";

/**
 * @typedef {object} Role
 * @property {string} key      "human-best", "human-mean", or who
 * @property {Entry} entry
 * @property {string} title
 * @property {Episode[]} episodes   one alone is played in every episode
 * @property {(episode: number) => string} nameOf   "attempt 3 of 6", "episode 12"
 * @property {string} standing       what this board stands for, in a line
 */

/** @param {ComparePageData} data @param {Entry[]} entries @returns {Role[]} */
export function castOf(data, entries) {
  return onStage(entries, Object.keys(data.run.learners)).flatMap((entry) =>
    entry.who === "human" ? attemptsOnStage(data, entry) : [policyOnStage(data, entry)],
  );
}

/** @param {ComparePageData} data @param {Entry} entry @returns {Role} */
function policyOnStage({ rollouts }, entry) {
  const { who, title } = entry;
  return {
    key: who,
    entry,
    title,
    episodes: rollouts[who] ?? [],
    nameOf: (episode) => `episode ${episode + 1}`,
    standing: `${withError(entry.mean_return, entry.standard_error)} over ${plural(entry.episodes, "episode")}`,
  };
}

/** The best attempt and the one nearest the mean; once where they are the same. @param {ComparePageData} data @param {Entry} entry */
function attemptsOnStage(data, entry) {
  const { Your, your } = voiceOf(data.is_own);
  const attempts = data.rollouts.human ?? [];
  const { best, mean } = twoAttempts(data, entry);
  const role = (/** @type {"best" | "mean"} */ which, /** @type {number} */ index, /** @type {string} */ standing) => ({
    key: `human-${which}`,
    entry,
    title: attempts.length === 1 ? `${Your} attempt` : `${Your} ${which} attempt`,
    episodes: attempts.slice(index, index + 1),
    nameOf: () => `attempt ${index + 1} of ${attempts.length}`,
    standing: attempts.length === 1 ? `${your} only one` : `${index + 1} of ${attempts.length}, ${standing}`,
  });
  const middling = `nearest the mean ${figure(entry.mean_return)}`;
  if (best === mean) return [role("best", best, `also ${middling}`)];
  return [role("best", best, "the best"), role("mean", mean, middling)];
}

/** Their places among the attempts; a comparison of an earlier version does not name them. @param {ComparePageData} data @param {Entry} entry */
function twoAttempts({ comparison, demonstrations, rollouts }, { mean_return }) {
  const totals = (rollouts.human ?? []).map(({ total }) => total);
  const nearness = totals.map((total) => -Math.abs(total - mean_return));
  const found = { best: firstLargest(totals), mean: firstLargest(nearness) };
  if (!comparison.human) return found;
  const { best, mean } = comparison.human;
  const at = (/** @type {string} */ id) => demonstrations.findIndex((one) => one.id === id);
  return { best: at(best), mean: at(mean) };
}

/** @param {number[]} values */
function firstLargest(values) {
  return values.indexOf(Math.max(...values));
}
