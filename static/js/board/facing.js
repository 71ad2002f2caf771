/** Where an agent looks: the way it last went, or the way it last meant to go when it bumped. */

/**
 * @param {import("#js/board/state.js").World | null} world
 * @param {{states: readonly number[], actions?: readonly number[]}} walk
 * @param {number} at index of the state it stands on
 * @returns {number | null}
 */
export function facingOf(world, walk, at) {
  if (!world || at < 1) return null;
  const difference = (walk.states[at] ?? 0) - (walk.states[at - 1] ?? 0);
  // On a board of one column a step down is also a step of +1: rows go first.
  if (difference === world.cols) return 2;
  if (difference === -world.cols) return 0;
  if (difference === 1) return 1;
  if (difference === -1) return 3;
  return walk.actions?.[at - 1] ?? null;
}
