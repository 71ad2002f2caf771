/** What the lists say, word by word: labels of cards, and what is announced when one is moved. Totals only where they are shown. */

import { number, plural, signed } from "#js/lib/format.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {{rank: number, n: number, nOthers: number}} Standing   the place people count; how many share it */

/** "Success with +8.8 in 12 steps". @param {{outcome: Outcome, total: number, actions: readonly number[]}} demonstration @param {boolean} showTotals */
export function cardWords({ outcome, total, actions }, showTotals) {
  const earned = showTotals ? ` with ${signed(total)}` : "";
  return `${outcome === "success" ? "Success" : "Failure"}${earned} in ${plural(actions.length, "step")}`;
}

/** "place 2 of 6, shared with 1 other". @param {Standing} standing */
export function placeWords({ rank, n, nOthers }) {
  const shared = nOthers > 0 ? `, shared with ${plural(nOthers, "other")}` : "";
  return `place ${rank} of ${n}${shared}`;
}

/** @param {string} words @param {Standing} standing */
export function labelOf(words, standing) {
  return `${words}, ${placeWords(standing)}`;
}

/** θ of one of so many: among many the second decimal would say nothing. @param {number} weight @param {number} n */
export function weightText(weight, n) {
  return number(weight, n < 10 ? 2 : 3);
}

/** "3.4 s", "48 s", "2 min 5 s". @param {readonly number[]} stepMs */
export function timeText(stepMs) {
  const seconds = stepMs.reduce((sum, ms) => sum + ms, 0) / 1000;
  if (seconds < 9.95) return `${number(seconds, 1)} s`;
  const whole = Math.round(seconds);
  return whole < 60 ? `${whole} s` : `${Math.floor(whole / 60)} min ${whole % 60} s`;
}

/** @typedef {{words: string, standing: Standing, weight: string, tiedWith: readonly string[]}} Told   tiedWith: the words of those that share its place */

export const say = {
  /** @param {Told} card */
  lifted: ({ words, standing }) =>
    `Lifted: ${labelOf(words, standing)}. Arrows move it, T ties it with the one above, Space puts it down, Escape puts it back.`,
  /** @param {Told} card */
  putDown: ({ words, standing, weight }) => `Put down: ${labelOf(words, standing)}. Weight ${weight}.`,
  /** @param {Told} card */
  putBack: ({ words, standing }) => `Put back: ${labelOf(words, standing)}.`,
  /** One step on the way, in few words: many of them follow each other. @param {Told} card */
  stepped: ({ standing, weight }) => `${capital(placeWords(standing))}. Weight ${weight}.`,
  /** @param {Told} card */
  placed: ({ words, standing, weight }) => `${labelOf(words, standing)}. Weight ${weight}.`,
  /** @param {Told} card */
  tied: ({ standing: { rank, n }, weight, tiedWith }) => {
    const others = tiedWith.length === 1 ? `the ${small(tiedWith[0])}` : `${tiedWith.length} others`;
    return `Tied with ${others}: place ${rank} of ${n}. Weight ${weight}.`;
  },
  /** @param {Told} card */
  parted: ({ standing, weight }) => `No longer tied: ${placeWords(standing)}. Weight ${weight}.`,
  /** @param {-1 | 1} way */
  noFurther: (way) => (way < 0 ? "It stands first already." : "It stands last already."),
  nothingAbove: "Nothing stands above it that it could be tied with.",
  /** @param {Told} card @param {boolean} isByKey */
  marked: ({ words }, isByKey) =>
    `To compare: ${words}. ${isByKey ? "Press C on the other one; Escape forgets it." : "Now press Compare on the other one."}`,
  unmarked: "Nothing is marked to compare any more.",
  /** @param {Outcome} outcome */
  sorted: (outcome) =>
    outcome === "success" ? "Sorted by total, the highest first." : "Sorted by total, the lowest first.",
  sortedAlready: "It is sorted by total already.",
};

/** @param {string} text */
function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** @param {string} text */
function small(text) {
  return text.charAt(0).toLowerCase() + text.slice(1);
}
