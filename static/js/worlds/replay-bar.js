/** A replay on the page's board: play and pause, step by step, any step, 0.5× to 8×, and "try again from here". */

import { describePosition } from "#js/board/describe.js";
import { canBranch } from "#js/board/moves.js";
import { Replay } from "#js/board/replay.js";
import { rewardOf } from "#js/board/state.js";
import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { exactSum } from "#js/lib/exact-sum.js";
import { plural, signed } from "#js/lib/format.js";

/** @typedef {import("#js/worlds/attempt-strip.js").Entry} Entry */

const SPEEDS = [0.5, 1, 2, 4, 8];

export class ReplayBar {
  #world;
  #showTotals;
  #onShow;
  #replay;
  #bar = byId("replay");
  #range = /** @type {HTMLInputElement} */ (byId("replay-at"));
  #speed = /** @type {HTMLSelectElement} */ (byId("replay-speed"));
  /** @type {Entry | null} */
  #entry = null;
  #name = "";

  /**
   * @param {import("#js/elements/irl-board.js").IrlBoard} board
   * @param {{showTotals: boolean, onShow: (entry: Entry, at: number) => void, signal: AbortSignal}} options  `onShow`: after every step
   */
  constructor(board, { showTotals, onShow, signal }) {
    this.#world = /** @type {import("#js/board/state.js").World} */ (board.world);
    this.#showTotals = showTotals;
    this.#onShow = onShow;
    this.#replay = new Replay(board, () => this.#show());
    this.#range.addEventListener("input", () => this.#replay.seek(Number(this.#range.value)), { signal });
    this.#speed.addEventListener("change", () => this.#setSpeed(Number(this.#speed.value)), { signal });
    this.#bar.addEventListener("click", (event) => this.#onClick(event), { signal });
  }

  /** The attempt on show and the steps shown of it. @returns {{entry: Entry, at: number} | null} */
  get shown() {
    return this.#entry && { entry: this.#entry, at: this.#replay.at };
  }

  /** Whether one can try again from the step on show; never from an attempt that the server does not have and will not. */
  get canBranch() {
    return (
      this.#entry !== null && this.#entry.sync !== "refused" && canBranch(this.#world, this.#entry, this.#replay.at)
    );
  }

  /** @param {Entry} entry @param {number} n */
  open(entry, n) {
    this.#entry = entry;
    this.#name = `Replay of attempt ${n}`;
    const total = this.#showTotals ? `, ${signed(entry.total)}` : "";
    byId("replay-title").textContent = `Attempt ${n}: ${entry.outcome}${total}`;
    this.#range.max = String(entry.actions.length);
    this.#range.setAttribute("aria-label", `Step of attempt ${n}`);
    announce(
      `${this.#name}: ${entry.outcome}${total} in ${plural(entry.actions.length, "step")}. Escape goes back to play.`,
    );
    this.#replay.play(entry, () => announce(`${this.#name} is over. Escape goes back to play.`));
  }

  close() {
    this.#entry = null;
    this.#replay.stop();
  }

  /** Space, and the button. */
  toggle() {
    if (this.#replay.isPlaying) this.#replay.stop();
    else this.#replay.resume();
  }

  /** One step on or back; the replay then stands still. @param {number} by */
  nudge(by) {
    this.#replay.seek(this.#replay.at + by);
    const state = this.#entry?.states[this.#replay.at] ?? this.#world.start;
    announce(`${this.#words()}. ${describePosition(this.#world, state)}`);
  }

  /** The next faster or slower speed. @param {number} by */
  changeSpeed(by) {
    const index = SPEEDS.indexOf(this.#replay.speed) + by;
    const speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, index))] ?? 1;
    this.#setSpeed(speed);
    announce(`${speed} times.`);
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (!button || !this.#entry) return;
    const { replay } = button.dataset;
    if (replay === "toggle") this.toggle();
    else if (replay === "back") this.nudge(-1);
    else if (replay === "on") this.nudge(1);
  }

  /** @param {number} speed */
  #setSpeed(speed) {
    this.#replay.speed = speed;
    this.#speed.value = String(speed);
  }

  #show() {
    if (!this.#entry) return;
    const { at, isPlaying } = this.#replay;
    this.#bar.dataset.playing = String(isPlaying);
    byId("replay-toggle").setAttribute("aria-label", isPlaying ? "Pause" : "Play");
    this.#range.value = String(at);
    this.#range.setAttribute("aria-valuetext", this.#words());
    this.#onShow(this.#entry, at);
    /** @type {HTMLButtonElement} */ (byId("branch")).disabled = !this.canBranch;
  }

  #words() {
    const { at, nSteps } = this.#replay;
    const rewards = this.#entry?.states.slice(1, at + 1).map((state) => rewardOf(this.#world, state)) ?? [];
    return `Step ${at} of ${nSteps}${this.#showTotals ? `, total ${signed(exactSum(rewards))}` : ""}`;
  }
}
