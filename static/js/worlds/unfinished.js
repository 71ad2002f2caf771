/**
 * Attempts being played, kept in this browser after every step, so that neither a reload nor a crash costs more than the
 * last one. Each tab holds the attempt it plays; what nobody holds was left and is offered again. What is kept but
 * cannot be read is set aside, never thrown away.
 */

import { LastStraw } from "#js/lib/last-straw.js";
import { Belongings } from "#js/lib/locks.js";
import { ask, browserStorage } from "#js/lib/storage.js";
import { LONGEST_STEP_MS } from "#js/worlds/session.js";

/** @typedef {import("#js/worlds/session.js").Draft} Draft */

/**
 * @typedef {object} Drafts   where they are kept
 * @property {(draft: Draft & {isSetAside?: boolean}) => Promise<unknown>} put
 * @property {(id: string) => Promise<unknown>} delete
 * @property {() => Promise<any[]>} all   whatever is there
 */

/** Up to here writing an attempt takes less than a millisecond; one of 20,000 steps takes 12. */
const MOST_STEPS_AT_ONCE = 1000;
/** After a reload the old page may hold its attempt for a moment longer. */
const RELOAD_MS = 1000;
const OLD_KEY = "irlfr:attempt:";
const MINE_KEY = "irlfr:mine";

export class Unfinished {
  #worldId;
  #drafts;
  #belongings;
  /** Long ones that wait for a quiet moment, by id. @type {Map<string, Draft>} */
  #toWrite = new Map();
  /** @type {Promise<void> | null} */
  #writing = null;
  /** Attempts being played, by id: one may be taken back to its start and begun again while it is being deleted. @type {Set<string>} */
  #kept = new Set();
  /** What the storage does not have yet, by id. @type {Map<string, Draft>} */
  #unwritten = new Map();
  #lasts = true;
  #quiet;
  #lastStraw;

  /**
   * @param {{id: string}} world
   * @param {object} [parts]
   * @param {Drafts} [parts.drafts]
   * @param {Pick<Belongings, "has" | "take" | "giveBack" | "ofOthers">} [parts.belongings]
   * @param {Pick<LastStraw<Draft>, "keep" | "all" | "drop">} [parts.lastStraw]
   * @param {() => Promise<unknown>} [parts.quiet]  resolves when writing stands in nobody's way
   */
  constructor(world, parts = {}) {
    const { drafts = storedDrafts(browserStorage), belongings = new Belongings() } = parts;
    const { lastStraw = new LastStraw("unfinished"), quiet = afterFrame } = parts;
    this.#worldId = world.id;
    this.#lastStraw = lastStraw;
    this.#drafts = drafts;
    this.#belongings = belongings;
    this.#quiet = quiet;
  }

  /** Ready at once: the storage opens meanwhile. @param {{id: string}} world */
  static async open(world) {
    const unfinished = new Unfinished(world);
    window.addEventListener("pagehide", () => unfinished.rescue());
    return unfinished;
  }

  /** False when the last step could not be kept: the storage is closed or full. */
  get lasts() {
    return this.#lasts;
  }

  /**
   * After every step and every step back. In the task of the key press, so that a browser killed after it loses nothing;
   * long attempts wait until the frame is painted, and steps that come meanwhile are written together.
   * @param {Draft} draft
   */
  keep(draft) {
    const { id, actions } = draft;
    this.#kept.add(id);
    if (!this.#belongings.has(nameOf(id))) this.#own(id);
    this.#unwritten.set(id, draft);
    if (actions.length > MOST_STEPS_AT_ONCE) this.#later(draft);
    else {
      this.#toWrite.delete(id);
      void this.#write(draft);
    }
  }

  /** The page is being closed: what is not in the storage goes where it can. */
  rescue() {
    this.#lastStraw.keep(this.#unwritten.values());
  }

  /** It is finished, or thrown away. @param {string} id */
  drop(id) {
    this.#kept.delete(id);
    this.#unwritten.delete(id);
    this.#lastStraw.drop(id);
    this.#toWrite.delete(id);
    const gone = this.#drafts.delete(id).catch(() => {});
    void gone.then(() => this.#kept.has(id) || this.#belongings.giveBack(nameOf(id)));
  }

  /**
   * Make a draft that was left this tab's own, and read how far it has come by now; null when another tab plays it, or
   * has finished it or thrown it away since it was offered here. So two tabs never go on with the same attempt.
   * @param {string} id @returns {Promise<Draft | null>}
   */
  async take(id) {
    if (!(await this.#belongings.take(nameOf(id)))) return null;
    const all = await this.#drafts.all().catch(() => []);
    const draft = all.find((one) => one.id === id && !one.isSetAside && isSound(one));
    if (draft) remember(id);
    else this.#belongings.giveBack(nameOf(id));
    return draft ?? null;
  }

  /** Attempts in this world that nobody plays any more: first this tab's own, then the newest. @returns {Promise<{drafts: Draft[], nDamaged: number}>} */
  async left() {
    await this.#takeOver();
    const all = (await this.#drafts.all().catch(() => [])).filter((one) => !one.isSetAside);
    const ours = all.filter(({ worldId }) => worldId === this.#worldId || typeof worldId !== "string");
    const damaged = ours.filter((one) => !isSound(one));
    for (const one of damaged) await this.#drafts.put({ ...one, isSetAside: true }).catch(() => {});
    const drafts = await this.#free(ours.filter(isSound));
    return { drafts, nDamaged: damaged.length };
  }

  /** @param {Draft[]} drafts @returns {Promise<Draft[]>} */
  async #free(drafts) {
    if (drafts.length === 0) return [];
    const mine = drafts.find(({ id }) => id === remembered())?.id;
    const isMineFree = mine !== undefined && !this.#belongings.has(nameOf(mine)) && (await this.#canTake(mine));
    const taken = await this.#belongings.ofOthers();
    const isFree = (/** @type {string} */ id) => !taken.has(nameOf(id)) && !this.#belongings.has(nameOf(id));
    return (
      drafts
        // A lock just given back may still be listed as held.
        .filter(({ id }) => (id === mine ? isMineFree : isFree(id)))
        .sort((a, b) => Number(b.id === mine) - Number(a.id === mine) || b.savedAt - a.savedAt)
    );
  }

  /** @param {string} id */
  async #canTake(id) {
    const isFree = await this.#belongings.take(nameOf(id), RELOAD_MS);
    if (isFree) this.#belongings.giveBack(nameOf(id));
    return isFree;
  }

  /** @param {string} id */
  #own(id) {
    void this.#belongings.take(nameOf(id));
    remember(id);
  }

  /** @param {Draft} draft */
  #later(draft) {
    this.#toWrite.set(draft.id, draft);
    this.#writing ??= this.#writeLong().finally(() => {
      this.#writing = null;
    });
  }

