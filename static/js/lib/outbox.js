/**
 * Attempts and orders on their way to the server. Each is written to the browser's own storage before the first request and leaves
 * it when the server has acknowledged it; until then it is sent again: with growing pauses, when the server asked for
 * it, when the network comes back, when the page is seen again, at the next visit. Ids are made in the browser, so
 * sending twice does no harm; one tab sends at a time, so that strangers in two tabs become one visitor. What the server
 * refuses for good (409, 422, …) is kept and said plainly (a log and a wish are told and over); what the storage refuses lives in memory until it is sent.
 */

import { ApiError } from "#js/lib/api.js";
import { LastStraw } from "#js/lib/last-straw.js";
import { inTurn } from "#js/lib/locks.js";
import { isOfRankings, isRefused, isSound, parcelSender, storedParcels, wishId } from "#js/lib/parcels.js";
import { browserStorage, rankingStorage } from "#js/lib/storage.js";

const FIRST_PAUSE_MS = 1000;
const LONGEST_PAUSE_MS = 60_000;
const DAMAGED = "What this browser had kept of it is damaged, so it cannot be sent.";

/** @typedef {import("#js/lib/parcels.js").Parcel} Parcel */
/** @template {Parcel} P @typedef {P extends Parcel ? Omit<P, "at" | "refusal" | "seq"> : never} Unsent */
/** @typedef {import("#js/lib/parcels.js").Store} Store */

/**
 * What becomes of a parcel. `kept`: it is in the storage, or in memory alone (`isStored`); `waiting`: the server could
 * not take it, and why (`status`, 0 for no answer; `retryAfterMs`); `saved`, `refused`, `forgotten`.
 * @typedef {object} News
 * @property {"kept" | "waiting" | "saved" | "refused" | "forgotten"} kind
 * @property {Parcel} parcel
 * @property {boolean} [isStored]
 * @property {number} [status]
 * @property {number | null} [retryAfterMs]
 * @property {any} [answer]  what the server made of it: a demonstration, a ranking, how much of a log it has
 * @property {boolean} [isElsewhere]  it happened in another tab
 */

/** The outbox of this page, which hears from those of other tabs. @param {(news: News) => void} report */
export function openOutbox(report) {
  const channels = typeof BroadcastChannel === "undefined" ? null : openChannels();
  const outbox = new Outbox({
    store: storedParcels({ attempts: browserStorage, rankings: rankingStorage }),
    lastStraw: new LastStraw("parcel"),
    inTurn: (work) => inTurn("irlfr:outbox", browserStorage, work),
    report: (news) => {
      report(news);
      channels?.[isOfRankings(news.parcel) ? "rankings" : "attempts"].postMessage(news);
    },
  });
  window.addEventListener("pagehide", () => outbox.rescue());
  for (const channel of Object.values(channels ?? {})) {
    channel.addEventListener("message", ({ data }) => {
      outbox.hear(data);
      report({ ...data, isElsewhere: true });
    });
  }
  return outbox;
}

/** A tab that still shows version 0.3 listens to the first, and would take all it hears for an attempt. */
function openChannels() {
  return { attempts: new BroadcastChannel("irlfr"), rankings: new BroadcastChannel("irlfr:rankings") };
}

export class Outbox {
  #store;
  #lastStraw;
  #send;
  #report;
  #wait;
  #inTurn;
  #now;
  #pause = FIRST_PAUSE_MS;
  #notBefore = 0;
  #timer = 0;
  /** @type {Promise<void> | null} */
  #running = null;
  #isStale = false;
  /** On their way into the storage. @type {Set<Parcel>} */
  #storing = new Set();
  /** What the storage did not take. @type {Map<string, Parcel>} */
  #unstored = new Map();
  /** Answered, though the storage may not have heard of it. @type {Set<unknown>} */
  #answered = new Set();

