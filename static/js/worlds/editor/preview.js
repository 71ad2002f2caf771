/**
 * Asks the server what a world is like, a moment after the last change. Only the newest question counts: an answer to
 * an older one is never heard. While the server is silent the question is asked again. No DOM here.
 */

import { ApiError } from "#js/lib/api.js";

/** @typedef {import("#js/board/state.js").World & {spec: import("#js/worlds/query.js").Spec}} PreviewWorld */
/**
 * @typedef {object} Listener
 * @property {(world: PreviewWorld) => void} answer
 * @property {(problem: {message: string, fields: Record<string, string>}) => void} refuse
 * @property {() => void} miss      the server cannot be reached
 */

const PAUSE_MS = 150;
const RETRY_MS = 4_000;

export class Preview {
  #get;
  #listener;
  #pauseMs;
  #retryMs;
  #timer = /** @type {ReturnType<typeof setTimeout> | undefined} */ (undefined);
  #call = new AbortController();
  #query = "";

  /**
   * @param {(path: string, options: {signal: AbortSignal}) => Promise<any>} get
   * @param {Listener} listener
   * @param {{pauseMs?: number, retryMs?: number}} [pauses]
   */
  constructor(get, listener, { pauseMs = PAUSE_MS, retryMs = RETRY_MS } = {}) {
    this.#get = get;
    this.#listener = listener;
    this.#pauseMs = pauseMs;
    this.#retryMs = retryMs;
  }

  /** @param {string} query */
  ask(query) {
    this.stop();
    this.#query = query;
    this.#timer = setTimeout(() => this.#send(), this.#pauseMs);
  }

  /** Once more and at once, for instance when the network is back. */
  askAgain() {
    if (this.#query === "") return;
    this.stop();
    void this.#send();
  }

  /** What is under way is no longer wanted. */
  stop() {
    clearTimeout(this.#timer);
    this.#call.abort();
  }

  async #send() {
    this.#call = new AbortController();
    const { signal } = this.#call;
    try {
      const world = await this.#get(`/worlds/preview?${this.#query}`, { signal });
      if (signal.aborted) return;
      this.#query = "";
      this.#listener.answer(world);
    } catch (error) {
      if (!signal.aborted) this.#fail(error);
    }
  }

  /** @param {unknown} error */
  #fail(error) {
    if (!(error instanceof ApiError)) throw error;
    if (error.isTemporary) {
      this.#timer = setTimeout(() => this.#send(), this.#retryMs);
      this.#listener.miss();
      return;
    }
    this.#query = "";
    this.#listener.refuse({ message: error.message, fields: /** @type {Record<string, string>} */ (error.fields) });
  }
}
