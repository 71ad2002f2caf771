/** Chance that can be repeated, and what is drawn from it. */

/** @param {number} seed */
export function dice(seed) {
  let state = Math.imul(seed, 2654435761);
  const next = () => {
    state = Math.imul(state, 1664525) + 1013904223;
    return (state >>> 0) / 2 ** 32;
  };
  // Neighbouring seeds begin alike.
  for (let i = 0; i < 8; i += 1) next();
  return {
    next,
    /** 0 … n − 1 @param {number} n */
    upTo: (n) => Math.floor(next() * n),
    /** @template T @param {readonly T[]} items @returns {T} */
    of: (items) => items[Math.floor(next() * items.length)],
  };
}

/** n cards in any order, some of them tied. @param {ReturnType<typeof dice>} rng @param {number} n @param {string} [prefix] */
export function drawnOrder(rng, n, prefix = "c") {
  const ids = Array.from({ length: n }, (_, i) => `${prefix}${i}`);
  /** @type {string[][]} */
  const order = [];
  while (ids.length > 0) {
    const [id] = ids.splice(rng.upTo(ids.length), 1);
    if (order.length > 0 && rng.next() < 0.3) order.at(-1)?.push(id);
    else order.push([id]);
  }
  return order;
}
