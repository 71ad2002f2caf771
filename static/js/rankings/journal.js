/**
 * Sittings as they lie in this browser: what was done in each, event by event, so that neither a reload nor a crash costs
 * a step. Each tab holds the sitting it goes on with; the one left last is taken up again. Nothing here is ever changed
 * but the few lines about a sitting; what cannot be read is left where it is.
 */

import { LastStraw } from "#js/lib/last-straw.js";
import { Belongings } from "#js/lib/locks.js";
import { ask, rankingStorage } from "#js/lib/storage.js";

/** @typedef {import("#js/lib/parcels.js").LoggedEvent} LoggedEvent */

/**
 * What is known about a sitting beside its events. One tab writes it, the one that holds the sitting.
 * @typedef {object} Entry
 * @property {string} id
 * @property {string} worldId
 * @property {number} savedAt        of its last event, ms since 1970
 * @property {number} acknowledged   so many events are on the server
 * @property {Record<"success" | "failure", number>} versions   the newest confirmed orders that it knows of
 * @property {boolean} [isSetAside]  the server would not have its log; another one goes on with its work
 */

/**
 * @typedef {object} Shelf   where they are kept
 * @property {(entry: Entry, events: readonly LoggedEvent[]) => Promise<unknown>} put   both or neither
 * @property {() => Promise<Entry[]>} entries
 * @property {(id: string) => Promise<LoggedEvent[]>} events   by their numbers
 * @property {(id: string) => Promise<unknown>} delete
 */

/** @typedef {{id: string, entry: Entry, events: LoggedEvent[]}} Unkept */

/** After a reload the old page may hold its sitting for a moment longer. */
const RELOAD_MS = 1000;
const MINE_KEY = "irlfr:sitting";

export class Journal {
  #shelf;
  #belongings;
  #lastStraw;
  /** What the storage is not known to have, by number. @type {Map<number, LoggedEvent>} */
  #unkept = new Map();
  /** @type {Entry | null} */
  #entry = null;
  #lasts = true;

  /**
   * @param {object} [parts]
   * @param {Shelf} [parts.shelf]
   * @param {Pick<Belongings, "take" | "giveBack">} [parts.belongings]
   * @param {Pick<LastStraw<Unkept>, "keep" | "all" | "drop">} [parts.lastStraw]
   */
  constructor({ shelf = storedSittings(), belongings = new Belongings(), lastStraw = new LastStraw("sitting") } = {}) {
    this.#shelf = shelf;
    this.#belongings = belongings;
    this.#lastStraw = lastStraw;
  }

  /** False while the last event could not be kept: the storage is closed or full. */
  get lasts() {
    return this.#lasts;
  }

