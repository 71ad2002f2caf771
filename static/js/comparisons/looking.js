/**
 * Looking at one square: the same square is marked on all boards, and a sentence says what they show of it. By mouse, by a
 * tap, or square by square with the keyboard.
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 * @import {World} from "#js/board/state.js"
 */
import { placeOf } from "#js/board/state.js";
import { announce } from "#js/lib/announce.js";

export class Looking {
  #world;
  #boards;
  #wordsOf;
  #words;
  #idle;
  /** @type {number | null} */
  #state = null;

  /**
   * @param {World} world
   * @param {{ boards: IrlBoard[], words: HTMLElement, wordsOf: (state: number) => string }} shown
   */
  constructor(world, { boards, words, wordsOf }) {
    this.#world = world;
    this.#boards = boards;
    this.#words = words;
    this.#wordsOf = wordsOf;
    this.#idle = words.textContent;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    for (const board of this.#boards) {
      const lookAt = (/** @type {PointerEvent | MouseEvent} */ event) =>
        this.#set(board.stateAt(event.clientX, event.clientY));
      board.addEventListener("pointermove", (event) => event.pointerType === "mouse" && lookAt(event), { signal });
      board.addEventListener("click", lookAt, { signal });
      board.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && this.away(), { signal });
    }
  }

  get isLooking() {
    return this.#state !== null;
  }

  /** From square to square; the first is the start's. @param {number} down @param {number} right */
  step(down, right) {
    const { rows, cols, start } = this.#world;
    const [row, col] = placeOf(this.#world, this.#state ?? start);
    const isFirst = this.#state === null;
    const toRow = Math.min(rows - 1, Math.max(0, row + (isFirst ? 0 : down)));
    const toCol = Math.min(cols - 1, Math.max(0, col + (isFirst ? 0 : right)));
    this.#set(toRow * cols + toCol);
    announce(this.#words.textContent);
  }

  away() {
    this.#set(null);
  }

  /** What the boards show has changed. */
  again() {
    this.#say();
  }

  /** @param {number | null} state */
  #set(state) {
    if (state === this.#state) return;
    this.#state = state;
    for (const board of this.#boards) board.cursor = state;
    this.#say();
  }

  #say() {
    this.#words.textContent = this.#state === null ? this.#idle : this.#wordsOf(this.#state);
  }
}
