/** Keys, swipes and taps become the few things a player can want. */

import { Hold } from "#js/board/hold.js";
import { isCovered, isTaken, letterOf } from "#js/lib/keys.js";

/** @typedef {"key" | "hold" | "pad" | "swipe" | "tap" | "gamepad"} Device */
/** @typedef {{when: number, device: Device}} Press   `when`: the event's time in ms */
/** @typedef {"undo" | "restart" | "giveUp" | "again" | "endReplay" | "branch" | "where" | "sound"} Command */

/**
 * @typedef {object} Player
 * @property {(action: number, press: Press) => boolean | void} move   false: a held key stops here
 * @property {(command: Command) => void} command
 * @property {(direction: number) => void} look       look around without moving
 */

/** @type {Record<string, number>} by `event.code`, so that WASD lies in the same place on every keyboard */
const MOVES_BY_PLACE = { KeyW: 0, KeyD: 1, KeyS: 2, KeyA: 3 };
/** @type {Record<string, number>} by what is printed: arrows (those of a number pad too), and vi's letters */
const MOVES_BY_PRINT = { arrowup: 0, arrowright: 1, arrowdown: 2, arrowleft: 3, k: 0, l: 1, j: 2, h: 3 };

/** @type {Record<string, Command>} by what is printed. On a French keyboard Z lies where W moves up: there U undoes. */
const COMMANDS = {
  z: "undo",
  u: "undo",
  backspace: "undo",
  r: "restart",
  g: "giveUp",
  i: "where",
  m: "sound",
  t: "branch",
  escape: "endReplay",
};
const SWIPE = 24;

/** The direction a key means, or undefined. @param {{key: string, code: string}} event */
export function actionOf(event) {
  return MOVES_BY_PLACE[event.code] ?? MOVES_BY_PRINT[letterOf(event)];
}

/** What else a key means, or undefined. @param {{key: string, code: string}} event @returns {Command | undefined} */
export function commandOf(event) {
  return actionOf(event) === undefined ? COMMANDS[letterOf(event)] : undefined;
}

/**
 * One press, one step: repeats are ignored, and keys held while the window loses the focus count as let go.
 * @param {Player} player
 * @param {{signal: AbortSignal, holdToMove?: boolean, root?: Element | null}} options  `root`: one's own dialog
 */
export function listenToKeys(player, { signal, holdToMove = false, root = null }) {
  /** @type {Set<string>} */
  const held = new Set();
  const hold = new Hold(
    (action) => !isCovered(root) && player.move(action, { when: performance.now(), device: "hold" }) !== false,
  );
  const letGo = () => {
    held.clear();
    hold.stop();
  };
  const onKeydown = (/** @type {KeyboardEvent} */ event) => {
    if (isTaken(event, root)) return;
    const action = actionOf(event);
    const command = commandOf(event) ?? againCommand(event);
    if (action === undefined && command === undefined) return;
    // Escape also closes things, and may.
    if (command !== "endReplay") event.preventDefault();
    const name = event.code || event.key;
    if (event.repeat || held.has(name)) return;
    held.add(name);
    if (action === undefined) hold.stop();
    if (command !== undefined) player.command(command);
    else if (action !== undefined && event.shiftKey) player.look(action);
    else if (action !== undefined) {
      const goesOn = player.move(action, { when: event.timeStamp, device: "key" }) !== false;
      if (holdToMove && goesOn) hold.press(name, action);
    }
  };
  const onKeyup = (/** @type {KeyboardEvent} */ event) => {
    held.delete(event.code || event.key);
    hold.release(event.code || event.key);
  };
  document.addEventListener("keydown", onKeydown, { signal });
  document.addEventListener("keyup", onKeyup, { signal });
  window.addEventListener("blur", letGo, { signal });
  signal.addEventListener("abort", letGo);
}

/** Enter and Space mean "again" unless a control has the focus and wants them itself. @param {KeyboardEvent} event @returns {Command | undefined} */
function againCommand(event) {
  if (event.key !== "Enter" && event.key !== " ") return undefined;
  const target = event.target instanceof Element ? event.target : null;
  return target?.closest("a, button, summary, label, input") ? undefined : "again";
}

/**
 * A swipe is one step in its direction; a tap on a square beside the agent is a step to it.
 * @param {import("#js/elements/irl-board.js").IrlBoard} board
 * @param {Player & {tap: (state: number, press: Press) => void}} player
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
    player.move(directionOf(dx, dy), { when: event.timeStamp, device: "swipe" });
  };
  const onUp = (/** @type {PointerEvent} */ event) => {
    if (!start || event.pointerId !== start.id) return;
    start = null;
    const state = board.stateAt(event.clientX, event.clientY);
    if (state !== null) player.tap(state, { when: event.timeStamp, device: "tap" });
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
