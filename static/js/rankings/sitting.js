/**
 * One person's work on the orders of one world: the state, the log of what led there, how it is kept in this browser
 * (`journal.js`, in the task of each action) and reaches the server (`dispatch.js`, by the outbox). A reload, a crash and
 * a night in between change nothing: the same sitting goes on, with its undo and redo.
 */

import { Guard } from "#js/lib/guard.js";
import { openOutbox } from "#js/lib/outbox.js";
import { isOfRankings, logId } from "#js/lib/parcels.js";
import { uuid } from "#js/lib/uuid.js";
import * as beginning from "#js/rankings/beginning.js";
import { Dispatch } from "#js/rankings/dispatch.js";
import { Journal } from "#js/rankings/journal.js";
import { isSame } from "#js/rankings/order.js";
import { apply, beginState, SILENT } from "#js/rankings/sitting-state.js";

/** @typedef {import("#js/rankings/sitting-state.js").State} State */
/** @typedef {import("#js/rankings/sitting-state.js").Change} Change */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/dispatch.js").Book} Book */
/** @typedef {import("#js/rankings/journal.js").Entry} Entry */
/** @typedef {Change & {n: number, at_ms: number}} Event */
/** Of another tab, or of a sitting before this one. @typedef {{outcome: Outcome, ranking: any}} ConfirmedElsewhere */

/**
 * @typedef {object} Around   what a sitting stands in
 * @property {Pick<Journal, "take" | "keep" | "rescue" | "leave" | "setAside" | "drop" | "lasts">} journal
 * @property {Pick<import("#js/lib/outbox.js").Outbox, "add" | "all" | "forget">} outbox
 * @property {(run: () => void, ms: number) => void} [wait]
 * @property {() => number} [now]        monotonic ms
 * @property {() => string} [newId]
 * @property {(showTotals: boolean) => unknown} [client]   what the browser and the device are like
 */

export class Sitting {
  #around;
  #now;
  /** @type {State} */
  #state;
  /** @type {Book} */
  #book;
  #dispatch;
  /** What the clock shows, less what it showed when the sitting began; the time with the page closed left out. */
  #began = 0;
  #savedAt = Date.now();
  #showsTotals;
  #isRenewed = false;
  /** @type {Set<(state: State, event: Event) => void>} */
  #listeners = new Set();
  /** @type {Set<() => void>} */
  #savingListeners = new Set();
  /** @type {Set<(news: ConfirmedElsewhere) => void>} */
  #newsListeners = new Set();
  /** @type {Set<() => void>} */
  #arrivalListeners = new Set();

