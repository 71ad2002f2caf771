/**
 * An order of attempts: groups of ids from first to last, the most weight first (the best success, the worst failure).
 * A group of several is a tie. Orders are values; every function returns a new one.
 */

/** @typedef {readonly (readonly string[])[]} Order */

/** @param {Order} order @returns {string[]} */
export function flat(order) {
  return order.flat();
}

/** Put a card at a place among all others, counted from 0. Between two cards of one tie it joins the tie, else it stands alone. @param {Order} order @param {string} id @param {number} position @returns {Order} */
export function move(order, id, position) {
  const others = order.map((group) => group.filter((other) => other !== id)).filter((group) => group.length > 0);
  let start = 0;
  for (const [i, group] of others.entries()) {
    const inside = position - start;
    if (inside <= 0) return [...others.slice(0, i), [id], ...others.slice(i)];
    if (inside < group.length) {
      return others.with(i, [...group.slice(0, inside), id, ...group.slice(inside)]);
    }
    start += group.length;
  }
  return [...others, [id]];
}

/** True when the card shares its place with the one above. @param {Order} order @param {string} id */
export function isTiedAbove(order, id) {
  return order.some((group) => group.indexOf(id) > 0);
}

/** Tie a card (and what is tied to it) with the one above, or part it from it again. @param {Order} order @param {string} id @returns {Order} */
export function toggleTie(order, id) {
  const i = order.findIndex((group) => group.includes(id));
  const group = order[i] ?? [];
  const at = group.indexOf(id);
  if (at > 0) return [...order.slice(0, i), group.slice(0, at), group.slice(at), ...order.slice(i + 1)];
  if (i <= 0) return order;
  return [...order.slice(0, i - 1), [...(order[i - 1] ?? []), ...group], ...order.slice(i + 1)];
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

/** An older order brought up to the cards there are now: gone ones left out, new ones last. @param {Order} order @param {readonly string[]} ids @returns {Order} */
export function reconcile(order, ids) {
  const kept = order.map((group) => group.filter((id) => ids.includes(id))).filter((group) => group.length > 0);
  const known = new Set(flat(kept));
  return [...kept, ...ids.filter((id) => !known.has(id)).map((id) => [id])];
}

/** @param {Order} a @param {Order} b */
export function isSame(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}

/** What was, is, and was taken back. @template T @typedef {{past: readonly T[], present: T, future: readonly T[]}} History */

/** @template T @param {T} present @returns {History<T>} */
export function begin(present) {
  return { past: [], present, future: [] };
}

/** @template T @param {History<T>} history @param {T} next @returns {History<T>} */
export function record({ past, present }, next) {
  return { past: [...past, present], present: next, future: [] };
}

/** @template T @param {History<T>} history @returns {History<T>} */
export function undo(history) {
  const last = history.past.at(-1);
  if (last === undefined) return history;
  return { past: history.past.slice(0, -1), present: last, future: [history.present, ...history.future] };
}

/** @template T @param {History<T>} history @returns {History<T>} */
export function redo(history) {
  const [next, ...future] = history.future;
  if (next === undefined) return history;
  return { past: [...history.past, history.present], present: next, future };
}