  async #writeLong() {
    while (this.#toWrite.size > 0) {
      await this.#quiet();
      for (const [id, draft] of this.#toWrite) {
        this.#toWrite.delete(id);
        await this.#write(draft);
      }
    }
  }

  /** @param {Draft} draft */
  async #write(draft) {
    try {
      await this.#put(draft);
      this.#lasts = true;
    } catch {
      this.#lasts = false;
    }
  }

  /** @param {Draft} draft */
  async #put(draft) {
    await this.#drafts.put(draft);
    if (this.#unwritten.get(draft.id) === draft) this.#unwritten.delete(draft.id);
    this.#lastStraw.drop(draft.id);
  }

  /** What an earlier page could not store in time, and the one attempt a world that version 0.2 kept. */
  async #takeOver() {
    for (const draft of this.#lastStraw.all()) await this.#put(draft).catch(() => {});
    const key = OLD_KEY + this.#worldId;
    try {
      const text = localStorage.getItem(key);
      if (text === null) return;
      await this.#drafts.put(oldDraft(text, this.#worldId));
      localStorage.removeItem(key);
    } catch {
      // No storage, or a full one: it stays where it is.
    }
  }
}

/** @param {import("#js/lib/storage.js").Storage} storage @returns {Drafts} */
function storedDrafts(storage) {
  return {
    put: (draft) => storage.run(["unfinished"], "readwrite", (store) => void store("unfinished").put(draft), "relaxed"),
    delete: (id) => storage.run(["unfinished"], "readwrite", (store) => void store("unfinished").delete(id), "relaxed"),
    all: () => storage.run(["unfinished"], "readonly", (store) => ask(store("unfinished").getAll())),
  };
}

/** After the next frame; at once if the page is being closed. */
function afterFrame() {
  const waited = new AbortController();
  return new Promise((resolve) => {
    const done = () => {
      waited.abort();
      resolve(null);
    };
    requestAnimationFrame(() => setTimeout(done));
    // No frames come while the page is hidden.
    setTimeout(done, 100);
    window.addEventListener("pagehide", done, { signal: waited.signal });
  });
}

/** @param {string} text @param {string} worldId @returns {any} */
function oldDraft(text, worldId) {
  const savedAt = Date.now();
  try {
    const { id, actions, stepMs } = JSON.parse(text);
    if (typeof id !== "string") throw new TypeError("An attempt has an id.");
    return { id, worldId, actions, stepMs, slipSeeds: [[id, 0]], parentId: null, parentStep: 0, record: {}, savedAt };
  } catch {
    return { id: `damaged:${worldId}:${savedAt}`, worldId, text, savedAt };
  }
}

/** Whether it can be walked again, and taken by the server once it is finished. @param {any} draft */
function isSound({ id, actions, stepMs, slipSeeds, parentId, parentStep, savedAt }) {
  const isWalk =
    Array.isArray(actions) && actions.length > 0 && actions.every((action) => [0, 1, 2, 3].includes(action));
  const isTimed = Array.isArray(stepMs) && stepMs.length === actions?.length && stepMs.every(isMs);
  const isSeeded = Array.isArray(slipSeeds) && slipSeeds.every(isSeed) && areInOrder(slipSeeds, id, parentStep);
  const isChild =
    parentId === null
      ? parentStep === 0
      : typeof parentId === "string" && Number.isInteger(parentStep) && parentStep > 0;
  return isWalk && isTimed && isSeeded && isChild && parentStep <= actions.length && Number.isFinite(savedAt);
}

/** @param {unknown} ms */
function isMs(ms) {
  return typeof ms === "number" && ms >= 0 && ms <= LONGEST_STEP_MS;
}

/** @param {any} pair */
function isSeed(pair) {
  return typeof pair?.[0] === "string" && Number.isInteger(pair?.[1]);
}

/** From step 0, rising, and by its own id at last. @param {[string, number][]} seeds @param {string} id @param {number} parentStep */
function areInOrder(seeds, id, parentStep) {
  const [seed, fromStep] = seeds.at(-1) ?? ["", -1];
  const isRising = seeds.every(([, from], i) => (i === 0 ? from === 0 : from > (seeds[i - 1]?.[1] ?? 0)));
  return isRising && seed === id && fromStep === parentStep;
}

/** @param {string} id */
function nameOf(id) {
  return `irlfr:attempt:${id}`;
}

/** Which attempt this tab plays, across reloads. @param {string} id */
function remember(id) {
  try {
    sessionStorage.setItem(MINE_KEY, id);
  } catch {
    // Then the newest is offered first.
  }
}

function remembered() {
  try {
    return sessionStorage.getItem(MINE_KEY);
  } catch {
    return null;
  }
}
