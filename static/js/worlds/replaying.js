/** The page while it shows a replay: the board plays an earlier attempt, the keys steer it, and the way back is kept. */

import { announce } from "#js/lib/announce.js";
import { ReplayBar } from "#js/worlds/replay-bar.js";

/** @typedef {import("#js/worlds/attempt-strip.js").Entry} Entry */
/** @typedef {import("#js/board/input.js").Command} Command */

export class Replaying {
  #board;
  #slot;
  #acts;
  #bar;
  /** Where the keyboard was when the replay began. @type {HTMLElement | null} */
  #cameFrom = null;

  /**
   * @param {import("#js/elements/irl-board.js").IrlBoard} board
   * @param {HTMLElement} slot   says by `data-shows` what the page shows
   * @param {object} acts
   * @param {boolean} acts.showTotals
   * @param {(entry: Entry, at: number) => void} acts.onShow   after every step
   * @param {() => void} acts.onEnd     the attempt being played is on the board again
   * @param {(entry: Entry, at: number) => void} acts.onBranch
   * @param {AbortSignal} acts.signal
   */
  constructor(board, slot, acts) {
    this.#board = board;
    this.#slot = slot;
    this.#acts = acts;
    this.#bar = new ReplayBar(board, acts);
  }

  get isOn() {
    return this.#slot.dataset.shows === "replay";
  }

  /** The square on which the replayed attempt stands. @returns {number | undefined} */
  get state() {
    const shown = this.#bar.shown;
    return shown?.entry.states[shown.at];
  }

  /** @param {Entry} entry @param {number} n */
  begin(entry, n) {
    if (!this.isOn) this.#slot.dataset.before = this.#slot.dataset.shows;
    this.#slot.dataset.shows = "replay";
    this.#board.dataset.mode = "replay";
    this.#board.cursor = null;
    // On a phone the list lies below the board.
    this.#board.scrollIntoView({ block: "nearest" });
    this.#comeFrom(document.activeElement);
    this.#bar.open(entry, n);
  }

  end() {
    if (!this.isOn) return;
    this.#bar.close();
    delete this.#board.dataset.mode;
    this.#slot.dataset.shows = this.#slot.dataset.before ?? "playing";
    this.#acts.onEnd();
  }

  /** Left and right go through the steps, up and down change the speed. @param {number} action */
  steer(action) {
    if (action === 1 || action === 3) this.#bar.nudge(action === 1 ? 1 : -1);
    else this.#bar.changeSpeed(action === 0 ? 1 : -1);
  }

  /** A tap on the board. */
  toggle() {
    this.#bar.toggle();
  }

  /** @param {Command} command */
  command(command) {
    if (command === "again") this.#bar.toggle();
    else if (command === "branch") this.#branch();
    else if (command === "endReplay" || command === "undo") {
      // Escape; or the way back that a gamepad has.
      this.end();
      this.#cameFrom?.focus();
    }
  }

  #branch() {
    const shown = this.#bar.shown;
    if (!shown) return;
    if (!this.#bar.canBranch)
      return announce("Here the attempt is over, or has not begun: there is nothing to try again.");
    this.end();
    this.#acts.onBranch(shown.entry, shown.at);
  }

  /** The replay's keys need the board: on the button that began it, Space would begin it anew. @param {Element | null} place */
  #comeFrom(place) {
    const isByKeyboard = place instanceof HTMLElement && place !== this.#board && place.matches(":focus-visible");
    this.#cameFrom = isByKeyboard ? place : null;
    this.#board.focus({ preventScroll: true });
  }
}
