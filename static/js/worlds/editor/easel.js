/** The board under a hand: mouse, touch and keys become strokes, and a cursor goes over the squares. */

import { nextState } from "#js/board/state.js";
import { isTaken } from "#js/lib/keys.js";
import { nearestSquare, placeAt } from "#js/worlds/editor/plan.js";

/**
 * @typedef {object} Painter
 * @property {(place: number) => void} begin
 * @property {(place: number) => void} moveTo
 * @property {() => void} end
 * @property {() => void} cancel
 * @property {(square: number) => void} look    the cursor came here
 */

/** @type {Record<string, number>} */
const WAYS = { ArrowUp: 0, ArrowRight: 1, ArrowDown: 2, ArrowLeft: 3 };

export class Easel {
  #board;
  #painter;
  /** @type {number | null} a place, so that it survives another size */
  #cursor = null;
  #isShown = false;
  #isSpaceDown = false;
  /** @type {number | null} */
  #pointer = null;

  /** @param {import("#js/elements/irl-board.js").IrlBoard} board @param {Painter} painter */
  constructor(board, painter) {
    this.#board = board;
    this.#painter = painter;
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    const board = this.#board;
    board.addEventListener("pointerdown", (event) => this.#press(event), { signal });
    board.addEventListener("pointermove", (event) => this.#drag(event), { signal });
    board.addEventListener("pointerup", (event) => this.#lift(event), { signal });
    board.addEventListener("pointercancel", () => this.#drop(), { signal });
    board.addEventListener("keydown", (event) => this.#onKeydown(event), { signal });
    board.addEventListener("keyup", (event) => this.#onKeyup(event), { signal });
    board.addEventListener("focus", () => this.#show(board.matches(":focus-visible")), { signal });
    board.addEventListener("blur", () => this.#leave(), { signal });
  }

  /** @param {import("#js/board/state.js").World} world */
  show(world) {
    this.#board.world = world;
    this.#placeCursor();
  }

  /** @param {PointerEvent} event */
  #press(event) {
    const square = this.#board.stateAt(event.clientX, event.clientY);
    if (!event.isPrimary || event.button !== 0 || square === null || this.#isSpaceDown) return;
    this.#board.setPointerCapture(event.pointerId);
    this.#pointer = event.pointerId;
    this.#show(false);
    this.#cursor = this.#placeOf(square);
    this.#painter.begin(this.#cursor);
  }

  /** A quick hand passes many squares between two frames, and may leave the board and come back. @param {PointerEvent} event */
  #drag(event) {
    if (event.pointerId !== this.#pointer) return;
    const square = this.#board.stateAt(event.clientX, event.clientY);
    if (square === null) return;
    this.#cursor = this.#placeOf(square);
    this.#painter.moveTo(this.#cursor);
  }

  /** @param {PointerEvent} event */
  #lift(event) {
    if (event.pointerId !== this.#pointer) return;
    this.#pointer = null;
    this.#painter.end();
  }

  /** A second finger made it a pinch: what the first one drew was not meant. */
  #drop() {
    if (this.#pointer === null) return;
    this.#pointer = null;
    this.#painter.cancel();
  }

  /** @param {KeyboardEvent} event */
  #onKeydown(event) {
    if (isTaken(event)) return;
    const way = WAYS[event.key];
    if (way !== undefined) this.#walk(way);
    else if (event.key === " ") this.#pressSpace();
    else if (event.key === "Enter") this.#touch(event.repeat);
    else return;
    event.preventDefault();
  }

  /** @param {KeyboardEvent} event */
  #onKeyup(event) {
    if (event.key !== " " || !this.#isSpaceDown) return;
    event.preventDefault();
    this.#isSpaceDown = false;
    this.#painter.end();
  }

  /** @param {number} way */
  #walk(way) {
    const world = this.#board.world;
    if (!world) return;
    const square = nextState({ ...world, walls: [] }, this.#square(), way);
    this.#cursor = this.#placeOf(square);
    this.#show(true);
    if (this.#isSpaceDown) this.#painter.moveTo(this.#cursor);
    this.#painter.look(square);
  }

  #pressSpace() {
    if (this.#isSpaceDown || this.#pointer !== null) return;
    this.#isSpaceDown = true;
    this.#show(true);
    this.#painter.begin(this.#placeOf(this.#square()));
  }

  /** @param {boolean} isRepeated */
  #touch(isRepeated) {
    if (isRepeated || this.#isSpaceDown || this.#pointer !== null) return;
    this.#show(true);
    this.#painter.begin(this.#placeOf(this.#square()));
    this.#painter.end();
  }

  #leave() {
    if (this.#isSpaceDown) this.#painter.end();
    this.#isSpaceDown = false;
    this.#show(false);
  }

  /** @param {boolean} isShown */
  #show(isShown) {
    const isNew = isShown && !this.#isShown;
    this.#isShown = isShown;
    this.#placeCursor();
    if (isNew) this.#painter.look(this.#square());
  }

  #placeCursor() {
    this.#board.cursor = this.#isShown ? this.#square() : null;
  }

  /** Where the cursor stands; at first on the start. */
  #square() {
    const world = this.#board.world;
    if (!world) return 0;
    return this.#cursor === null ? world.start : nearestSquare(world, this.#cursor);
  }

  /** @param {number} square */
  #placeOf(square) {
    return placeAt(this.#board.world ?? { cols: 1 }, square);
  }
}
