/**
 * What an outbox holds: finished attempts, wishes about attempts, logs of sittings, confirmed orders; where they are kept
 * and how the first two are sent (lib/ranking-sender.js: the others).
 */

import { ApiError, api } from "#js/lib/api.js";
import { noAnswer, options, rankingSender } from "#js/lib/ranking-sender.js";
import { ask } from "#js/lib/storage.js";

/**
 * @typedef {object} Shared
 * @property {string} id
 * @property {string} worldId
 * @property {number} at                     when it was put in, ms since 1970
 * @property {string | null} refusal         the server's sentence, once it has refused for good
 * @property {number} [status]              of the refusal
 * @property {string} [code]
 * @property {Record<string, unknown>} [fields]
 * @property {number} [seq]                  its place in the order; none while it is kept in memory alone
 */

/**
 * @typedef {object} AttemptBody
 * @property {string} id
 * @property {readonly number[]} actions
 * @property {readonly number[]} step_ms
 * @property {string} ending
 * @property {string} [parent_id]
 * @property {number} [parent_step]
 * @property {unknown} [record]
 */

/** @typedef {Shared & {kind?: undefined, world: Record<string, any>, body: AttemptBody, slipSeeds?: readonly (readonly [string, number])[]}} AttemptParcel   `id`: of the demonstration */
/** @typedef {Shared & {kind: "discard", attemptId: string, discarded: boolean}} Wish */
/** @typedef {{n: number, at_ms: number, type: string, [field: string]: any}} LoggedEvent */
/** What was done in a sitting and has not been acknowledged; a later one takes its place. @typedef {Shared & {kind: "log", sittingId: string, events: readonly LoggedEvent[]}} LogParcel */
/**
 * @typedef {object} RankingBody
 * @property {readonly (readonly string[])[]} order
 * @property {true} confirmed
 * @property {number} based_on
 * @property {boolean} untouched
 * @property {{id: string, events: readonly LoggedEvent[]}} sitting   the last event is the confirmation
 */
/** A confirmed order; one confirmed later in the same sitting takes its place. @typedef {Shared & {kind: "ranking", sittingId: string, outcome: "success" | "failure", body: RankingBody}} RankingParcel */
/** @typedef {LogParcel | RankingParcel} OrderParcel */
/** @typedef {AttemptParcel | Wish | OrderParcel} Parcel */

/**
 * @typedef {object} Store
 * @property {(parcel: Parcel) => Promise<Parcel>} add        in place of another of the same id; with its `seq`
 * @property {(parcel: Parcel) => Promise<void>} refuse       keep its refusal, if it is still there
 * @property {(parcel: Parcel) => Promise<void>} delete       this one, not a later one of the same id
 * @property {() => Promise<Parcel[]>} all                    oldest first
 */

/** @param {string} attemptId */
export function wishId(attemptId) {
  return `discard:${attemptId}`;
}

/** @param {string} sittingId */
export function logId(sittingId) {
  return `log:${sittingId}`;
}

/** @param {string} sittingId @param {string} outcome */
export function rankingId(sittingId, outcome) {
  return `ranking:${sittingId}:${outcome}`;
}

/** Whether it is about an order, not about an attempt. @param {Parcel} parcel @returns {parcel is OrderParcel} */
export function isOfRankings(parcel) {
  return parcel.kind === "log" || parcel.kind === "ranking";
}

/** @typedef {import("#js/lib/storage.js").Storage} Storage */

/** Attempts first: an order may hold one that has not arrived. @param {{attempts: Storage, rankings: Storage}} storages @returns {Store} */
export function storedParcels({ attempts, rankings }) {
  const places = { attempts: attemptParcels(attempts), rankings: orderParcels(rankings) };
  const placeOf = (/** @type {Parcel} */ parcel) => (isOfRankings(parcel) ? places.rankings : places.attempts);
  return {
    add: (parcel) => placeOf(parcel).add(parcel),
    refuse: (parcel) => placeOf(parcel).refuse(parcel),
    delete: (parcel) => placeOf(parcel).delete(parcel),
    // One that does not open hides nothing that is in the other.
    all: async () => (await Promise.all(Object.values(places).map((place) => place.all().catch(() => [])))).flat(),
  };
}

/** A finished attempt takes the place of the unfinished one: never both, never neither. @param {Storage} storage @returns {Store} */
function attemptParcels(storage) {
  return {
    ...keptParcels(storage),
    add: ({ seq: _, ...parcel }) =>
      numbered(parcel, (added) =>
        storage.run(["outbox", "unfinished"], "readwrite", async (store) => {
          // An attempt never changes, so only a wish needs a look: without one, all is said before the page can close.
          if (parcel.kind === "discard") await deleteById(store("outbox"), parcel.id);
          added(store("outbox").add(parcel));
          store("unfinished").delete(parcel.id);
        }),
      ),
  };
}

