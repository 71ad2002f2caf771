/** The keys of the stage, as users of players expect them; whatever has a use of its own for a key keeps it. */

import { isTaken, letterOf } from "#js/lib/keys.js";

/**
 * @typedef {object} KeyPlayer
 * @property {() => void} togglePlay
 * @property {(by: number) => void} nudge        steps
 * @property {(step: number) => void} seek
 * @property {(by: number) => void} turn         episodes on or back
 * @property {(down: number, right: number) => void} look   to the next square
 * @property {() => void} lookAway
 * @property {() => void} fillScreen
 */

const ARROWS = /** @type {Record<string, [number, number]>} */ ({
  ArrowUp: [-1, 0],
  ArrowRight: [0, 1],
  ArrowDown: [1, 0],
  ArrowLeft: [0, -1],
});
/** What does something with keys by itself: controls, links, whatever scrolls or is moved with arrows. */
const BUSY = "a, button, input, select, textarea, summary, [tabindex], [contenteditable]";
/** Buttons and boxes have no use for arrows. */
const IDLE_WITH_ARROWS = "button, input[type=checkbox], a";

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
  if (key === "Home") return () => player.seek(0);
  if (key === "End") return () => player.seek(Number.POSITIVE_INFINITY);
  if (key === "Escape") return () => player.lookAway();
  if (event.repeat) return null;
  if (key === ",") return () => player.turn(-1);
  if (key === ".") return () => player.turn(1);
  return letterOf(event) === "f" ? () => player.fillScreen() : null;
}

/** @param {KeyboardEvent} event */
function isBusy({ target, key }) {
  const control = target instanceof Element ? target.closest(BUSY) : null;
  return control !== null && !(key in ARROWS && control.matches(IDLE_WITH_ARROWS));
}
