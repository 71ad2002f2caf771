/** What is said where two attempts are looked at together. */

import { plural } from "#js/lib/format.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/merge-insertion.js").Said} Said */
/** @typedef {import("#js/rankings/pairwise.js").Standing} Standing */

/** What stands higher in a list is better, or worse. @param {Outcome} outcome */
export function questionOf(outcome) {
  return `Which one is ${outcome === "success" ? "better" : "worse"}?`;
}

/** @param {Outcome} outcome @param {boolean} hasOther  whether the other list is asked about, too */
export function whichWords(outcome, hasOther) {
  if (outcome === "success") return hasOther ? "Your successes; your failures come after them." : "Your successes.";
  return "Your failures.";
}

/** @param {Pick<Standing, "left" | "isContradictory">} standing */
export function leftWords({ left: { least, most }, isContradictory }) {
  const atMost = `at most ${most}`;
  if (isContradictory) return `Some of your answers do not fit together yet: ${atMost} more ${plainPlural(most)}.`;
  if (least === most) return `${plural(most, "question")} left`;
  return `About ${plural(least, "question")} left (${atMost})`;
}

/** @param {Said} said @param {Outcome} outcome */
export function saidWords(said, outcome) {
  if (said === "alike") return "They are alike.";
  return `The ${said === "a" ? "left" : "right"} one is ${outcome === "success" ? "better" : "worse"}.`;
}

/** @param {{outcome: Outcome, words: Record<"a" | "b", string>, standing: Pick<Standing, "left" | "isContradictory">}} question */
export function askedWords({ outcome, words, standing }) {
  return `${questionOf(outcome)} Left: ${words.a}. Right: ${words.b}. ${leftWords(standing).replace(/\.$/, "")}.`;
}

/** @param {number} nAnswers @param {boolean} isTheirs  whether the lists stand as the answers say */
export function doneWords(nAnswers, isTheirs) {
  if (nAnswers === 0) return "There is nothing to ask: no list has two attempts.";
  const settled = `${plural(nAnswers, "answer")} settled it.`;
  return isTheirs
    ? `${settled} This is the order they make: look it over, change what you like, and confirm it.`
    : `${settled} The order below is another one than your answers make.`;
}

/** @param {number} count */
function plainPlural(count) {
  return count === 1 ? "question" : "questions";
}
