/**
 * An order of attempts: groups of ids from top to bottom, the most weight first (the best success, the worst failure).
 * A group of several is a tie. Orders are values; every function returns a new one.
 *
 * A card changes its place in one way only, `place`: taken out, it is put among the others, alone before a group or into
 * one. A drag, a key and a button each come to such a place, so that whoever reads the log has one thing to understand.
 */

/** @typedef {readonly (readonly string[])[]} Order */

/** Where a card lands among the others: alone before others[group] (at their number: last), or tied with that group. @typedef {{group: number, joins: boolean}} Place */

/** @param {Order} order @returns {string[]} */
export function flat(order) {
  return order.flat();
}

/** @param {Order} order @param {string} id @returns {Order} */
export function without(order, id) {
  return order.map((group) => group.filter((other) => other !== id)).filter((group) => group.length > 0);
}

/** @param {Order} order @param {string} id @param {Place} where @returns {Order} */
export function place(order, id, { group, joins }) {
  const others = without(order, id);
  if (joins) return others.with(group, [...(others[group] ?? []), id]);
  return others.toSpliced(group, 0, [id]);
}

/** @param {Order} order @param {string} id @param {string} other @returns {Order} */
export function swap(order, id, other) {
  const instead = new Map([
    [id, other],
    [other, id],
  ]);
  return order.map((group) => group.map((one) => instead.get(one) ?? one));
}

/** Past so many groups, up (below 0) or down; out of a tie the first step stands alone beside it. Null where there is nowhere to go. @param {Order} order @param {string} id @param {number} by @returns {Place | null} */
export function step(order, id, by) {
  const at = groupOf(order, id);
  const isTied = isInTie(order, id);
  const last = without(order, id).length;
  // Taken out of a tie, the rest of it stands at `at`; alone, the next group does.
  const to = by < 0 ? at + by + (isTied ? 1 : 0) : at + by;
  const group = Math.min(last, Math.max(0, to));
  return group === at && !isTied ? null : { group, joins: false };
}

/** Tied with the group above; out of its tie if it is in one, alone below it. Null at the top. @param {Order} order @param {string} id @returns {Place | null} */
export function toggleTie(order, id) {
  const at = groupOf(order, id);
  if (isInTie(order, id)) return { group: at + 1, joins: false };
  return at <= 0 ? null : { group: at - 1, joins: true };
}

/** @param {Order} order @param {string} id */
export function groupOf(order, id) {
  return order.findIndex((group) => group.includes(id));
}

/** @param {Order} order @param {string} id */
export function isInTie(order, id) {
  return (order[groupOf(order, id)]?.length ?? 0) > 1;
}

/** Places as people count them, 1 at the top; a tie shares its first. @param {Order} order @returns {Map<string, number>} */
export function displayRanks(order) {
  /** @type {Map<string, number>} */
  const ranks = new Map();
  for (const group of order) {
    const rank = ranks.size + 1;
    for (const id of group) ranks.set(id, rank);
  }
  return ranks;
}

/** The weight θ of each card: 2i / (N (N + 1)) with i = N for the first; a tie shares the mean. @param {Order} order @returns {Map<string, number>} */
export function weights(order) {
  const n = flat(order).length;
  /** @type {Map<string, number>} */
  const theta = new Map();
  let rank = n;
  for (const group of order) {
    const mean = rank - (group.length - 1) / 2;
    for (const id of group) theta.set(id, (2 * mean) / (n * (n + 1)));
    rank -= group.length;
  }
  return theta;
}

/** By total: successes from the highest, failures from the lowest; equal totals tie. @param {Order} order @param {Map<string, number>} totals @param {"success" | "failure"} outcome @returns {Order} */
export function sortByScore(order, totals, outcome) {
  const sign = outcome === "success" ? -1 : 1;
  const ids = flat(order).sort((a, b) => sign * ((totals.get(a) ?? 0) - (totals.get(b) ?? 0)));
  /** @type {string[][]} */
  const groups = [];
  for (const id of ids) {
    const last = groups.at(-1);
    if (last?.[0] !== undefined && totals.get(last[0]) === totals.get(id)) last.push(id);
    else groups.push([id]);
  }
  return groups;
}

/** Gone cards left out, new ones last, each alone. @param {Order} order @param {readonly string[]} added @param {readonly string[]} removed @returns {Order} */
export function reconcile(order, added, removed) {
  const gone = new Set(removed);
  const kept = order.map((group) => group.filter((id) => !gone.has(id))).filter((group) => group.length > 0);
  return [...kept, ...added.map((id) => [id])];
}

/** Whether both hold the same cards, each once. @param {Order} a @param {Order} b */
export function holdsTheSame(a, b) {
  return isSame([flat(a).sort()], [flat(b).sort()]) && b.every((group) => group.length > 0);
}

/** @param {Order} a @param {Order} b */
export function isSame(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}
