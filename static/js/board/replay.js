/** Shows an attempt again, step by step, on any board. */

import { facingOf } from "#js/board/facing.js";

const STEP_MS = 320;

/** @typedef {{states: readonly number[], actions?: readonly number[]}} Walk */

export class Replay {
  #timer = 0;
  #at = 0;
  /** @type {Walk} */
  #walk = { states: [] };
  /** @type {(() => void) | null} */
  #onEnd = null;

  /** @param {import("#js/elements/irl-board.js").IrlBoard} board */
  constructor(board) {
    this.board = board;
    this.speed = 1;
  }

  get isPlaying() {
    return this.#timer !== 0;
  }

  /** @param {Walk} walk @param {() => void} [onEnd] */
  play(walk, onEnd) {
    this.stop();
    this.#walk = walk;
    this.#onEnd = onEnd ?? null;
    this.#at = 0;
    this.#show();
    this.#timer = window.setTimeout(() => this.#advance(), STEP_MS / this.speed);
  }

  stop() {
    clearTimeout(this.#timer);
    this.#timer = 0;
  }

  #advance() {
    if (this.#at >= this.#walk.states.length - 1) {
      this.stop();
      this.#onEnd?.();
      return;
    }
    this.#at += 1;
    this.#show();
    this.#timer = window.setTimeout(() => this.#advance(), STEP_MS / this.speed);
  }

  #show() {
    const states = this.#walk.states.slice(0, this.#at + 1);
    const agent = { state: states.at(-1) ?? 0, who: "human", facing: facingOf(this.board.world, this.#walk, this.#at) };
    this.board.view = { ...this.board.view, paths: [{ states, who: "human", width: 0.3 }], agents: [agent] };
  }
}
