/**
 * The one clock all rollouts of the Compare page run on. It counts steps; who has fewer waits at the end. After the last step it
 * rests a moment, then starts again when it loops.
 */

/** Steps a second at speed 1. */
const STEPS_PER_SECOND = 4;
/** How long the last step stays on screen before a loop starts again, in seconds at any speed. */
const REST_SECONDS = 1.2;

export const SPEEDS = /** @type {const} */ ([0.5, 1, 2, 4, 8]);

export class Transport {
  #exact = 0;
  #length = 0;
  #rested = 0;
  #isPlaying = false;
  speed = 1;
  loop = true;

  /** Whole steps done since the start. */
  get step() {
    return Math.min(this.#length, Math.floor(this.#exact + 1e-9));
  }

  /** Steps of the longest rollout. */
  get length() {
    return this.#length;
  }

  get isPlaying() {
    return this.#isPlaying;
  }

  get isAtEnd() {
    return this.step >= this.#length;
  }

  /** @param {number} length steps of the longest rollout of the episode now shown */
  load(length) {
    this.#length = length;
    this.#exact = 0;
    this.#rested = 0;
  }

  play() {
    if (this.isAtEnd) this.seek(0);
    this.#isPlaying = true;
  }

  pause() {
    this.#isPlaying = false;
  }

  /** @param {number} step */
  seek(step) {
    this.#exact = Math.min(this.#length, Math.max(0, Math.round(step)));
    this.#rested = 0;
  }

  /** One step on or back; takes over from playing. @param {number} by */
  nudge(by) {
    this.pause();
    this.seek(this.step + by);
  }

  /**
   * @param {number} elapsedMs since the last call
   * @returns {boolean} whether another step is shown now
   */
  advance(elapsedMs) {
    if (!this.#isPlaying) return false;
    const before = this.step;
    const seconds = elapsedMs / 1000;
    if (this.isAtEnd) this.#rest(seconds);
    else this.#exact = Math.min(this.#length, this.#exact + seconds * STEPS_PER_SECOND * this.speed);
    return this.step !== before;
  }

  /** @param {number} seconds */
  #rest(seconds) {
    if (!this.loop) {
      this.pause();
      return;
    }
    this.#rested += seconds;
    if (this.#rested >= REST_SECONDS) this.seek(0);
  }
}