  /**
   * @param {object} parts
   * @param {Store} parts.store
   * @param {Pick<LastStraw<Parcel>, "keep" | "all" | "drop">} [parts.lastStraw]
   * @param {(parcel: Parcel) => Promise<any>} [parts.send]
   * @param {(news: News) => void} [parts.report]
   * @param {<T>(work: () => Promise<T>) => Promise<T>} [parts.inTurn]  while no other tab sends
   * @param {(run: () => void, ms: number) => void} [parts.wait]
   * @param {() => number} [parts.now]  monotonic ms
   */
  constructor({
    store,
    lastStraw = { keep: () => {}, all: () => [], drop: () => {} },
    send = parcelSender(),
    report = () => {},
    inTurn: alone = (work) => work(),
    wait = (run, ms) => void setTimeout(run, ms),
    now = () => performance.now(),
  }) {
    this.#store = store;
    this.#lastStraw = lastStraw;
    this.#send = send;
    this.#report = report;
    this.#inTurn = alone;
    this.#wait = wait;
    this.#now = now;
  }

  /** How many parcels would be lost if this page were closed now. */
  get nUnstored() {
    return this.#unstored.size;
  }

  /** Keep a finished attempt, a log or an order, then try to send it. Resolves when it is kept. @param {Unsent<Parcel>} parcel */
  add(parcel) {
    return this.#keep({ ...parcel, at: Date.now(), refusal: null });
  }

  /** Discard or restore an attempt, after it has arrived. The last wish counts. @param {{attemptId: string, worldId: string, discarded: boolean}} wish */
  setDiscarded({ attemptId, worldId, discarded }) {
    const id = wishId(attemptId);
    return this.#keep({ kind: "discard", id, attemptId, worldId, discarded, at: Date.now(), refusal: null });
  }

