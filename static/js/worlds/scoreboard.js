/** The figures of the attempt being played: total, steps, the last step's cost, the time that is left. */

import { totalOf } from "#js/board/moves.js";
import { number, plural, signed } from "#js/lib/format.js";

/** Said when this much is left (s), by what is left of the limit. */
const WARN_AT_S = 10;

export class Scoreboard {
  #total = document.getElementById("total");
  #nSteps = /** @type {HTMLElement} */ (document.getElementById("n-steps"));
  #lastStep = /** @type {HTMLElement} */ (document.getElementById("last-step"));
  #timeLeft = document.getElementById("time-left");
  #announce;
  #hasWarned = false;

  /** @param {(sentence: string) => void} announce */
  constructor(announce) {
    this.#announce = announce;
  }

  /** @param {import("#js/board/moves.js").Attempt} attempt */
  show(attempt) {
    const reward = attempt.rewards.at(-1);
    if (this.#total) this.#total.textContent = number(totalOf(attempt));
    this.#nSteps.textContent = String(attempt.actions.length);
    this.#lastStep.textContent = reward === undefined ? "–" : signed(reward);
  }

  /** @param {number | null} ms */
  showTime(ms) {
    if (!this.#timeLeft || ms === null) return;
    const seconds = Math.ceil(ms / 1000);
    const words = clock(seconds);
    if (this.#timeLeft.textContent === words) return;
    this.#timeLeft.textContent = words;
    const isLow = seconds <= WARN_AT_S;
    this.#timeLeft.dataset.low = String(isLow);
    if (isLow && seconds > 0 && !this.#hasWarned) this.#announce(`${plural(seconds, "second")} left.`);
    this.#hasWarned = isLow;
  }
}

/** 90 → "1:30". @param {number} seconds */
export function clock(seconds) {
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}
