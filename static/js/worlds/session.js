/**
 * One person at one board, without a page: the attempt being played, what is measured about it, and its limits. The page
 * calls it with what the person does and shows what it answers; it never touches the document, the network or a store.
 */

import {
  beginAttempt,
  branch,
  giveUp,
  lastStep,
  replayActions,
  runOutOfTime,
  stateOf,
  step,
  undo,
} from "#js/board/moves.js";
import { Recorder } from "#js/worlds/recorder.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/moves.js").Attempt} Attempt */
/** @typedef {import("#js/worlds/recorder.js").Device} Device */
/** @typedef {import("#js/worlds/recorder.js").Notes} Notes */

/** @typedef {{reached: number, reward: number, taken: number, isSlip: boolean, isBump: boolean}} Step   what a press did */

/**
 * @typedef {object} Draft   an attempt that has not ended, as it is kept in this browser
 * @property {string} id
 * @property {string} worldId
 * @property {readonly number[]} actions
 * @property {readonly number[]} stepMs
 * @property {readonly (readonly [string, number])[]} slipSeeds
 * @property {string | null} parentId
 * @property {number} parentStep
 * @property {Notes} record
 * @property {number} savedAt      ms since 1970
 */

/** A day: whoever comes back the next morning has left. */
export const LONGEST_STEP_MS = 86_400_000;

export class PlaySession {
  #world;
  #newId;
  /** @type {Attempt} */
  #attempt;
  /** @type {Recorder} */
  #recorder;
  #lastEvent;

  /** @param {{world: World, newId: () => string, at: number}} parts   `at`: now, monotonic ms */
  constructor({ world, newId, at }) {
    this.#world = world;
    this.#newId = newId;
    this.#attempt = beginAttempt(world, newId());
    this.#recorder = new Recorder({ at });
    this.#lastEvent = at;
  }

  get attempt() {
    return this.#attempt;
  }

  get state() {
    return stateOf(this.#attempt);
  }

  get isOver() {
    return this.#attempt.ending !== null;
  }

  /** Whether there is anything of the person's own to take back, throw away or give up. */
  get hasOwnSteps() {
    return this.#attempt.actions.length > this.#attempt.parentStep;
  }

  /** One press. Null when nothing moves any more. @param {number} action @param {{when: number, device: Device, paintedAt?: number}} press @returns {Step | null} */
  move(action, { when, device, paintedAt = Number.NaN }) {
    if (this.isOver || this.#endIfOutOfTime(when)) return null;
    const before = this.state;
    this.#attempt = step(this.#world, this.#attempt, action, this.#since(when));
    this.#recorder.step({ when, device, paintedAt });
    const reached = this.state;
    const { taken, isSlip } = lastStep(this.#world, this.#attempt);
    return { reached, reward: this.#attempt.rewards.at(-1) ?? 0, taken, isSlip, isBump: reached === before };
  }

  /** One step back. @param {number} when @returns {boolean} whether there was one */
  undo(when) {
    if (!this.hasOwnSteps || this.isOver) return false;
    const action = this.#attempt.actions.at(-1) ?? 0;
    this.#attempt = undo(this.#attempt);
    this.#recorder.undo(when, action);
    this.#lastEvent = when;
    return true;
  }

  /** @returns {boolean} whether there was something to give up */
  giveUp() {
    const before = this.#attempt;
    this.#attempt = giveUp(this.#attempt);
    return this.#attempt !== before;
  }

  /** Begin anew; an unfinished attempt is thrown away, which the next one's record tells. @param {number} when */
  begin(when) {
    const abandoned = this.#abandoned(when);
    this.#attempt = beginAttempt(this.#world, this.#newId());
    this.#start(when, { abandoned });
  }

  /** Try again from where another attempt stood after `k` steps. @param {Parameters<typeof branch>[1]} parent @param {number} k @param {number} when */
  beginFrom(parent, k, when) {
    // What was under way is set aside, not thrown away: it does not count among the abandoned.
    const { abandoned } = this.isOver ? { abandoned: [] } : this.#recorder.notes(when);
    this.#attempt = branch(this.#world, parent, k, this.#newId());
    this.#start(when, { abandoned });
    this.#recorder.fit(this.#attempt.actions.length);
  }

  /** Go on with an attempt that was left. False if it is none that can go on. @param {Draft} draft @param {number} when @param {number | null} awayMs */
  resume(draft, when, awayMs) {
    const attempt = replayActions(this.#world, draft);
    if (attempt.ending !== null || attempt.actions.length <= attempt.parentStep) return false;
    this.#attempt = attempt;
    this.#start(when, draft.record);
    this.#recorder.fit(attempt.actions.length);
    this.#recorder.event("resumed", when, awayMs);
    return true;
  }

  /** @param {import("#js/worlds/recorder.js").EventType} type @param {number} when @param {number | null} [value] */
  note(type, when, value = null) {
    if (!this.isOver) this.#recorder.event(type, when, value);
  }

  /** Ms by which the wall clock jumped since this was last asked; it is noted. @param {number} when */
  checkClock(when) {
    return this.isOver ? 0 : this.#recorder.checkClock(when);
  }

  /** Ms left to play; null in a world without a time limit. The time begins with the first step. @param {number} when */
  timeLeft(when) {
    const limit = this.#world.time_limit_s;
    return limit === null || limit === undefined
      ? null
      : Math.max(0, 1000 * limit - this.#recorder.sinceFirstStep(when));
  }

  /** End the attempt if its time is up. @param {number} when @returns {boolean} whether it ended just now */
  tick(when) {
    return !this.isOver && this.#endIfOutOfTime(when);
  }

  /** What is kept of it in this browser until it ends. @param {number} when @returns {Draft} */
  draft(when) {
    const { id, actions, stepMs, slipSeeds, parentId, parentStep } = this.#attempt;
    const shared = { id, actions, stepMs, slipSeeds, parentId, parentStep };
    return { ...shared, worldId: this.#world.id, record: this.#recorder.notes(when), savedAt: Date.now() };
  }

  /** What the server is told about the playing. @param {number} when @param {Record<string, unknown>} client */
  record(when, client) {
    return this.#recorder.record(when, client);
  }

  /** What was thrown away since the last finished attempt, the present one included. @param {number} when */
  #abandoned(when) {
    if (this.isOver) return [];
    return this.hasOwnSteps ? this.#recorder.abandonedWithThis(when) : this.#recorder.notes(when).abandoned;
  }

  /** @param {number} when @param {Partial<Notes>} [notes] */
  #start(when, notes) {
    this.#recorder = new Recorder({ at: when, notes });
    this.#lastEvent = when;
  }

  /** @param {number} when */
  #endIfOutOfTime(when) {
    if (this.timeLeft(when) !== 0 || !this.hasOwnSteps) return false;
    this.#attempt = runOutOfTime(this.#attempt);
    return true;
  }

  /** Ms since the event before, which this one now is. @param {number} when */
  #since(when) {
    const ms = Math.min(LONGEST_STEP_MS, Math.max(0, Math.round((when - this.#lastEvent) * 10) / 10));
    this.#lastEvent = when;
    return ms;
  }
}
