/**
 * One question of "Why" as a part that opens: nothing is asked before. While an answer is under way the one before stands,
 * quietly marked; what went wrong is said in a sentence, with a way to ask again where that may help.
 * @import {Send, Trouble} from "#js/comparisons/why/asking.js"
 */
import { Asking } from "#js/comparisons/why/asking.js";
import { announce } from "#js/lib/announce.js";

/** An answer within this time comes as if at once: no word about waiting. */
const QUIET_MS = 300;

/** @template Answer */
export class Panel {
  #details;
  #draw;
  #asking;
  #timer = 0;

  /**
   * @param {HTMLDetailsElement} details
   * @param {(answer: Answer) => string} draw shows an answer and returns it as a sentence
   * @param {AbortSignal} signal
   */
  constructor(details, draw, signal) {
    this.#details = details;
    this.#draw = draw;
    this.#asking = /** @type {Asking<Answer>} */ (
      new Asking({
        wait: () => this.#wait(),
        answer: (answer) => this.#answer(answer),
        fail: (trouble) => this.#fail(trouble),
      })
    );
    this.part("again").addEventListener("click", () => this.#asking.again(), { signal });
    window.addEventListener("online", () => this.#asking.again(), { signal });
    signal.addEventListener("abort", () => {
      clearTimeout(this.#timer);
      this.#asking.stop();
    });
  }

  get isOpen() {
    return this.#details.open;
  }

  set isOpen(isOpen) {
    this.#details.open = isOpen;
  }

  /** @param {string} question the same for the same @param {Send} send */
  ask(question, send) {
    this.#asking.ask(question, send);
  }

  /** Neither an answer nor a question. */
  clear() {
    this.#asking.stop();
    this.#settle("empty");
  }

  /** A part of the markup; which element it is stands in the template. @param {string} name @returns {any} */
  part(name) {
    return this.#details.querySelector(`[data-why="${name}"]`);
  }

  #wait() {
    clearTimeout(this.#timer);
    this.part("trouble").hidden = true;
    this.#details.dataset.asking = "true";
    this.#timer = window.setTimeout(() => {
      this.part("body").setAttribute("aria-busy", "true");
    }, QUIET_MS);
  }

  /** @param {Answer} answer */
  #answer(answer) {
    const isNew = this.#details.dataset.asking === "true";
    this.#settle("answered");
    const sentence = this.#draw(answer);
    this.part("sentence").textContent = sentence;
    if (isNew) announce(sentence);
  }

  /** @param {Trouble} trouble */
  #fail({ sentence, mayRetry }) {
    // An answer to another question may stand there still; it fades.
    this.#settle(this.#details.dataset.state === "empty" ? "empty" : "outdated");
    this.part("trouble").hidden = false;
    this.part("trouble-words").textContent = sentence;
    this.part("again").hidden = !mayRetry;
    announce(sentence);
  }

  /** @param {"empty" | "answered" | "outdated"} state */
  #settle(state) {
    clearTimeout(this.#timer);
    this.#details.dataset.asking = "false";
    this.#details.dataset.state = state;
    this.part("body").removeAttribute("aria-busy");
    this.part("trouble").hidden = true;
    this.part("answer").hidden = state === "empty";
  }
}
