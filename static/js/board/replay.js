/** Shows an attempt again, step by step, on any board: plays, pauses, goes to any step. */

import { facingOf } from "#js/board/facing.js";

const STEP_MS = 320;

/** @typedef {{states: readonly number[], actions?: readonly number[]}} Walk */

export class Replay {
  #timer = 0;
  #at = 0;
  #speed = 1;
  /** @type {Walk} */
  #walk = { states: [] };
  /** @type {() => void} */
  #onEnd = () => {};
  /** @type {() => void} */
  #onChange;

  /** @param {import("#js/elements/irl-board.js").IrlBoard} board @param {() => void} [onChange]  called after every step, pause and start */
  constructor(board, onChange = () => {}) {
    this.board = board;
    this.#onChange = onChange;
  }

  get isPlaying() {
    return this.#timer !== 0;
  }

  /** Steps shown so far. */
  get at() {
    return this.#at;
  }

  get nSteps() {
    return Math.max(0, this.#walk.states.length - 1);
  }

  get speed() {
    return this.#speed;
  }

  /** 1 is some three steps a second. */
  set speed(speed) {
    this.#speed = speed;
    if (this.isPlaying) this.#wait();
    this.#onChange();
  }

  /** From the beginning. @param {Walk} walk @param {() => void} [onEnd] */
  play(walk, onEnd = () => {}) {
    this.#walk = walk;
    this.#onEnd = onEnd;
    this.#at = 0;
    this.resume();
  }

  /** Go on from where it stands; from the beginning if that is the end. */
  resume() {
    if (this.#at >= this.nSteps) this.#at = 0;
    this.#wait();
    this.#show();
  }

  /** Stand still. */
  stop() {
    clearTimeout(this.#timer);
    this.#timer = 0;
    this.#onChange();
  }

  /** Stand still after `at` steps. @param {number} at */
  seek(at) {
    clearTimeout(this.#timer);
    this.#timer = 0;
    this.#at = Math.min(this.nSteps, Math.max(0, at));
    this.#show();
  }

  #wait() {
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => this.#advance(), STEP_MS / this.#speed);
  }

  #advance() {
    if (this.#at >= this.nSteps) {
      this.stop();
      this.#onEnd();
      return;
    }
    this.#at += 1;
    this.#wait();
    this.#show();
  }

  #show() {
    const { board } = this;
    const states = this.#walk.states.slice(0, this.#at + 1);
    const agent = { state: states.at(-1) ?? 0, who: "human", facing: facingOf(board.world, this.#walk, this.#at) };
    board.view = { ...board.view, paths: [{ states, who: "human", width: 0.3 }], agents: [agent] };
    this.#onChange();
  }
}
