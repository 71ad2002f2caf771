/**
 * Where on the time line of iterations the boards stand. While it follows, it stands at the newest iteration; taking
 * hold of the scrubber stops that, playing back moves it on by itself.
 */

/** A whole playback lasts this long, however many iterations there are (ms). */
export const PLAYBACK_MS = 8_000;

export class Timeline {
  #last = 0;
  #position = 0;
  #isPlaying = false;
  #isFollowing = true;

  get last() {
    return this.#last;
  }

  get position() {
    return this.#isFollowing ? this.#last : Math.round(this.#position);
  }

  get isPlaying() {
    return this.#isPlaying;
  }

  get isFollowing() {
    return this.#isFollowing;
  }

  /** @param {number} iteration the newest recorded iteration */
  extendTo(iteration) {
    this.#last = Math.max(this.#last, iteration);
  }

  /** @param {number} iteration */
  moveTo(iteration) {
    this.#position = Math.min(this.#last, Math.max(0, iteration));
    this.#isPlaying = false;
    this.#isFollowing = this.#position >= this.#last;
  }

  /** Play from here; from the start when standing at the end. */
  play() {
    if (this.#last === 0) return;
    if (this.position >= this.#last) this.#position = 0;
    else this.#position = this.position;
    this.#isFollowing = false;
    this.#isPlaying = true;
  }

  pause() {
    this.#isPlaying = false;
  }

  /** @param {number} elapsedMs since the last call */
  advance(elapsedMs) {
    if (!this.#isPlaying) return;
    this.#position += (elapsedMs / PLAYBACK_MS) * this.#last;
    if (this.#position >= this.#last) this.moveTo(this.#last);
  }
}
