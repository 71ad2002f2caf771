/**
 * The result in words. Two means closer than two standard errors of the learner's are "about the same": the sentence
 * never claims more than fifty episodes can show.
 * @import {Entry} from "#js/comparisons/types.js"
 */
import { figure, listed, withError } from "#js/charts/figures.js";

const SURE = 2;

/**
 * "IRLFR earned more than you in this world: 5.1 ± 0.4 against 0.2. The optimum is 7.7."
 * @param {Entry[]} entries
 */
export function resultSentence(entries) {
  const human = entries.find((entry) => entry.who === "human");
  const optimum = entries.find((entry) => entry.who === "optimal");
  const learners = learnersByPlace(entries);
  const parts = [human ? againstHuman(learners, human) : amongLearners(learners)];
  if (optimum) parts.push(optimumSentence(optimum));
  return parts.filter(Boolean).join(" ");
}

/**
 * What stands behind the first sentence: what the person's figure is, their best attempt, who else did better.
 * @param {Entry[]} entries
 * @param {number[]} attemptTotals of the ranked demonstrations
 */
export function backgroundSentence(entries, attemptTotals) {
  const human = entries.find((entry) => entry.who === "human");
  if (!human) return "";
  const count = attemptTotals.length || human.episodes;
  if (count === 1) return `Your figure is your one attempt.${headCount(learnersByPlace(entries), human, "it")}`;
  const mean = `Your figure is the mean of all ${count} attempts, failures included.`;
  const best = attemptTotals.length > 0 ? ` Your best attempt alone earned ${figure(Math.max(...attemptTotals))}.` : "";
  return mean + headCount(learnersByPlace(entries), human, "that mean") + best;
}

/**
 * @param {Entry[]} learners by place
 * @param {Entry} human
 */
function againstHuman(learners, human) {
  const best = learners[0];
  if (!best) return "";
  const winners = learners.filter((entry) => entry.place === best.place).map((entry) => entry.title);
  const names = listed(winners);
  const together = winners.length > 1;
  const yours = figure(human.mean_return);
  const verdict = against(best, human);
  if (verdict === 0) {
    return `${names} and you earned about the same in this world: ${withReturn(best)} and ${yours}.`;
  }
  if (verdict > 0)
    return `${names} ${together ? "each " : ""}earned more than you in this world: ${withReturn(best)} against ${yours}.`;
  if (learners.length === 1)
    return `You earned more than ${names} in this world: ${yours} against ${withReturn(best)}.`;
  return `You earned more than every learner in this world: ${yours} against ${withReturn(best)} for ${names}, the best of them.`;
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
