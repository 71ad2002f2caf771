/** Beside a board whose squares are small: the squares around the agent, large. It follows by itself. */

import "#js/elements/irl-board.js";
import { cropTo, cropView, windowAround } from "#js/board/crop.js";

/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */
/** @typedef {import("#js/board/crop.js").Window} Window */
/** @typedef {import("#js/board/crop.js").Crop} Crop */

/** Squares smaller than this (CSS pixels) are hard to tell apart. */
const SMALL_SQUARE = 14;
const SIZE = 9;

export class CloseUp {
  #near = /** @type {IrlBoard} */ (document.createElement("irl-board"));
  /** @type {Window | null} */
  #window = null;
  /** @type {Crop | null} */
  #part = null;
  /** @type {import("#js/board/state.js").World | null} */
  #world = null;

  /** @param {HTMLElement} host shown and hidden as it is needed @param {IrlBoard} board @param {AbortSignal} [signal] */
  constructor(host, board, signal) {
    this.host = host;
    this.board = board;
    // The board itself says everything there is to say.
    this.#near.setAttribute("aria-hidden", "true");
    host.append(this.#near);
    host.hidden = true;
    board.addEventListener("board:changed", () => this.#follow(), { signal });
    this.#follow();
  }

  #follow() {
    const { world, view, cell } = this.board;
    const state = view.agents[0]?.state;
    const isNeeded = world !== null && state !== undefined && cell > 0 && cell < SMALL_SQUARE;
    this.host.hidden = !isNeeded;
    if (!isNeeded) {
      this.board.frame = null;
      return;
    }
    const window = windowAround(world, state, SIZE, world === this.#world ? this.#window : null);
    if (window !== this.#window || !this.#part) {
      this.#part = cropTo(world, window);
      this.#near.world = this.#part.world;
    }
    [this.#window, this.#world] = [window, world];
    this.board.frame = window;
    this.#near.view = cropView(view, this.#part);
  }
}
