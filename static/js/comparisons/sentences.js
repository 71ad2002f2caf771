/**
 * The result in words. Two means closer than two standard errors of the learner's are "about the same": the sentence
 * never claims more than fifty episodes can show.
 * @import {Entry} from "#js/comparisons/types.js"
 * @import {Voice} from "#js/comparisons/voice.js"
 * @import {Result, World} from "#js/learning/types.js"
 */
import { figure, listed, percent, withError } from "#js/charts/figures.js";
import { TO_YOU } from "#js/comparisons/voice.js";

const SURE = 2;

/**
 * "IRLFR earned more than ${you} in this world: 5.1 ± 0.4 against 0.2. The optimum is 7.7."
 * @param {Entry[]} entries
 * @param {Voice} [voice]
 */
export function resultSentence(entries, voice = TO_YOU) {
  const human = entries.find((entry) => entry.who === "human");
  const optimum = entries.find((entry) => entry.who === "optimal");
  const learners = learnersByPlace(entries);
  const parts = [human ? againstHuman(learners, human, voice) : amongLearners(learners)];
  if (optimum) parts.push(optimumSentence(optimum));
  return parts.filter(Boolean).join(" ");
}

/**
 * What stands behind the first sentence: what the person's figure is, their best attempt, who else did better.
 * @param {Entry[]} entries
 * @param {number[]} attemptTotals of the ranked demonstrations
 * @param {Voice} [voice]
 */
export function backgroundSentence(entries, attemptTotals, { Your, your } = TO_YOU) {
  const human = entries.find((entry) => entry.who === "human");
  if (!human) return "";
  const count = attemptTotals.length || human.episodes;
  if (count === 1) return `${Your} figure is ${your} one attempt.${headCount(learnersByPlace(entries), human, "it")}`;
  const mean = `${Your} figure is the mean of all ${count} attempts, failures included.`;
  const best =
    attemptTotals.length > 0 ? ` ${Your} best attempt alone earned ${figure(Math.max(...attemptTotals))}.` : "";
  return mean + headCount(learnersByPlace(entries), human, "that mean") + best;
}

/**
 * What learners that know what they do not know expect of their own plan: one sentence each. They reckon in units of
 * their own; the goal, whose worth the world tells, sets the scale.
 * @param {Entry[]} entries
 * @param {Record<string, Result>} results
 * @param {Pick<World, "rewards" | "goal">} world
 */
export function posteriorSentences(entries, results, { rewards, goal }) {
  return entries.flatMap(({ who, title }) => {
    const { posterior, reward } = results[who] ?? {};
    const scale = (rewards.flat()[goal] ?? 0) / (reward?.flat()[goal] ?? 0);
    if (!posterior || !(scale > 0) || !Number.isFinite(scale)) return [];
    const [low, high] = [posterior.return_low, posterior.return_high].map((value) => figure(scale * value));
    return `${title} itself expects its plan to earn ${low} to ${high} (${percent(posterior.level)} of its ${posterior.n_draws} draws).`;
  });
}

/**
 * Who walks softly and who plans. Of the squares where nothing is preferred (the goal, walls) neither is said.
 * @param {Entry[]} entries
 * @param {Record<string, Result>} results
 */
export function softSentence(entries, results) {
  const titles = (/** @type {string} */ manner) =>
    learnersByPlace(entries)
      .filter(({ who }) => mannerOf(results[who]?.policy ?? []) === manner)
      .map(({ title }) => title);
  const [soft, plans] = [titles("soft"), titles("plan")];
  const parts = [];
  if (soft.length > 0)
    parts.push(
      `${listed(soft)} ${soft.length === 1 ? "walks" : "walk"} softly: likelier steps more often, none always.`,
    );
  if (plans.length === 1) parts.push(`${listed(plans)} plans, and always takes the step it thinks best.`);
  if (plans.length > 1) parts.push(`${listed(plans)} plan, and always take the step they think best.`);
  return parts.join(" ");
}

/** @param {number[][]} policy (S, 4) @returns {"plan" | "soft" | "random"} */
function mannerOf(policy) {
  const preferring = policy.filter((row) => Math.max(...row) - Math.min(...row) > 1e-9);
  if (preferring.length === 0) return "random";
  return preferring.every((row) => Math.max(...row) > 1 - 1e-9) ? "plan" : "soft";
}

/**
 * @param {Entry[]} learners by place
 * @param {Entry} human
 * @param {Voice} voice
 */
function againstHuman(learners, human, { You, you }) {
  const best = learners[0];
  if (!best) return "";
  const winners = learners.filter((entry) => entry.place === best.place).map((entry) => entry.title);
  const names = listed(winners);
  const together = winners.length > 1;
  const yours = figure(human.mean_return);
  const verdict = against(best, human);
  if (verdict === 0) {
    return `${names} and ${you} earned about the same in this world: ${withReturn(best)} and ${yours}.`;
  }
  if (verdict > 0)
    return `${names} ${together ? "each " : ""}earned more than ${you} in this world: ${withReturn(best)} against ${yours}.`;
  if (learners.length === 1)
    return `${You} earned more than ${names} in this world: ${yours} against ${withReturn(best)}.`;
  const whose = winners.length === learners.length ? "each of them" : `${names}, the best of them`;
  return `${You} earned more than every learner in this world: ${yours} against ${withReturn(best)} for ${whose}.`;
}

/** @param {Entry[]} learners by place */
function amongLearners(learners) {
  const best = learners[0];
  return best ? `${best.title} earned most among the learners: ${withReturn(best)}.` : "";
}

/** @param {Entry} optimum */
function optimumSentence(optimum) {
  const value = optimum.expected_return ?? optimum.mean_return;
  if (value > 0) return `The optimum is ${figure(value)}.`;
  return `Even the optimum only gets ${figure(value)} here, so a share of it would mean nothing.`;
}

/**
 * @param {Entry[]} learners
 * @param {Entry} human
 * @param {string} figureName
 */
function headCount(learners, human, figureName) {
  const better = learners.filter((entry) => against(entry, human) > 0).length;
  if (learners.length < 2 || better === 0) return "";
  return better === learners.length
    ? ` Every learner earned more than ${figureName}.`
    : ` ${better} of ${learners.length} learners earned more than ${figureName}.`;
}

/**
 * 1: the learner earned more than the person, −1: less, 0: too close to tell.
 * @param {Entry} learner
 * @param {Entry} human
 */
function against(learner, human) {
  const difference = learner.mean_return - human.mean_return;
  return Math.abs(difference) <= Math.max(SURE * (learner.standard_error ?? 0), 0.05) ? 0 : Math.sign(difference);
}

/** @param {Entry} entry */
function withReturn(entry) {
  return withError(entry.mean_return, entry.standard_error);
}

/** @param {Entry[]} entries */
function learnersByPlace(entries) {
  return entries.filter(isLearner).sort((a, b) => a.place - b.place);
}

/** @param {Pick<Entry, "who">} entry */
export function isLearner({ who }) {
  return who !== "human" && who !== "optimal";
}

/**
 * In the order they stand on stage: the person, the learners as they were asked for, the optimum.
 * @param {Entry[]} entries
 * @param {string[]} learners
 */
export function onStage(entries, learners) {
  const order = ["human", ...learners, "optimal"];
  return [...entries].sort((a, b) => order.indexOf(a.who) - order.indexOf(b.who));
}
