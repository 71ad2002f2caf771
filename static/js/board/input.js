/** Keys, swipes and taps become the few things a player can want. */

import { isTaken } from "#js/lib/keys.js";

/** @type {Record<string, number>} by `event.code`, so that WASD lies in the same place on every keyboard */
const MOVES = {
  ArrowUp: 0,
  ArrowRight: 1,
  ArrowDown: 2,
  ArrowLeft: 3,
  KeyW: 0,
  KeyD: 1,
  KeyS: 2,
  KeyA: 3,
};

/** @type {Record<string, string>} by the letter printed on the key */
const COMMANDS = { z: "undo", backspace: "undo", r: "restart", g: "giveUp", escape: "endReplay" };
const SWIPE = 24;

/**
 * @typedef {object} Player
 * @property {(action: number, when: number) => void} move    `when`: the event's time in ms
 * @property {(command: string) => void} command              "undo", "restart", "giveUp", "endReplay" or "again"
 */

/** One press, one step: repeats are ignored, and keys held while the window loses the focus count as let go. @param {Player} player @param {AbortSignal} signal */
export function listenToKeys(player, signal) {
  /** @type {Set<string>} */
  const held = new Set();
  const onKeydown = (/** @type {KeyboardEvent} */ event) => {
    if (isTaken(event)) return;
    const action = MOVES[event.code];
    const command = COMMANDS[event.key.toLowerCase()] ?? againCommand(event);
    if (action === undefined && command === undefined) return;
    event.preventDefault();
    if (event.repeat || held.has(event.code)) return;
    held.add(event.code);
    if (action !== undefined) player.move(action, event.timeStamp);
    else if (command) player.command(command);
  };
  document.addEventListener("keydown", onKeydown, { signal });
  document.addEventListener("keyup", (event) => held.delete(event.code), { signal });
  window.addEventListener("blur", () => held.clear(), { signal });
}

/** Enter and Space mean "again" unless a control has the focus and wants them itself. @param {KeyboardEvent} event */
function againCommand(event) {
  if (event.key !== "Enter" && event.key !== " ") return undefined;
  const target = event.target instanceof Element ? event.target : null;
  return target?.closest("a, button, summary, label, input") ? undefined : "again";
}

/**
 * A swipe is one step in its direction; a tap on a square beside the agent is a step to it.
 * @param {import("#js/elements/irl-board.js").IrlBoard} board
 * @param {Player & {tap: (state: number, when: number) => void}} player
 * @param {AbortSignal} signal
 */
export function listenToPointer(board, player, signal) {
  /** @type {{x: number, y: number, id: number} | null} */
  let start = null;
  const onDown = (/** @type {PointerEvent} */ event) => {
    if (event.isPrimary && event.button === 0) start = { x: event.clientX, y: event.clientY, id: event.pointerId };
  };
  const onMove = (/** @type {PointerEvent} */ event) => {
    if (!start || event.pointerId !== start.id || event.pointerType === "mouse") return;
    const [dx, dy] = [event.clientX - start.x, event.clientY - start.y];
    if (Math.max(Math.abs(dx), Math.abs(dy)) < SWIPE) return;
    start = null;
    player.move(directionOf(dx, dy), event.timeStamp);
  };
  const onUp = (/** @type {PointerEvent} */ event) => {
    if (!start || event.pointerId !== start.id) return;
    start = null;
    const state = board.stateAt(event.clientX, event.clientY);
    if (state !== null) player.tap(state, event.timeStamp);
  };
  board.addEventListener("pointerdown", onDown, { signal });
  board.addEventListener("pointermove", onMove, { signal });
  board.addEventListener("pointerup", onUp, { signal });
  board.addEventListener(
    "pointercancel",
    () => {
      start = null;
    },
    { signal },
  );
}

/** @param {number} dx @param {number} dy */
function directionOf(dx, dy) {
  if (Math.abs(dx) > Math.abs(dy)) return dx > 0 ? 1 : 3;
  return dy > 0 ? 2 : 0;
}
