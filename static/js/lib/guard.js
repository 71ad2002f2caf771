/** Asks before the page is closed, but only while that would lose something: a page that always asks is not kept for "back". */

export class Guard {
  #isNeeded;
  #isListening = false;

  /** @param {() => boolean} isNeeded */
  constructor(isNeeded) {
    this.#isNeeded = isNeeded;
  }

  /** Something may have changed. */
  look() {
    const isNeeded = this.#isNeeded();
    if (isNeeded === this.#isListening) return;
    this.#isListening = isNeeded;
    if (isNeeded) window.addEventListener("beforeunload", ask);
    else window.removeEventListener("beforeunload", ask);
  }
}

/** @param {Event} event */
function ask(event) {
  event.preventDefault();
}
