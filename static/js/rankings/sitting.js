/** One person's work on the orders of one world: the state, the log of what led there, and how it reaches the server. */

import { api } from "#js/lib/api.js";
import { reconcile } from "#js/rankings/order.js";
import { apply, beginState, SILENT } from "#js/rankings/sitting-state.js";

/** @typedef {import("#js/rankings/sitting-state.js").State} State */
/** @typedef {import("#js/rankings/sitting-state.js").Change} Change */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {Change & {n: number, at_ms: number}} Event */

export class Sitting {
  #worldId;
  #state;
  /** @type {Event[]} */
  #log = [];
  #began = performance.now();
  /** @type {Set<(state: State, event: Event) => void>} */
  #listeners = new Set();

  /** @param {{worldId: string, begin: Change}} parts */
  constructor({ worldId, begin }) {
    this.#worldId = worldId;
    this.#state = beginState(begin);
    this.#append(begin);
  }

  /** From the page data: the order confirmed last, else the one the server drew. @param {any} data @returns {Promise<Sitting>} */
  static async open(data) {
    const from = (/** @type {Outcome} */ outcome) => data.rankings[outcome]?.order ?? [];
    const orderOf = (/** @type {Outcome} */ outcome) => {
      const kept = data.demonstrations.filter((/** @type {any} */ one) => one.outcome === outcome && !one.discarded);
      const ids = new Set(kept.map((/** @type {any} */ one) => one.id));
      const known = new Set(from(outcome).flat());
      const added = data.start_order[outcome].filter((/** @type {string} */ id) => ids.has(id) && !known.has(id));
      return reconcile(
        from(outcome),
        added,
        [...known].filter((id) => !ids.has(id)),
      );
    };
    const orders = { success: orderOf("success"), failure: orderOf("failure") };
    const way = data.options.ways[0];
    return new Sitting({ worldId: data.world.id, begin: { type: "begin", means: "page", orders, way } });
  }

  get state() {
    return this.#state;
  }

  get orders() {
    return this.#state.present.orders;
  }

  /** @param {Change} change @returns {boolean} whether anything came of it */
  do(change) {
    const next = apply(this.#state, change);
    if (next === null || (next === this.#state && !SILENT.has(change.type))) return false;
    this.#state = next;
    const event = this.#append(change);
    for (const listener of this.#listeners) listener(next, event);
    return true;
  }

  /** @param {(state: State, event: Event) => void} listener */
  subscribe(listener) {
    this.#listeners.add(listener);
  }

  /** @param {Outcome} outcome @param {{means: string, untouched?: boolean}} how */
  async confirm(outcome, { means, untouched = false }) {
    this.do({ type: "confirm", means, outcome, untouched });
    const body = { order: this.orders[outcome], confirmed: true };
    return { ranking: await api.put(`/worlds/${this.#worldId}/rankings/${outcome}`, body) };
  }

  /** @param {Change} change @returns {Event} */
  #append(change) {
    const event = { ...change, n: this.#log.length, at_ms: Math.round(10 * (performance.now() - this.#began)) / 10 };
    this.#log.push(event);
    return event;
  }
}
