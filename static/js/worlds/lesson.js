/**
 * The practice without a page: a small world that never changes, and three things to do in it. Each waits until it has
 * been done; nothing of it is kept.
 */

import { beginAttempt, giveUp, outcomeOf, stateOf, step, totalOf, undo } from "#js/board/moves.js";
import { signed } from "#js/lib/format.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {"move" | "goal" | "fail" | "done"} Part */
/** @typedef {"keys" | "touch" | "gamepad"} Means   what the person has in hand */

/** The short way through the middle is red, and costs more than the goal pays; both ways round it are blue. @type {World} */
export const PRACTICE_WORLD = {
  id: "practice",
  rows: 3,
  cols: 4,
  start: 4,
  goal: 7,
  goals: [7],
  walls: [],
  rewards: [
    [-0.4, -0.2, -0.5, -0.3],
    [-0.2, -4.2, -5.1, 7],
    [-0.3, -0.6, -0.2, -0.4],
  ],
  colours: [
    ["blue", "blue", "blue", "blue"],
    ["blue", "red", "red", "goal"],
    ["blue", "blue", "blue", "blue"],
  ],
  seed: null,
  red_probability: null,
  slip: 0,
  horizon: 24,
  time_limit_s: null,
};

/** @type {Record<Means, string>} */
const HOW_TO_MOVE = {
  keys: "This is you: press an arrow key to move.",
  touch: "This is you: swipe on the board to move, or press an arrow below it.",
  gamepad: "This is you: move with the stick or the d-pad.",
};
/** @type {Record<Means, string>} */
const HOW_TO_FAIL = {
  keys: "Now fail on purpose: walk straight through the red, or give up with G.",
  touch: "Now fail on purpose: walk straight through the red, or press Give up.",
  gamepad: "Now fail on purpose: walk straight through the red, or give up with Back.",
};

export class Lesson {
  #means;
  #showTotals;
  /** @type {Part} */
  #part = "move";
  #attempt = beginAttempt(PRACTICE_WORLD, "practice");

  /** @param {Means} means @param {{showTotals?: boolean}} [options]   of the study */
  constructor(means, { showTotals = true } = {}) {
    this.#means = means;
    this.#showTotals = showTotals;
  }

  get part() {
    return this.#part;
  }

  get attempt() {
    return this.#attempt;
  }

  /** The way on, once an attempt has ended. @returns {"Go on" | "Once more" | "Play for real" | null} */
  get next() {
    if (this.#part === "done") return "Play for real";
    if (this.#attempt.ending === null) return null;
    return this.#isLearnt() ? "Go on" : "Once more";
  }

  get canGiveUp() {
    return this.#part === "fail" && this.#attempt.ending === null && this.#attempt.actions.length > 0;
  }

  /** What to do now, or what has just happened, in one sentence. @returns {string} */
  get words() {
    const { ending, actions } = this.#attempt;
    if (this.#part === "done")
      return "A useful failure: it shows what is better avoided, and no success can show that.";
    if (ending !== null) return this.#endWords();
    if (this.#part === "move")
      return actions.length > 0 ? "That is the edge: try another way." : HOW_TO_MOVE[this.#means];
    if (this.#part === "goal") return "Blue squares cost little and red ones a lot: walk to the flag over blue.";
    return HOW_TO_FAIL[this.#means];
  }

  /** What a step did, or null after the end. @param {number} action @returns {{reached: number, reward: number, isBump: boolean} | null} */
  move(action) {
    if (this.#attempt.ending !== null) return null;
    const before = stateOf(this.#attempt);
    this.#attempt = step(PRACTICE_WORLD, this.#attempt, action, 0);
    const reached = stateOf(this.#attempt);
    if (this.#part === "move" && reached !== before) this.#part = "goal";
    this.#end();
    return { reached, reward: this.#attempt.rewards.at(-1) ?? 0, isBump: reached === before };
  }

  undo() {
    this.#attempt = undo(this.#attempt);
  }

  giveUp() {
    if (!this.canGiveUp) return;
    this.#attempt = giveUp(this.#attempt);
    this.#end();
  }

  restart() {
    if (this.#attempt.ending === null) this.#begin();
  }

  /** After an end: the next thing to do, or the same once more. */
  goOn() {
    if (this.#attempt.ending === null || this.#part === "done") return;
    if (this.#isLearnt()) this.#part = "fail";
    this.#begin();
  }

  #begin() {
    this.#attempt = beginAttempt(PRACTICE_WORLD, "practice");
  }

  #end() {
    const hasFailed = this.#attempt.ending !== null && outcomeOf(this.#attempt) === "failure";
    if (hasFailed && this.#part === "fail") this.#part = "done";
  }

  #isLearnt() {
    return this.#part === "goal" && outcomeOf(this.#attempt) === "success";
  }

  #endWords() {
    const total = signed(totalOf(this.#attempt));
    const say = (/** @type {string} */ words) => (this.#showTotals ? words : "");
    if (this.#isLearnt()) return `A success: the goal paid 7, and ${this.#showTotals ? total : "some"} is left of it.`;
    if (this.#part === "fail")
      return `A success again${say(`, ${total}`)}: for a failure walk through both red squares, or give up on the way.`;
    if (this.#attempt.ending === "goal")
      return `You got there, but the red took more than the goal paid${say(`, ${total} in all`)}: try it over blue.`;
    return `All ${PRACTICE_WORLD.horizon} steps are used up: try it once more.`;
  }
}