  /** Everything that is still here, oldest first. @returns {Promise<Parcel[]>} */
  async all() {
    const stored = await this.#store.all().catch(() => []);
    return [...stored, ...this.#unstored.values()];
  }

  /** Forget an attempt (a refused one the person has read about). @param {string} id */
  async forget(id) {
    const parcel = (await this.all()).find((one) => one.id === id);
    if (!parcel) return;
    await this.#remove(parcel);
    this.#report({ kind: "forgotten", parcel });
  }

  /** Send what waits, oldest first, one at a time; the first that finds no server stops the round. */
  flush() {
    this.#isStale = true;
    this.#running ??= this.#rounds().finally(() => {
      this.#running = null;
    });
    return this.#running;
  }

  /** Try again whenever there is reason to hope. @param {AbortSignal} signal */
  watch(signal) {
    const again = () => {
      if (document.visibilityState === "visible") void this.flush();
    };
    window.addEventListener("online", again, { signal });
    window.addEventListener("pageshow", again, { signal });
    document.addEventListener("visibilitychange", again, { signal });
    void this.recover().then(() => this.flush());
  }

  /** The page is being closed: what is not in the storage goes where it can. */
  rescue() {
    this.#lastStraw.keep([...this.#storing, ...this.#unstored.values()]);
  }

  /** Take in what an earlier page could not store in time. */
  async recover() {
    for (const parcel of this.#lastStraw.all()) {
      const isStored = await this.#put(parcel);
      this.#report({ kind: "kept", parcel, isStored });
    }
  }

  /** What another tab met holds for this one too. @param {News} news */
  hear({ kind, retryAfterMs }) {
    if (kind === "waiting" && retryAfterMs) this.#leaveAlone(retryAfterMs);
    if (kind === "kept") void this.flush();
  }

  /** @param {Parcel} parcel */
  async #keep(parcel) {
    const isStored = await this.#put(parcel);
    this.#report({ kind: "kept", parcel, isStored });
    void this.flush();
  }

  /** @param {Parcel} parcel @returns {Promise<boolean>} whether it is in the storage */
  async #put(parcel) {
    this.#storing.add(parcel);
    try {
      await this.#store.add(parcel);
      this.#unstored.delete(parcel.id);
      this.#lastStraw.drop(parcel.id);
      return true;
    } catch {
      this.#unstored.set(parcel.id, parcel);
      return false;
    } finally {
      this.#storing.delete(parcel);
    }
  }

  async #rounds() {
    while (this.#isStale && this.#now() >= this.#notBefore) {
      this.#isStale = false;
      await this.#storeTheUnstored();
      let couldSend = true;
      while (couldSend) couldSend = await this.#inTurn(() => this.#sendNext());
    }
  }

  /** There may be room again. */
  async #storeTheUnstored() {
    for (const parcel of [...this.#unstored.values()]) {
      if (await this.#put(parcel)) this.#report({ kind: "kept", parcel, isStored: true });
    }
  }

  /** @returns {Promise<boolean>} whether there may be more to send now */
  async #sendNext() {
    const parcel = this.#next(await this.all());
    if (!parcel) return false;
    if (!isSound(parcel)) return this.#refuse(parcel, DAMAGED);
    try {
      const answer = await this.#send(parcel);
      await this.#remove(parcel);
      this.#pause = FIRST_PAUSE_MS;
      this.#report({ kind: "saved", parcel, answer });
      return true;
    } catch (error) {
      if (error instanceof ApiError && !error.isTemporary) return this.#refuse(parcel, error.message, error);
      return this.#comeBackLater(parcel, error);
    }
  }

  /** Whatever another one rests on goes first. @param {Parcel[]} parcels */
  #next(parcels) {
    const waiting = parcels.filter((parcel) => !isRefused(parcel) && !this.#answered.has(keyOf(parcel)));
    const ids = new Set(waiting.map(({ id }) => id));
    return waiting.find((parcel) => !ids.has(foundationOf(parcel)));
  }

  /** @param {Parcel} parcel @param {string} refusal @param {Partial<ApiError>} [why] */
  async #refuse(parcel, refusal, { status, code, fields } = {}) {
    const refused = { ...parcel, refusal, status, code, fields };
    // A wish that cannot be granted is told, and over; so is a log, which its sitting still has. The others are kept.
    if (parcel.kind === "discard" || parcel.kind === "log") await this.#remove(parcel);
    else await this.#keepRefused(refused);
    this.#report({ kind: "refused", parcel: refused, status });
    return true;
  }

  /** @param {Parcel} refused */
  async #keepRefused(refused) {
    if (this.#unstored.has(refused.id)) this.#unstored.set(refused.id, refused);
    else await this.#store.refuse(refused).catch(() => this.#answered.add(keyOf(refused)));
  }

  /** @param {Parcel} parcel @param {unknown} error */
  #comeBackLater(parcel, error) {
    const { status, retryAfterMs } = error instanceof ApiError ? error : { status: 0, retryAfterMs: null };
    this.#report({ kind: "waiting", parcel, status, retryAfterMs });
    if (retryAfterMs) this.#leaveAlone(retryAfterMs);
    else this.#flushIn(this.#pause * (0.75 + Math.random() / 2));
    this.#pause = Math.min(LONGEST_PAUSE_MS, this.#pause * 2);
    return false;
  }

  /** As long as the server asked for, and a little longer: not everybody at once. @param {number} ms */
  #leaveAlone(ms) {
    this.#notBefore = Math.max(this.#notBefore, this.#now() + ms);
    this.#flushIn((1.05 + Math.random() / 4) * ms);
  }

  /** The last call counts. @param {number} ms */
  #flushIn(ms) {
    this.#timer += 1;
    const timer = this.#timer;
    this.#wait(() => {
      if (timer === this.#timer) void this.flush();
    }, ms);
  }

  /** @param {Parcel} parcel */
  async #remove(parcel) {
    this.#answered.add(keyOf(parcel));
    this.#lastStraw.drop(parcel.id);
    if (this.#unstored.get(parcel.id) === parcel) this.#unstored.delete(parcel.id);
    else await this.#store.delete(parcel).catch(() => {});
  }
}

/** Attempts and orders are numbered apart. @param {Parcel} parcel */
function keyOf(parcel) {
  return parcel.seq === undefined ? parcel : `${isOfRankings(parcel) ? "order" : "attempt"} ${parcel.seq}`;
}

/** The id of the parcel that has to arrive before this one; empty if it rests on none. @param {Parcel} parcel */
function foundationOf(parcel) {
  if (isOfRankings(parcel)) return "";
  const id = parcel.kind === "discard" ? parcel.attemptId : parcel.body?.parent_id;
  return id === undefined || id === parcel.id ? "" : id;
}
