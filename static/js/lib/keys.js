/** Who may listen to the keyboard just now. */

const TYPING = "input:not([type=button], [type=checkbox]), textarea, select, [contenteditable]";

/** True when a key belongs to something else: a field, an open dialog or menu, a browser shortcut. @param {KeyboardEvent} event */
export function isTaken(event) {
  if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return true;
  const target = event.target instanceof Element ? event.target : null;
  if (target?.closest(TYPING)) return true;
  return document.querySelector("dialog[open], .menu[open]") !== null;
}
