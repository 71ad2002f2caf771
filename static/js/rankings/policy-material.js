/**
 * What there is to say of a policy learned from an order as it stands: who can learn from it, which arrows turned, where
 * they lead. The conditions are those of `LearningProblem.missing` in irl_core, so that nothing is asked in vain. No page.
 */

import { walker } from "#js/board/colours.js";
import { nextState } from "#js/board/state.js";
import { plural } from "#js/lib/format.js";
import { flat } from "#js/rankings/order.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {Readonly<Record<Outcome, Order>>} Orders */
/** @typedef {"irlr" | "irlfr" | "birlfr"} Learner   those whose policy an order changes */
/** @typedef {{learner: Learner, orders: Partial<Record<Outcome, Order>>}} Question */
/** @typedef {{learner: string, title: string, outcome: string, sentence: string, iterations: number, reward: number[][], policy: number[][], visitation: number[][], compute_ms: number}} Preview */
/** @typedef {{states: number[], ending: string}} Played */
/** How many of each can be learned from, and how many failures cannot: they never reached the goal. @typedef {{nSuccesses: number, nFailures: number, nLeftOut: number}} Material */

/** Who learns unless the person says so: the first that can. @type {readonly Learner[]} */
export const BY_PREFERENCE = ["irlfr", "irlr", "birlfr"];
/** What an arrow must gain on the one that was longest before, so that noise between equals turns none. */
const LEAST_TURN = 0.01;

/** @param {Orders} orders @param {Map<string, Played>} demonstrations @returns {Material} */
export function materialOf({ success, failure }, demonstrations) {
  const failures = flat(failure);
  const nFailures = failures.filter((id) => demonstrations.get(id)?.ending === "goal").length;
  return { nSuccesses: flat(success).length, nFailures, nLeftOut: failures.length - nFailures };
}

/** @param {Material} material @param {Learner} learner */
export function canLearn({ nSuccesses, nFailures }, learner) {
  if (learner === "birlfr") return nSuccesses + nFailures > 0;
  return nSuccesses > 0 && (learner === "irlr" || nFailures > 0);
}

/** Only what this learner looks at, so that nothing is asked again when the rest changes. @param {Learner} learner @param {Orders} orders @returns {Question} */
export function questionOf(learner, { success, failure }) {
  return { learner, orders: learner === "irlr" ? { success } : { success, failure } };
}

/** Why nobody can learn yet. @param {Material} material */
export function missingWords({ nLeftOut }) {
  if (nLeftOut === 0) return "Nothing to learn from yet: play some attempts first.";
  return "Nothing to learn from yet: no attempt of yours has reached the goal. Reach it once, whatever it costs.";
}

/** "From 3 successes and 2 failures.", and why others do not count. @param {Learner} learner @param {Material} material */
export function usedWords(learner, { nSuccesses, nFailures, nLeftOut }) {
  const takesFailures = learner !== "irlr" && nFailures > 0;
  const used = [
    ...(nSuccesses > 0 ? [plural(nSuccesses, "success", "successes")] : []),
    ...(takesFailures ? [plural(nFailures, "failure")] : []),
  ];
  return [`From ${used.join(" and ")}.`, besideWords(learner, nFailures, nLeftOut)].filter(Boolean).join(" ");
}

/** @param {Learner} learner @param {number} nFailures @param {number} nLeftOut */
function besideWords(learner, nFailures, nLeftOut) {
  if (learner === "irlr" && nFailures > 0) return "IRLR looks at successes alone.";
  if (nLeftOut === 0) return "";
  if (nFailures === 0) return "Failures teach it something once they reach the goal.";
  return `${plural(nLeftOut, "failure")} that never reached the goal left out.`;
}

/** Squares whose longest arrow is another one now. @param {World} world @param {number[][]} before @param {number[][]} after @returns {number[]} */
export function turnedIn(world, before, after) {
  const still = new Set([...world.goals, ...world.walls]);
  return [...after.keys()].filter((state) => {
    const [now, was] = [longest(after[state]), longest(before[state])];
    return !still.has(state) && now !== was && after[state][now] - after[state][was] > LEAST_TURN;
  });
}

/** @param {number} nTurned */
export function turnedWords(nTurned) {
  return nTurned === 0 ? "No arrow turned." : `${plural(nTurned, "arrow")} turned.`;
}

/** Where the longest arrows lead from the start. @param {World} world @param {number[][]} policy */
export function leadWords(world, policy) {
  const nSteps = stepsToGoal(world, policy);
  if (nSteps === null) return "Its longest arrows go round in circles.";
  return `Its longest arrows lead to the goal in ${plural(nSteps, "step")}.`;
}

/** The board for whoever does not see it. @param {World} world @param {Preview} preview */
export function boardWords(world, { title, reward, policy }) {
  const flatReward = reward.flat();
  const place = (/** @type {number} */ value) => {
    const state = flatReward.indexOf(value);
    return `row ${Math.floor(state / world.cols) + 1}, column ${(state % world.cols) + 1}`;
  };
  const [most, least] = [place(Math.max(...flatReward)), place(Math.min(...flatReward))];
  const lead = leadWords(world, policy);
  return `What ${title} would learn from this order. ${lead} It values ${most} most and ${least} least.`;
}

/** The name that fits a small button. @param {Learner} learner */
export function shortTitle(learner) {
  return learner === "birlfr" ? "Bayesian" : walker(learner).title;
}

/** Null where they go round in circles. @param {World} world @param {number[][]} policy */
function stepsToGoal(world, policy) {
  let state = world.start;
  for (let nSteps = 0; nSteps <= policy.length; nSteps++) {
    if (world.goals.includes(state)) return nSteps;
    state = nextState(world, state, longest(policy[state]));
  }
  return null;
}

/** @param {number[]} arrows */
function longest(arrows) {
  return arrows.indexOf(Math.max(...arrows));
}
