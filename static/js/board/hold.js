/** Hold-to-move, an option of studies: a direction that is held goes on by itself, at one pace on every machine. */

const FIRST_MS = 220;
const NEXT_MS = 120;

/**
 * Of several that are held the latest leads; when it is let go, the one before takes over. The system's own key
 * repeat has no part in this: its pace is a setting of each computer.
 */
export class Hold {
  /** @type {{name: string, action: number}[]} the latest last */
  #held = [];
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  /** @type {(action: number) => boolean} */
  #repeat;

  /** @param {(action: number) => boolean} repeat  false ends it */
  constructor(repeat) {
    this.#repeat = repeat;
  }

  /** @param {string} name  which key or button @param {number} action */
  press(name, action) {
    this.#held = [...this.#held.filter((one) => one.name !== name), { name, action }];
    this.#wait(FIRST_MS);
  }

  /** @param {string} name */
  release(name) {
    const isLeading = this.#held.at(-1)?.name === name;
    this.#held = this.#held.filter((one) => one.name !== name);
    if (isLeading) this.#wait(NEXT_MS);
  }

  stop() {
    this.#held = [];
    clearTimeout(this.#timer);
  }

  /** @param {number} ms */
  #wait(ms) {
    clearTimeout(this.#timer);
    const leading = this.#held.at(-1);
    if (!leading) return;
    this.#timer = setTimeout(() => {
      if (this.#repeat(leading.action)) this.#wait(NEXT_MS);
      else this.stop();
    }, ms);
  }
}
