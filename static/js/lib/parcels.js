/** What an outbox holds: finished attempts, and wishes about attempts; where they are kept and how they are sent. */

import { ApiError, api } from "#js/lib/api.js";
import { ask } from "#js/lib/storage.js";

/** A server that says nothing for so long will not; the same parcel may be sent again. */
const ANSWER_WITHIN_MS = 60_000;

/**
 * @typedef {object} Shared
 * @property {string} id
 * @property {string} worldId
 * @property {number} at                     when it was put in, ms since 1970
 * @property {string | null} refusal         the server's sentence, once it has refused for good
 * @property {number} [status]              of the refusal
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
/** @typedef {AttemptParcel | Wish} Parcel */

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

/** A finished attempt takes the place of the unfinished one: never both, never neither. @param {import("#js/lib/storage.js").Storage} storage @returns {Store} */
export function storedParcels(storage) {
  return {
    async add({ seq: _, ...parcel }) {
      /** @type {IDBRequest<IDBValidKey> | undefined} */
      let added;
      await storage.run(["outbox", "unfinished"], "readwrite", async (store) => {
        // An attempt never changes, so only a wish needs a look: without one, all is said before the page can close.
        if (parcel.kind === "discard") await deleteById(store("outbox"), parcel.id);
        added = store("outbox").add(parcel);
        store("unfinished").delete(parcel.id);
      });
      return { ...parcel, seq: Number(added?.result) };
    },
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
  const { world, body } = parcel ?? {};
  const isAttempt = Array.isArray(body?.actions) && Array.isArray(body?.step_ms) && typeof body?.ending === "string";
  return isAttempt && body.id === parcel.id && world !== null && typeof world === "object";
}

/**
 * A way to the server that remembers which worlds it has. The world goes first, even one that the server has: it costs
 * nothing to make the same world again, and its answer brings a new visitor their cookie. Were the attempt the first to
 * ask, and its answer lost, it would come again from a stranger.
 */
export function parcelSender() {
  /** @type {Map<string, string>} */
  const worldIds = new Map();

  /** @param {AttemptParcel} parcel */
  async function worldIdOf({ worldId, world }) {
    const known = worldIds.get(worldId);
    if (known !== undefined) return known;
    const made = await api.post("/worlds", world, { signal: AbortSignal.timeout(ANSWER_WITHIN_MS) });
    if (typeof made?.id !== "string") throw noAnswer();
    worldIds.set(worldId, made.id);
    return made.id;
  }

  /** @param {AttemptParcel} parcel */
  async function sendAttempt(parcel) {
    const id = await worldIdOf(parcel);
    const options = { keepalive: true, signal: AbortSignal.timeout(ANSWER_WITHIN_MS) };
    return acknowledged(parcel.id, await api.post(`/worlds/${id}/demonstrations`, parcel.body, options));
  }

  /** @param {Parcel} parcel @returns {Promise<any>} */
  return async function send(parcel) {
    if (parcel.kind === "discard") return sendWish(parcel);
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
  const options = { keepalive: true, signal: AbortSignal.timeout(ANSWER_WITHIN_MS) };
  const call = discarded ? api.put(path, undefined, options) : api.delete(path, options);
  return call.then((answer) => acknowledged(attemptId, answer));
}

/** A gateway that answers 200 with a page of its own has saved nothing. @param {string} id @param {any} answer */
function acknowledged(id, answer) {
  if (answer?.id !== id) throw noAnswer();
  return answer;
}

function noAnswer() {
  const message = "Something on the way answered in the server's place.";
  return new ApiError({ status: 0, code: "offline", message });
}
