/**
 * The browser's own storage (IndexedDB): what has not reached the server yet. Three stores:
 * - `outbox`: finished attempts and wishes on their way, keyed by `seq`, a number that only ever grows and is drawn
 *   where it is stored, so that their order never depends on a clock;
 * - `unfinished`: attempts being played, by id;
 * - `turns`: who of the tabs may send, where the browser has no locks (lib/locks.js).
 *
 * A database of its own rather than a second version of "irlfr" (version 0.2): an upgrade has to wait until the last tab
 * with the old page is closed, and what is played meanwhile would be kept nowhere. What still waits in the old one is
 * taken over at every opening; both may send the same attempt, which the server stores once.
 */

const NAME = "irlfr-attempts";
const VERSION = 1;
const OLD_NAME = "irlfr";
/** Opening may wait for ever: for another tab's upgrade, for a disk that hangs. */
const OPEN_WITHIN_MS = 3000;
const TAKE_OVER_WITHIN_MS = 1500;

/** @typedef {"outbox" | "unfinished" | "turns"} StoreName */

export class Storage {
  /** @type {Promise<IDBDatabase> | null} */
  #opening = null;

  /**
   * One transaction; resolves with what `work` gives once it is stored. Rejects when the storage is closed to us or full.
   * @param {StoreName[]} names
   * @param {IDBTransactionMode} mode
   * @param {(store: (name: StoreName) => IDBObjectStore) => any} work
   * @param {IDBTransactionDurability} [durability] "strict": on the disk, not only with the system
   */
  async run(names, mode, work, durability = "strict") {
    const transaction = await this.#begin(names, mode, durability);
    const ended = endOf(transaction);
    try {
      const result = await work((name) => transaction.objectStore(name));
      // Said outright, it goes through even if the page is closed in this moment.
      if (mode === "readwrite") transaction.commit();
      await ended;
      return result;
    } catch (error) {
      ended.catch(() => {});
      throw transaction.error ?? error;
    }
  }

  /** @param {StoreName[]} names @param {IDBTransactionMode} mode @param {IDBTransactionDurability} durability */
  async #begin(names, mode, durability) {
    try {
      return (await this.#open()).transaction(names, mode, { durability });
    } catch (error) {
      // Closed under us: by an upgrade in another tab, or by the browser.
      if (!(error instanceof DOMException) || error.name !== "InvalidStateError") throw error;
      this.#opening = null;
      return (await this.#open()).transaction(names, mode, { durability });
    }
  }

  #open() {
    const forget = () => {
      this.#opening = null;
    };
    this.#opening ??= within(OPEN_WITHIN_MS, openAttempts(forget)).catch((error) => {
      forget();
      throw error;
    });
    return this.#opening;
  }
}

/** The one of this page; it opens when it is first used. */
export const browserStorage = new Storage();

/** The result of one request inside a transaction. @template T @param {IDBRequest<T>} request @returns {Promise<T>} */
export function ask(request) {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** @param {() => void} onGone */
async function openAttempts(onGone) {
  const database = await open(NAME, VERSION, makeStores);
  database.onversionchange = () => {
    database.close();
    onGone();
  };
  database.onclose = onGone;
  // What cannot be taken over now stays where it is until the next time.
  await within(TAKE_OVER_WITHIN_MS, takeOver(database)).catch(() => {});
  return database;
}

/** @param {IDBDatabase} database */
function makeStores(database) {
  database
    .createObjectStore("outbox", { keyPath: "seq", autoIncrement: true })
    .createIndex("id", "id", { unique: true });
  database.createObjectStore("unfinished", { keyPath: "id" });
  database.createObjectStore("turns", { keyPath: "name" });
}

/** Parcels of the database of version 0.2. @param {IDBDatabase} database */
async function takeOver(database) {
  const known = await indexedDB.databases?.();
  if (known && !known.some(({ name }) => name === OLD_NAME)) return;
  const old = await open(OLD_NAME, undefined, (fresh) => fresh.createObjectStore("outbox", { keyPath: "id" }));
  try {
    const parcels = await ask(old.transaction("outbox").objectStore("outbox").getAll());
    if (parcels.length === 0) return;
    await copyInOrder(parcels, database);
    const cleared = old.transaction("outbox", "readwrite");
    for (const { id } of parcels) cleared.objectStore("outbox").delete(id);
    await endOf(cleared);
  } finally {
    old.close();
  }
}

/** @param {any[]} parcels @param {IDBDatabase} database */
async function copyInOrder(parcels, database) {
  const transaction = database.transaction("outbox", "readwrite", { durability: "strict" });
  const outbox = transaction.objectStore("outbox");
  for (const parcel of parcels.sort((a, b) => a.at - b.at)) {
    if ((await ask(outbox.index("id").getKey(parcel.id))) === undefined) outbox.add(parcel);
  }
  await endOf(transaction);
}

/** @param {string} name @param {number | undefined} version @param {(database: IDBDatabase) => void} make @returns {Promise<IDBDatabase>} */
function open(name, version, make) {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(name, version);
    request.onupgradeneeded = () => make(request.result);
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => {
      // A newer page has been here: it only ever adds stores.
      if (request.error?.name === "VersionError" && version !== undefined) resolve(open(name, undefined, make));
      else reject(request.error);
    };
  });
}

/** @param {IDBTransaction} transaction @returns {Promise<void>} */
function endOf(transaction) {
  return new Promise((resolve, reject) => {
    transaction.oncomplete = () => resolve();
    transaction.onabort = () => reject(transaction.error ?? new DOMException("The storage gave up.", "AbortError"));
  });
}

/** @template T @param {number} ms @param {Promise<T>} promise @returns {Promise<T>} */
function within(ms, promise) {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error("The browser's storage does not open.")), ms);
    promise.then(resolve, reject).finally(() => clearTimeout(timer));
  });
}
