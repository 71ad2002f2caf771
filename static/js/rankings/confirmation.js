/**
 * Confirming: what counts, what has yet to be confirmed, and the way on. Whatever the server answers, the order on the
 * page stays; what stands against it is said, with what can be done about it.
 */

import { announce, announceToo } from "#js/lib/announce.js";
import { ApiError } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { setStep } from "#js/lib/path.js";
import { AgreementPanel } from "#js/rankings/agreement.js";
import { confirmedSentence, elsewhereSentence, stateSentence } from "#js/rankings/confirm-words.js";
import { askUntouched } from "#js/rankings/conflict.js";
import { MiniCards } from "#js/rankings/mini-cards.js";
import { flat, isSame } from "#js/rankings/order.js";
import { saveOrders } from "#js/rankings/order-file.js";
import { Refusals } from "#js/rankings/refusals.js";
import { canOrder, differing, OUTCOMES, printOf, says } from "#js/rankings/standing.js";
import { Told } from "#js/rankings/told.js";
import { Versions } from "#js/rankings/versions.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/standing.js").Ranking} Ranking */
/** @typedef {import("#js/rankings/refusals.js").Answer} Answer */

const ARRIVE_TOGETHER_MS = 400;

export class Confirmation {
  #sitting;
  #data;
  #onFocus;
  /** @type {import("#js/rankings/standing.js").Newest} */
  #newest;
  /** What was sent and is not answered yet: what the page said then. @type {Map<Outcome, string>} */
  #onItsWay = new Map();
  #wasWaiting = false;
  #arrivals = 0;
  #told = new Told();
  #refusals;
  #versions;
  #agreement;

