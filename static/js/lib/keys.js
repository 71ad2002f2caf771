/** Who may listen to the keyboard just now, and which key is meant. */

/** Where letters are text or choose an option; a slider, a box or a radio button has no use for them. */
const TYPING =
  "input:not([type=button], [type=checkbox], [type=radio], [type=range]), textarea, select, [contenteditable]";

/**
 * True when a key belongs to something else: a field, a browser shortcut, an open dialog or menu. Who listens from
 * within a dialog gives it as `root`.
 * @param {KeyboardEvent} event
 * @param {Element | null} [root]
 */
export function isTaken(event, root = null) {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return true;
  const target = event.target instanceof Element ? event.target : null;
  return target?.closest(TYPING) != null || isCovered(root);
}

/** True while a dialog or a menu is open, other than one's own. @param {Element | null} [root] */
export function isCovered(root = null) {
  return [...document.querySelectorAll("dialog[open], .menu[open]")].some((open) => open !== root);
}

/**
 * The letter a key means, in lower case: the one printed on it; where the layout has no Latin letters (Greek,
 * Cyrillic, Hebrew, …), the one that stands there on a Latin keyboard.
 * @param {{key: string, code: string}} event
 */
export function letterOf({ key, code }) {
  const isForeign = /^\p{L}$/u.test(key) && !/^\p{Script=Latin}$/u.test(key);
  return isForeign && code.startsWith("Key") ? code.slice(3).toLowerCase() : key.toLowerCase();
}
