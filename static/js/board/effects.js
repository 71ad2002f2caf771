/** What passes over a board: a cost that floats up, a bump against a wall, the joy at a goal, the look-around cursor, the frame of a close-up. */

import { make, makeSvg, prefersStill } from "#js/board/dom.js";
import { DELTAS, placeOf } from "#js/board/state.js";

/** @typedef {import("#js/board/state.js").World} World */

const FLOAT_MS = 750;
/** The part of a float's time in which it fades in; one that follows another closely is there at once. */
const FLOAT_ENTRY = 0.16;
const BUMP_MS = 220;
const JOY_MS = 800;

export class Effects {
  layer = make("div", "board-effects");
  #note = make("span", "board-float");
  #bump = make("div", "board-bump");
  #joy = makeJoy();
  /** Marks that belong to who stands there, and where. @type {Map<Element, number>} */
  #besides = new Map();
  #cursor = make("div", "board-cursor");
  #frame = make("div", "board-frame");
  /** @type {WeakMap<Element, Animation>} */
  #running = new WeakMap();

  /** A short text rises from a square and fades; one that follows closely takes its place. @param {World} world @param {number} state @param {string} text @param {"gain" | "loss"} kind */
  float(world, state, text, kind) {
    const isShowing = this.#running.get(this.#note)?.playState === "running";
    this.#note.textContent = text;
    this.#note.className = `board-float board-float--${kind}`;
    // As wide as its letters are, about: measuring would cost the key press a layout.
    this.#note.style.setProperty("--half", `${text.length * 0.3 + 0.5}em`);
    this.#note.dataset.isFirstRow = String(placeOf(world, state)[0] === 0);
    this.#put(this.#note, world, state);
    const rise = (/** @type {number} */ share) =>
      `translate(-50%, calc(-50% - ${prefersStill() ? 0 : share} * 0.35 * var(--cell)))`;
    const animation = this.#play(this.#note, FLOAT_MS, [
      { opacity: 0, transform: rise(0) },
      { opacity: 1, transform: rise(0.4), offset: FLOAT_ENTRY },
      { opacity: 1, transform: rise(0.8), offset: 0.7 },
      { opacity: 0, transform: rise(1) },
    ]);
    if (isShowing) animation.currentTime = FLOAT_ENTRY * FLOAT_MS;
  }

  /** The side of a square that let nobody through. @param {World} world @param {number} state @param {number} direction 0…3 */
  bump(world, state, direction) {
    const [down, right] = DELTAS[direction] ?? [0, 0];
    this.#bump.style.setProperty("--down", String(down));
    this.#bump.style.setProperty("--right", String(right));
    this.#bump.dataset.lies = down === 0 ? "upright" : "flat";
    this.#besides.set(this.#bump, state);
    this.#put(this.#bump, world, state);
    this.#play(this.#bump, BUMP_MS, [{ opacity: 1 }, { opacity: 1, offset: 0.6 }, { opacity: 0 }]);
  }

  /** Rays around a square, once; with reduced motion they stand still. @param {World} world @param {number} state */
  celebrate(world, state) {
    this.#besides.set(this.#joy, state);
    this.#put(this.#joy, world, state);
    const grow = (/** @type {number} */ scale) => `translate(-50%, -50%) scale(${prefersStill() ? 1 : scale})`;
    this.#play(this.#joy, JOY_MS, [
      { opacity: 0, transform: grow(0.55), easing: "ease-out" },
      { opacity: 1, transform: grow(0.85), offset: 0.2, easing: "ease-out" },
      { opacity: 1, transform: grow(1), offset: 0.6 },
      { opacity: 0, transform: grow(1.06) },
    ]);
  }

  /** A bump and joy belong to who stands there: they end when the agent is elsewhere. @param {number | undefined} state */
  follow(state) {
    for (const [mark, place] of this.#besides) {
      if (place === state) continue;
      this.#besides.delete(mark);
      mark.remove();
    }
  }

  /** @param {World} world @param {number | null} state */
  pointAt(world, state) {
    if (state === null) this.#cursor.remove();
    else this.#put(this.#cursor, world, state);
  }

  /** @param {World} world @param {import("#js/board/crop.js").Window | null} window */
  frame(world, window) {
    if (window === null) return this.#frame.remove();
    this.#frame.style.setProperty("--rows", String(window.rows));
    this.#frame.style.setProperty("--cols", String(window.cols));
    this.#put(this.#frame, world, window.top * world.cols + window.left);
  }

  /** @param {HTMLElement | SVGElement} element @param {World} world @param {number} state */
  #put(element, world, state) {
    const [row, col] = placeOf(world, state);
    element.style.setProperty("--row", String(row));
    element.style.setProperty("--col", String(col));
    if (!element.isConnected) this.layer.append(element);
  }

  /** @param {Element} element @param {number} duration ms @param {Keyframe[]} frames */
  #play(element, duration, frames) {
    this.#running.get(element)?.cancel();
    const animation = element.animate(frames, { duration });
    animation.onfinish = () => element.remove();
    this.#running.set(element, animation);
    return animation;
  }
}

/** A ring and eight short rays, gold over a dark edge, so that they stand out on any square. */
function makeJoy() {
  const rays = Array.from({ length: 8 }, (_, i) => {
    const [x, y] = [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)];
    const at = (/** @type {number} */ r) => `${(x * r).toFixed(2)} ${(y * r).toFixed(2)}`;
    return `M${at(13.5)}L${at(17.5)}`;
  });
  const d = `M10.5 0A10.5 10.5 0 1 1 -10.5 0A10.5 10.5 0 1 1 10.5 0${rays.join("")}`;
  return makeSvg(
    "svg",
    { class: "board-joy", viewBox: "-20 -20 40 40" },
    makeSvg("path", { class: "board-joy-edge", d }),
    makeSvg("path", { class: "board-joy-gold", d }),
  );
}
