/**
 * Turns among the tabs of this browser. Web Locks where there are any; a page over plain http has none, so there a turn is
 * a record in the storage that runs out, and who plays an attempt is asked by BroadcastChannel.
 */

import { ask } from "#js/lib/storage.js";

/** @typedef {import("#js/lib/storage.js").Storage} Storage */

/** A tab that sleeps with the turn in its hands must not stop the others for ever: turns avoid waste, ids avoid harm. */
const PATIENCE_MS = 90_000;
const LEASE_MS = 15_000;
const LOOK_AGAIN_MS = 250;
const ANSWER_WITHIN_MS = 250;

/** Do `work` while no other tab does what has this name. @template T @param {string} name @param {Storage} storage @param {() => Promise<T>} work @returns {Promise<T>} */
export async function inTurn(name, storage, work) {
  if (!navigator.locks) return byLease(name, storage, work);
  let hasBegun = false;
  try {
    return await navigator.locks.request(name, { signal: AbortSignal.timeout(PATIENCE_MS) }, () => {
      hasBegun = true;
      return work();
    });
  } catch (error) {
    if (hasBegun) throw error;
    return work();
  }
}

/** @template T @param {string} name @param {Storage} storage @param {() => Promise<T>} work @returns {Promise<T>} */
async function byLease(name, storage, work) {
  const holder = Math.random();
  const giveUpAt = performance.now() + PATIENCE_MS;
  try {
    while (!(await take(name, holder, storage)) && performance.now() < giveUpAt) await pause(LOOK_AGAIN_MS);
  } catch {
    // Without a storage there is nothing that tabs could share.
  }
  try {
    return await work();
  } finally {
    await giveBack(name, holder, storage).catch(() => {});
  }
}

/** @param {string} name @param {number} holder @param {Storage} storage @returns {Promise<boolean>} */
function take(name, holder, storage) {
  return storage.run(
    ["turns"],
    "readwrite",
    async (store) => {
      const turn = await ask(store("turns").get(name));
      const left = (turn?.until ?? 0) - Date.now();
      // More than a lease is left only where the clock was set back.
      if (left > 0 && left <= LEASE_MS) return false;
      store("turns").put({ name, holder, until: Date.now() + LEASE_MS });
      return true;
    },
    "relaxed",
  );
}

/** @param {string} name @param {number} holder @param {Storage} storage */
function giveBack(name, holder, storage) {
  return storage.run(
    ["turns"],
    "readwrite",
    async (store) => {
      if ((await ask(store("turns").get(name)))?.holder === holder) store("turns").delete(name);
    },
    "relaxed",
  );
}

/** Things that belong to one tab as long as it lives, each with a name. */
export class Belongings {
  /** @type {Map<string, () => void>} */
  #mine = new Map();
  #channel =
    navigator.locks || typeof BroadcastChannel === "undefined" ? null : new BroadcastChannel("irlfr:belongings");

  constructor() {
    this.#channel?.addEventListener("message", ({ data }) => {
      if (data.asks && this.#mine.size > 0) this.#channel?.postMessage({ has: [...this.#mine.keys()] });
    });
  }

  /** @param {string} name */
  has(name) {
    return this.#mine.has(name);
  }

  /**
   * Make it ours, unless another tab has it for longer than we wait.
   * @param {string} name @param {number} [patienceMs] @returns {Promise<boolean>}
   */
  async take(name, patienceMs = 0) {
    if (this.#mine.has(name)) return true;
    if (!navigator.locks) return this.#takeByAsking(name);
    this.#mine.set(name, () => {});
    const isOurs = await new Promise((resolve) => {
      const options = patienceMs > 0 ? { signal: AbortSignal.timeout(patienceMs) } : { ifAvailable: true };
      const hold = (/** @type {Lock | null} */ lock) => {
        resolve(lock !== null);
        return lock && this.#mine.has(name)
          ? new Promise((release) => this.#mine.set(name, () => release(null)))
          : null;
      };
      navigator.locks.request(name, options, hold).catch(() => resolve(false));
    });
    if (!isOurs) this.#mine.delete(name);
    return isOurs;
  }

  /** @param {string} name */
  giveBack(name) {
    this.#mine.get(name)?.();
    this.#mine.delete(name);
  }

  /** Names that other tabs hold. @returns {Promise<Set<string>>} */
  async ofOthers() {
    if (navigator.locks) {
      const { held = [] } = await navigator.locks.query();
      return new Set(held.map(({ name }) => name ?? "").filter((name) => !this.#mine.has(name)));
    }
    return this.#askAround();
  }

  /** @param {string} name */
  async #takeByAsking(name) {
    if ((await this.#askAround()).has(name)) return false;
    this.#mine.set(name, () => {});
    return true;
  }

  /** @returns {Promise<Set<string>>} */
  async #askAround() {
    /** @type {Set<string>} */
    const names = new Set();
    const listen = (/** @type {MessageEvent} */ { data }) => {
      for (const name of data.has ?? []) names.add(name);
    };
    this.#channel?.addEventListener("message", listen);
    this.#channel?.postMessage({ asks: true });
    await pause(ANSWER_WITHIN_MS);
    this.#channel?.removeEventListener("message", listen);
    return names;
  }
}

/** @param {number} ms */
function pause(ms) {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
