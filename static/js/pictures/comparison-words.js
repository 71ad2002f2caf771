/**
 * What the figure of a comparison says in words: its first sentence, its caption. For readers who were not there: the person
 * is "the player". Nothing is claimed beyond the figures.
 */

import { figure, listed, percent } from "#js/charts/figures.js";
import { plural } from "#js/lib/format.js";
import { worldSentence } from "#js/pictures/picture.js";

/** @typedef {import("#js/pictures/comparison.js").ComparisonData} ComparisonData */
/** @typedef {import("#js/comparisons/types.js").Entry} Entry */

/** @param {ComparisonData} data */
export function titleOf({ run }) {
  return `Comparison of run ${run.id.slice(0, 8)}`;
}

/** "IRLFR earned 5.1 ± 0.4 an episode, the player 0.2 ± 1.6 an attempt; the optimum is 7.7." @param {ComparisonData} data */
export function figureSentence({ entries }) {
  const best = entries.filter(isLearner).sort((a, b) => a.place - b.place || b.mean_return - a.mean_return)[0];
  const human = entries.find(({ who }) => who === "human");
  const optimum = entries.find(({ who }) => who === "optimal");
  const parts = [];
  if (best) parts.push(`${best.title} earned ${withError(best)} an episode`);
  if (human) parts.push(`the player ${withError(human)} an attempt`);
  const first = parts.join(", ");
  const last = optimum ? `the optimum is ${figure(optimum.expected_return ?? optimum.mean_return)}` : "";
  const sentence = [first, last].filter(Boolean).join("; ");
  return `${sentence.charAt(0).toUpperCase()}${sentence.slice(1)}.`;
}

/** An error that rounds to nothing is not worth its sign. @param {Entry} entry */
function withError({ mean_return, standard_error }) {
  const error = standard_error ?? 0;
  return error < 0.05 ? figure(mean_return) : `${figure(mean_return)} ± ${figure(error)}`;
}

/** One paragraph on what is seen, one on where it comes from. @param {ComparisonData} data */
export function captionOf(data) {
  return [
    `${walksWords(data)} ${plotWords(data)} ${beliefsWords(data)}`.trim(),
    `${originWords(data)} ${citeWords(data)}`.trim(),
  ];
}

/** @param {ComparisonData} data */
function walksWords({ walks, episode, entries }) {
  const count = Math.max(1, ...entries.filter(isLearner).map(({ episodes }) => episodes));
  const people = walks.filter(({ who }) => who === "human").map(({ title }) => title.replace(/^Player, /, ""));
  const person = people.length > 0 ? `the player's ${listed(people)} and ` : "";
  return `a, Ways through the same world, on its true reward: ${person}episode ${episode} of ${count} of the others; at the right of each name what it earned, the marker at its end.`;
}

/** @param {ComparisonData} data */
function plotWords({ entries }) {
  const count = Math.max(1, ...entries.filter(isLearner).map(({ episodes }) => episodes));
  const human = entries.find(({ who }) => who === "human");
  const person = human ? ` (the player: of ${plural(human.episodes, "attempt")}, failures included)` : "";
  return `b, Average return of ${count} episodes${person} with ${intervalWords(entries)}; tick: exact expected return; hollow marker: greedy plan on the learned reward; dashed: optimum; in the title, ± one standard error.`;
}

/** What the whiskers are: newer comparisons carry their intervals. @param {Entry[]} entries */
function intervalWords(entries) {
  const hasIntervals = entries.some((entry) => typeof (/** @type {any} */ (entry).interval_low) === "number");
  return hasIntervals ? "95 % intervals" : "two standard errors to each side";
}

/** @param {ComparisonData} data */
function beliefsWords({ beliefs }) {
  if (beliefs.length === 0) return "";
  return "c, Reward that each learner learned, arrows as long as its policy's steps are likely; hatched in grey: no attempt it used came there.";
}

/** @param {ComparisonData} data */
function originWords({ world, run, seed, attempts }) {
  const optimum = `${plural(attempts.length, "attempt")}`;
  const versions = run.versions ?? {};
  const made = versions.irlfr
    ? `IRLFR ${versions.irlfr}${versions.numpy ? ` (NumPy ${versions.numpy})` : ""}`
    : "IRLFR";
  const slip = world.slip > 0 ? ` Steps go astray with probability ${percent(world.slip)}.` : "";
  return `${worldSentence(world)}${slip} Run ${run.id.slice(0, 8)} from ${optimum}, seed ${run.seed}; episodes of at most ${world.horizon} steps, seed ${seed}; ${made}.`;
}

/** @param {ComparisonData} data */
function citeWords({ citations }) {
  return citations.length > 0 ? `Methods: ${citations.join("; ")}.` : "";
}

/** @param {Entry} entry */
function isLearner({ who }) {
  return who !== "human" && who !== "optimal";
}