/** @param {Storage} storage @returns {Store} */
function orderParcels(storage) {
  return {
    ...keptParcels(storage),
    add: ({ seq: _, ...parcel }) =>
      numbered(parcel, (added) =>
        storage.run(["outbox"], "readwrite", async (store) => {
          await deleteById(store("outbox"), parcel.id);
          added(store("outbox").add(parcel));
        }),
      ),
  };
}

/** With the number that the storage gave it. @param {any} parcel @param {(added: (request: IDBRequest<IDBValidKey>) => void) => Promise<unknown>} store */
async function numbered(parcel, store) {
  /** @type {IDBRequest<IDBValidKey> | undefined} */
  let request;
  await store((added) => {
    request = added;
  });
  return { ...parcel, seq: Number(request?.result) };
}

/** @param {Storage} storage @returns {Omit<Store, "add">} */
function keptParcels(storage) {
  return {
    refuse: (parcel) =>
      storage.run(["outbox"], "readwrite", async (store) => {
        const isThere = (await ask(store("outbox").getKey(Number(parcel.seq)))) !== undefined;
        if (isThere) store("outbox").put(parcel);
      }),
    delete: (parcel) =>
      storage.run(["outbox"], "readwrite", (store) => void store("outbox").delete(Number(parcel.seq))),
    all: () => storage.run(["outbox"], "readonly", (store) => ask(store("outbox").getAll())),
  };
}

/** @param {IDBObjectStore} outbox @param {string} id */
async function deleteById(outbox, id) {
  const seq = await ask(outbox.index("id").getKey(id));
  if (seq !== undefined) outbox.delete(seq);
}

/** @param {Pick<Parcel, "refusal">} parcel */
export function isRefused({ refusal }) {
  return typeof refusal === "string";
}

/** Whether it can be sent at all; storage can be damaged. @param {any} parcel */
export function isSound(parcel) {
  if (parcel?.kind === "discard") return typeof parcel.attemptId === "string" && typeof parcel.discarded === "boolean";
  if (parcel?.kind === "log") return isLog(parcel.sittingId, parcel.events);
  if (parcel?.kind === "ranking")
    return Array.isArray(parcel.body?.order) && isLog(parcel.body.sitting?.id, parcel.body.sitting?.events);
  const { world, body } = parcel ?? {};
  const isAttempt = Array.isArray(body?.actions) && Array.isArray(body?.step_ms) && typeof body?.ending === "string";
  return isAttempt && body.id === parcel.id && world !== null && typeof world === "object";
}

/** @param {unknown} id @param {unknown} events */
function isLog(id, events) {
  return typeof id === "string" && Array.isArray(events) && events.length > 0;
}

/**
 * A way to the server that remembers which worlds it has. The world goes first, even one that the server has: it costs
 * nothing to make the same world again, and its answer brings a new visitor their cookie. Were the attempt the first to
 * ask, and its answer lost, it would come again from a stranger.
 */
export function parcelSender() {
  /** @type {Map<string, string>} */
  const worldIds = new Map();
  const sendOrder = rankingSender();

  /** @param {AttemptParcel} parcel */
  async function worldIdOf({ worldId, world }) {
    const known = worldIds.get(worldId);
    if (known !== undefined) return known;
    const made = await api.post("/worlds", world, { ...options(), keepalive: false });
    if (typeof made?.id !== "string") throw noAnswer();
    worldIds.set(worldId, made.id);
    return made.id;
  }

  /** @param {AttemptParcel} parcel */
  async function sendAttempt(parcel) {
    const id = await worldIdOf(parcel);
    return acknowledged(parcel.id, await api.post(`/worlds/${id}/demonstrations`, parcel.body, options()));
  }

  /** @param {Parcel} parcel @returns {Promise<any>} */
  return async function send(parcel) {
    if (parcel.kind === "discard") return sendWish(parcel);
    if (isOfRankings(parcel)) return sendOrder(parcel);
    try {
      return await sendAttempt(parcel);
    } catch (error) {
      // The server may have lost the world, or forgotten this visitor: next time from the beginning.
      const isKnown = worldIds.delete(parcel.worldId);
      if (isKnown && error instanceof ApiError && error.status === 404) return sendAttempt(parcel);
      throw error;
    }
  };
}

/** @param {Wish} wish */
function sendWish({ attemptId, discarded }) {
  const path = `/demonstrations/${attemptId}/discard`;
  const call = discarded ? api.put(path, undefined, options()) : api.delete(path, options());
  return call.then((answer) => acknowledged(attemptId, answer));
}

/** A gateway that answers 200 with a page of its own has saved nothing. @param {string} id @param {any} answer */
function acknowledged(id, answer) {
  if (answer?.id !== id) throw noAnswer();
  return answer;
}
