/**
 * How a sitting reaches the server: its log a few seconds behind the hand, an order in the moment it is confirmed. Both
 * go by the outbox, so neither a dead network nor a closed page loses them, and any page sends what another one left.
 */

import { ApiError } from "#js/lib/api.js";
import { isRefused, logId, rankingId } from "#js/lib/parcels.js";

/** @typedef {import("#js/lib/outbox.js").News} News */
/** @typedef {import("#js/lib/parcels.js").LogParcel} LogParcel */
/** @typedef {import("#js/lib/parcels.js").RankingParcel} RankingParcel */
/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting.js").Event} Event */

/**
 * What the server is told about a sitting, and has acknowledged.
 * @typedef {object} Book
 * @property {string} id
 * @property {string} worldId
 * @property {Event[]} log
 * @property {number} acknowledged                 so many events are on the server
 * @property {Record<Outcome, number>} versions    the confirmed orders it goes by; 0: none
 */

/**
 * An order on its way.
 * @typedef {object} Pending
 * @property {Order} order
 * @property {boolean} untouched
 * @property {number} since                   ms since 1970
 * @property {Promise<{ranking: any}>} done   rejects with an ApiError when it is refused for good
 */
/**
 * @typedef {object} Rest
 * @property {string} parcelId
 * @property {number} nEvents                 its confirmation is the last of so many
 * @property {boolean} isSecondTry
 * @property {(told: {ranking: any}) => void} resolve
 * @property {(error: Error) => void} reject
 */

/**
 * @typedef {object} Parts
 * @property {Pick<import("#js/lib/outbox.js").Outbox, "add" | "forget">} outbox
 * @property {() => boolean} renew   go on in another sitting, since the log of this one cannot be sent; whether there is hope
 * @property {(outcome: Outcome, told: {order: Order, untouched: boolean}) => boolean} confirmAgain   there, if it still stands so
 * @property {() => void} onChange   of what waits, or is acknowledged
 * @property {(news: {outcome: Outcome, ranking: any}) => void} onNews   confirmed elsewhere
 * @property {(run: () => void, ms: number) => void} [wait]
 */

/** So far behind the hand: often enough to lose little with a broken machine, seldom enough to be no traffic. */
const LOG_PAUSE_MS = 4000;

export class Dispatch {
  #book;
  #parts;
  #wait;
  /** @type {Partial<Record<Outcome, Pending & Rest>>} */
  #pending = {};
  /** What the server, or its silence, said last. @type {{status: number, retryAfterMs: number | null} | null} */
  #trouble = null;
  #isLogDue = false;
  #isLogOnItsWay = false;
  #isLogHopeless = false;

  /** @param {Book} book @param {Parts} parts */
  constructor(book, parts) {
    this.#book = book;
    this.#parts = parts;
    this.#wait = parts.wait ?? ((run, ms) => void setTimeout(run, ms));
  }

  /** Orders that are confirmed here and not yet on the server, also from before a reload. @returns {Readonly<Partial<Record<Outcome, Pending>>>} */
  get pending() {
    return this.#pending;
  }

