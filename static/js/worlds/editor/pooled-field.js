/** Whether everybody's comparisons in the world being made are pooled, without names: the result of a class. */

import { byId } from "#js/lib/dom.js";

const SENTENCE = "Tick it for one result of everybody who plays here.";

export class PooledField {
  #box = /** @type {HTMLInputElement} */ (byId("pooled"));
  #words = byId("pooled-problem");
  #set;

  /** @param {(isPooled: boolean) => void} set */
  constructor(set) {
    this.#set = set;
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    this.#box.addEventListener("change", () => this.#set(this.#box.checked), { signal });
  }

  /** @param {boolean} isPooled */
  show(isPooled) {
    this.#box.checked = isPooled;
  }

  /** The words of the server name what stands in the address; here a tick is all that is needed. @param {string} problem */
  tell(problem) {
    this.#words.textContent = problem && SENTENCE;
    this.#words.hidden = problem === "";
  }
}
