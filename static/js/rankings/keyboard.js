/** The keyboard on a focused card: arrows go to the next one, Space lifts it, lifted the same keys move it. */

import { letterOf } from "#js/lib/keys.js";

/** @typedef {import("#js/rankings/card.js").Card} Card */
/** @typedef {import("#js/rankings/hands.js").Hands} Hands */

const PAGE = 5;
/** How far these keys go: the focus, or the card that is lifted. @type {Record<string, number>} */
const WAYS = {
  ArrowUp: -1,
  ArrowDown: 1,
  PageUp: -PAGE,
  PageDown: PAGE,
  Home: -Number.MAX_SAFE_INTEGER,
  End: Number.MAX_SAFE_INTEGER,
};

export class CardKeys {
  #hands;

  /** @param {Hands} hands */
  constructor(hands) {
    this.#hands = hands;
  }

  /** @param {HTMLElement} root @param {AbortSignal} signal */
  listen(root, signal) {
    root.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    root.addEventListener("focusout", (event) => this.#onLeave(event), { signal });
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const target = event.target instanceof HTMLElement ? event.target : null;
    const card = this.#hands.find(target)?.card;
    if (!card || event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    if (event.key === "Escape") this.#onEscape(card, event);
    const act = target === card.element ? this.#actOf(card, event) : null;
    if (!act) return;
    event.preventDefault();
    if (!event.repeat || event.key in WAYS) act();
  }

  /** @param {Card} card @param {KeyboardEvent} event */
  #onEscape(card, event) {
    if (this.#hands.isLifted(card)) this.#hands.putBack(card);
    else if (!this.#hands.unmark()) return;
    event.preventDefault();
  }

  /** @param {Card} card @param {KeyboardEvent} event @returns {(() => void) | null} */
  #actOf(card, event) {
    const [hands, isLifted, way] = [this.#hands, this.#hands.isLifted(card), WAYS[event.key]];
    if (way !== undefined) return () => (isLifted ? hands.step(card, way, "key") : hands.goTo(card, way));
    if (event.key === " ") return () => (isLifted ? hands.drop(card) : hands.lift(card));
    if (letterOf(event) === "t") return () => hands.tie(card, "key");
    return letterOf(event) === "c" ? () => hands.compare(card, "key") : null;
  }

  /** A card that was moved keeps the focus within the same turn; one that truly lost it is put down where it is. @param {FocusEvent} event */
  #onLeave({ target }) {
    const card = this.#hands.find(/** @type {Element} */ (target))?.card;
    if (!card || !this.#hands.isLifted(card)) return;
    queueMicrotask(() => {
      if (document.activeElement !== card.element) this.#hands.drop();
    });
  }
}
