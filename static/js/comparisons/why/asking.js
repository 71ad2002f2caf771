/**
 * One question at a time, and the newest wins: the answer to an older one is never heard. What was answered is kept, for
 * a run never changes and so the same question has the same answer. No DOM here.
 */
import { ApiError } from "#js/lib/api.js";

/** @typedef {{ sentence: string, mayRetry: boolean }} Trouble */
/**
 * @template Answer
 * @typedef {object} Listener
 * @property {() => void} wait                    an answer is under way; the one before may stand until it comes
 * @property {(answer: Answer) => void} answer
 * @property {(trouble: Trouble) => void} fail
 */
/** @typedef {(options: { signal: AbortSignal }) => Promise<any>} Send */

const GONE = "This run is no longer there: it was deleted, or its link was taken back.";

/** A server that is busy, or just starting, is asked again by itself after such pauses, before anybody is told. */
const PAUSES_MS = [400, 1_200, 3_000];

/** @template Answer */
export class Asking {
  #listener;
  #pausesMs;
  #call = new AbortController();
  /** @type {Map<string, Answer>} */
  #known = new Map();
  /** @type {{ name: string, send: Send } | null} the question that has no answer yet */
  #open = null;
  /** The question whose answer was heard last. */
  #heard = "";

  /** @param {Listener<Answer>} listener @param {number[]} [pausesMs] */
  constructor(listener, pausesMs = PAUSES_MS) {
    this.#listener = listener;
    this.#pausesMs = pausesMs;
  }

  /**
   * @param {string} name the same for the same question
   * @param {Send} send
   */
  ask(name, send) {
    const isUnderWay = this.#open?.name === name && !this.#call.signal.aborted;
    if (isUnderWay || (!this.#open && this.#heard === name)) return;
    this.#drop();
    const known = this.#known.get(name);
    if (known !== undefined) return this.#tell(name, known);
    this.#open = { name, send };
    void this.#send();
  }

  /** Once more: somebody pressed "Ask again", or the network is back. */
  again() {
    this.#call.abort();
    if (this.#open) void this.#send();
  }

  /** Neither what is under way nor what was heard is wanted any more. */
  stop() {
    this.#drop();
    this.#heard = "";
  }

  #drop() {
    this.#call.abort();
    this.#open = null;
  }

  /** @param {string} name @param {Answer} answer */
  #tell(name, answer) {
    this.#heard = name;
    this.#listener.answer(answer);
  }

  async #send() {
    const { name, send } = /** @type {{ name: string, send: Send }} */ (this.#open);
    const call = new AbortController();
    this.#call = call;
    this.#listener.wait();
    try {
      const answer = await this.#persist(send, call.signal);
      if (call.signal.aborted) return;
      this.#open = null;
      this.#known.set(name, answer);
      this.#tell(name, answer);
    } catch (error) {
      if (call.signal.aborted) return;
      call.abort(); // over: the same question may be asked again
      this.#listener.fail(troubleOf(error));
    }
  }

  /** @param {Send} send @param {AbortSignal} signal */
  async #persist(send, signal) {
    for (const pause of this.#pausesMs) {
      try {
        return await send({ signal });
      } catch (error) {
        if (signal.aborted || !(error instanceof ApiError && error.isTemporary)) throw error;
        await new Promise((resume) => setTimeout(resume, pause));
        signal.throwIfAborted();
      }
    }
    return send({ signal });
  }
}

/** @param {unknown} error @returns {Trouble} */
export function troubleOf(error) {
  if (!(error instanceof ApiError)) throw error;
  if (error.status === 404) return { sentence: GONE, mayRetry: false };
  // A conflict (another question of the same visitor) passes, and what took too long may be quicker when less is going on.
  const mayPass = error.isTemporary || error.status === 409 || error.code === "too_slow";
  return { sentence: error.message, mayRetry: mayPass };
}
