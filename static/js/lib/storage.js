/**
 * The browser's own storage (IndexedDB): what has not reached the server yet, in two databases.
 *
 * `irlfr-attempts`:
 * - `outbox`: finished attempts and wishes on their way, keyed by `seq`, a number that only ever grows and is drawn
 *   where it is stored, so that their order never depends on a clock;
 * - `unfinished`: attempts being played, by id;
 * - `turns`: who of the tabs may send, where the browser has no locks (lib/locks.js).
 *
 * `irlfr-rankings`:
 * - `outbox`: logs and confirmed orders on their way, alike;
 * - `sittings`: work on orders, by id; `events`: what was done in them, by sitting and number.
 *
 * A database of its own for each, never a second version of one that a page in use may have open: `irlfr-attempts` came
 * after "irlfr" (version 0.2) because an upgrade waits until the last tab with the old page is closed, and what is played
 * meanwhile would be kept nowhere. `irlfr-rankings` came after it because a tab that still shows version 0.3 reads the
 * same outbox: it would take a confirmed order for a damaged attempt and refuse it. So it never sees one.
 *
 * What still waits in "irlfr" is taken over at every opening; both may send the same attempt, which the server stores once.
 */

const ATTEMPTS = { name: "irlfr-attempts", version: 1, make: makeAttemptStores, prepare: takeOver };
const RANKINGS = { name: "irlfr-rankings", version: 1, make: makeRankingStores };
const OLD_NAME = "irlfr";
/** Opening may wait for ever: for another tab's upgrade, for a disk that hangs. */
const OPEN_WITHIN_MS = 3000;
const TAKE_OVER_WITHIN_MS = 1500;

/** @typedef {"outbox" | "unfinished" | "turns" | "sittings" | "events"} StoreName */

/**
 * @typedef {object} Plan   of a database
 * @property {string} name
 * @property {number} version
 * @property {(database: IDBDatabase) => void} make
 * @property {(database: IDBDatabase) => Promise<void>} [prepare]   at every opening
 */

export class Storage {
  #plan;
  /** @type {Promise<IDBDatabase> | null} */
  #opening = null;

  /** @param {Plan} plan */
  constructor(plan) {
    this.#plan = plan;
  }

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
    this.#opening ??= within(OPEN_WITHIN_MS, openDatabase(this.#plan, forget)).catch((error) => {
      forget();
      throw error;
    });
    return this.#opening;
  }
}

/** Those of this page; each opens when it is first used. */
export const browserStorage = new Storage(ATTEMPTS);
export const rankingStorage = new Storage(RANKINGS);

/** The result of one request inside a transaction. @template T @param {IDBRequest<T>} request @returns {Promise<T>} */
export function ask(request) {
  return new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** @param {Plan} plan @param {() => void} onGone */
async function openDatabase({ name, version, make, prepare = async () => {} }, onGone) {
  const database = await open(name, version, make);
  database.onversionchange = () => {
    database.close();
    onGone();
  };
  database.onclose = onGone;
  // What cannot be taken over now stays where it is until the next time.
  await within(TAKE_OVER_WITHIN_MS, prepare(database)).catch(() => {});
  return database;
}

/** @param {IDBDatabase} database */
function makeAttemptStores(database) {
  makeOutbox(database);
  database.createObjectStore("unfinished", { keyPath: "id" });
  database.createObjectStore("turns", { keyPath: "name" });
}

/** @param {IDBDatabase} database */
function makeRankingStores(database) {
  makeOutbox(database);
  database.createObjectStore("sittings", { keyPath: "id" });
  database.createObjectStore("events", { keyPath: ["sitting", "n"] });
}

/** @param {IDBDatabase} database */
function makeOutbox(database) {
  database
    .createObjectStore("outbox", { keyPath: "seq", autoIncrement: true })
    .createIndex("id", "id", { unique: true });
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
