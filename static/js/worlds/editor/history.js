/** What was, what is, and what was taken back. A gesture (a stroke, a pull on a slider) is one step. No DOM here. */

const MOST_KEPT = 200;

/** @template T */
export class History {
  /** @type {T[]} */
  #past = [];
  /** @type {T} */
  #present;
  /** @type {T[]} the next one last */
  #future = [];
  /** @type {unknown} */
  #gesture = null;

  /** @param {T} present */
  constructor(present) {
    this.#present = present;
  }

  get present() {
    return this.#present;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }

  /** Changes of the same gesture, one after the other, are one step. @param {T} next @param {unknown} [gesture] */
  change(next, gesture = null) {
    if (next === this.#present) return;
    const goesOn = gesture !== null && gesture === this.#gesture;
    if (!goesOn) this.#past.push(this.#present);
    if (this.#past.length > MOST_KEPT) this.#past.shift();
    this.#gesture = gesture;
    this.#future = [];
    this.#present = next;
  }

  /** What comes next is another step. */
  endGesture() {
    this.#gesture = null;
  }

  undo() {
    this.#move(this.#past, this.#future);
  }

  redo() {
    this.#move(this.#future, this.#past);
  }

  /** @param {T[]} from @param {T[]} to */
  #move(from, to) {
    const next = from.pop();
    if (next === undefined) return;
    to.push(this.#present);
    this.#present = next;
    this.#gesture = null;
  }
}