  /** @param {import("#js/rankings/rank.js").Parts & {onCompare: (outcome: Outcome, a: string, b: string) => void, onFocus: (id: string) => void}} parts */
  constructor(parts) {
    const { sitting, data, onCompare, onFocus } = parts;
    this.#sitting = sitting;
    this.#data = data;
    this.#onFocus = onFocus;
    const newest = { success: data.rankings.success ?? null, failure: data.rankings.failure ?? null };
    this.#newest = newest;
    const worldId = data.world.id;
    const cards = new MiniCards({ ...parts, template: /** @type {HTMLTemplateElement} */ (byId("mini-card")) });
    const send = (/** @type {Outcome} */ outcome, /** @type {boolean} */ untouched) => this.#send(outcome, untouched);
    this.#refusals = new Refusals({ ...parts, worldId, cards, newest, send });
    this.#versions = new Versions({ worldId, sitting, cards });
    const isAllowed = data.options.show_agreement !== false;
    this.#agreement = new AgreementPanel({ worldId, isAllowed, cards, onCompare });
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#versions.start(signal);
    this.#agreement.start(signal);
    const onSave = () => saveOrders(this.#data.world.id, this.#sitting.state);
    this.#told.start(signal, { onShow: this.#onFocus, onSave });
    byId("confirm").addEventListener("click", () => void this.confirm(), { signal });
    this.#sitting.subscribe(() => this.#show());
    this.#sitting.subscribeSaving(() => this.#onSaving());
    this.#sitting.subscribeNews((news) => this.#onNews(news));
    this.#sitting.subscribeArrivals(() => this.#onArrival());
    this.#awaitOlder();
    this.#show();
  }

  async confirm() {
    const outcomes = this.#toSend;
    if (outcomes.length === 0) return announce(byId("rank-state").textContent ?? "");
    const untouched = outcomes.filter((outcome) => this.#isUntouched(outcome));
    if (untouched.length > 0 && !(await this.#areTheirs(untouched))) return;
    this.#told.clear();
    await this.#settle(await Promise.all(outcomes.map((one) => this.#send(one, untouched.includes(one)))));
  }

  /** Attempts that waited come one after the other, and are told of together. */
  #onArrival() {
    clearTimeout(this.#arrivals);
    this.#arrivals = window.setTimeout(() => void this.#catchUp(), ARRIVE_TOGETHER_MS);
  }

  /** Attempts have come or gone under the page: the lists follow, and it says so. */
  async #catchUp() {
    const { sentences, ...help } = await this.#refusals.catchUp();
    if (sentences.length > 0) this.#told.say(sentences.join(" "), help);
  }

  /** What differs from what counts and is not on its way like this already. */
  get #toSend() {
    const isSent = (/** @type {Outcome} */ one) => this.#onItsWay.get(one) === printOf(this.#sitting.state, one);
    return differing(this.#sitting.state, this.#newest).filter((outcome) => !isSent(outcome));
  }

  /** Whether what counts is what the page says. */
  get #isConfirmed() {
    const hasCards = OUTCOMES.some((outcome) => this.#sitting.orders[outcome].length > 0);
    return hasCards && differing(this.#sitting.state, this.#newest).length === 0;
  }

  /** As it was drawn, and nobody has laid a hand on it. @param {Outcome} outcome */
  #isUntouched(outcome) {
    const isRandom = this.#data.rankings[outcome] == null;
    return isRandom && flat(this.#sitting.orders[outcome]).length > 1 && !this.#sitting.state.touched[outcome];
  }

  /** @param {Outcome[]} untouched */
  async #areTheirs(untouched) {
    const answer = await askUntouched(untouched, this.#sitting.state.way);
    if (answer === "no") this.#onFocus(flat(this.#sitting.orders[untouched[0]])[0]);
    return answer === "yes";
  }

  /** @param {Outcome} outcome @param {boolean} untouched @returns {Promise<Answer>} */
  #send(outcome, untouched) {
    const basedOn = this.#refusals.basisOf(outcome);
    const sending = this.#sitting.confirm(outcome, { means: "button", untouched, basedOn });
    return this.#await(outcome, { untouched, sending, print: printOf(this.#sitting.state, outcome) });
  }

  /** What was confirmed before a reload and has not arrived. */
  #awaitOlder() {
    for (const outcome of OUTCOMES) {
      const older = this.#sitting.pending[outcome];
      if (!older) continue;
      const { order, untouched, done } = older;
      const print = isSame(order, this.#sitting.orders[outcome]) ? printOf(this.#sitting.state, outcome) : "";
      void this.#await(outcome, { untouched, sending: done, print }).then((answer) => this.#settle([answer]));
    }
  }

  /** @param {Outcome} outcome @param {{untouched: boolean, sending: Promise<{ranking: Ranking}>, print: string}} sent @returns {Promise<Answer>} */
  async #await(outcome, { untouched, sending, print }) {
    this.#onItsWay.set(outcome, print);
    this.#show();
    try {
      const { ranking } = await sending;
      // It had arrived long ago, and its answer got lost; meanwhile another one was confirmed.
      if (ranking.counts === false) return { outcome, untouched, error: overtaken() };
      this.#newest[outcome] = ranking;
      this.#refusals.forget(outcome);
      return { outcome, untouched, ranking };
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      return { outcome, untouched, error };
    } finally {
      if (this.#onItsWay.get(outcome) === print) this.#onItsWay.delete(outcome);
      this.#show();
    }
  }

  /** Say what was taken and what was not; ask where there are two orders. @param {Answer[]} answers */
  async #settle(answers) {
    const taken = answers.filter(({ ranking }) => ranking);
    const counts = Object.fromEntries(taken.map(({ outcome, ranking }) => [outcome, ranking?.version]));
    const { sentences, ...help } = await this.#refusals.explain(answers.filter(({ error }) => error));
    const confirmed = taken.length > 0 ? [confirmedSentence(counts, this.#isConfirmed)] : [];
    const sentence = [...confirmed, ...sentences].join(" ");
    if (sentences.length > 0) this.#told.say(sentence, help);
    else announce(sentence);
  }

  /** It waits, or no longer does. */
  #onSaving() {
    this.#show();
    const isWaiting = this.#sitting.waiting !== null;
    if (isWaiting && !this.#wasWaiting) announceToo(byId("rank-state").textContent ?? "");
    this.#wasWaiting = isWaiting;
  }

  /** Another tab was faster, or an earlier page. @param {{outcome: Outcome, ranking: Ranking}} news */
  #onNews({ outcome, ranking }) {
    if (ranking.version <= (this.#newest[outcome]?.version ?? 0)) return;
    this.#newest[outcome] = ranking;
    this.#show();
    if (!says(this.#sitting.state, ranking, outcome)) this.#told.say(elsewhereSentence(outcome, ranking.version));
  }

  #show() {
    const isConfirmed = this.#isConfirmed;
    const counts = OUTCOMES.filter((outcome) => this.#newest[outcome]);
    const isRanked = isConfirmed && counts.length > 0;
    byId("rank").dataset.confirmed = String(isConfirmed);
    this.#showState();
    this.#showButtons(isConfirmed);
    setStep("rank", { state: isRanked ? "ranked" : "", isDone: isRanked });
    this.#versions.show(this.#newest);
    this.#agreement.show(this.#newest, isConfirmed);
  }

  #showState() {
    const { state } = this.#sitting;
    const counting = OUTCOMES.filter((outcome) => this.#newest[outcome]);
    byId("rank-state").textContent = stateSentence({
      nCards: OUTCOMES.reduce((n, outcome) => n + flat(state.present.orders[outcome]).length, 0),
      canOrder: canOrder(state),
      counts: Object.fromEntries(counting.map((outcome) => [outcome, this.#newest[outcome]?.version])),
      differs: differing(state, this.#newest),
      onItsWay: [...this.#onItsWay.keys()],
      trouble: this.#sitting.waiting,
      lasts: this.#sitting.lasts,
    });
    byId("rank-state").hidden = byId("rank-state").textContent === "";
  }

  /** One of the two stands there, and takes the other's focus. @param {boolean} isConfirmed */
  #showButtons(isConfirmed) {
    const [confirm, learn] = [byId("confirm"), byId("learn")];
    const focused = document.activeElement;
    confirm.hidden = isConfirmed || differing(this.#sitting.state, this.#newest).length === 0;
    confirm.setAttribute("aria-disabled", String(this.#toSend.length === 0));
    learn.hidden = !isConfirmed;
    if (focused === confirm && confirm.hidden && isConfirmed) learn.focus();
    if (focused === learn && learn.hidden) confirm.focus();
  }
}

function overtaken() {
  return new ApiError({ status: 409, code: "stale_version", message: "Another order counts by now." });
}
