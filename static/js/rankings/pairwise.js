/**
 * Two at a time: which pair to ask about next, how many questions are left, and the order so far. The state is the
 * answers alone, so undoing one, a reload and another tab cost nothing.
 *
 * Settling: merge insertion, which finds the order of a consistent judge in hardly more questions than any way could.
 * Checking: a tenth more questions, each about the pair that is least sure. If they agree with the rest, that is the
 * order. If not, somewhere an answer was a slip: go on with the least sure pair until all are sure, or until there are
 * twice as many answers as an order holds bits. `python3 dev.py bench rank` measures what that is worth.
 */

import { evidenceOf, isContradictory, orderOf, strengthsOf, variancesOf } from "#js/rankings/comparison-order.js";
import { mergeInsertion } from "#js/rankings/merge-insertion.js";

/** @typedef {import("#js/rankings/sitting-state.js").Answer} Answer */
/** @typedef {import("#js/rankings/comparison-order.js").Evidence} Evidence */
/** @typedef {import("#js/rankings/merge-insertion.js").Question} Question */
/** @typedef {import("#js/rankings/merge-insertion.js").Said} Said */

/**
 * @typedef {object} Standing
 * @property {[string, string] | null} next   null: nothing left to ask
 * @property {string[][]} order               groups, the top first; final when nothing is left to ask
 * @property {{least: number, most: number}} left   least: about as many if the answers agree and no two are alike; never more than most
 * @property {"settling" | "checking" | "done"} phase
 * @property {boolean} isContradictory        whether some answers cannot be true together
 */

/** A pair is sure when its strengths stand this many standard deviations apart: a probability of 2 in 3. */
const SURE_DEVIATIONS = 0.43;
/** Below this many, a tenth is less than a question. */
const FEWEST_TO_CHECK = 6;
/** One pair is not asked about more often, nor twice within so many questions. */
const MOST_TIMES = 3;
const REST = 2;

/** @param {readonly string[]} ids in their start order @param {readonly Answer[]} answers @returns {Standing} */
export function pairwise(ids, answers) {
  const there = new Set(ids);
  const known = answers.filter(({ a, b }) => there.has(a) && there.has(b));
  const evidence = evidenceOf(ids, known);
  const strengths = strengthsOf(evidence);
  const order = orderOf(evidence, strengths).map((group) => group.map((i) => /** @type {string} */ (ids[i])));
  const told = { order, isContradictory: isContradictory(evidence) };
  const budget = budgetOf(ids.length) - known.length;
  const done = { ...told, ...DONE };
  if (budget <= 0) return done;
  const settling = settle(evidence, known, order);
  if (settling.next) {
    const left = leftToSettle(settling, { n: ids.length, budget });
    return { ...told, next: sided(settling.next, known.length), left, phase: "settling" };
  }
  const nChecksLeft = told.isContradictory ? 1 : nChecks(ids.length) - (known.length - settling.nGiven);
  const pair = nChecksLeft > 0 && ids.length >= FEWEST_TO_CHECK ? leastSure(evidence, strengths, known) : null;
  if (!pair) return done;
  return { ...told, next: sided(pair, known.length), left: { least: nChecksLeft, most: budget }, phase: "checking" };
}

/** @type {Pick<Standing, "next" | "left" | "phase">} */
const DONE = Object.freeze({ next: null, left: { least: 0, most: 0 }, phase: "done" });

/** Twice as many answers as an order of n holds bits: some n (log₂ n − 1.4) times two. @param {number} n */
function budgetOf(n) {
  return Math.floor(2 * bitsOf(n));
}

/** A tenth of the questions that settle an order, one at least. @param {number} n */
function nChecks(n) {
  return n < FEWEST_TO_CHECK ? 0 : Math.max(1, Math.floor(bitsOf(n) / 10));
}

/** log₂ n!, below which no way of sorting by comparisons can stay on average. @param {number} n */
function bitsOf(n) {
  let bits = 0;
  for (let k = 2; k <= n; k += 1) bits += Math.log2(k);
  return bits;
}

/** The most that merge insertion of n ever asks. @param {number} n */
function mostToSettle(n) {
  let most = 0;
  for (let k = 2; k <= n; k += 1) most += Math.ceil(Math.log2((3 * k) / 4));
  return most;
}

