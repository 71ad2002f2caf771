/** How the orders on the page stand to those that were confirmed: what counts already, what has yet to be confirmed. */

import { flat, isSame } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Way} Way */
/** @typedef {import("#js/rankings/sitting-state.js").Content} Content */
/** @typedef {{outcome: Outcome, order: Order, version: number, created_at: string, way?: Way, given?: any, untouched?: boolean | null, counts?: boolean}} Ranking */
/** @typedef {Record<Outcome, Ranking | null>} Newest */
/** @typedef {{present: Content, way: Way}} Stated */

/** @type {Outcome[]} */
export const OUTCOMES = ["success", "failure"];

/** What a person has said beside the order, as the server stores it. @param {Stated} state @param {Outcome} outcome */
export function givenOf({ present, way }, outcome) {
  if (way === "pairwise") return present.answers[outcome];
  if (way === "magnitude") return present.gaps[outcome];
  if (way === "lists") return null;
  const ids = new Set(flat(present.orders[outcome]));
  return Object.fromEntries(Object.entries(present.stretches).filter(([id]) => ids.has(id)));
}

/** Whether a confirmed order says what the page says. @param {Stated} state @param {Ranking | null} ranking @param {Outcome} outcome */
export function says(state, ranking, outcome) {
  if (!ranking || !isSame(ranking.order, state.present.orders[outcome])) return false;
  const given = givenOf(state, outcome);
  // Who only looks at another way has said nothing new.
  return isNothing(given) || print(given) === print(ranking.given);
}

/** Whether anything can be ordered: one attempt alone needs no order. @param {Stated} state */
export function canOrder({ present: { orders } }) {
  return OUTCOMES.some((outcome) => flat(orders[outcome]).length > 1);
}

/** What a confirmation sends; an attempt alone goes along with others, never by itself. @param {Stated} state @param {Newest} newest @returns {Outcome[]} */
export function differing(state, newest) {
  const sizeOf = (/** @type {Outcome} */ outcome) => flat(state.present.orders[outcome]).length;
  const all = OUTCOMES.filter((outcome) => sizeOf(outcome) > 0 && !says(state, newest[outcome], outcome));
  return all.some((outcome) => sizeOf(outcome) > 1) ? all : [];
}

/** What the page says of an outcome, as one text. @param {Stated} state @param {Outcome} outcome */
export function printOf(state, outcome) {
  return print([state.present.orders[outcome], givenOf(state, outcome)]);
}

/** @param {any} given */
function isNothing(given) {
  return given == null || Object.keys(given).length === 0;
}

/** The same things give the same text, in whatever order their fields came. @param {unknown} value */
function print(value) {
  return JSON.stringify(value, (_, part) => {
    if (part === null || typeof part !== "object" || Array.isArray(part)) return part;
    return Object.fromEntries(Object.entries(part).sort(([a], [b]) => (a < b ? -1 : 1)));
  });
}
