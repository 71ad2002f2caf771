/** What is pointed at, focused or tapped plays again: on the board between the lists, or on its card where there is none. */

import { Replay } from "#js/board/replay.js";

/** @typedef {import("#js/rankings/card.js").Card} Card */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */

/** A pointer on its way to somewhere else stays shorter. */
const DWELL_MS = 120;
const SPEED = 2;

export class Watching {
  #center;
  #caption;
  #onWatch;
  #replay;
  #timer = 0;
  /** @type {Card | null} */
  #card = null;
  /** What the card that plays by itself showed before. @type {{board: IrlBoard, view: import("#js/board/state.js").View} | null} */
  #still = null;

  /** @param {{center: IrlBoard, caption: HTMLElement, onWatch: (id: string, means: Means) => void}} parts */
  constructor({ center, caption, onWatch }) {
    this.#center = center;
    this.#caption = caption;
    this.#onWatch = onWatch;
    this.#replay = new Replay(center);
  }

  /** After a moment, if nothing else comes up until then. @param {Card | null} card */
  hover(card) {
    clearTimeout(this.#timer);
    if (card && card !== this.#card) this.#timer = window.setTimeout(() => this.play(card, "mouse"), DWELL_MS);
  }

  /** At once; what plays already goes on. @param {Card} card @param {Means} means */
  watch(card, means) {
    if (card !== this.#card || !this.#replay.isPlaying) this.play(card, means);
  }

  /** At once and from the beginning. @param {Card} card @param {Means} means */
  play(card, means) {
    clearTimeout(this.#timer);
    this.#replay.stop();
    this.#rest();
    if (this.#card) delete this.#card.element.dataset.watching;
    this.#card = card;
    card.element.dataset.watching = "true";
    this.#caption.textContent = card.words;
    card.draw();
    this.#start(card);
    this.#onWatch(card.id, means);
  }

  /** @param {Card} card */
  #start({ board: own, demonstration }) {
    const board = this.#center.clientWidth > 0 ? this.#center : own;
    this.#still = board === own ? { board, view: board.view } : null;
    if (this.#replay.board !== board) this.#replay = new Replay(board);
    this.#replay.speed = SPEED;
    this.#replay.play(demonstration, () => this.#rest());
  }

  /** A card that played by itself shows its whole path again. */
  #rest() {
    if (this.#still) this.#still.board.view = this.#still.view;
    this.#still = null;
  }
}