  /** Why they wait; null while they do not. */
  get waiting() {
    const since = Object.values(this.#pending).map((one) => one.since);
    return since.length > 0 && this.#trouble ? { since: Math.min(...since), ...this.#trouble } : null;
  }

  /** The same work goes on under another name. @param {Book} book */
  follow(book) {
    this.#book = book;
    this.#isLogOnItsWay = false;
    this.#isLogHopeless = false;
    this.logSoon();
  }

  /** Something was done. */
  logSoon() {
    if (this.#isLogDue) return;
    this.#isLogDue = true;
    this.#wait(() => {
      this.#isLogDue = false;
      // While one waits for the server the next would only be the same and more.
      if (!this.#isLogOnItsWay) this.logNow();
    }, LOG_PAUSE_MS);
  }

  /** The page may be closed. */
  logNow() {
    const { id, worldId, log, acknowledged } = this.#book;
    if (acknowledged >= log.length || this.#isLogHopeless) return;
    this.#isLogOnItsWay = true;
    const events = log.slice(acknowledged);
    void this.#parts.outbox.add({ kind: "log", id: logId(id), worldId, sittingId: id, events });
  }

  /** The last event of the log is its confirmation. @param {Outcome} outcome @param {{order: Order, untouched: boolean}} told @returns {Promise<{ranking: any}>} */
  confirm(outcome, told) {
    const pending = this.#expect(outcome, { ...told, since: Date.now(), nEvents: this.#book.log.length });
    this.#send(outcome, pending);
    this.#parts.onChange();
    return pending.done;
  }

  /** What an earlier page of this sitting confirmed, and what became of it. @param {readonly RankingParcel[]} parcels */
  adopt(parcels) {
    for (const parcel of parcels) {
      const { order, untouched, sitting } = parcel.body;
      this.#expect(parcel.outcome, {
        order,
        untouched,
        since: parcel.at,
        nEvents: (sitting.events.at(-1)?.n ?? 0) + 1,
      });
      if (isRefused(parcel)) void this.#refuse(parcel);
    }
  }

