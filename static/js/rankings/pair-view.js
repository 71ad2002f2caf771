/** Two attempts on two boards, shown by one clock: who has fewer steps waits at the end. At rest both paths lie there whole. */

import "#js/elements/irl-board.js";
import { prefersStill } from "#js/board/dom.js";
import { facingOf } from "#js/board/facing.js";
import { Transport } from "#js/comparisons/transport.js";

/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */
/** @typedef {{id: string, states: number[], actions: number[]}} Walk */

/** A page that slept does not catch up all at once. */
const LONGEST_FRAME_MS = 100;
const SIDES = /** @type {const} */ (["a", "b"]);

export class PairView {
  #root;
  #world;
  #onPlay;
  #clock = new Transport();
  /** @type {Record<"a" | "b", Walk> | null} */
  #walks = null;
  #frame = 0;
  #drawnAt = 0;

  /** @param {HTMLElement} root @param {{world: any, onPlay: (ids: string[], means: Means) => void}} parts  onPlay: somebody asked to see them again */
  constructor(root, { world, onPlay }) {
    this.#root = root;
    this.#world = world;
    this.#onPlay = onPlay;
    this.#clock.loop = false;
    this.#clock.speed = 2;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    for (const side of SIDES) this.#board(side).addEventListener("click", () => this.replay("mouse"), { signal });
    this.#root.querySelector('[data-act="play"]')?.addEventListener("click", () => this.toggle("button"), { signal });
    const range = this.#range;
    range.addEventListener("input", () => this.#seek(Number(range.value)), { signal });
    // The arrow keys answer again once the hand has left the slider.
    range.addEventListener("pointerup", () => range.blur(), { signal });
    const speed = /** @type {HTMLSelectElement} */ (this.part("speed"));
    speed.addEventListener("change", () => this.#setSpeed(Number(speed.value)), { signal });
    signal.addEventListener("abort", () => this.stop());
  }

  /** Put two attempts on the boards and play them once. @param {Walk} a @param {Walk} b @param {Record<"a" | "b", string>} words */
  show(a, b, words) {
    this.#walks = { a, b };
    for (const side of SIDES) {
      const board = this.#board(side);
      if (board.world !== this.#world) board.world = this.#world;
      board.label = `${side === "a" ? "Left" : "Right"}: ${words[side]}`;
      this.part(`words-${side}`).textContent = words[side];
      this.#root.querySelector(`[data-side="${side}"]`)?.setAttribute("data-shows", { a, b }[side].id);
    }
    this.#clock.load(Math.max(a.actions.length, b.actions.length));
    this.#clock.pause();
    this.#range.max = String(Math.max(1, this.#clock.length));
    if (!prefersStill()) this.#play();
    this.#draw();
  }

  /** Space, and the button. @param {Means} means */
  toggle(means) {
    if (!this.#clock.isPlaying) return this.replay(means);
    this.#clock.pause();
    this.#draw();
  }

  /** On from where it stands; from the beginning if that is the end. @param {Means} means */
  replay(means) {
    if (!this.#walks) return;
    this.#onPlay([this.#walks.a.id, this.#walks.b.id], means);
    this.#play();
    this.#draw();
  }

  stop() {
    this.#clock.pause();
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
  }

  /** @param {string} name @returns {HTMLElement} */
  part(name) {
    return /** @type {HTMLElement} */ (this.#root.querySelector(`[data-part="${name}"]`));
  }

  get #range() {
    return /** @type {HTMLInputElement} */ (this.part("range"));
  }

  /** @param {"a" | "b"} side */
  #board(side) {
    return /** @type {IrlBoard} */ (this.part(`board-${side}`));
  }

  #play() {
    this.#clock.play();
    this.#drawnAt = 0;
    this.#frame ||= requestAnimationFrame((now) => this.#tick(now));
  }

  /** @param {number} step */
  #seek(step) {
    this.#clock.pause();
    this.#clock.seek(step);
    this.#draw();
  }

  /** @param {number} speed */
  #setSpeed(speed) {
    this.#clock.speed = speed;
  }

  /** @param {number} now */
  #tick(now) {
    const elapsed = this.#drawnAt ? Math.min(LONGEST_FRAME_MS, now - this.#drawnAt) : 0;
    this.#drawnAt = now;
    const hasMoved = this.#clock.advance(elapsed);
    this.#frame = this.#clock.isPlaying ? requestAnimationFrame((next) => this.#tick(next)) : 0;
    if (hasMoved || !this.#clock.isPlaying) this.#draw();
  }

  #draw() {
    const { step, length, isPlaying } = this.#clock;
    for (const side of SIDES) this.#drawSide(side, step, !isPlaying && step === 0);
    this.#range.value = String(step);
    this.#range.setAttribute("aria-valuetext", `step ${step} of ${length}`);
    this.part("step").textContent = `step ${step} of ${length}`;
    this.part("play-icon").hidden = isPlaying;
    this.part("pause-icon").hidden = !isPlaying;
    this.part("play-word").textContent = isPlaying ? "Pause" : "Play both";
  }

  /** @param {"a" | "b"} side @param {number} step @param {boolean} isAtRest */
  #drawSide(side, step, isAtRest) {
    const walk = this.#walks?.[side];
    if (!walk) return;
    const at = Math.min(step, walk.actions.length);
    const states = isAtRest ? walk.states : walk.states.slice(0, at + 1);
    const agent = { state: walk.states[at] ?? 0, who: "human", facing: facingOf(this.#world, walk, at) };
    const board = this.#board(side);
    board.view = { ...board.view, paths: [{ states, who: "human", width: 0.35 }], agents: [agent] };
  }
}
