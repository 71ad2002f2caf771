/**
 * Choosing a what-if: first one of the attempts, then what should have been otherwise with it. Both by mouse and by
 * keyboard: the attempts are one group of radio buttons.
 * @import {About} from "#js/comparisons/why/about.js"
 * @import {Attempt, Change} from "#js/comparisons/why/types.js"
 */
import { canBeCalledOtherwise, OUTCOMES, partnersOf } from "#js/comparisons/why/attempts.js";
import { pathBoard } from "#js/comparisons/why/path-board.js";
import { capital, factsOf, nameOf, standingOf } from "#js/comparisons/why/words.js";

export class Chooser {
  #root;
  #about;
  #onChange;
  /** @type {Change | null} */
  #change = null;

  /**
   * @param {HTMLElement} root
   * @param {About} about
   * @param {(change: Change) => void} onChange
   * @param {AbortSignal} signal
   */
  constructor(root, about, onChange, signal) {
    this.#root = root;
    this.#about = about;
    this.#onChange = onChange;
    for (const outcome of OUTCOMES) this.#fill(outcome);
    this.#part("attempts").addEventListener("change", () => this.#offer(), { signal });
    this.#part("drop").addEventListener("click", () => this.#ask((id) => ({ drop: id })), { signal });
    this.#part("relabel").addEventListener("click", () => this.#ask((id) => ({ relabel: id })), { signal });
    this.#part("partner").addEventListener("change", () => this.#ask((id) => this.#swapOf(id)), { signal });
    this.#offer();
  }

  /** What is asked just now, or nothing. @param {Change | null} change */
  set change(change) {
    this.#change = change;
    const id = change && idOf(change);
    for (const radio of this.#radios) radio.checked = id === null ? radio.checked : radio.value === id;
    this.#offer();
  }

  focus() {
    (this.#radios.find((radio) => radio.checked) ?? this.#radios[0])?.focus();
  }

  /** @param {"success" | "failure"} outcome */
  #fill(outcome) {
    const attempts = this.#about.attempts.filter((one) => one.outcome === outcome);
    this.#part(outcome).replaceChildren(...attempts.map((attempt) => this.#card(attempt)));
    this.#part(`${outcome}-group`).hidden = attempts.length === 0;
    this.#part(`${outcome}-title`).textContent = titleOf(attempts, this.#about.voice);
  }

  /** @param {Attempt} attempt */
  #card(attempt) {
    const template = /** @type {HTMLTemplateElement} */ (this.#root.querySelector("#why-attempt"));
    const card = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    const part = (/** @type {string} */ name) =>
      /** @type {HTMLElement} */ (card.querySelector(`[data-why="${name}"]`));
    const board = pathBoard(this.#about.world, attempt);
    board.setAttribute("aria-hidden", "true");
    part("board").append(board);
    part("name").textContent = capital(nameOf(attempt));
    part("facts").textContent = factsOf(attempt);
    part("standing").textContent = standingOf(attempt);
    /** @type {HTMLInputElement} */ (card.querySelector("input")).value = attempt.id;
    return card;
  }

  /** What can be otherwise with the attempt that is chosen. */
  #offer() {
    const chosen = this.#chosen;
    this.#part("changes").hidden = !chosen;
    this.#part("hint").hidden = Boolean(chosen);
    if (!chosen) return;
    const other = chosen.outcome === "success" ? "failure" : "success";
    const partners = partnersOf(this.#about.attempts, chosen);
    this.#part("chosen").textContent = `What if ${this.#about.voice.your} ${nameOf(chosen)} …`;
    this.#part("relabel").textContent = `were called a ${other}`;
    this.#part("relabel").disabled = !canBeCalledOtherwise(chosen);
    this.#part("never").hidden = canBeCalledOtherwise(chosen);
    this.#part("swap").hidden = partners.length === 0;
    this.#part("partner").replaceChildren(
      new Option("choose one", ""),
      ...partners.map((one) => new Option(`the ${nameOf(one)}`, one.id)),
    );
    this.#press(chosen);
  }

  /** The change that is answered stands pressed. @param {Attempt} chosen */
  #press({ id }) {
    const change = this.#change && idOf(this.#change) === id ? this.#change : null;
    this.#part("drop").setAttribute("aria-pressed", String(change !== null && "drop" in change));
    this.#part("relabel").setAttribute("aria-pressed", String(change !== null && "relabel" in change));
    this.#part("partner").value = change && "swap" in change ? change.swap[1] : "";
  }

  /** @param {(id: string) => Change | null} make */
  #ask(make) {
    const change = this.#chosen ? make(this.#chosen.id) : null;
    if (!change) return;
    this.#change = change;
    if (this.#chosen) this.#press(this.#chosen);
    this.#onChange(change);
  }

  /** @param {string} id @returns {Change | null} */
  #swapOf(id) {
    const partner = this.#part("partner").value;
    return partner ? { swap: [id, partner] } : null;
  }

  /** @returns {Attempt | undefined} */
  get #chosen() {
    const id = this.#radios.find((radio) => radio.checked)?.value;
    return this.#about.attempts.find((one) => one.id === id);
  }

  /** @returns {HTMLInputElement[]} */
  get #radios() {
    return [...this.#root.querySelectorAll('input[name="why-attempt"]')].map(
      (radio) => /** @type {HTMLInputElement} */ (radio),
    );
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-why="${name}"]`);
  }
}

/** The attempt that a change is about; of a swap the first. @param {Change} change */
export function idOf(change) {
  if ("drop" in change) return change.drop;
  return "relabel" in change ? change.relabel : change.swap[0];
}

/** "Your successes, best first". @param {Attempt[]} attempts @param {import("#js/comparisons/voice.js").Voice} voice */
function titleOf(attempts, { Your }) {
  const [first] = attempts;
  if (!first) return "";
  const isSuccess = first.outcome === "success";
  if (attempts.length === 1) return `${Your} ${first.outcome}`;
  const order = !first.isOrdered ? "in the order played" : isSuccess ? "best first" : "worst first";
  return `${Your} ${isSuccess ? "successes" : "failures"}, ${order}`;
}
