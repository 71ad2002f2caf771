/** A small board with a learned policy: reward in colour, arrows, and for a moment a mark on each square whose arrow turned. */

import { make } from "#js/board/dom.js";
import { boardWords } from "#js/rankings/policy-material.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/rankings/policy-material.js").Preview} Preview */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */

export class PolicyPicture {
  #world;
  #board;
  #marks;
  /** @type {readonly number[]} */
  #turned = [];

  /** @param {HTMLElement} root @param {World} world */
  constructor(root, world) {
    this.#world = world;
    this.#board = /** @type {IrlBoard} */ (root.querySelector("irl-board"));
    this.#marks = /** @type {HTMLElement} */ (root.querySelector(".policy-marks"));
    this.#board.world = world;
    this.#board.addEventListener("board:changed", () => this.#placeMarks());
  }

  /** @param {Preview} preview @param {{turned: readonly number[], unknown: boolean[]}} how  unknown: no attempt it learned from came there */
  show(preview, { turned, unknown }) {
    this.#turned = turned;
    this.#board.view = { values: preview.reward.flat(), arrows: preview.policy, unknown };
    this.#board.label = boardWords(this.#world, preview);
    this.#marks.replaceChildren(...turned.map(() => make("span", "policy-mark")));
    this.#placeMarks();
  }

  /** The squares have whole device pixels, so the board rarely fills its box. */
  #placeMarks() {
    const { cell } = this.#board;
    const { rows, cols } = this.#world;
    this.#marks.style.inlineSize = `${cell * cols}px`;
    this.#marks.style.blockSize = `${cell * rows}px`;
    this.#marks.style.setProperty("--cell", `${cell}px`);
    for (const [at, mark] of [...this.#marks.children].entries()) {
      const state = this.#turned[at] ?? 0;
      /** @type {HTMLElement} */ (mark).style.translate =
        `${cell * (state % cols)}px ${cell * Math.floor(state / cols)}px`;
    }
  }
}
