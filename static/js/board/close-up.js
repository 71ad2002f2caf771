/** Beside a board whose squares are small: the squares around the agent, large. It follows by itself. */

import "#js/elements/irl-board.js";
import { cropTo, cropView, windowAround } from "#js/board/crop.js";

/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */
/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/crop.js").Window} Window */
/** @typedef {import("#js/board/crop.js").Crop} Crop */
/** @typedef {{window: Window, float: IrlBoard["float"], bump: IrlBoard["bump"]}} CloseUpOf   what a board hands over */

/** Squares smaller than this (CSS pixels) are hard to tell apart. */
const SMALL_SQUARE = 14;
const SIZE = 9;

export class CloseUp {
  #near = /** @type {IrlBoard} */ (document.createElement("irl-board"));
  /** @type {Window | null} */
  #window = null;
  /** @type {Crop | null} */
  #part = null;
  /** @type {World | null} */
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
    const { world, view, cell, cursor } = this.board;
    const state = cursor ?? view.agents[0]?.state;
    const isNeeded = world !== null && state !== undefined && cell > 0 && cell < SMALL_SQUARE;
    this.host.hidden = !isNeeded;
    if (!isNeeded) return this.#forget();
    const before = world === this.#world ? this.#window : null;
    const window = windowAround(world, state, SIZE, before);
    if (window !== before || !this.#part) this.#show(world, window);
    if (!this.#part) return;
    this.#near.view = cropView(view, this.#part);
    this.#near.cursor = cursor === null ? null : this.#part.toLocal(cursor);
  }

  /** @param {World} world @param {Window} window */
  #show(world, window) {
    const part = cropTo(world, window);
    [this.#world, this.#window, this.#part] = [world, window, part];
    this.#near.world = part.world;
    this.board.closeUp = {
      window,
      bump: (direction) => this.#near.bump(direction),
      float: (state, text, kind) => {
        const near = part.toLocal(state);
        if (near !== null) this.#near.float(near, text, kind);
      },
    };
  }

  #forget() {
    if (this.#part) this.board.closeUp = null;
    [this.#world, this.#window, this.#part] = [null, null, null];
  }
}
