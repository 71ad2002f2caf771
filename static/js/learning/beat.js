/**
 * One paint an animation frame, however often it is asked for. A page that nobody sees gets no animation frames: what
 * comes meanwhile waits as state, not as a queue of paints, and the next frame shows how things stand then.
 */
export class Beat {
  #paint;
  #asked = 0;

  /** @param {(now: number) => boolean} paint true where it wants the next frame, too */
  constructor(paint) {
    this.#paint = paint;
  }

  ask() {
    if (this.#asked) return;
    this.#asked = requestAnimationFrame((now) => {
      this.#asked = 0;
      if (this.#paint(now)) this.ask();
    });
  }

  stop() {
    cancelAnimationFrame(this.#asked);
    this.#asked = 0;
  }
}
