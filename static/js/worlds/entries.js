/** Attempts as the list has them: from the server, from the board, from the outbox. */

import { outcomeOf, replayActions, totalOf } from "#js/board/moves.js";
import { isRefused, isSound } from "#js/lib/parcels.js";
import { refusalSentence } from "#js/worlds/saving-words.js";

/** @typedef {import("#js/board/moves.js").Attempt} Attempt */
/** @typedef {import("#js/board/moves.js").SlipSeed} SlipSeed */
/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/lib/parcels.js").AttemptParcel} AttemptParcel */

/**
 * @typedef {object} Entry
 * @property {string} id
 * @property {readonly number[]} states
 * @property {readonly number[]} actions
 * @property {readonly number[]} stepMs
 * @property {readonly SlipSeed[]} slipSeeds
 * @property {string | null} parentId
 * @property {number} parentStep
 * @property {string | null} ending
 * @property {"success" | "failure"} outcome
 * @property {number} total
 * @property {boolean} discarded
 * @property {"saved" | "waiting" | "refused"} sync
 * @property {string | null} note
 */

/** @param {any} demonstration of the API @returns {Entry} */
export function entryOfDemonstration(demonstration) {
  const { id, states, actions, step_ms, slip_seeds, parent_id, parent_step, ...rest } = demonstration;
  return {
    id,
    states,
    actions,
    stepMs: step_ms ?? actions.map(() => 0),
    slipSeeds: slip_seeds ?? [[id, 0]],
    parentId: parent_id ?? null,
    parentStep: parent_step ?? 0,
    ending: rest.ending,
    outcome: rest.outcome,
    total: rest.total,
    discarded: rest.discarded,
    sync: "saved",
    note: null,
  };
}

/** @param {Attempt} attempt @returns {Entry} */
export function entryOfAttempt(attempt) {
  const { rewards: _, ...shared } = attempt;
  return {
    ...shared,
    outcome: outcomeOf(attempt),
    total: totalOf(attempt),
    discarded: false,
    sync: "waiting",
    note: null,
  };
}

/** One that waits, or was refused, perhaps since another day. @param {World} world @param {AttemptParcel} parcel @returns {Entry} */
export function entryOfParcel(world, parcel) {
  const sync = isRefused(parcel) ? "refused" : "waiting";
  const note = sync === "refused" ? refusalSentence(parcel) : null;
  return { ...entryOfAttempt(attemptOf(world, parcel)), sync, note };
}

/** @param {World} world @param {AttemptParcel} parcel @returns {Attempt} */
function attemptOf(world, { id, body, slipSeeds }) {
  try {
    const { actions, step_ms: stepMs, parent_id: parentId, parent_step: parentStep } = body;
    const walked = replayActions(world, { id, actions, stepMs, slipSeeds, parentId, parentStep });
    return { ...walked, ending: /** @type {Attempt["ending"]} */ (body.ending) };
  } catch {
    // Damaged: it is listed all the same, so that it can be saved as a file.
    return replayActions(world, { id, actions: [], stepMs: [] });
  }
}

/** @param {Attempt} attempt @param {unknown} record @returns {import("#js/lib/parcels.js").AttemptBody} */
export function bodyOf({ id, actions, stepMs, ending, parentId, parentStep }, record) {
  const body = { id, actions, step_ms: stepMs, ending: ending ?? "gave_up", record };
  return parentId === null ? body : { ...body, parent_id: parentId, parent_step: parentStep };
}

/** A demonstration file of one attempt that the server does not have; what is too damaged for that, as it is. @param {World} world @param {Entry} entry @param {AttemptParcel} parcel */
export function fileOf(world, { slipSeeds }, parcel) {
  const { body, refusal, at } = parcel;
  const lines = isSound(parcel)
    ? [
        { kind: "world", ...world },
        { kind: "demonstration", world_id: world.id, ...body, slip_seeds: slipSeeds, refusal, kept_at: at },
      ]
    : [{ kind: "damaged", ...parcel }];
  return lines.map((line) => `${JSON.stringify(line)}\n`).join("");
}
