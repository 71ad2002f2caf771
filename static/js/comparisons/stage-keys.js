/** The keys of the stage, as users of players expect them; whatever has a use of its own for a key keeps it. */

import { isTaken, letterOf } from "#js/lib/keys.js";

/**
 * @typedef {object} KeyPlayer
 * @property {() => void} togglePlay
 * @property {(by: number) => void} nudge        steps
 * @property {(by: number) => void} turn         episodes on or back
 * @property {(down: number, right: number) => void} look   to the next square
 * @property {boolean} isLooking
 * @property {() => void} lookAway
 * @property {() => void} fillScreen
 */

const ARROWS = /** @type {Record<string, [number, number]>} */ ({
  ArrowUp: [-1, 0],
  ArrowRight: [0, 1],
  ArrowDown: [1, 0],
  ArrowLeft: [0, -1],
});
/** What moves, scrolls or is written into by keys keeps them all. */
const KEEPS_ALL = "input[type=range], [tabindex], [contenteditable]";
/** What is pressed with the space bar keeps that. */
const IS_PRESSED = "a, button, input, summary";

/** @param {KeyPlayer} player @param {AbortSignal} signal */
export function listenForKeys(player, signal) {
  document.addEventListener("keydown", (event) => onKey(player, event), { signal });
}

/** @param {KeyPlayer} player @param {KeyboardEvent} event */
function onKey(player, event) {
  const action = isTaken(event) || isBusy(event) ? null : actionOf(player, event);
  if (!action) return;
  event.preventDefault();
  action();
}

/** @param {KeyPlayer} player @param {KeyboardEvent} event @returns {(() => void) | null} */
function actionOf(player, event) {
  const { key, shiftKey } = event;
  const [down, right] = ARROWS[key] ?? [0, 0];
  if (shiftKey && (down || right)) return () => player.look(down, right);
  if (right && !shiftKey) return () => player.nudge(right);
  if (key === " " && !event.repeat) return () => player.togglePlay();
  if (key === "Escape") return player.isLooking ? () => player.lookAway() : null;
  if (event.repeat) return null;
  if (key === ",") return () => player.turn(-1);
  if (key === ".") return () => player.turn(1);
  return letterOf(event) === "f" ? () => player.fillScreen() : null;
}

/** True where what has the focus has a use of its own for this key. @param {KeyboardEvent} event */
function isBusy({ target, key, shiftKey }) {
  if (!(target instanceof Element)) return false;
  if (target.closest(KEEPS_ALL)) return true;
  if (key in ARROWS) return !shiftKey && target.matches("input[type=radio]");
  return key === " " && target.closest(IS_PRESSED) !== null;
}
