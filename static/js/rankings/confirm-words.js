/** What is said about confirming an order, each sentence built from plain figures. Whatever happens, nothing is lost, and the words say so. */

import { number, plural, signed } from "#js/lib/format.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Way} Way */
/** @typedef {{status: number, retryAfterMs: number | null}} Trouble   what the server answered last; 0: nothing */
/** @typedef {{total: number, actions: readonly number[]}} Attempt */

/** @type {Record<Outcome, string>} */
export const PLURAL = { success: "successes", failure: "failures" };

/** @type {Record<Way, string>} */
const WAY_WORDS = {
  lists: "in two lists",
  pairwise: "two at a time",
  magnitude: "with how much better",
  segments: "by good and bad stretches",
};

/** @param {readonly Outcome[]} outcomes */
export function yours(outcomes) {
  return outcomes.map((outcome) => `your ${PLURAL[outcome]}`).join(" and ");
}

/** @param {string} sentence */
export function capital(sentence) {
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}

/** "10:42"; of another day "3 Nov, 10:42". @param {string | number | Date} when @param {Date} [now] */
export function clockWords(when, now = new Date()) {
  const date = new Date(when);
  const time = `${String(date.getHours()).padStart(2, "0")}:${String(date.getMinutes()).padStart(2, "0")}`;
  if (date.toDateString() === now.toDateString()) return time;
  return `${date.toLocaleDateString("en-GB", { day: "numeric", month: "short" })}, ${time}`;
}

/**
 * @typedef {object} Standing
 * @property {number} nCards
 * @property {boolean} canOrder                       some list holds two cards or more
 * @property {Partial<Record<Outcome, number>>} counts  the version that counts, where there is one
 * @property {Outcome[]} differs                      what has yet to be confirmed
 * @property {Outcome[]} onItsWay                     what was sent and is not answered yet
 * @property {Trouble | null} trouble                 why it is not
 * @property {boolean} lasts                          false where this browser's storage takes nothing
 */

/** The line beside the button. @param {Standing} standing */
export function stateSentence({ nCards, canOrder, counts, differs, onItsWay, trouble, lasts }) {
  if (nCards === 0) return "";
  if (onItsWay.length > 0)
    return trouble ? waitingSentence(onItsWay, trouble, lasts) : `Sending the order of ${yours(onItsWay)} …`;
  if (differs.length === 0 && Object.keys(counts).length > 0)
    return `✓ Confirmed: ${countsWords(counts)}. You can still change it.`;
  if (!canOrder) return "One attempt alone needs no order. Go on, or play more.";
  const changed = differs.filter((outcome) => counts[outcome] !== undefined);
  if (changed.length === 0) return "An order counts once you confirm it.";
  const since = changed.map((outcome, i) => {
    const [whose, have] = i === 0 ? ["Your", " have changed"] : ["your", ""];
    return `${whose} ${PLURAL[outcome]}${have} since version ${counts[outcome]}`;
  });
  return `${since.join(" and ")}. The new order counts once you confirm it.`;
}

/** "version 2 of your successes and version 1 of your failures count". @param {Partial<Record<Outcome, number>>} counts */
export function countsWords(counts) {
  const each = /** @type {[Outcome, number][]} */ (Object.entries(counts));
  const versions = new Set(each.map(([, version]) => version));
  const words = each.map(([outcome, version], i) => {
    const isSaid = i > 0 && versions.size === 1;
    return `${isSaid ? "" : `version ${version} `}of your ${PLURAL[outcome]}`;
  });
  return `${words.join(" and ")} ${versions.size === 1 ? "counts" : "count"}`;
}

/** @param {Outcome[]} outcomes @param {Trouble} trouble @param {boolean} lasts */
function waitingSentence(outcomes, trouble, lasts) {
  const where = lasts ? "kept in this browser and" : "in this page alone, so keep it open: it is";
  return `${troubleSentence(trouble)} The order of ${yours(outcomes)} is ${where} sent by itself; then it counts.`;
}

/** @param {Trouble} trouble */
function troubleSentence({ status, retryAfterMs }) {
  if (status === 0) return "The server cannot be reached just now.";
  if (retryAfterMs) return `The server is busy and asked for ${timeWords(retryAfterMs)}.`;
  return status === 500 ? "Something went wrong on the server." : "The server is busy just now.";
}

/** @param {number} ms */
function timeWords(ms) {
  const s = Math.max(1, Math.ceil(ms / 1000));
  return s < 120 ? `${s} s` : `${Math.round(s / 60)} min`;
}

