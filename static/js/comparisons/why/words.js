/**
 * "Why" in words: how an attempt is called, what it changed, what would be otherwise. What is too small to show is
 * "about as much", and where nothing changes the sentence says why, if the data tell.
 * @import {Attempt, Change, Influence, Uncertainty, WhatIf} from "#js/comparisons/why/types.js"
 * @import {World} from "#js/learning/types.js"
 * @import {Voice} from "#js/comparisons/voice.js"
 */
import { figure, listed } from "#js/charts/figures.js";
import { isSameWalk } from "#js/comparisons/why/attempts.js";
import { plural } from "#js/lib/format.js";

/** Returns that differ by less look the same when they are written out. */
const SMALLEST = 0.05;
/** What is smaller is nothing: the same sums in another order. */
const DUST = 1e-9;
/** A share of the steps that is less than half a percent. */
const SMALLEST_SHARE = 0.005;
/** Draws of which fewer agree leave a square in doubt. */
export const AGREEMENT = 0.75;

/** @typedef {{ title: string, uses_failures: boolean, uses_ranking: boolean }} Who */

/** "2nd success", "only failure". @param {Attempt} attempt */
export function nameOf({ outcome, place, count }) {
  return `${count === 1 ? "only" : ordinal(place)} ${outcome}`;
}

/** 1st, 2nd, 3rd, 4th, 11th. @param {number} n */
export function ordinal(n) {
  const teens = n % 100 >= 11 && n % 100 <= 13;
  return `${n}${(teens ? "" : ["", "st", "nd", "rd"][n % 10]) || "th"}`;
}

/** "12 steps, earned −3.4". @param {Attempt} attempt */
export function factsOf({ demonstration: { actions, total } }) {
  return `${plural(actions.length, "step")}, earned ${figure(total)}`;
}

/** What is said of its place besides its number: "best", "worst", "tied with 1 other". @param {Attempt} attempt */
export function standingOf({ outcome, place, count, isOrdered, tiedWith }) {
  if (count === 1) return "";
  if (!isOrdered) return "in no order";
  if (tiedWith.length > 0) return `tied with ${plural(tiedWith.length, "other")}`;
  return place > 1 ? "" : outcome === "success" ? "best" : "worst";
}

/** Squares that have arrows: all but goals and walls. @param {Pick<World, "rows" | "cols" | "goals" | "walls">} world */
export function countArrows({ rows, cols, goals, walls }) {
  return rows * cols - goals.length - walls.length;
}

/**
 * "Your 2nd success mattered most to IRLFR: without it, 11 of 48 arrows turn and it would earn 2.1 less."
 * @param {Influence[]} sorted the greatest first
 * @param {Attempt[]} attempts
 * @param {{ who: Who, voice: Voice, world: World }} about
 */
export function mattersSentence(sorted, attempts, { who, voice, world }) {
  const [first] = sorted;
  if (!first) return "There are no attempts to leave out.";
  const needed = sorted.filter((one) => one.policy_change === null);
  if (needed.length > 0) return neededSentence(namesOf(needed, attempts), { who, voice });
  if (isNothing(first))
    return `None of ${voice.your} attempts matters to ${who.title} alone: it learns the same without any one of them.`;
  const alike = sorted.filter((one) => hasSameEffect(one, first));
  const without = `without ${alike.length > 1 ? "any one of them" : "it"}, ${withoutWords(first, world)}.`;
  if (sorted.length === 1) return `${voice.Your} only attempt is all ${who.title} has: ${without}`;
  if (alike.length === sorted.length) return `All of ${voice.your} attempts mattered alike to ${who.title}: ${without}`;
  const most = alike.length > 1 ? "mattered most, and alike," : "mattered most";
  return `${voice.Your} ${listed(namesOf(alike, attempts))} ${most} to ${who.title}: ${without}`;
}

/** @param {Influence} one @param {Influence} other */
function hasSameEffect(one, other) {
  const [policy, earned] = [
    (one.policy_change ?? 0) - (other.policy_change ?? 0),
    (one.return_change ?? 0) - (other.return_change ?? 0),
  ];
  return Math.abs(policy) <= DUST && Math.abs(earned) <= DUST;
}

/** @param {string[]} names @param {{ who: Who, voice: Voice }} about */
function neededSentence(names, { who, voice }) {
  const each = names.length > 1 ? "any one of " : "";
  return `Without ${each}${voice.your} ${listed(names)}, ${who.title} could learn nothing at all.`;
}

/** What one row of the list says of its attempt. @param {Influence} influence @param {World} world */
export function withoutSentence(influence, world) {
  if (influence.policy_change === null) return `Nothing can be learned without it. ${influence.sentence ?? ""}`.trim();
  return `Without it, ${withoutWords(influence, world)}.`;
}

/** @param {Pick<Influence, "policy_change" | "reward_change">} difference */
function isNothing({ policy_change, reward_change }) {
  return (policy_change ?? 0) <= DUST && (reward_change ?? 0) <= DUST;
}

/** @param {Influence} influence @param {World} world */
function withoutWords(influence, world) {
  if (isNothing(influence)) return "nothing changes";
  const { turned, policy_change, return_change } = influence;
  const n = turned?.length ?? 0;
  const earns = return_change === null ? "" : earningWords("it", -return_change);
  if (n === 0 && Math.abs(return_change ?? 0) < SMALLEST && (policy_change ?? 0) < SMALLEST_SHARE)
    return "hardly anything changes";
  return [arrowsTurn(n, world), earns].filter(Boolean).join(" and ");
}