/**
 * Merge insertion as far as the answers carry it.
 * @typedef {{next: [string, string] | null, nAnswered: number, nGiven: number, nAhead: number}} Settling
 * nAnswered: its questions that are answered; nGiven: those that somebody was asked; nAhead: those to come at the least
 */

/** @param {Evidence} evidence @param {readonly Answer[]} answers @param {string[][]} order @returns {Settling} */
function settle(evidence, answers, order) {
  const given = firstAnswers(answers);
  const sort = mergeInsertion(evidence.ids);
  /** @type {Settling} */
  const settling = { next: null, nAnswered: 0, nGiven: 0, nAhead: 0 };
  for (let step = sort.next(); !step.done; ) {
    const { a, b, shorter } = step.value;
    const direct = given.get(`${a} ${b}`);
    const said = direct ?? implied(evidence, order, a, b);
    if (said === null) {
      settling.next ??= [a, b];
      settling.nAhead += 1;
    } else if (!settling.next) {
      settling.nAnswered += 1;
      settling.nGiven += direct ? 1 : 0;
    }
    step = sort.next(said ?? shorter);
  }
  return settling;
}

/** What was said first of a pair, seen from either side; a later word on it is a check. @param {readonly Answer[]} answers @returns {Map<string, Said>} */
function firstAnswers(answers) {
  /** @type {Map<string, Said>} */
  const first = new Map();
  for (const { a, b, said } of answers) {
    if (first.has(`${a} ${b}`)) continue;
    first.set(`${a} ${b}`, said);
    first.set(`${b} ${a}`, said === "alike" ? "alike" : said === "a" ? "b" : "a");
  }
  return first;
}

/** What follows from other answers; where they contradict each other, what the order makes of them. @param {Evidence} evidence @param {string[][]} order @param {string} a @param {string} b @returns {Said | null} */
function implied({ ids, isAbove }, order, a, b) {
  const [i, j] = [ids.indexOf(a), ids.indexOf(b)];
  const [above, below] = [isAbove[i]?.[j] === 1, isAbove[j]?.[i] === 1];
  if (above !== below) return above ? "a" : "b";
  if (!above) return null;
  const [x, y] = [a, b].map((id) => order.findIndex((group) => group.includes(id)));
  return x === y ? "alike" : Number(x) < Number(y) ? "a" : "b";
}

/** @param {Settling} settling @param {{n: number, budget: number}} limits */
function leftToSettle({ nAnswered, nAhead }, { n, budget }) {
  const most = n < FEWEST_TO_CHECK ? Math.min(budget, mostToSettle(n) - nAnswered) : budget;
  return { least: Math.min(most, nAhead + nChecks(n)), most };
}

/** The pair whose order has the probability nearest to one half, by the normal approximation to the posterior; null if all are sure. @param {Evidence} evidence @param {{means: number[], factor: number[][]}} strengths @param {readonly Answer[]} answers @returns {[string, string] | null} */
function leastSure({ ids, wins, alike }, { means, factor }, answers) {
  const variances = variancesOf(factor);
  const recent = answers.slice(-REST);
  /** @type {[string, string] | null} */
  let pair = null;
  let least = SURE_DEVIATIONS ** 2;
  for (const [i, a] of ids.entries()) {
    for (let j = 0; j < i; j += 1) {
      const difference = Number(means[i]) - Number(means[j]);
      const deviations = difference ** 2 / Number(variances[i]?.[j]);
      if (deviations >= least) continue;
      const b = /** @type {string} */ (ids[j]);
      const nAsked = Number(wins[i]?.[j]) + Number(wins[j]?.[i]) + Number(alike[i]?.[j]);
      if (nAsked < MOST_TIMES && !recent.some((one) => isAbout(one, a, b))) [pair, least] = [[a, b], deviations];
    }
  }
  return pair;
}

/** @param {Answer} answer @param {string} a @param {string} b */
function isAbout(answer, a, b) {
  return (answer.a === a && answer.b === b) || (answer.a === b && answer.b === a);
}

/** Who stands left is no matter of who was to be placed, and the same whenever the same is asked. @param {[string, string]} pair @param {number} nAnswers @returns {[string, string]} */
function sided([a, b], nAnswers) {
  let mixed = nAnswers;
  for (const letter of a < b ? a + b : b + a) mixed = (Math.imul(mixed, 31) + letter.charCodeAt(0)) >>> 0;
  return ((mixed >>> 7) & 1) === Number(a < b) ? [a, b] : [b, a];
}
