/**
 * One slider between two groups: how much better is the one above? Unset until a first key or press says something, for
 * a default would be taken for an answer. It tells what was said once the hand has let go, not on the way there.
 */

import { FAR, HARDLY } from "#js/rankings/magnitude.js";

/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */

/** Where the thumb of an unset slider waits, unseen. */
const MIDDLE = 50;

export class GapSlider {
  element;
  #input;
  #value;
  #takeBack;
  #onSay;
  /** @type {number | null} */
  #said = null;
  /** @type {Means} */
  #means = "key";
  #isKeyDown = false;
  #isWaiting = false;

  /** @param {HTMLTemplateElement} template @param {(value: number | null, means: Means) => void} onSay */
  constructor(template, onSay) {
    this.#onSay = onSay;
    this.element = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    this.#input = /** @type {HTMLInputElement} */ (this.element.querySelector("input"));
    this.#value = /** @type {HTMLElement} */ (this.element.querySelector(".gap-value"));
    this.#takeBack = /** @type {HTMLButtonElement} */ (this.element.querySelector("button"));
    [this.#input.min, this.#input.max] = [String(HARDLY), String(FAR)];
    this.#listen();
  }

  /** @param {number | null} value @param {string} question */
  show(value, question) {
    this.#said = value;
    this.#isWaiting = false;
    this.#input.value = String(value ?? MIDDLE);
    this.#input.setAttribute("aria-label", question);
    this.#takeBack.setAttribute("aria-label", `Take back: ${question}`);
    this.#draw(value);
  }

  #listen() {
    const input = this.#input;
    input.addEventListener("pointerdown", ({ pointerType }) => {
      this.#means = pointerType === "touch" || pointerType === "pen" ? pointerType : "mouse";
    });
    // A finger that turned out to scroll the page has said nothing.
    input.addEventListener("pointercancel", () => this.show(this.#said, input.ariaLabel ?? ""));
    input.addEventListener("keydown", (event) => this.#onKeyDown(event));
    input.addEventListener("keyup", () => this.#onKeyUp());
    input.addEventListener("blur", () => this.#onKeyUp());
    input.addEventListener("input", () => this.#draw(Number(input.value)));
    input.addEventListener("change", () => this.#onChange());
    // A press right where the thumb waits changes nothing, and is an answer all the same.
    input.addEventListener("click", () => this.#said === null && this.#say(Number(input.value)));
    this.#takeBack.addEventListener("click", () => this.#forget("button"));
  }

  /** @param {KeyboardEvent} event */
  #onKeyDown(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    this.#means = "key";
    this.#isKeyDown = true;
    const isUnset = this.#said === null && !this.#isWaiting;
    if (event.key === "Delete" || event.key === "Backspace") this.#forget("key");
    else if (isUnset && (event.key === " " || event.key === "Enter")) this.#say(Number(this.#input.value));
    else return;
    event.preventDefault();
  }

  /** A key that is held changes the value many times; what it comes to is one answer. */
  #onChange() {
    if (this.#isKeyDown) this.#isWaiting = true;
    else this.#say(Number(this.#input.value));
  }

  #onKeyUp() {
    this.#isKeyDown = false;
    if (this.#isWaiting) this.#say(Number(this.#input.value));
  }

  /** @param {number} value */
  #say(value) {
    this.#isWaiting = false;
    this.#onSay(value, this.#means);
  }

  /** @param {Means} means */
  #forget(means) {
    const hadSaid = this.#said !== null;
    this.show(this.#said, this.#input.ariaLabel ?? "");
    if (!hadSaid) return;
    this.#onSay(null, means);
    this.#input.focus({ preventScroll: true });
  }

  /** @param {number | null} value */
  #draw(value) {
    this.element.dataset.said = String(value !== null);
    this.#value.textContent = value === null ? "not said yet" : String(value);
    this.#input.setAttribute("aria-valuetext", value === null ? "not said yet" : `${value} of ${FAR}`);
    this.#takeBack.hidden = value === null;
  }
}
