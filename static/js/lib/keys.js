/** Who may listen to the keyboard just now. */

/** Where letters are text or choose an option; a slider, a box or a radio button has no use for them. */
const TYPING =
  "input:not([type=button], [type=checkbox], [type=radio], [type=range]), textarea, select, [contenteditable]";

/** True when a key belongs to something else: a field, an open dialog or menu, a browser shortcut. @param {KeyboardEvent} event */
export function isTaken(event) {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return true;
  const target = event.target instanceof Element ? event.target : null;
  if (target?.closest(TYPING)) return true;
  return document.querySelector("dialog[open], .menu[open]") !== null;
}
