/** The unfinished attempt, kept in this browser so that a reload loses nothing. */

import { replayActions } from "#js/board/moves.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/moves.js").Attempt} Attempt */

/** @param {string} worldId */
const keyOf = (worldId) => `irlfr:attempt:${worldId}`;

/** @param {string} worldId @param {Attempt} attempt */
export function keepAttempt(worldId, attempt) {
  try {
    if (attempt.actions.length === 0 || attempt.ending !== null) localStorage.removeItem(keyOf(worldId));
    else {
      const { id, actions, stepMs } = attempt;
      localStorage.setItem(keyOf(worldId), JSON.stringify({ id, actions, stepMs }));
    }
  } catch {
    // A full or closed storage costs only the checkpoint; the finished attempt goes through the outbox.
  }
}

/** The attempt that was left unfinished here, walked again; null when there is none. @param {World} world @returns {Attempt | null} */
export function keptAttempt(world) {
  try {
    const { id, actions, stepMs } = JSON.parse(localStorage.getItem(keyOf(world.id)) ?? "null");
    const isSound =
      typeof id === "string" && actions.every((/** @type {unknown} */ a) => [0, 1, 2, 3].includes(Number(a)));
    const attempt = isSound ? replayActions(world, { id, actions, stepMs }) : null;
    return attempt && attempt.actions.length > 0 && attempt.ending === null ? attempt : null;
  } catch {
    return null;
  }
}
