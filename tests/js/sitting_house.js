/** A browser, its tabs and a server for the tests of sittings: all real but the storage, the network and the clock. */

import { Outbox } from "#js/lib/outbox.js";
import { parcelSender } from "#js/lib/parcels.js";
import { Journal } from "#js/rankings/journal.js";
import { flat, isSame } from "#js/rankings/order.js";
import { Sitting } from "#js/rankings/sitting.js";
import { apply, beginState } from "#js/rankings/sitting-state.js";
import { memoryParcels } from "./factories.js";

export const UNDO = { type: "undo", means: "button" };
export const REDO = { type: "redo", means: "button" };
export const logOf = (browser, { sitting }) => browser.server.logs.get(sitting.id) ?? [];
/** The state without what only the hand knows. */
export const contents = ({ past, present, future, way, touched }) => ({ past, present, future, way, touched });

/** A tab that has done something and undone some of it. */
export async function busy(browser, name = "first") {
  const tab = await browser.open(name);
  for (const id of ["a", "b", "a", "c"]) tab.top(id);
  tab.sitting.do({ type: "answer", means: "key", outcome: "success", a: "a", b: "b", said: "a" });
  tab.sitting.do({ type: "place", means: "touch", outcome: "failure", id: "y", group: 0, joins: true });
  tab.sitting.do(UNDO);
  tab.sitting.do(UNDO);
  return tab;
}

/** What the server would say, in short: it keeps logs and versions, and refuses as design and contract have it. */
export class Server {
  /** @type {Map<string, any[]>} */
  logs = new Map();
  /** @type {Record<string, any[]>} newest last */
  versions = { success: [], failure: [] };
  calls = [];
  isAway = false;
  /** A refusal for the next call that matches. @type {{path: RegExp, status: number, code: string, fields?: any}[]} */
  refusals = [];

  constructor() {
    globalThis.fetch = async (url, { method, body }) => this.#answer(method, url, body ? JSON.parse(body) : undefined);
  }

  #answer(method, url, body) {
    if (this.isAway) throw new TypeError("no network");
    this.calls.push(`${method} ${url.replace("/api/v1/worlds/w", "")}`);
    const refusal = this.refusals.findIndex(({ path }) => path.test(url));
    if (refusal >= 0) return refused(this.refusals.splice(refusal, 1)[0]);
    const [, sitting] = url.match(/sittings\/(.+)\/events/) ?? [];
    return sitting ? this.#log(sitting, body.events) : this.#rank(url.split("/").at(-1), body);
  }

  #log(id, events) {
    return this.#append(id, events) ?? json(200, { id, n_events: this.logs.get(id)?.length });
  }

  #append(id, events) {
    const log = [...(this.logs.get(id) ?? [])];
    if (events.length > 500) return refused({ status: 422, code: "invalid", fields: { events: "too many" } });
    for (const event of events) {
      if (event.n > log.length)
        return refused({ status: 409, code: "log_gap", fields: { n_events: String(log.length) } });
      if (event.n < log.length && !isSame(log[event.n], event)) return refused({ status: 409, code: "conflict" });
      if (event.n === log.length) log.push(event);
    }
    if (stateOf(log) === null) return refused({ status: 422, code: "invalid", fields: { events: "cannot be" } });
    this.logs.set(id, log);
    return null;
  }

  #rank(outcome, { order, based_on, sitting }) {
    const { version: newest = 0, sitting_id: from } = this.versions[outcome].at(-1) ?? {};
    const n = sitting.events.at(-1).n + 1;
    const again = this.versions[outcome].find((one) => one.sitting_id === sitting.id && one.n_events === n);
    if (again) return json(200, again);
    if (based_on !== newest && from !== sitting.id)
      return refused({ status: 409, code: "stale_version", fields: { version: String(newest) } });
    const error = this.#append(sitting.id, sitting.events);
    if (error) return error;
    const rebuilt = stateOf(this.logs.get(sitting.id).slice(0, n));
    if (!isSame(rebuilt.present.orders[outcome], order)) return refused({ status: 422, code: "log_differs" });
    const ranking = { outcome, order, version: newest + 1, sitting_id: sitting.id, n_events: n };
    this.versions[outcome].push(ranking);
    return json(200, ranking);
  }
}

/** @param {any[]} log */
export function stateOf([begin, ...rest]) {
  return rest.reduce((state, event) => (state ? apply(state, event) : null), beginState(begin));
}

/** One browser with its storage, whose tabs each hold what is theirs. */
export class Browser {
  server = new Server();
  /** What there is to rank: ids by outcome. */
  cards = { success: ["a", "b", "c"], failure: ["x", "y"] };
  /** What the storage has. */
  entries = new Map();
  events = new Map();
  parcels = memoryParcels();
  isFull = false;
  /** So many times it fails for once. */
  nFailures = 0;
  #held = new Map();
  #straws = new Map();
  #nSittings = 0;
  ways = ["lists"];
  /** @type {Tab[]} */
  tabs = [];

