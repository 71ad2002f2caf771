/** The numbers of a world as they are typed: what is allowed, and the sentence where it is not. No DOM here. */

import {
  HIGHEST_PAY,
  LARGEST_SEED,
  LARGEST_SIDE,
  LOWEST_REWARD,
  MOST_SLIP,
  SMALLEST_SIDE,
  TIME_LIMITS_S,
} from "#js/worlds/editor/plan.js";

/**
 * @typedef {object} Rule
 * @property {number} least       as typed
 * @property {number} most
 * @property {string} sentence    what would be right
 * @property {boolean} [isWhole]
 * @property {boolean} [mayBeEmpty]
 * @property {number} [unit]      typed / kept: 100 for percent, −1 for a cost
 */

/** Digits that survive a division by a hundred. */
const EXACT_DIGITS = 15;
const [SHORTEST_S, LONGEST_S] = TIME_LIMITS_S;

/** @satisfies {Record<string, Rule>} */
export const RULES = {
  rows: side("rows"),
  cols: side("columns"),
  seed: { least: 0, most: LARGEST_SEED, isWhole: true, sentence: "A seed is a whole number of up to 15 digits." },
  red_probability: { least: 0, most: 100, unit: 100, sentence: "From 0 to 100 % of the squares can be red." },
  slip: {
    least: 0,
    most: 100 * MOST_SLIP,
    unit: 100,
    sentence: `From 0 to ${100 * MOST_SLIP} % of the steps can slip.`,
  },
  step_limit: {
    least: 1,
    most: 2 * LARGEST_SIDE ** 2,
    isWhole: true,
    mayBeEmpty: true,
    sentence: "A step limit is a whole number of steps; leave it empty for the usual one.",
  },
  time_limit_s: {
    least: SHORTEST_S,
    most: LONGEST_S,
    isWhole: true,
    mayBeEmpty: true,
    sentence: `A time limit is ${SHORTEST_S} to ${LONGEST_S} whole seconds; leave it empty for none.`,
  },
  reward: { least: 0, most: -LOWEST_REWARD, unit: -1, sentence: `A square costs from 0 to ${-LOWEST_REWARD}.` },
  pay: { least: 0, most: HIGHEST_PAY, sentence: `A goal pays from 0 to ${HIGHEST_PAY}.` },
};

/** @typedef {keyof typeof RULES} RuleName */

/** What is kept of a typed text, or the sentence. @param {Rule} rule @param {string} text @param {boolean} [isGarbled] the browser could not read it as a number @returns {{value: number | null} | {problem: string}} */
export function readNumber(rule, text, isGarbled = false) {
  if (text.trim() === "" && rule.mayBeEmpty && !isGarbled) return { value: null };
  const typed = Number(text);
  const isRight = text.trim() !== "" && typed >= rule.least && typed <= rule.most;
  if (!isRight || isGarbled || (rule.isWhole && !Number.isInteger(typed))) return { problem: rule.sentence };
  return { value: keptOf(rule, typed) };
}

/** @param {Rule} rule @param {number | null} value */
export function writeNumber(rule, value) {
  return value === null ? "" : String(exactly(value * (rule.unit ?? 1)));
}

/** @param {Rule} rule @param {number} typed */
function keptOf(rule, typed) {
  return rule.unit ? exactly(typed / rule.unit) : typed;
}

/** 0.3 · 100 is 30, and −0 is 0. @param {number} value */
function exactly(value) {
  return Number(value.toPrecision(EXACT_DIGITS)) + 0;
}

/** @param {string} word @returns {Rule} */
function side(word) {
  return {
    least: SMALLEST_SIDE,
    most: LARGEST_SIDE,
    isWhole: true,
    sentence: `A world has ${SMALLEST_SIDE} to ${LARGEST_SIDE} ${word}.`,
  };
}
