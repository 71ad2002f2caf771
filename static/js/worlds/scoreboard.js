/** The figures of the attempt on the board: total, steps, the last step's cost, the time that is left. */

import { exactSum } from "#js/lib/exact-sum.js";
import { number, plural, signed } from "#js/lib/format.js";

/** Said when this much is left (s), or half of a shorter limit. */
const WARN_AT_S = 10;

export class Scoreboard {
  #total = document.getElementById("total");
  #nSteps = /** @type {HTMLElement} */ (document.getElementById("n-steps"));
  #lastStep = /** @type {HTMLElement} */ (document.getElementById("last-step"));
  #timeLeft = document.getElementById("time-left");
  #announce;
  #warnAt;
  #hasWarned = false;

  /** @param {(sentence: string) => void} announce @param {number | null} [timeLimit]  s */
  constructor(announce, timeLimit) {
    this.#announce = announce;
    this.#warnAt = Math.min(WARN_AT_S, (timeLimit ?? Number.POSITIVE_INFINITY) / 2);
  }

  /** @param {readonly number[]} rewards  of the steps made */
  show(rewards) {
    const reward = rewards.at(-1);
    if (this.#total) this.#total.textContent = number(exactSum(rewards));
    this.#nSteps.textContent = String(rewards.length);
    this.#lastStep.textContent = reward === undefined ? "–" : signed(reward);
  }

  /** @param {number | null} ms */
  showTime(ms) {
    if (!this.#timeLeft || ms === null) return;
    const seconds = Math.ceil(ms / 1000);
    const words = clock(seconds);
    if (this.#timeLeft.textContent === words) return;
    this.#timeLeft.textContent = words;
    const isLow = seconds <= this.#warnAt;
    this.#timeLeft.dataset.low = String(isLow);
    if (isLow && seconds > 0 && !this.#hasWarned) this.#announce(`${plural(seconds, "second")} left.`);
    this.#hasWarned = isLow;
  }
}

/** 90 → "1:30". @param {number} seconds */
export function clock(seconds) {
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}