  /** @param {string} name of the tab */
  async open(name) {
    const tab = new Tab(this, name);
    this.tabs.push(tab);
    await tab.start();
    return tab;
  }

  data() {
    const kept = (outcome) => this.cards[outcome].map((id) => ({ id, outcome, discarded: false }));
    const newest = ({ success, failure }) => ({ success: success.at(-1) ?? null, failure: failure.at(-1) ?? null });
    return {
      world: { id: "w" },
      demonstrations: [...kept("success"), ...kept("failure")],
      rankings: newest(this.server.versions),
      start_order: { success: [...this.cards.success].reverse(), failure: this.cards.failure },
      options: { show_totals: true, ways: this.ways },
    };
  }

  newId() {
    this.#nSittings += 1;
    return `sitting-${this.#nSittings}`;
  }

  /** @param {string} tab */
  belongings(tab) {
    return {
      take: async (name) => {
        if (!this.#held.has(name)) this.#held.set(name, tab);
        return this.#held.get(name) === tab;
      },
      giveBack: (name) => void this.#held.delete(name),
    };
  }

  /** @param {string} tab */
  letGo(tab) {
    for (const [name, by] of this.#held) if (by === tab) this.#held.delete(name);
    this.tabs = this.tabs.filter((one) => one.name !== tab);
  }

  get shelf() {
    return {
      put: async (entry, events) => {
        if (this.isFull || this.nFailures-- > 0) throw new DOMException("no room", "QuotaExceededError");
        this.entries.set(entry.id, structuredClone(entry));
        for (const event of events) this.events.set(`${entry.id} ${event.n}`, structuredClone(event));
      },
      entries: async () => [...this.entries.values()],
      events: async (id) =>
        [...this.events]
          .filter(([key]) => key.startsWith(`${id} `))
          .map(([, event]) => event)
          .sort((p, q) => p.n - q.n),
      delete: async (id) => {
        this.entries.delete(id);
        for (const key of this.events.keys()) if (key.startsWith(`${id} `)) this.events.delete(key);
      },
    };
  }

  get lastStraw() {
    return {
      keep: (items) => [...items].map((one) => this.#straws.set(one.id, structuredClone(one))),
      all: () => [...this.#straws.values()],
      drop: (id) => void this.#straws.delete(id),
    };
  }
}

export class Tab {
  #browser;
  #waits = [];
  now = 0;
  /** @type {Sitting} */
  sitting;
  isClosed = false;
  /** What waited when the page was opened. */
  atFirst = {};

  constructor(browser, name) {
    this.#browser = browser;
    this.name = name;
  }

  async start() {
    const browser = this.#browser;
    const wait = (run) => void this.#waits.push(run);
    this.outbox = new Outbox({
      store: browser.parcels,
      send: parcelSender(),
      report: (news) => {
        if (!this.isClosed) this.sitting?.hear(news);
        for (const other of browser.tabs.filter((one) => one !== this))
          other.sitting?.hear({ ...structuredClone(news), isElsewhere: true });
      },
      wait,
    });
    const journal = new Journal({
      shelf: browser.shelf,
      belongings: browser.belongings(this.name),
      lastStraw: browser.lastStraw,
    });
    this.sitting = await Sitting.of(browser.data(), {
      journal,
      outbox: this.outbox,
      wait,
      now: () => this.now,
      newId: () => browser.newId(),
      client: () => ({}),
    });
    this.atFirst = { ...this.sitting.pending };
    await this.outbox.flush();
    await this.settle();
  }

  /** All that a while would bring: the log goes out, the outbox tries again. */
  async settle() {
    for (let i = 0; i < 8; i += 1) {
      for (const run of this.#waits.splice(0)) if (!this.isClosed) run();
      await new Promise((resolve) => setTimeout(resolve, 1));
      await this.outbox.flush();
    }
  }

  /** Closed by a person, or (killed) by nothing that asks. */
  close({ isKilled = false } = {}) {
    if (!isKilled) this.sitting.pause();
    this.isClosed = true;
    this.#browser.letGo(this.name);
  }

  top(id, outcome = "success") {
    this.now += 1000;
    return this.sitting.do({ type: "place", means: "mouse", outcome, id, group: 0, joins: false });
  }

  get order() {
    return flat(this.sitting.orders.success).join("");
  }
}

function json(status, answer) {
  return new Response(JSON.stringify(answer), { status });
}

function refused({ status, code, fields = {} }) {
  return json(status, { error: { code, message: `refused: ${code}`, fields } });
}