  /** @param {News} news */
  hear(news) {
    const { kind, parcel, status = 0, retryAfterMs = null } = news;
    if (kind === "kept" || kind === "forgotten") return this.#parts.onChange();
    this.#trouble = kind === "waiting" ? { status, retryAfterMs } : null;
    if (parcel.kind === "log" && parcel.sittingId === this.#book.id) this.#hearOfLog(news, parcel);
    if (parcel.kind === "ranking" && parcel.worldId === this.#book.worldId) this.#hearOfOrder(news, parcel);
    this.#parts.onChange();
  }

  /** @param {News} news @param {LogParcel} parcel */
  #hearOfLog({ kind, answer }, parcel) {
    if (kind === "waiting") return;
    this.#isLogOnItsWay = false;
    if (kind === "saved") this.#acknowledge(answer.n_events);
    else this.#mend(parcel, parcel.events[0]?.n ?? 0);
    if (this.#book.acknowledged < this.#book.log.length) this.logSoon();
  }

  /** @param {News} news @param {RankingParcel} parcel */
  #hearOfOrder({ kind, answer }, parcel) {
    if (kind === "refused") void this.#refuse(parcel);
    else if (kind === "saved" && (this.#isOf(parcel) || parcel.sittingId === this.#book.id))
      this.#settle(parcel, answer);
    else if (kind === "saved") this.#parts.onNews({ outcome: parcel.outcome, ranking: answer });
  }

  /** @param {RankingParcel} parcel @param {any} ranking */
  #settle(parcel, ranking) {
    const { outcome, sittingId } = parcel;
    this.#book.versions[outcome] = ranking.version;
    if (sittingId === this.#book.id) this.#acknowledge(ranking.n_events ?? 0);
    const pending = this.#pending[outcome];
    // One confirmed since then may have taken its place; it is still on its way.
    if (!pending || !this.#isOf(parcel)) return;
    delete this.#pending[outcome];
    pending.resolve({ ranking });
  }

  /**
   * The page is told why. But where the server would not have the log, nothing is wrong with the order: once, it is sent
   * again with what was missing, or confirmed again in a new sitting.
   * @param {RankingParcel} parcel
   */
  async #refuse(parcel) {
    const pending = this.#pending[parcel.outcome];
    if (!pending || !this.#isOf(parcel)) return;
    const isOfLog = isAboutTheLog(parcel) && !pending.isSecondTry;
    await this.#parts.outbox.forget(parcel.id);
    if (isOfLog && this.#tryAgain(parcel, pending)) return;
    if (this.#pending[parcel.outcome] === pending) delete this.#pending[parcel.outcome];
    pending.reject(errorOf(parcel));
    this.#parts.onChange();
  }

  /** @param {RankingParcel} parcel @param {Pending & Rest} pending */
  #tryAgain(parcel, pending) {
    const { outcome, sittingId, body } = parcel;
    pending.isSecondTry = true;
    const isMended = sittingId !== this.#book.id || this.#mend(parcel, body.sitting.events[0]?.n ?? 0);
    const isElsewhere = sittingId !== this.#book.id;
    if (!isMended || (isElsewhere && !this.#parts.confirmAgain(outcome, pending))) return false;
    if (isElsewhere) pending.nEvents = this.#book.log.length;
    this.#send(outcome, pending);
    return true;
  }

  /**
   * The server would not have a log. Where it only lacks earlier events, it gets them. Else, since two pages wrote on in
   * different ways or something is damaged, the work goes on in another sitting. False: neither helps, as where the server
   * does not know this browser any more.
   * @param {LogParcel | RankingParcel} parcel @param {number} nTold  up to there it was taken to know it
   */
  #mend(parcel, nTold) {
    const nThere = numberIn(parcel, "n_events");
    if (parcel.code === "log_gap" && nThere !== null && nThere < nTold) {
      this.#book.acknowledged = nThere;
      return true;
    }
    this.#isLogHopeless = !isAboutTheLog(parcel) || !this.#parts.renew();
    return !this.#isLogHopeless;
  }

  /** @param {Outcome} outcome @param {Pick<Pending & Rest, "order" | "untouched" | "since" | "nEvents">} told */
  #expect(outcome, told) {
    const before = this.#pending[outcome];
    const promise = promised();
    // Whoever wants to know asks for it; nobody has to.
    promise.done.catch(() => {});
    if (before) promise.done.then(before.resolve, before.reject);
    const pending = { ...told, ...promise, parcelId: rankingId(this.#book.id, outcome), isSecondTry: false };
    this.#pending[outcome] = pending;
    return pending;
  }

  /** @param {Outcome} outcome @param {Pending & Rest} pending */
  #send(outcome, pending) {
    const { id, worldId, log, acknowledged, versions } = this.#book;
    const { order, untouched, nEvents } = pending;
    const events = log.slice(Math.min(acknowledged, nEvents - 1), nEvents);
    const body = { order, confirmed: /** @type {true} */ (true), based_on: versions[outcome], untouched };
    pending.parcelId = rankingId(id, outcome);
    const parcel = {
      id: pending.parcelId,
      worldId,
      sittingId: id,
      outcome,
      body: { ...body, sitting: { id, events } },
    };
    void this.#parts.outbox.add({ kind: "ranking", ...parcel });
  }

  /** Whether it is the one that this page waits for. @param {RankingParcel} parcel */
  #isOf({ id, outcome, body }) {
    const pending = this.#pending[outcome];
    return pending?.parcelId === id && body.sitting.events.at(-1)?.n === pending.nEvents - 1;
  }

  /** @param {number} nEvents */
  #acknowledge(nEvents) {
    this.#book.acknowledged = Math.max(this.#book.acknowledged, Math.min(nEvents, this.#book.log.length));
  }
}

/** @param {RankingParcel} parcel */
function errorOf({ refusal, status = 0, code = "refused", fields }) {
  return new ApiError({ status, code, message: refusal ?? "", fields });
}

/** Whether a refusal says nothing against the order itself. @param {LogParcel | RankingParcel} parcel */
function isAboutTheLog({ status, code = "", fields = {} }) {
  const isAboutEvents = Object.keys(fields).some((name) => /^(events|sitting)\b/.test(name));
  return ["conflict", "log_gap", "log_differs"].includes(code) || (status === 422 && isAboutEvents);
}

/** Fields of a refusal are words. @param {LogParcel | RankingParcel} parcel @param {string} field */
function numberIn({ fields }, field) {
  const number = Number.parseInt(String(fields?.[field] ?? ""), 10);
  return Number.isNaN(number) ? null : number;
}

/** A promise to be kept from outside. */
function promised() {
  /** @type {(told: {ranking: any}) => void} */
  let resolve = () => {};
  /** @type {(error: Error) => void} */
  let reject = () => {};
  /** @type {Promise<{ranking: any}>} */
  const done = new Promise((keep, breakIt) => {
    resolve = keep;
    reject = breakIt;
  });
  return { done, resolve, reject };
}
