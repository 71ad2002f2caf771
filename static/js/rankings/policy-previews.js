/**
 * Asks the server what would be learned from an order. One question is on its way at most, and one waits: the newest.
 * So answers come in the order of their questions, and none is older than what is shown. No page.
 */

import { ApiError } from "#js/lib/api.js";

/** @typedef {import("#js/rankings/policy-material.js").Question} Question */
/** @typedef {import("#js/rankings/policy-material.js").Preview} Preview */

/**
 * @typedef {object} Listener
 * @property {(preview: Preview, question: Question) => void} onAnswer
 * @property {(error: ApiError) => void} onRefusal   of the newest question
 * @property {(isAsking: boolean) => void} onAsking
 */

/** @typedef {(question: Question, options: {signal: AbortSignal}) => Promise<Preview>} Post */

/** While the server is silent or busy; longer if it says so. */
const RETRY_MS = 5_000;
/** A connection that neither answers nor breaks would keep all later questions waiting. */
const PATIENCE_MS = 20_000;

export class Previews {
  #post;
  #listener;
  #retryMs;
  /** The newest question, as text; "" once it was refused. */
  #newest = "";
  /** @type {Question | null} */
  #waiting = null;
  /** @type {AbortController | null} */
  #call = null;
  #timer = /** @type {ReturnType<typeof setTimeout> | undefined} */ (undefined);

  /** @param {Post} post @param {Listener} listener @param {{retryMs?: number}} [pauses] */
  constructor(post, listener, { retryMs = RETRY_MS } = {}) {
    this.#post = post;
    this.#listener = listener;
    this.#retryMs = retryMs;
  }

  /** Nothing is asked twice in a row. @param {Question} question */
  ask(question) {
    const text = JSON.stringify(question);
    if (text === this.#newest) return;
    clearTimeout(this.#timer);
    this.#newest = text;
    this.#waiting = question;
    if (!this.#call) void this.#send();
  }

  /** What is on its way or waits is no longer wanted. */
  stop() {
    clearTimeout(this.#timer);
    this.#call?.abort();
    [this.#call, this.#waiting, this.#newest] = [null, null, ""];
    this.#listener.onAsking(false);
  }

  async #send() {
    const question = this.#waiting;
    if (!question) return this.#listener.onAsking(false);
    const call = new AbortController();
    [this.#call, this.#waiting] = [call, null];
    this.#listener.onAsking(true);
    try {
      const preview = await this.#post(question, {
        signal: AbortSignal.any([call.signal, AbortSignal.timeout(PATIENCE_MS)]),
      });
      if (this.#call === call) this.#listener.onAnswer(preview, question);
    } catch (error) {
      if (this.#call === call) this.#fail(error, question);
    }
    if (this.#call !== call) return;
    this.#call = null;
    void this.#send();
  }

  /** Who has gone on to another question meanwhile need not hear of it. @param {unknown} error @param {Question} question */
  #fail(error, question) {
    if (this.#waiting) return;
    this.#newest = "";
    const refusal = asRefusal(error);
    if (refusal.isTemporary || refusal.code === "superseded")
      this.#timer = setTimeout(() => this.ask(question), Math.max(this.#retryMs, refusal.retryAfterMs ?? 0));
    this.#listener.onRefusal(refusal);
  }
}

/** For several who ask: the server takes a visitor's newer question for the end of the one before. @param {Post} post @returns {Post} */
export function inTurns(post) {
  /** @type {Promise<unknown>} */
  let last = Promise.resolve();
  return (question, options) => {
    const answer = last.then(() => post(question, options));
    last = answer.catch(() => {});
    return answer;
  };
}

/** @param {unknown} error */
function asRefusal(error) {
  if (error instanceof ApiError) return error;
  if (error instanceof DOMException)
    return new ApiError({ status: 0, code: "silent", message: "The server does not answer just now." });
  throw error;
}
