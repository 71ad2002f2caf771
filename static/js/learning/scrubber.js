/**
 * The controls of the time line: the slider, the button that plays back, and where it stands in words.
 * @import {Timeline} from "#js/learning/timeline.js"
 */

export class Scrubber {
  #root;

  /** @param {HTMLElement} root */
  constructor(root) {
    this.#root = root;
  }

  /** @returns {HTMLInputElement} */
  get range() {
    return this.#part("range");
  }

  /**
   * @param {Timeline} timeline
   * @param {number} last the right end
   * @param {boolean} isEmpty nothing has been recorded yet
   */
  paint({ position, isPlaying }, last, isEmpty) {
    const { range } = this;
    range.max = String(last);
    range.value = String(position);
    range.disabled = isEmpty;
    range.setAttribute("aria-valuetext", `iteration ${position}`);
    this.#say("position", `iteration ${position}`);
    this.#part("play-back").disabled = isEmpty;
    this.#part("play-back").setAttribute("aria-pressed", String(isPlaying));
    this.#part("play-icon").hidden = isPlaying;
    this.#part("pause-icon").hidden = !isPlaying;
    this.#say("play-word", isPlaying ? "Pause" : "Play back");
  }

  /** @param {string} name @param {string} text */
  #say(name, text) {
    const part = this.#part(name);
    if (part.textContent !== text) part.textContent = text;
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}