  /** @param {{book: Book, state: State, showTotals: boolean}} parts @param {Around} around */
  constructor({ book, state, showTotals }, around) {
    const { now = () => performance.now(), wait } = around;
    this.#around = around;
    this.#now = now;
    this.#book = book;
    this.#state = state;
    this.#showsTotals = showTotals;
    this.#began = now() - (book.log.at(-1)?.at_ms ?? 0);
    this.#dispatch = new Dispatch(book, {
      outbox: around.outbox,
      wait,
      renew: () => this.#renew(),
      confirmAgain: (outcome, told) => this.#confirmAgain(outcome, told),
      onChange: () => this.#onSaving(),
      onNews: (news) => {
        for (const listener of this.#newsListeners) listener(news);
      },
    });
  }

  /** The one that was left, or a new one. @param {any} data of the page @returns {Promise<Sitting>} */
  static async open(data) {
    /** @type {Sitting | undefined} */
    let sitting;
    // Before the outbox's own: what is put in here it still rescues.
    window.addEventListener("pagehide", () => sitting?.pause());
    const outbox = openOutbox((news) => sitting?.hear(news));
    await outbox.recover();
    sitting = await Sitting.of(data, { journal: new Journal(), outbox });
    const guard = new Guard(() => outbox.nUnstored > 0);
    sitting.subscribeSaving(() => guard.look());
    outbox.watch(new AbortController().signal);
    return sitting;
  }

  /** @param {any} data of the page @param {Around} around */
  static async of(data, around) {
    const awaited = beginning.refusedIn(await around.outbox.all(), data);
    const left = await around.journal.take(data.world.id, awaited);
    const work = left ? beginning.rebuilt(left.events) : null;
    const sitting = left && work ? await Sitting.#goOn(data, { ...left, ...work }, around) : null;
    // What cannot be read is left where it is, and out of the way.
    if (left && !work) around.journal.setAside(left.entry);
    return sitting ?? Sitting.#begin(data, around);
  }

  /** @param {any} data @param {{entry: Entry, state: State, log: Event[]}} left @param {Around} around @returns {Promise<Sitting | null>} */
  static async #goOn(data, { entry, state, log }, around) {
    const { id, worldId, acknowledged, versions, savedAt } = entry;
    // Another person's, or one's own from before the cookie was lost: it is not for this page to change.
    if (beginning.isStrange(state, data)) return around.journal.leave(id);
    const parcels = beginning.ordersAmong(await around.outbox.all()).filter((one) => one.sittingId === id);
    if (parcels.length === 0 && beginning.isAllConfirmed(id, state, data)) {
      const events = log.slice(acknowledged);
      if (events.length > 0) await around.outbox.add({ kind: "log", id: logId(id), worldId, sittingId: id, events });
      return around.journal.drop(id);
    }
    // Begun before there was anything to order: what there is now is shown as it was drawn.
    if (acknowledged === 0 && beginning.isEmpty(log[0].orders)) return around.journal.drop(id);
    const book = { id, worldId, log, acknowledged: Math.min(acknowledged, log.length), versions: { ...versions } };
    const sitting = new Sitting({ book, state, showTotals: data.options.show_totals }, around);
    sitting.#bringUpToDate(data, savedAt);
    sitting.#dispatch.adopt(parcels);
    return sitting;
  }

  /** @param {any} data @param {Around} around */
  static #begin(data, around) {
    const { newId = uuid, client = beginning.describeClient } = around;
    const [start, showTotals] = [beginning.startOf(data), data.options.show_totals];
    const begin = beginning.beginOf(start, { way: data.options.ways[0], client: client(showTotals) });
    const book = { id: newId(), worldId: data.world.id, log: [], acknowledged: 0, versions: start.versions };
    const sitting = new Sitting({ book, state: beginState(begin), showTotals }, around);
    sitting.#append(begin);
    beginning.forgetOldDraft(data.world.id);
    return sitting;
  }

  get id() {
    return this.#book.id;
  }

  get state() {
    return this.#state;
  }

  get orders() {
    return this.#state.present.orders;
  }

  /** Orders confirmed here that are not on the server yet, also from before a reload: `{success?: {order, since, done}, failure?: …}`. */
  get pending() {
    return this.#dispatch.pending;
  }

  /** Why they are not: `{since, status, retryAfterMs}` (status 0: no answer); null while nothing is amiss. */
  get waiting() {
    return this.#dispatch.waiting;
  }

  /** False while this browser's storage takes nothing: what is done then lives in this page until it is sent. */
  get lasts() {
    return this.#around.journal.lasts;
  }

  /** @param {Change} change @returns {boolean} whether anything came of it */
  do(change) {
    const next = apply(this.#state, change);
    if (next === null || (next === this.#state && !SILENT.has(change.type))) return false;
    this.#state = next;
    this.#tell(this.#append(change));
    if (change.type === "hidden") this.pause();
    return true;
  }

  /** After each event. @param {(state: State, event: Event) => void} listener */
  subscribe(listener) {
    this.#listeners.add(listener);
  }

  /** Whenever `pending`, `waiting` or `lasts` may have changed. @param {() => void} listener */
  subscribeSaving(listener) {
    this.#savingListeners.add(listener);
  }

  /** An order of this world was confirmed, but not here. @param {(news: ConfirmedElsewhere) => void} listener */
  subscribeNews(listener) {
    this.#newsListeners.add(listener);
  }

  /** Attempts of this world have arrived, or were discarded or restored, after this page was made. @param {() => void} listener */
  subscribeArrivals(listener) {
    this.#arrivalListeners.add(listener);
  }

  /**
   * The order as it stands is the person's. Resolves when the server has it, however long that takes; rejects with an
   * ApiError when the server will not. `basedOn`: the version that it is to follow, where the person has seen a newer one
   * than this sitting began with.
   * @param {Outcome} outcome @param {{means: string, untouched?: boolean, basedOn?: number}} how @returns {Promise<{ranking: any}>}
   */
  confirm(outcome, { means, untouched = false, basedOn }) {
    if (basedOn !== undefined) this.#book.versions[outcome] = basedOn;
    this.do({ type: "confirm", means, outcome, untouched });
    return this.#dispatch.confirm(outcome, { order: this.orders[outcome], untouched });
  }

  /** News of the outbox. @param {import("#js/lib/outbox.js").News} news */
  hear(news) {
    this.#dispatch.hear(news);
    const { kind, parcel } = news;
    if (kind !== "saved" || isOfRankings(parcel) || parcel.worldId !== this.#book.worldId) return;
    for (const listener of this.#arrivalListeners) listener();
  }

  /** The page may be closed at any moment. */
  pause() {
    if (!beginning.isEmpty(this.orders)) this.#dispatch.logNow();
    this.#around.journal.rescue();
  }

  /** After a reload, or a night. @param {any} data @param {number} savedAt */
  #bringUpToDate(data, savedAt) {
    const awayMs = Date.now() - savedAt;
    // A clock that was set back says nothing.
    this.do({ type: "resumed", means: "page", away_ms: awayMs >= 0 ? awayMs : null });
    // Nobody holds the card any more that was lifted then.
    if (this.#state.mark) this.do({ type: "drop", means: "page" });
    for (const outcome of beginning.OUTCOMES) {
      const news = beginning.newsOf(data, outcome, this.orders[outcome]);
      if (news.added.length + news.removed.length > 0) this.do({ type: "cards", means: "page", outcome, ...news });
    }
    const { ways } = data.options;
    if (!ways.includes(this.#state.way)) this.do({ type: "way", means: "page", way: ways[0] });
  }

  /**
   * The server will not have this log: two pages wrote on in different ways, or something is damaged. The same work goes
   * on in a new sitting, which begins with the orders as they stand and all that was said beside them; only the way back
   * (undo) ends there. Not again before anything of the new one has arrived: then the fault is not in a log.
   */
  #renew() {
    if (this.#isRenewed && this.#book.acknowledged === 0) return false;
    const { newId = uuid, client = beginning.describeClient, journal } = this.#around;
    const [before, left, { worldId, versions }] = [this.#state, this.#entry(), this.#book];
    const start = { orders: before.present.orders, from: { success: "draft", failure: "draft" }, versions };
    const begin = beginning.beginOf(start, { way: before.way, client: client(this.#showsTotals) });
    this.#isRenewed = true;
    this.#book = { id: newId(), worldId, log: [], acknowledged: 0, versions: { ...versions } };
    this.#began = this.#now();
    this.#state = beginState(begin);
    this.#append(begin);
    journal.setAside(left);
    this.#dispatch.follow(this.#book);
    for (const change of beginning.retold(before)) this.do(change);
    this.#tell(this.#book.log[0]);
    return true;
  }

  /** @param {Outcome} outcome @param {{order: Order, untouched: boolean}} told */
  #confirmAgain(outcome, { order, untouched }) {
    if (!isSame(order, this.orders[outcome])) return false;
    return this.do({ type: "confirm", means: "page", outcome, untouched });
  }

  /** @param {Change} change @returns {Event} */
  #append(change) {
    const { log } = this.#book;
    const at = Math.round(10 * (this.#now() - this.#began)) / 10;
    const event = { ...change, n: log.length, at_ms: Math.max(log.at(-1)?.at_ms ?? 0, at) };
    log.push(event);
    this.#savedAt = Date.now();
    this.#around.journal.keep(this.#entry(), [event]);
    // Without an attempt there is nothing that the server would keep.
    if (!beginning.isEmpty(this.orders)) this.#dispatch.logSoon();
    return event;
  }

  /** @returns {Entry} */
  #entry() {
    const { id, worldId, acknowledged, versions } = this.#book;
    return { id, worldId, savedAt: this.#savedAt, acknowledged, versions: { ...versions } };
  }

  /** @param {Event} event */
  #tell(event) {
    for (const listener of this.#listeners) listener(this.#state, event);
  }

  #onSaving() {
    this.#around.journal.keep(this.#entry(), []);
    for (const listener of this.#savingListeners) listener();
  }
}