/** What was confirmed just now. @param {Partial<Record<Outcome, number>>} counts @param {boolean} isDone */
export function confirmedSentence(counts, isDone) {
  return `Confirmed: ${countsWords(counts)}.${isDone ? " Next: Learn." : ""}`;
}

/** What an untouched order has to be asked. @param {Outcome[]} outcomes @param {Way} way */
export function untouchedSentence(outcomes, way) {
  const done = { lists: "moved", magnitude: "moved", pairwise: "compared", segments: "marked" }[way];
  const lists = outcomes.map((outcome) => `your ${PLURAL[outcome]}`).join(" or ");
  const both = outcomes.length > 1;
  return `You have not ${done} anything in ${lists}. ${both ? "Both lists" : "They"} stand in a random order. ${both ? "Are they" : "Is it"} yours?`;
}

/** "+2.1 in 12 steps". @param {Attempt} attempt @param {boolean} showTotals */
export function attemptWords({ total, actions }, showTotals) {
  const steps = plural(actions.length, "step");
  return showTotals ? `${signed(total)} in ${steps}` : steps;
}

/**
 * Attempts came or went under the page.
 * @param {{outcome: Outcome, added: string[], nRemoved: number, nLeft: number}} news  `added`: each in words
 */
export function cardsSentence({ outcome, added, nRemoved, nLeft }) {
  const sentences = [];
  if (added.length > 0) {
    const [it, stands] = added.length === 1 ? ["it", "It stands"] : ["them", "They stand"];
    const whereTo =
      nLeft > added.length ? `${stands} last: move ${it} to ${it === "it" ? "its place" : "their places"}.` : "";
    sentences.push(
      `${capital(nNew(added.length, outcome))} since this page was opened: ${named(added)}. ${whereTo}`.trim(),
    );
  }
  if (nRemoved > 0) {
    const were =
      nRemoved === 1
        ? "was discarded meanwhile and has left its list"
        : "were discarded meanwhile and have left their list";
    sentences.push(`${plural(nRemoved, outcome, PLURAL[outcome])} ${were}.`);
  }
  return sentences.join(" ");
}

/** @param {number} n @param {Outcome} outcome */
function nNew(n, outcome) {
  return n === 1 ? `1 new ${outcome}` : `${n} new ${PLURAL[outcome]}`;
}

/** The first few; the rest as a number. @param {string[]} words */
function named(words) {
  if (words.length <= 3) return words.join(", ");
  return `${words.slice(0, 3).join(", ")} and ${words.length - 3} more`;
}

export const LEFT_AS_IT_WAS = "The order of the others is as you left it. Look at it, then confirm again.";

export const STRANGER =
  "The server does not know this browser any more as the one that played these attempts: its cookie is gone or another one. So it cannot take the order as yours. Your order is as you left it; save it as a file to keep it, or come back with the cookie you had.";

/** What the server would not have, in its own words. @param {Outcome} outcome @param {string} message */
export function refusedSentence(outcome, message) {
  return `Your ${PLURAL[outcome]} are not confirmed. ${message} Your order is as you left it.`;
}

/**
 * Two tabs, two orders.
 * @param {{outcome: Outcome, version: number, at: string, nElsewhere: number, n: number}} conflict
 */
export function conflictSentence({ outcome, version, at, nElsewhere, n }) {
  const differ =
    nElsewhere === 0
      ? `Both put your ${PLURAL[outcome]} in the same places; what was said beside that differs.`
      : `${nElsewhere} of ${n} stand elsewhere.`;
  return `Version ${version} was confirmed at ${at}, after this page was opened, perhaps in another tab. ${differ} Which order counts?`;
}

/** @param {number} version */
export function bothKeptSentence(version) {
  return `Nothing is lost: if yours counts, version ${version} is kept beside it; if you take the other one, Undo brings yours back.`;
}

/** @param {Outcome} outcome @param {number} version @param {number} [other]  the one it was chosen over */
export function countsNowSentence(outcome, version, other) {
  const counts = `Version ${version} of your ${PLURAL[outcome]} counts${other === undefined ? "" : ", the one on this page"}.`;
  return other === undefined ? counts : `${counts} Version ${other} is kept beside it.`;
}

/** Another tab confirmed the very same. @param {Outcome} outcome @param {number} version */
export function sameSentence(outcome, version) {
  return `Version ${version} of your ${PLURAL[outcome]}, confirmed in another tab, is this very order: it counts.`;
}

