/** The board for those who need it in words, or closer: the position as a sentence, a table, a close-up. */

import { CloseUp } from "#js/board/close-up.js";
import { describePosition } from "#js/board/describe.js";
import { TextBoard } from "#js/board/text-board.js";
import { byId } from "#js/lib/dom.js";

export class Surroundings {
  #world;
  #position = byId("position");
  #textBoard = new TextBoard(/** @type {HTMLTableElement} */ (byId("text-board")));

  /** @param {import("#js/elements/irl-board.js").IrlBoard} board @param {import("#js/board/state.js").World} world */
  constructor(board, world) {
    this.#world = world;
    new CloseUp(byId("close-up"), board);
    byId("as-text-scroll").addEventListener("keydown", keepToScroll);
  }

  /** @param {number} state */
  show(state) {
    this.#position.textContent = describePosition(this.#world, state);
    this.#textBoard.update(this.#world, state);
  }
}

/** Where the table is larger than its place, arrow keys go over it rather than over the world. @param {KeyboardEvent} event */
function keepToScroll(event) {
  const place = /** @type {HTMLElement} */ (event.currentTarget);
  const isLarger = place.scrollWidth > place.clientWidth || place.scrollHeight > place.clientHeight;
  if (isLarger && event.key.startsWith("Arrow")) event.stopPropagation();
}
