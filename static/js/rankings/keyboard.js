/** The keyboard on the cards: Space lifts and drops, arrows move, Escape puts back, T ties. All of it is announced. */

import { announce } from "#js/lib/announce.js";

/**
 * @typedef {object} Hands
 * @property {(card: HTMLElement, position: number) => void} place     0-based, among the cards of its list
 * @property {(card: HTMLElement) => void} tie
 * @property {(card: HTMLElement) => void} lift
 * @property {() => void} drop
 * @property {() => void} back   to where it was lifted
 */

export class CardKeys {
  /** @type {{card: HTMLElement} | null} */
  #lifted = null;
  #hands;

  /** @param {Hands} hands */
  constructor(hands) {
    this.#hands = hands;
  }

  /** @param {HTMLElement} root @param {AbortSignal} signal */
  listen(root, signal) {
    root.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    root.addEventListener("focusout", () => this.#onLeave(), { signal });
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const card = event.target instanceof HTMLElement && event.target.matches(".card") ? event.target : null;
    if (!card || event.ctrlKey || event.metaKey || event.altKey) return;
    const act = this.#actOf(event.key, card);
    if (!act) return;
    event.preventDefault();
    if (!event.repeat || event.key.startsWith("Arrow")) act();
  }

  /** @param {string} key @param {HTMLElement} card @returns {(() => void) | null} */
  #actOf(key, card) {
    if (key === " ") return this.#lifted ? () => this.#drop(card) : () => this.#lift(card);
    if (key === "Escape" && this.#lifted) return () => this.#cancel();
    if (key === "ArrowUp") return () => this.#go(card, -1);
    if (key === "ArrowDown") return () => this.#go(card, 1);
    if (key.toLowerCase() === "t") return () => this.#hands.tie(card);
    return null;
  }

  /** @param {HTMLElement} card */
  #lift(card) {
    this.#lifted = { card };
    this.#hands.lift(card);
    card.dataset.lifted = "true";
    announce(`Lifted: ${card.getAttribute("aria-label")}. Arrows move it, Space puts it down, Escape puts it back.`);
  }

  /** @param {HTMLElement} card */
  #drop(card) {
    this.#release();
    this.#hands.drop();
    announce(`Put down: ${card.getAttribute("aria-label")}.`);
  }

  #cancel() {
    const lifted = this.#lifted;
    this.#release();
    this.#hands.back();
    lifted?.card.focus();
    announce(`Put back: ${lifted?.card.getAttribute("aria-label")}.`);
  }

  /** @param {HTMLElement} card @param {-1 | 1} by */
  #go(card, by) {
    const cards = /** @type {HTMLElement[]} */ ([...(card.parentElement?.children ?? [])]);
    const to = cards.indexOf(card) + by;
    if (this.#lifted) {
      if (to < 0 || to >= cards.length) announce(by < 0 ? "It stands first already." : "It stands last already.");
      else this.#hands.place(card, to);
    } else cards[to]?.focus();
  }

  /** A card that was moved keeps the focus within the same turn; one that truly lost it is put down where it is. */
  #onLeave() {
    queueMicrotask(() => {
      if (this.#lifted && document.activeElement !== this.#lifted.card) this.#release();
    });
  }

  #release() {
    if (this.#lifted) delete this.#lifted.card.dataset.lifted;
    this.#lifted = null;
  }
}
