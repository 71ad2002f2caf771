/** What the play page says about saving, each sentence built from plain figures. Nothing is lost, and the words say so. */

import { plural } from "#js/lib/format.js";

/**
 * @typedef {object} Saving
 * @property {number} nAttempts    that the server does not have yet
 * @property {number} nWishes      discards and restores that it does not know of yet
 * @property {number} nUnstored    of both, those that live in this page alone
 * @property {number} nRefused     attempts that the server did not take and that are kept here
 * @property {{status: number, retryAfterMs: number | null} | null} trouble  what the server answered last (0: nothing), if it could not take them
 */

/** @typedef {{sync: "saved" | "waiting" | "offline" | "busy" | "memory" | "refused", badge: string, sentence: string}} SavingWords */

/** @param {Saving} saving @returns {SavingWords} */
export function savingWords({ nAttempts, nWishes, nUnstored, nRefused, trouble }) {
  if (nAttempts + nWishes === 0) {
    if (nRefused > 0) return { sync: "refused", badge: `${nRefused} not saved`, sentence: "" };
    return { sync: "saved", badge: "✓ all saved", sentence: "" };
  }
  const what = nAttempts > 0 ? plural(nAttempts, "attempt") : plural(nWishes, "change");
  if (trouble === null) return { sync: "waiting", badge: `saving ${what} …`, sentence: "" };
  if (nUnstored > 0) return { sync: "memory", badge: "keep this page open", sentence: unstoredSentence(nUnstored) };
  const it = nAttempts + nWishes === 1 ? "it" : "them";
  if (trouble.status > 0) return { sync: "busy", badge: `busy: ${what} kept`, sentence: busySentence(trouble, it) };
  const sentence = "The server cannot be reached. What you play is kept in this browser and sent later by itself.";
  return { sync: "offline", badge: `offline: ${what} kept`, sentence };
}

/** @param {number} n */
function unstoredSentence(n) {
  const [is, it] = n === 1 ? ["1 of your attempts is", "it"] : [`${n} of your attempts are`, "them"];
  return `The server cannot take ${it} just now, and this browser's storage is full or closed: ${is} in this page alone. Keep it open until ${it === "it" ? "it is" : "they are"} sent.`;
}

/** @param {{status: number, retryAfterMs: number | null}} trouble @param {string} it */
function busySentence({ status, retryAfterMs }, it) {
  const sends = `kept in this browser; the page sends ${it} again`;
  if (retryAfterMs)
    return `The server is busy and asked for ${timeWords(retryAfterMs)}. What you played is ${sends} then.`;
  if (status === 500) return `Something went wrong on the server. What you played is ${sends} by itself.`;
  return `The server is busy just now. What you played is ${sends} in a moment.`;
}

/** "20 s", "3 min". @param {number} ms */
function timeWords(ms) {
  const s = Math.max(1, Math.ceil(ms / 1000));
  return s < 120 ? `${s} s` : `${Math.round(s / 60)} min`;
}

/** What is spoken when the state of saving has changed. @param {SavingWords} now @param {SavingWords["sync"]} before */
export function savingNews(now, before) {
  if (now.sync === before || now.sync === "waiting") return "";
  if (now.sync !== "saved") return now.sentence;
  return before === "waiting" || before === "refused" ? "" : "Everything is saved again.";
}

/** Why an attempt is kept here for good. @param {{refusal: string | null, status?: number}} parcel */
export function refusalSentence({ refusal, status }) {
  const kept = "It stays in this browser: save it as a file, or forget it.";
  if (status === 409) {
    return `The server has another attempt under the same number, so it did not take this one. ${kept}`;
  }
  return `This attempt could not be saved. ${refusal ?? ""} ${kept}`;
}

/** @param {{message: string, isDiscarded: boolean}} wish that was not granted */
export function wishSentence({ message, isDiscarded }) {
  return `This could not be ${isDiscarded ? "discarded" : "restored"}. ${message}`;
}

/** Attempts that are kept but can no longer be read. @param {number} n */
export function damagedSentence(n) {
  const [it, is] = n === 1 ? ["An unfinished attempt", "is"] : [`${n} unfinished attempts`, "are"];
  return `${it} in this browser's storage ${is} damaged and cannot go on. What is left is set aside.`;
}
