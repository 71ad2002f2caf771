/**
 * A gamepad in the hand: d-pad and left stick move, a few buttons do the rest. Browsers tell only that a gamepad is
 * there, not what is pressed on it: that is read once a frame, and only while one is connected and the page is seen.
 */

import { Hold } from "#js/board/hold.js";
import { isCovered } from "#js/lib/keys.js";

/** @typedef {import("#js/board/input.js").Player} Player */
/** @typedef {import("#js/board/input.js").Command} Command */
/** @typedef {{buttons: ReadonlySet<number>, stick: number | null}} Held   pressed buttons; where the stick points */
/** @typedef {{player: Player, root: Element | null, hold: Hold | null}} Listener */

/** The d-pad of the standard gamepad @type {Record<number, number>} */
const MOVES = { 12: 0, 15: 1, 13: 2, 14: 3 };
/** By place: 0 is the lower button (A, ×), 1 the right (B, ○), 3 the upper one (Y, △), 8 Back, 9 Start @type {Record<number, Command>} */
const COMMANDS = { 0: "again", 9: "again", 1: "undo", 3: "restart", 8: "giveUp" };

const STICK = "stick";
/** A stick points somewhere from here on, and does so until it is back below the other: no trembling at the border. */
const [PUSHED, LET_GO] = [0.6, 0.4];
/** A stick that rolls from one direction to the next changes over when it leans this much more there. */
const ROLLED = 0.15;
const OLDEST_MS = 250;
/** @type {Held} */
const AT_REST = { buttons: new Set(), stick: null };

/** One reader for the whole page, so that a press belongs to one board even when it closes a dialog above another. */
class Reader {
  /** @type {Set<Listener>} */
  #listeners = new Set();
  /** @type {Map<number, Held>} by the gamepad's index */
  #held = new Map();
  #frame = 0;

  /** @param {Listener} listener @param {AbortSignal} signal */
  add(listener, signal) {
    if (this.#listeners.size === 0) this.#begin();
    this.#listeners.add(listener);
    signal.addEventListener("abort", () => this.#remove(listener));
    window.addEventListener("gamepadconnected", () => this.#schedule(), { signal });
    window.addEventListener("gamepaddisconnected", () => listener.hold?.stop(), { signal });
    window.addEventListener("blur", () => listener.hold?.stop(), { signal });
    document.addEventListener("visibilitychange", () => this.#onVisibility(), { signal });
    this.#schedule();
  }

  /** @param {Listener} listener */
  #remove(listener) {
    this.#listeners.delete(listener);
    listener.hold?.stop();
  }

  #onVisibility() {
    if (document.hidden) return;
    this.#begin();
    this.#schedule();
  }

  /** What is held as the reading begins was pressed for something else. */
  #begin() {
    this.#held = new Map(gamepads().map((pad) => [pad.index, heldOn(pad, AT_REST)]));
  }

  #schedule() {
    if (this.#frame || this.#listeners.size === 0 || document.hidden || gamepads().length === 0) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      this.#read();
      this.#schedule();
    });
  }

  #read() {
    // Whoever may hear is settled before anybody acts: acting may open or close a dialog.
    const hearing = [...this.#listeners].filter(({ root }) => document.hasFocus() && !isCovered(root));
    const pads = gamepads();
    for (const pad of pads) {
      const before = this.#held.get(pad.index) ?? AT_REST;
      const now = heldOn(pad, before);
      this.#held.set(pad.index, now);
      for (const listener of hearing) tell(listener, before, now, timeOf(pad));
    }
    for (const index of this.#held.keys()) if (!pads.some((pad) => pad.index === index)) this.#held.delete(index);
  }
}

const reader = new Reader();

/**
 * @param {Player} player
 * @param {AbortSignal} signal
 * @param {{root?: Element | null, holdToMove?: boolean}} [options]   `root`: one's own dialog
 */
export function listenToGamepad(player, signal, { root = null, holdToMove = false } = {}) {
  const repeat = (/** @type {number} */ action) =>
    !isCovered(root) && player.move(action, { when: performance.now(), device: "hold" }) !== false;
  reader.add({ player, root, hold: holdToMove ? new Hold(repeat) : null }, signal);
}

/** Is a gamepad there that has shown itself, by a press of any button? */
export function hasGamepad() {
  return gamepads().length > 0;
}

/** What is pressed on a gamepad, given what was a frame ago. @param {Pick<Gamepad, "buttons" | "axes">} pad @param {Held} before @returns {Held} */
export function heldOn(pad, before) {
  const buttons = pad.buttons.flatMap(({ pressed }, i) => (pressed ? [i] : []));
  return { buttons: new Set(buttons), stick: directionOf(pad.axes[0] ?? 0, pad.axes[1] ?? 0, before.stick) };
}

/**
 * Where a stick points: nowhere within its dead zone, else one of four directions, which it keeps until it comes back
 * or leans clearly elsewhere.
 * @param {number} x  right is positive @param {number} y  down is positive @param {number | null} before
 */
function directionOf(x, y, before) {
  const leans = [-y, x, y, -x];
  const most = Math.max(...leans);
  const kept = before === null ? 0 : leans[before];
  if (before !== null && kept >= LET_GO && most < kept + ROLLED) return before;
  return most >= PUSHED ? leans.indexOf(most) : null;
}

/** @param {Listener} listener @param {Held} before @param {Held} now @param {number} when */
function tell({ player, hold }, before, now, when) {
  const [were, are] = [directionsOf(before), directionsOf(now)];
  for (const [name, action] of were) if (are.get(name) !== action) hold?.release(name);
  for (const [name, action] of are) {
    if (were.get(name) === action) continue;
    if (player.move(action, { when, device: "gamepad" }) !== false) hold?.press(name, action);
  }
  for (const button of now.buttons) {
    const command = COMMANDS[button];
    if (command === undefined || before.buttons.has(button)) continue;
    hold?.stop();
    player.command(command);
  }
}

/** @param {Held} held @returns {Map<string, number>} */
function directionsOf({ buttons, stick }) {
  /** @type {[string, number][]} */
  const pressed = [...buttons].filter((button) => button in MOVES).map((button) => [`${button}`, MOVES[button]]);
  return new Map(stick === null ? pressed : [...pressed, [STICK, stick]]);
}

/** The gamepad's own time of the press; some report none, or count from elsewhere. @param {Gamepad} pad */
function timeOf({ timestamp }) {
  const now = performance.now();
  return timestamp > 0 && timestamp <= now && timestamp > now - OLDEST_MS ? timestamp : now;
}

/** @returns {Gamepad[]} */
function gamepads() {
  return [...(navigator.getGamepads?.() ?? [])]
    .filter((pad) => pad?.connected === true)
    .map((pad) => /** @type {Gamepad} */ (pad));
}
