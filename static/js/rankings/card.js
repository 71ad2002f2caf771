/** One attempt as a card: its path on a small board, its figures, its place, and the weight θ it has or would have. */

import { plural, signed } from "#js/lib/format.js";
import { cardWords, labelOf, timeText, weightText } from "#js/rankings/sentences.js";

/** @typedef {import("#js/rankings/sentences.js").Standing} Standing */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */
/** @typedef {{id: string, outcome: Outcome, states: number[], actions: number[], total: number, step_ms?: number[] | null}} Demonstration */

/** Where a card stands: `position` 1-based among all, `of` what may be done from there. @typedef {Standing & {position: number, isFirst: boolean, isLast: boolean}} Stand */

export class Card {
  #world;
  #isDrawn = false;

  /** @param {HTMLTemplateElement} template @param {any} world @param {Demonstration} demonstration @param {boolean} showTotals */
  constructor(template, world, demonstration, showTotals) {
    this.#world = world;
    this.demonstration = demonstration;
    this.element = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    this.board = /** @type {IrlBoard} */ (this.#part("irl-board"));
    this.words = cardWords(demonstration, showTotals);
    this.#fill();
  }

  get id() {
    return this.demonstration.id;
  }

  /** The small board is painted when it first comes near the window: forty large worlds would take a while. */
  draw() {
    if (this.#isDrawn) return;
    this.#isDrawn = true;
    this.board.world = this.#world;
    this.board.view = { ...this.board.view, paths: [{ states: this.demonstration.states, who: "human", width: 0.7 }] };
  }

  /** @param {Stand} stand */
  standAt({ position, rank, n, nOthers, isFirst, isLast }) {
    const { element } = this;
    const isTied = nOthers > 0;
    element.dataset.position = String(position);
    element.dataset.rank = String(rank);
    element.dataset.tied = String(isTied);
    element.setAttribute("aria-label", labelOf(this.words, { rank, n, nOthers }));
    this.button("up").disabled = isFirst && !isTied;
    this.button("down").disabled = isLast && !isTied;
    this.button("compare").disabled = n === 1;
    const tie = this.button("tie");
    tie.disabled = isFirst && !isTied;
    tie.setAttribute("aria-pressed", String(isTied));
    tie.title = isTied ? "Take it out of the tie" : "Tie with the one above";
  }

  /** θ as it is and, if it would change, as it would be. @param {number} weight @param {number} n @param {number} [would] */
  weigh(weight, n, would = weight) {
    const { element } = this;
    element.dataset.weight = weight.toFixed(6);
    const change = Math.sign(Number((would - weight).toFixed(9)));
    if (change === 0) delete element.dataset.would;
    else element.dataset.would = would.toFixed(6);
    this.#part(".card-theta").textContent = weightText(would, n);
    this.#part(".card-change").textContent = ["▾", "", "▴"][change + 1];
    // The whole width is what the first of so many has: the bars of two orders can be compared.
    const share = (/** @type {number} */ theta) => `${((100 * theta * (n + 1)) / 2).toFixed(2)}%`;
    this.#part(".card-bar-fill").style.inlineSize = share(would);
    const ghost = this.#part(".card-bar-ghost");
    ghost.hidden = change === 0;
    ghost.style.insetInlineStart = share(weight);
  }

  /** @param {"up" | "down" | "tie" | "compare"} act */
  button(act) {
    return /** @type {HTMLButtonElement} */ (this.#part(`[data-act="${act}"]`));
  }

  /** Only one card of a list is on the way of the Tab key, with its buttons; arrows lead to the others. @param {boolean} isCurrent */
  setCurrent(isCurrent) {
    /** @type {HTMLElement} */ for (const one of [this.element, ...this.element.querySelectorAll("button")])
      one.tabIndex = isCurrent ? 0 : -1;
  }

  #fill() {
    const { id, outcome, actions, total, step_ms: stepMs } = this.demonstration;
    this.element.dataset.demonstrationId = id;
    this.element.dataset.list = outcome;
    // Where a study hides the totals, the card has no place for one.
    const earned = this.element.querySelector(".card-total");
    if (earned) earned.textContent = signed(total);
    this.#part(".card-steps").textContent = plural(actions.length, "step");
    this.#part(".card-time").textContent = stepMs ? timeText(stepMs) : "";
    this.board.label = `The path of a ${outcome}`;
  }

  /** @param {string} selector */
  #part(selector) {
    return /** @type {HTMLElement} */ (this.element.querySelector(selector));
  }
}
