/** Notes where the attention went while an attempt was played: to another window, another tab, asleep. */

import { plural } from "#js/lib/format.js";

/** @typedef {import("#js/worlds/session.js").PlaySession} PlaySession */

/**
 * @param {PlaySession} session
 * @param {{signal: AbortSignal, onClockJump: (sentence: string) => void}} options
 */
export function noteAttention(session, { signal, onClockJump }) {
  const note = (/** @type {"blur" | "focus" | "hidden" | "visible"} */ type) => {
    const now = performance.now();
    session.note(type, now);
    const by = session.checkClock(now);
    if (by !== 0) onClockJump(clockJumpSentence(by));
  };
  window.addEventListener("blur", () => note("blur"), { signal });
  window.addEventListener("focus", () => note("focus"), { signal });
  document.addEventListener("visibilitychange", () => note(document.hidden ? "hidden" : "visible"), { signal });
}

/** @param {number} byMs */
export function clockJumpSentence(byMs) {
  const seconds = Math.round(Math.abs(byMs) / 1000);
  const size =
    seconds < 120
      ? plural(seconds, "second")
      : seconds < 7200
        ? plural(Math.round(seconds / 60), "minute")
        : plural(Math.round(seconds / 3600), "hour");
  return byMs > 0
    ? `This device's clock jumped ahead by ${size}; perhaps it slept. Your attempt is safe: play on.`
    : `This device's clock was set back by ${size}. Your attempt is safe: play on.`;
}