/** Another tab was faster, while this page was open. @param {Outcome} outcome @param {number} version */
export function elsewhereSentence(outcome, version) {
  return `Version ${version} of your ${PLURAL[outcome]} was confirmed in another tab just now, and it counts. This page's order is as you left it; confirm it to choose between the two.`;
}

export const OTHER_UNSEEN =
  "Another order was confirmed after this page was opened, and it cannot be fetched just now. Confirm again in a moment.";

/** @param {Outcome} outcome @param {number} version */
export function tookSentence(outcome, version) {
  return `Version ${version} of your ${PLURAL[outcome]} counts, and your list stands as in it. Undo brings your own order back.`;
}

/** @param {Outcome} outcome @param {number} version */
export function undecidedSentence(outcome, version) {
  return `Version ${version} of your ${PLURAL[outcome]} counts for now. Yours is as you left it; confirm again to decide.`;
}

/** How far a card stands from where the other order has it. @param {number} by  places higher than there */
export function movedWords(by) {
  if (by === 0) return { sign: "", words: "" };
  const n = plural(Math.abs(by), "place");
  return by > 0
    ? { sign: `▲ ${by}`, words: `, ${n} higher than in the other` }
    : { sign: `▼ ${-by}`, words: `, ${n} lower than in the other` };
}

/**
 * @typedef {object} Version
 * @property {number} version
 * @property {string} created_at
 * @property {Way} [way]
 * @property {boolean | null} [untouched]
 */

/** "Successes: version 3 counts, confirmed 10:42 · 2 earlier ones are kept". @param {Outcome} outcome @param {Version} newest */
export function versionsSummary(outcome, { version, created_at }) {
  const earlier = version - 1;
  const kept = earlier === 0 ? "" : ` · ${earlier} earlier ${earlier === 1 ? "one is" : "ones are"} kept`;
  return `${capital(PLURAL[outcome])}: version ${version} counts, confirmed ${clockWords(created_at)}${kept}`;
}

/** @param {Version} one @param {boolean} counts */
export function versionWords({ version, created_at, way = "lists", untouched }, counts) {
  const parts = [`Version ${version}`, clockWords(created_at), WAY_WORDS[way] ?? WAY_WORDS.lists];
  if (untouched) parts.push("nothing moved");
  if (counts) parts.push("counts");
  return parts.join(" · ");
}

/** @param {{outcome: Outcome, version: number, nNew: number}} taken */
export function takenAgainSentence({ outcome, version, nNew: n }) {
  const late = n === 0 ? "" : ` ${n === 1 ? "1 that is newer stands" : `${n} that are newer stand`} last.`;
  return `Your ${PLURAL[outcome]} stand as in version ${version} again.${late} It counts once you confirm it.`;
}

/**
 * @typedef {object} Agreement
 * @property {number} version
 * @property {number | null} tau_b
 * @property {number} n_pairs
 * @property {number} n_agreeing
 * @property {number} n_swapped
 * @property {number} n_tied
 * @property {[string, string][]} swapped
 */

/** @param {Agreement} agreement */
export function agreementSentence({ tau_b, n_pairs, n_agreeing, n_swapped, n_tied }) {
  const rest = [
    n_swapped > 0 ? `${n_swapped} the other way round` : "",
    n_tied > 0 ? `${n_tied} ${n_tied === 1 ? "is" : "are"} tied by you or by the totals` : "",
  ].filter(Boolean);
  const pairs = n_pairs === 1 ? "Of 1 pair" : `Of ${n_pairs} pairs`;
  const tau =
    tau_b === null
      ? "Kendall’s tau-b cannot be told where everything is tied."
      : `Kendall’s tau-b: ${number(tau_b, 2)}.`;
  return `${pairs} you put ${n_agreeing} as their totals would${rest.length > 0 ? `, ${rest.join(", ")}` : ""}. ${tau}`;
}

/** @param {Outcome} outcome @param {number} n */
export function swappedSentence(outcome, n) {
  if (n === 0) return "";
  const [pair, lower] =
    n === 1 ? ["This pair stands", "the lower one"] : ["These pairs stand", "the lower one of each"];
  return `${pair} the other way round: by the totals, ${lower} would be the ${outcome === "success" ? "better" : "worse"} one.`;
}

/** @param {Outcome} outcome @param {number} above @param {number} below   their places */
export function watchWords(outcome, above, below) {
  return `Watch both: ${outcome} at place ${above} and at place ${below}`;
}
