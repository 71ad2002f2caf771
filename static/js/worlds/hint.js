/** The line below the buttons: how to move, until there is something else to say. */

import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";

export class Hint {
  #line = byId("hint");
  #usual = [...this.#line.childNodes];

  /** Say a sentence, here and aloud; until the next step, or until there is another. @param {string} sentence @param {{stays?: boolean}} [options] */
  say(sentence, options) {
    this.show(sentence, options);
    announce(sentence);
  }

  /** Show a sentence that is said otherwise. @param {string} sentence @param {{stays?: boolean}} [options] */
  show(sentence, { stays = false } = {}) {
    this.#line.textContent = sentence;
    this.#line.dataset.isUsual = "false";
    this.#line.dataset.stays = String(stays);
  }

  /** What was said of a square or a moment is over with the next step. */
  forget() {
    const { isUsual, stays } = this.#line.dataset;
    if (isUsual === "true" || stays === "true") return;
    this.#line.replaceChildren(...this.#usual);
    this.#line.dataset.isUsual = "true";
  }
}
