/** What becomes of an order that the server would not take: attempts join or leave, two orders are weighed, the rest is said. */

import { ApiError, api } from "#js/lib/api.js";
import * as words from "#js/rankings/confirm-words.js";
import { askUntouched, askWhichCounts } from "#js/rankings/conflict.js";
import { bringUpToDate } from "#js/rankings/late-cards.js";
import { flat, reconcile } from "#js/rankings/order.js";
import { says } from "#js/rankings/standing.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/standing.js").Ranking} Ranking */
/** @typedef {{outcome: Outcome, untouched: boolean, ranking?: Ranking, error?: ApiError}} Answer */
/** @typedef {{sentences: string[], newIds: string[], canSave: boolean}} Explanation */

/** Refusals that say nothing about which attempts there are. */
const NOT_ABOUT_CARDS = new Set(["stale_version", "untouched", "log_differs", "conflict", "log_gap"]);

/**
 * @typedef {object} Parts
 * @property {import("#js/rankings/sitting.js").Sitting} sitting
 * @property {string} worldId
 * @property {Map<string, any>} demonstrations
 * @property {boolean} showTotals
 * @property {import("#js/rankings/mini-cards.js").MiniCards} cards
 * @property {import("#js/rankings/standing.js").Newest} newest   what counts; corrected where another tab was faster
 * @property {(outcome: Outcome, untouched: boolean) => Promise<Answer>} send
 */

export class Refusals {
  #parts;
  /** The version that the person's next order is to follow, where that is not for the sitting to say. @type {Partial<Record<Outcome, number>>} */
  #basis = {};

  /** @param {Parts} parts */
  constructor(parts) {
    this.#parts = parts;
  }

  /** @param {Outcome} outcome @returns {number | undefined} */
  basisOf(outcome) {
    return this.#basis[outcome];
  }

  /** It was taken, so the sitting knows what the next one follows. @param {Outcome} outcome */
  forget(outcome) {
    delete this.#basis[outcome];
  }

  /** @param {Answer[]} refused @returns {Promise<Explanation>} */
  async explain(refused) {
    const isAboutCards = (/** @type {Answer} */ { error }) =>
      !error?.isTemporary && !NOT_ABOUT_CARDS.has(error?.code ?? "");
    const late = refused.filter(isAboutCards);
    const news = late.length > 0 ? await this.catchUp() : nothing();
    const isExplained = news.sentences.length > 0;
    for (const answer of refused) {
      if (late.includes(answer) && isExplained) continue;
      news.sentences.push(await this.#explainOne(answer));
    }
    return news;
  }

  /** Attempts may have come or gone. @returns {Promise<Explanation>} */
  async catchUp() {
    const { demonstrations, showTotals } = this.#parts;
    const news = await bringUpToDate(this.#parts).catch(() => []);
    if (news === "stranger") return { sentences: [words.STRANGER], newIds: [], canSave: true };
    const inWords = (/** @type {string} */ id) => words.attemptWords(demonstrations.get(id), showTotals);
    const sentences = news.map(({ outcome, added, removed }) => {
      const nLeft = flat(this.#parts.sitting.orders[outcome]).length;
      return words.cardsSentence({ outcome, added: added.map(inWords), nRemoved: removed.length, nLeft });
    });
    if (news.length > 0) sentences.push(words.LEFT_AS_IT_WAS);
    return { sentences, newIds: news.flatMap(({ added }) => added), canSave: false };
  }

  /** @param {Answer} answer @returns {Promise<string>} */
  async #explainOne({ outcome, untouched, error }) {
    if (error?.code === "stale_version") return this.#decide(outcome, untouched);
    if (error?.code === "untouched") return this.#askAfterAll(outcome);
    return words.refusedSentence(outcome, error?.message ?? "");
  }

  /** The server knows better that nothing was moved. @param {Outcome} outcome */
  async #askAfterAll(outcome) {
    if ((await askUntouched([outcome], this.#parts.sitting.state.way)) === "yes")
      return this.#sayOf(await this.#parts.send(outcome, true));
    return words.refusedSentence(outcome, "You said that the order is not yours yet.");
  }

  /** Another order was confirmed after this page was opened: the person says which counts. @param {Outcome} outcome @param {boolean} untouched */
  async #decide(outcome, untouched) {
    const { sitting, cards } = this.#parts;
    const theirs = await this.#newestOf(outcome);
    // Until the person has chosen, nothing follows the order they did not know: the next try asks again.
    this.#basis[outcome] = (theirs?.version ?? 1) - 1;
    if (!theirs) return words.refusedSentence(outcome, words.OTHER_UNSEEN);
    const isSame = says(sitting.state, theirs, outcome);
    const answer = isSame ? "same" : await askWhichCounts(cards, { outcome, mine: sitting.orders[outcome], theirs });
    if (answer === "later") return words.undecidedSentence(outcome, theirs.version);
    this.#basis[outcome] = theirs.version;
    if (answer === "mine") return this.#sayOf(await this.#parts.send(outcome, untouched), theirs.version);
    if (answer === "same") return words.sameSentence(outcome, theirs.version);
    this.#take(outcome, theirs);
    return words.tookSentence(outcome, theirs.version);
  }

  /** @param {Outcome} outcome @returns {Promise<Ranking | null>} */
  async #newestOf(outcome) {
    try {
      const rankings = await api.get(`/worlds/${this.#parts.worldId}/rankings`);
      if (rankings[outcome]) this.#parts.newest[outcome] = rankings[outcome];
      return rankings[outcome];
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      return null;
    }
  }

  /** The list stands as in the other order, by a step that Undo takes back. @param {Outcome} outcome @param {Ranking} theirs */
  #take(outcome, { order }) {
    const { sitting } = this.#parts;
    const [here, there] = [flat(sitting.orders[outcome]), flat(order)];
    const isMissing = (/** @type {string[]} */ ids) => (/** @type {string} */ id) => !ids.includes(id);
    const wanted = reconcile(order, here.filter(isMissing(there)), there.filter(isMissing(here)));
    sitting.do({ type: "set", means: "button", outcome, order: wanted, by: "version" });
  }

  /** What came of a second try. @param {Answer} answer @param {number} [other]  the version it was chosen over */
  async #sayOf(answer, other) {
    if (answer.ranking) return words.countsNowSentence(answer.outcome, answer.ranking.version, other);
    return (await this.explain([answer])).sentences.join(" ");
  }
}

/** @returns {Explanation} */
function nothing() {
  return { sentences: [], newIds: [], canSave: false };
}
