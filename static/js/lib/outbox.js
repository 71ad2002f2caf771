/**
 * Attempts on their way to the server. Each is written to the browser's own storage (IndexedDB) before the first
 * request and leaves it when the server has acknowledged it; until then it is sent again: with growing pauses, when the
 * network comes back, when the page is seen again, at the next visit. Ids are made in the browser, so sending twice does
 * no harm. What the server refuses for good (409, 422, …) is kept and said plainly.
 */

import { ApiError, api } from "#js/lib/api.js";

const FIRST_PAUSE_MS = 1000;
const LONGEST_PAUSE_MS = 60_000;

/**
 * @typedef {object} Parcel
 * @property {string} id                     of the demonstration
 * @property {string} worldId
 * @property {Record<string, unknown>} world what makes the world
 * @property {{id: string, actions: readonly number[], step_ms: readonly number[], ending: string}} body
 * @property {number} at                     when it was put in, ms since 1970
 * @property {string | null} refusal         the server's sentence, once it has refused for good
 */

/**
 * @typedef {object} Store
 * @property {(parcel: Parcel) => Promise<void>} put
 * @property {(id: string) => Promise<void>} delete
 * @property {() => Promise<Parcel[]>} all
 */

/**
 * @typedef {object} News
 * @property {"saved" | "waiting" | "refused"} kind
 * @property {Parcel} parcel
 * @property {any} [demonstration]  as the server has it
 */

export class Outbox {
  #store;
  #send;
  #report;
  #wait;
  #pause = FIRST_PAUSE_MS;
  /** @type {Promise<void> | null} */
  #running = null;
  #isStale = false;

  /**
   * @param {object} parts
   * @param {Store} parts.store
   * @param {(parcel: Parcel) => Promise<any>} [parts.send]
   * @param {(news: News) => void} [parts.report]
   * @param {(run: () => void, ms: number) => void} [parts.wait]
   */
  constructor({ store, send = sendParcel, report = () => {}, wait = (run, ms) => void setTimeout(run, ms) }) {
    this.#store = store;
    this.#send = send;
    this.#report = report;
    this.#wait = wait;
  }

  /** Keep a parcel, then try to send it. Resolves when it is kept. @param {Omit<Parcel, "at" | "refusal">} parcel */
  async add(parcel) {
    await this.#store.put({ ...parcel, at: Date.now(), refusal: null });
    void this.flush();
  }

  /** Everything that is still here, oldest first. */
  async all() {
    return (await this.#store.all()).sort((a, b) => a.at - b.at);
  }

  /** Forget a parcel (a refused one the person has read about). @param {string} id */
  async forget(id) {
    await this.#store.delete(id);
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
    document.addEventListener("visibilitychange", again, { signal });
    void this.flush();
  }

  async #rounds() {
    while (this.#isStale) {
      this.#isStale = false;
      for (const parcel of await this.all()) {
        if (parcel.refusal === null && !(await this.#deliver(parcel))) return;
      }
    }
  }

  /** @param {Parcel} parcel @returns {Promise<boolean>} false when the server could not be reached */
  async #deliver(parcel) {
    try {
      const demonstration = await this.#send(parcel);
      await this.#store.delete(parcel.id);
      this.#pause = FIRST_PAUSE_MS;
      this.#report({ kind: "saved", parcel, demonstration });
      return true;
    } catch (error) {
      if (error instanceof ApiError && !error.isTemporary) {
        const refused = { ...parcel, refusal: error.message };
        await this.#store.put(refused);
        this.#report({ kind: "refused", parcel: refused });
        return true;
      }
      this.#report({ kind: "waiting", parcel });
      this.#wait(() => void this.flush(), this.#pause * (0.75 + Math.random() / 2));
      this.#pause = Math.min(LONGEST_PAUSE_MS, this.#pause * 2);
      return false;
    }
  }
}

/**
 * The world first, even one that the server has: it costs nothing to make the same world again, and its answer brings a
 * new visitor their cookie. Were the attempt the first to ask, and its answer lost, it would come again from a stranger.
 * @param {Parcel} parcel
 */
export async function sendParcel({ world, body }) {
  const { id } = await api.post("/worlds", world);
  return api.post(`/worlds/${id}/demonstrations`, body, { keepalive: true });
}

/** The browser's own storage; where it is closed to us (some private windows), memory, which lasts as long as the page. @returns {Promise<{store: Store, lasts: boolean}>} */
export async function openStore() {
  try {
    return { store: indexedStore(await openDatabase()), lasts: true };
  } catch {
    return { store: memoryStore(), lasts: false };
  }
}

/** @returns {Store} */
export function memoryStore() {
  /** @type {Map<string, Parcel>} */
  const kept = new Map();
  return {
    put: async (parcel) => void kept.set(parcel.id, parcel),
    delete: async (id) => void kept.delete(id),
    all: async () => [...kept.values()],
  };
}

/** @returns {Promise<IDBDatabase>} */
function openDatabase() {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open("irlfr", 1);
    request.onupgradeneeded = () => request.result.createObjectStore("outbox", { keyPath: "id" });
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
    request.onblocked = () => reject(new Error("Another tab holds an older version of the storage."));
  });
}

/** @param {IDBDatabase} database @returns {Store} */
function indexedStore(database) {
  /** @template T @param {IDBTransactionMode} mode @param {(store: IDBObjectStore) => IDBRequest<T>} ask @returns {Promise<T>} */
  const run = (mode, ask) =>
    new Promise((resolve, reject) => {
      const transaction = database.transaction("outbox", mode, { durability: "strict" });
      const request = ask(transaction.objectStore("outbox"));
      transaction.oncomplete = () => resolve(request.result);
      transaction.onerror = () => reject(transaction.error);
      transaction.onabort = () => reject(transaction.error);
    });
  return {
    put: async (parcel) => void (await run("readwrite", (store) => store.put(parcel))),
    delete: async (id) => void (await run("readwrite", (store) => store.delete(id))),
    all: () => run("readonly", (store) => store.getAll()),
  };
}
