/** From the page data of a comparison to what its figure shows. */

import { onStage } from "#js/comparisons/sentences.js";

/** @typedef {import("#js/comparisons/types.js").ComparePageData} PageData */
/** @typedef {import("#js/comparisons/types.js").Entry} Entry */
/** @typedef {import("#js/comparisons/types.js").Episode} Episode */
/** @typedef {import("#js/pictures/comparison.js").ComparisonData} ComparisonData */
/** @typedef {import("#js/pictures/comparison.js").Walk} Walk */
/** @typedef {{unknownTo: (learner: string) => boolean[], episode: number, citations: string[]}} Besides */

/** @param {PageData} data @param {Besides} besides `episode`: 0, 1, … @returns {ComparisonData} */
export function comparisonData({ world, run, comparison, rollouts }, { unknownTo, episode, citations }) {
  const staged = onStage(comparison.entries, Object.keys(run.learners));
  const attempts = rollouts.human ?? [];
  return {
    world,
    run,
    citations,
    entries: comparison.entries,
    seed: comparison.seed,
    episode: episode + 1,
    attempts: attempts.map(({ total }) => total),
    walks: staged.flatMap((entry) =>
      entry.who === "human" ? playerWalks(attempts, entry.mean_return) : walkOf(entry, rollouts[entry.who], episode),
    ),
    beliefs: staged.flatMap(({ who, title }) => {
      const { reward, policy } = run.learners[who] ?? {};
      return reward && policy ? [{ who, title, reward: reward.flat(), policy, unknown: unknownTo(who) }] : [];
    }),
  };
}

/** The best attempt and the one nearest the mean; one where they are the same. @param {Episode[]} attempts @param {number} mean @returns {Walk[]} */
function playerWalks(attempts, mean) {
  const best = least(attempts, ({ total }) => -total);
  const middling = least(attempts, ({ total }) => Math.abs(total - mean));
  if (!best || !middling) return [];
  if (best === middling) return [{ who: "human", title: "Player, best attempt", episode: best }];
  return [
    { who: "human", title: "Player, best attempt", episode: best },
    { who: "human", title: "Player, mean attempt", episode: middling },
  ];
}

/** @param {Entry} entry @param {Episode[] | undefined} episodes @param {number} episode @returns {Walk[]} */
function walkOf({ who, title }, episodes, episode) {
  const shown = episodes?.[episode % episodes.length];
  return shown ? [{ who, title, episode: shown }] : [];
}

/** The first of those with the least. @template T @param {T[]} items @param {(item: T) => number} measure @returns {T | undefined} */
function least(items, measure) {
  return items.reduce((/** @type {T | undefined} */ found, item) => {
    return found === undefined || measure(item) < measure(found) ? item : found;
  }, undefined);
}
