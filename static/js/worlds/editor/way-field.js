/** How attempts are put in order in the world being made: one way for everybody, or as people like. */

import { byId } from "#js/lib/dom.js";
import { WAYS } from "#js/worlds/editor/plan.js";

/** @typedef {import("#js/board/state.js").Way} Way */

const SENTENCE = "Choose one of these ways, or leave it to the people.";

export class WayField {
  #select = /** @type {HTMLSelectElement} */ (byId("rank_by"));
  #words = byId("rank_by-problem");
  #set;

  /** @param {(way: Way | null) => void} set */
  constructor(set) {
    this.#set = set;
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    const onChange = () => this.#set(WAYS.find((way) => way === this.#select.value) ?? null);
    this.#select.addEventListener("change", onChange, { signal });
  }

  /** @param {Way | null} way */
  show(way) {
    this.#select.value = way ?? "";
  }

  /** The words of the server name what stands in the address; here a choice is all that is needed. @param {string} problem */
  tell(problem) {
    this.#words.textContent = problem && SENTENCE;
    this.#words.hidden = problem === "";
    if (problem) this.#select.setAttribute("aria-invalid", "true");
    else this.#select.removeAttribute("aria-invalid");
  }
}