/** "11 of 48 arrows turn". @param {number} n @param {World} world */
function arrowsTurn(n, world) {
  return n === 0 ? "no arrow turns" : `${n} of ${plural(countArrows(world), "arrow")} ${n === 1 ? "turns" : "turn"}`;
}

/** "it would earn 2.1 less". @param {string} who @param {number} change */
function earningWords(who, change) {
  if (Math.abs(change) < SMALLEST) return `${who} would earn about as much`;
  return `${who} would earn ${figure(Math.abs(change))} ${change < 0 ? "less" : "more"}`;
}

/**
 * "Without your 2nd success, 11 of 48 arrows turn and IRLFR would earn 2.1 less: 3.1 instead of 5.2."
 * @param {WhatIf} answer
 * @param {Attempt[]} attempts
 * @param {{ who: Who, voice: Voice, world: World, leavesOut: boolean }} about leavesOut: failures that never reached the goal
 */
export function whatIfSentence({ change, difference, before, expected_return }, attempts, about) {
  const { who, world } = about;
  const clause = conditionWords(change, attempts, about.voice);
  const delta = expected_return - before.expected_return;
  if (isNothing(difference)) return `${clause}, nothing changes${reasonWords(change, attempts, about)}`;
  const figures = Math.abs(delta) < SMALLEST ? figure(expected_return) : apart(expected_return, before.expected_return);
  return `${clause}, ${arrowsTurn(difference.turned.length, world)} and ${earningWords(who.title, delta)}: ${figures}.`;
}

/** "3.1 instead of 5.2", as finely as tells them apart. @param {number} now @param {number} before */
function apart(now, before) {
  const digits = figure(now) === figure(before) ? 2 : 1;
  return `${figure(now, digits)} instead of ${figure(before, digits)}`;
}

/** @param {Change} change @param {Attempt[]} attempts @param {Voice} voice */
export function conditionWords(change, attempts, voice) {
  const name = (/** @type {string} */ id) => namesOf([{ id }], attempts)[0];
  if ("drop" in change) return `Without ${voice.your} ${name(change.drop)}`;
  if ("swap" in change) return `With ${voice.your} ${listed(change.swap.map(name))} trading places`;
  const other = attempts.find(({ id }) => id === change.relabel)?.outcome === "success" ? "failure" : "success";
  return `With ${voice.your} ${name(change.relabel)} called a ${other}`;
}

/**
 * Why a change changes nothing, where the attempts and the learner tell.
 * @param {Change} change
 * @param {Attempt[]} attempts
 * @param {{ who: Who, leavesOut: boolean }} about
 */
function reasonWords(change, attempts, { who, leavesOut }) {
  const touched = attempts.filter(({ id }) => Object.values(change).flat().includes(id));
  const [first, second] = touched;
  if (!first) return ".";
  const isFailure = first.outcome === "failure";
  if (isFailure && !who.uses_failures && !("relabel" in change)) return `: ${who.title} does not look at failures.`;
  if ("swap" in change && first.tiedWith.includes(second?.id ?? "")) return ": they are tied.";
  if ("swap" in change && !who.uses_ranking) return `: ${who.title} does not look at the order.`;
  if ("swap" in change && second && isSameWalk(first, second)) return ": they are the same walk.";
  const isLeftOut = leavesOut && isFailure && first.demonstration.ending !== "goal";
  return isLeftOut ? ": a failure that never reached the goal is left out at these settings." : ".";
}

/**
 * Where the draws disagree about the step.
 * @param {Uncertainty} found
 * @param {{ who: Who, world: World }} about
 */
export function doubtSentence(found, { who, world }) {
  if (!isSpread(found)) return `All draws came out the same, which says nothing of how sure ${who.title} may be.`;
  const unsure = doubtful(found.policy_agreement, world).filter(Boolean).length;
  if (unsure === 0)
    return `${who.title} is sure of its step on every square: three draws in four, or more, take the same.`;
  const squares = `${unsure} of ${plural(countArrows(world), "square")}`;
  return `On ${squares} ${who.title} is not sure of its step: fewer than three draws in four take the same.`;
}

/** How that was found out. @param {Uncertainty} found */
export function methodSentence({ method, n_draws, seed }) {
  const draws = plural(n_draws, "draw");
  if (method === "posterior")
    return `Each draw is a reward that it holds possible after the attempts (posterior, ${draws}).`;
  return `Each draw has as many attempts, successes and failures apart, some of them more than once and some not at all (bootstrap, ${draws}, seed ${seed}).`;
}

/** False where no draw differed from another: one attempt of a kind, or all alike. @param {Uncertainty} found */
export function isSpread({ policy_agreement, reward_low, reward_high }) {
  return (
    policy_agreement.some((share) => share < 1) || reward_low.some((low, state) => low < (reward_high[state] ?? 0))
  );
}

/** Squares to hatch: those with arrows where too few draws agree. Shape (S,). @param {number[]} agreement @param {Pick<World, "goals" | "walls">} world */
export function doubtful(agreement, { goals, walls }) {
  const bare = new Set([...goals, ...walls]);
  return agreement.map((share, state) => share < AGREEMENT && !bare.has(state));
}

/** @param {{ id: string }[]} those @param {Attempt[]} attempts */
function namesOf(those, attempts) {
  return those.map(({ id }) => {
    const attempt = attempts.find((one) => one.id === id);
    return attempt ? nameOf(attempt) : "attempt that is not here";
  });
}

/** @param {string} text */
export function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
