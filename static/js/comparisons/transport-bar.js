/**
 * What is seen of the transport: the slider, the step, whether it plays.
 * @import {Transport} from "#js/comparisons/transport.js"
 */

export class TransportBar {
  #root;

  /** @param {HTMLElement} root */
  constructor(root) {
    this.#root = root;
  }

  /** @param {Transport} transport */
  show({ step, length, isPlaying }) {
    const range = this.#part("range");
    range.max = String(length);
    range.value = String(step);
    range.setAttribute("aria-valuetext", `step ${step} of ${length}`);
    this.#part("step").textContent = `step ${step} of ${length}`;
    this.#part("play-word").textContent = isPlaying ? "Pause" : "Play";
    this.#part("play-icon").hidden = isPlaying;
    this.#part("pause-icon").hidden = !isPlaying;
    this.#action("play").setAttribute("aria-pressed", String(isPlaying));
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"]`);
  }

  /** @param {string} name @returns {any} */
  #action(name) {
    return this.#root.querySelector(`[data-action="${name}"]`);
  }
}
