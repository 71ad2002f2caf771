/**
 * Where the world being made is kept and passed on: in the address of the page; one too long for that in the entry of
 * the browser's history (which a reload keeps), and on the server once somebody shares or plays it.
 */

import { api } from "#js/lib/api.js";
import { toQuery } from "#js/worlds/query.js";

/** @typedef {import("#js/worlds/query.js").Spec} Spec */

const LONGEST = 8_000;
const PAUSE_MS = 250;

export class Address {
  /** @type {Spec} */
  #spec = {};
  #query = "";
  #timer = 0;
  /** @type {Promise<{id: string}> | null} */
  #stored = null;

  /** What a reload or a way back finds, if it was too long for the address. @returns {Spec | null} */
  static kept() {
    return history.state?.spec ?? null;
  }

  get query() {
    return this.#query;
  }

  get isLong() {
    return this.#query.length > LONGEST;
  }

  /** Browsers count how often an address changes, so a pull on a slider changes it once. @param {Spec} spec @param {string} query */
  show(spec, query) {
    if (query !== this.#query) this.#stored = null;
    this.#spec = spec;
    this.#query = query;
    clearTimeout(this.#timer);
    this.#timer = window.setTimeout(() => this.write(), PAUSE_MS);
  }

  write() {
    clearTimeout(this.#timer);
    if (!this.isLong) return history.replaceState(null, "", `/worlds/new?${this.#query}`);
    const { walls, painted, goals, start, ...numbers } = this.#spec;
    history.replaceState({ spec: this.#spec }, "", `/worlds/new?${toQuery(numbers)}`);
  }

  /** Where this world is played; null while that takes the server. */
  get playAddress() {
    return this.isLong ? null : `/?${this.#query}`;
  }

  /** The link that opens this world to play anywhere. */
  async link() {
    return new URL(this.playAddress ?? (await this.store()), location.href).href;
  }

  /** Store the world; its page. Asked twice, stored once. */
  async store() {
    this.#stored ??= api.post("/worlds", this.#spec);
    try {
      const { id } = await this.#stored;
      return `/worlds/${id}`;
    } catch (error) {
      this.#stored = null;
      throw error;
    }
  }
}
