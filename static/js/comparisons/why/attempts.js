/**
 * The attempts that a run learned from, in the order that it learned from: the best success first, the worst failure
 * first. What nobody put in order stands as it was played. A run keeps its snapshot, so a place never changes.
 * @import {Attempt, Change, Influence} from "#js/comparisons/why/types.js"
 * @import {Demonstration, Rankings} from "#js/learning/types.js"
 */

export const OUTCOMES = /** @type {const} */ (["success", "failure"]);

/**
 * @param {{ demonstrations: Demonstration[], rankings: Rankings }} snapshot
 * @returns {Attempt[]} successes, then failures
 */
export function attemptsOf({ demonstrations, rankings }) {
  return OUTCOMES.flatMap((outcome) => {
    const kept = demonstrations.filter((one) => one.outcome === outcome && !one.discarded);
    const order = (rankings[outcome]?.order ?? []).map((group) =>
      group.filter((id) => kept.some((one) => one.id === id)),
    );
    const placed = order.flat();
    const sorted = [...kept].sort((a, b) => rankIn(placed, a.id) - rankIn(placed, b.id));
    return sorted.map((demonstration, i) => ({
      id: demonstration.id,
      outcome,
      place: i + 1,
      count: kept.length,
      isOrdered: placed.includes(demonstration.id),
      tiedWith: (order.find((group) => group.includes(demonstration.id)) ?? []).filter((id) => id !== demonstration.id),
      demonstration,
    }));
  });
}

/** Those an attempt can trade places with: all others of its list that stand in an order. @param {Attempt[]} attempts @param {Attempt} one */
export function partnersOf(attempts, one) {
  return attempts.filter(
    (other) => other.id !== one.id && other.outcome === one.outcome && other.isOrdered && one.isOrdered,
  );
}

/** Only who reached the goal can be called a success. @param {Attempt} attempt */
export function canBeCalledOtherwise({ outcome, demonstration }) {
  return outcome === "success" || demonstration.ending === "goal";
}

/** The same steps, one after the other. @param {Attempt} one @param {Attempt} other */
export function isSameWalk(one, other) {
  const [a, b] = [one.demonstration.states, other.demonstration.states];
  return a.length === b.length && a.every((state, i) => state === b[i]);
}

/** Who nothing can be learned without comes first, then whose absence changes most. @param {Influence[]} influences */
export function byInfluence(influences) {
  const size = (/** @type {Influence} */ one) => one.policy_change ?? Number.POSITIVE_INFINITY;
  return [...influences].sort(
    (a, b) => (size(a) === size(b) ? 0 : size(b) - size(a)) || (b.reward_change ?? 0) - (a.reward_change ?? 0),
  );
}

/**
 * The attempts as a change would have them.
 * @param {Demonstration[]} demonstrations
 * @param {Change} change
 * @returns {Demonstration[]}
 */
export function changedPlay(demonstrations, change) {
  if ("drop" in change) return demonstrations.filter(({ id }) => id !== change.drop);
  if ("swap" in change) return demonstrations;
  return demonstrations.map((one) =>
    one.id === change.relabel ? { ...one, outcome: one.outcome === "success" ? "failure" : "success" } : one,
  );
}

/** What is in no order comes after all that is. @param {string[]} placed @param {string} id */
function rankIn(placed, id) {
  const rank = placed.indexOf(id);
  return rank < 0 ? placed.length : rank;
}
