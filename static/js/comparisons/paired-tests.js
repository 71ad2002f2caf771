/**
 * Which difference is real: the learners compared two by two, episode by episode. Sentences for the best against each other,
 * a table for all.
 * @import {Entry, PairedTest} from "#js/comparisons/types.js"
 */
import { figure } from "#js/charts/figures.js";
import { isLearner } from "#js/comparisons/sentences.js";
import { signed } from "#js/lib/format.js";

/** From here on a difference is called real. */
const SURE = 0.05;

/**
 * The best-placed learner against each other one.
 * @param {Entry[]} entries by place
 * @param {PairedTest[]} tests
 */
export function testSentences(entries, tests) {
  const [best, ...others] = entries.filter(isLearner);
  if (!best) return [];
  return others.flatMap((other) => {
    const test = between(tests, best.who, other.who);
    return test ? [sentenceOf(best.title, other.title, test)] : [];
  });
}

/**
 * "IRLFR earned 1.3 more an episode than IRLR [0.8, 1.9], p = 0.002."
 * @param {string} a
 * @param {string} b
 * @param {PairedTest} test
 */
function sentenceOf(a, b, test) {
  const { mean_difference, low, high, p_adjusted } = test;
  if (mean_difference === 0 && low === 0 && high === 0) return `${a} and ${b} earned the same in every episode.`;
  const size = figure(Math.abs(mean_difference));
  const way = mean_difference < 0 ? "less" : "more";
  const tail = `${bracketed(low, high)}, ${pText(p_adjusted)}`;
  if (isSure(test)) return `${a} earned ${size} ${way} an episode than ${b} ${tail}.`;
  return `${a} earned ${size} ${way} an episode than ${b} ${tail}: these episodes do not tell them apart.`;
}

/** The test of a against b, whichever way round it was kept. @param {PairedTest[]} tests @param {string} a @param {string} b @returns {PairedTest | null} */
export function between(tests, a, b) {
  const kept = tests.find((test) => test.a === a && test.b === b);
  if (kept) return kept;
  const turned = tests.find((test) => test.a === b && test.b === a);
  return turned ? turnedRound(turned) : null;
}

/** @param {PairedTest} test @returns {PairedTest} */
function turnedRound(test) {
  const minus = (/** @type {number | null} */ value) => (value === null ? null : 0 - value);
  const { a, b, mean_difference, low, high } = test;
  return { ...test, a: b, b: a, mean_difference: 0 - mean_difference, low: minus(high), high: minus(low) };
}

/** @param {PairedTest} test */
export function isSure({ p_adjusted }) {
  return p_adjusted < SURE;
}

/** "p = 0.002", "p < 0.001". @param {number} p */
export function pText(p) {
  return p < 0.001 ? "p < 0.001" : `p = ${p < 0.1 ? p.toFixed(3) : p.toFixed(2)}`;
}

/** "[0.8, 1.9]". @param {number | null} low @param {number | null} high */
export function bracketed(low, high) {
  return low === null || high === null ? "" : `[${figure(low)}, ${figure(high)}]`;
}

/** The words of a cell of the table: "+1.3", "[0.8, 1.9]", "p = 0.002". @param {PairedTest} test */
export function cellWords(test) {
  return [signed(test.mean_difference), bracketed(test.low, test.high), pText(test.p_adjusted)];
}