  /**
   * The sitting in this world that this tab goes on with: its own from before a reload, else one of the `awaited`, else
   * the one left last. Null where there is none, or another tab holds it.
   * @param {string} worldId @param {ReadonlySet<string>} awaited @returns {Promise<{entry: Entry, events: LoggedEvent[]} | null>}
   */
  async take(worldId, awaited) {
    await this.#recover();
    const id = next(await this.#entriesOf(worldId), awaited)?.id;
    if (id === undefined || !(await this.#belongings.take(nameOf(id), RELOAD_MS))) return null;
    // Read once it is ours: until then the other page may have written on.
    const entry = (await this.#entriesOf(worldId)).find((one) => one.id === id);
    const events = await this.#shelf.events(id).catch(() => []);
    if (!entry) {
      this.#belongings.giveBack(nameOf(id));
      return null;
    }
    remember(worldId, id);
    return { entry, events };
  }

  /** In the task of the action, so that a browser killed after it loses nothing. @param {Entry} entry @param {readonly LoggedEvent[]} events */
  keep(entry, events) {
    if (entry.id !== this.#entry?.id) this.#own(entry);
    this.#entry = entry;
    for (const event of events) this.#unkept.set(event.n, event);
    // All that is not known to be there goes along, also what is on its way: a log with a hole in it is none.
    void this.#write(entry, [...this.#unkept.values()]);
  }

  /** The page is being closed: what is not in the storage goes where it can. */
  rescue() {
    const [entry, events] = [this.#entry, [...this.#unkept.values()]];
    if (entry && events.length > 0) this.#lastStraw.keep([{ id: entry.id, entry, events }]);
  }

  /** It stays as it is, for whom it may concern. @param {string} id @returns {null} */
  leave(id) {
    this.#belongings.giveBack(nameOf(id));
    return null;
  }

  /** The server would not have its log. @param {Entry} entry */
  setAside(entry) {
    void this.#shelf.put({ ...entry, isSetAside: true }, []).catch(() => {});
    this.#belongings.giveBack(nameOf(entry.id));
  }

  /** There is nothing in it that is not on the server, or on its way. @param {string} id @returns {null} */
  drop(id) {
    this.#lastStraw.drop(id);
    void this.#shelf.delete(id).catch(() => {});
    this.#belongings.giveBack(nameOf(id));
    return null;
  }

  /** @param {string} worldId */
  async #entriesOf(worldId) {
    const all = await this.#shelf.entries().catch(() => []);
    return all.filter((one) => one.worldId === worldId && !one.isSetAside);
  }

  /** @param {Entry} entry */
  #own({ id, worldId }) {
    this.#unkept.clear();
    void this.#belongings.take(nameOf(id));
    remember(worldId, id);
  }

  /** @param {Entry} entry @param {readonly LoggedEvent[]} events */
  async #write(entry, events) {
    try {
      await this.#shelf.put(entry, events);
      for (const event of events) if (this.#unkept.get(event.n) === event) this.#unkept.delete(event.n);
      this.#lastStraw.drop(entry.id);
      this.#lasts = true;
    } catch {
      this.#lasts = false;
    }
  }

  /** What an earlier page could not store in time. */
  async #recover() {
    for (const { entry, events } of this.#lastStraw.all()) await this.#write(entry, events);
  }
}

/** @param {Entry[]} entries @param {ReadonlySet<string>} awaited */
function next(entries, awaited) {
  const mine = entries.find(({ id, worldId }) => id === remembered(worldId));
  const newestFirst = entries.toSorted((a, b) => b.savedAt - a.savedAt);
  return mine ?? newestFirst.find(({ id }) => awaited.has(id)) ?? newestFirst[0];
}

/** @returns {Shelf} */
function storedSittings(storage = rankingStorage) {
  const rangeOf = (/** @type {string} */ id) => IDBKeyRange.bound([id, 0], [id, Number.POSITIVE_INFINITY]);
  return {
    put: (entry, events) =>
      storage.run(
        ["sittings", "events"],
        "readwrite",
        (store) => {
          store("sittings").put(entry);
          for (const event of events) store("events").put({ sitting: entry.id, ...event });
        },
        // With the system, which outlives the browser; the disk would cost each step 10 ms and more.
        "relaxed",
      ),
    entries: () => storage.run(["sittings"], "readonly", (store) => ask(store("sittings").getAll())),
    events: async (id) => {
      const kept = await storage.run(["events"], "readonly", (store) => ask(store("events").getAll(rangeOf(id))));
      return kept.map((/** @type {any} */ { sitting: _, ...event }) => event);
    },
    delete: (id) =>
      storage.run(["sittings", "events"], "readwrite", (store) => {
        store("sittings").delete(id);
        store("events").delete(rangeOf(id));
      }),
  };
}

/** @param {string} id */
function nameOf(id) {
  return `irlfr:sitting:${id}`;
}

/** Which sitting this tab goes on with, across reloads. @param {string} worldId @param {string} id */
function remember(worldId, id) {
  try {
    sessionStorage.setItem(`${MINE_KEY}:${worldId}`, id);
  } catch {
    // Then the one left last is taken up.
  }
}

/** @param {string} worldId */
function remembered(worldId) {
  try {
    return sessionStorage.getItem(`${MINE_KEY}:${worldId}`);
  } catch {
    return null;
  }
}
