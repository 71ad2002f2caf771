/** The sheet "Options" of the play page: sound, vibration, the practice once more, one's own data. */

import { byId } from "#js/lib/dom.js";
import { canVibrate } from "#js/worlds/feedback.js";

/**
 * @param {object} parts
 * @param {import("#js/worlds/feedback.js").Feedback} parts.feedback
 * @param {() => void} parts.practise    opens the practice
 * @param {AbortSignal} parts.signal
 */
export function startOptions({ feedback, practise, signal }) {
  const sheet = /** @type {HTMLDetailsElement} */ (byId("options"));
  const sound = /** @type {HTMLInputElement} */ (byId("option-sound"));
  const vibration = /** @type {HTMLInputElement} */ (byId("option-vibration"));
  const show = () => {
    sound.checked = feedback.sound;
    vibration.checked = feedback.vibration;
  };

  byId("option-vibration-row").hidden = !canVibrate();
  show();
  feedback.addEventListener("change", show, { signal });
  sound.addEventListener("change", () => (feedback.sound = sound.checked), { signal });
  vibration.addEventListener("change", () => (feedback.vibration = vibration.checked), { signal });
  byId("practise-again").addEventListener(
    "click",
    () => {
      sheet.open = false;
      practise();
    },
    { signal },
  );
  // A world that nobody has finished an attempt in is not stored, and has no table yet.
  const showData = () => byId("steps-csv").toggleAttribute("hidden", !location.pathname.startsWith("/worlds/"));
  sheet.addEventListener("toggle", showData, { signal });
  closeLightly(sheet, signal);
}

/** Escape, a press elsewhere, or the focus moving on closes the sheet. @param {HTMLDetailsElement} sheet @param {AbortSignal} signal */
function closeLightly(sheet, signal) {
  const close = (/** @type {Event} */ event) => {
    const place = event instanceof FocusEvent ? event.relatedTarget : event.target;
    if (sheet.open && place instanceof Node && !sheet.contains(place)) sheet.open = false;
  };
  const onEscape = (/** @type {KeyboardEvent} */ event) => {
    if (event.key !== "Escape" || !sheet.open) return;
    sheet.open = false;
    sheet.querySelector("summary")?.focus();
  };
  document.addEventListener("pointerdown", close, { signal });
  sheet.addEventListener("focusout", close, { signal });
  document.addEventListener("keydown", onEscape, { signal });
}
