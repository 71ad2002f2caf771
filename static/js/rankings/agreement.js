/** How near a confirmed order comes to the totals: told only after confirming, only where it may be, and never as a reproach. */

import { ApiError, api } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { agreementSentence, capital, PLURAL, swappedSentence, watchWords } from "#js/rankings/confirm-words.js";
import { displayRanks, flat } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/standing.js").Ranking} Ranking */
/** @typedef {import("#js/rankings/standing.js").Newest} Newest */
/** @typedef {import("#js/rankings/confirm-words.js").Agreement} Agreement */

/** So many swapped pairs are shown before somebody asks for all. */
const FIRST = 6;

export class AgreementPanel {
  #worldId;
  #isAllowed;
  #cards;
  #onCompare;
  #panel = /** @type {HTMLDetailsElement} */ (byId("agreement"));
  /** @type {Ranking[]} */
  #rankings = [];
  #shown = "";

  /**
   * @param {object} parts
   * @param {string} parts.worldId
   * @param {boolean} parts.isAllowed
   * @param {import("#js/rankings/mini-cards.js").MiniCards} parts.cards
   * @param {(outcome: Outcome, a: string, b: string) => void} parts.onCompare
   */
  constructor({ worldId, isAllowed, cards, onCompare }) {
    this.#worldId = worldId;
    this.#isAllowed = isAllowed;
    this.#cards = cards;
    this.#onCompare = onCompare;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#panel.addEventListener("toggle", () => void this.#load(), { signal });
  }

  /** @param {Newest} newest @param {boolean} isConfirmed */
  show({ success, failure }, isConfirmed) {
    this.#rankings = [success, failure].filter((one) => one != null).filter(({ order }) => flat(order).length > 1);
    this.#panel.hidden = !this.#isAllowed || !isConfirmed || this.#rankings.length === 0;
    void this.#load();
  }

  /** Nothing is asked of the server before somebody wants to know. */
  async #load() {
    const print = JSON.stringify(this.#rankings.map(({ outcome, version }) => [outcome, version]));
    if (this.#panel.hidden || !this.#panel.open || print === this.#shown) return;
    this.#shown = print;
    const rankings = this.#rankings;
    const path = (/** @type {Ranking} */ { outcome }) => `/worlds/${this.#worldId}/rankings/${outcome}/agreement`;
    try {
      const told = await Promise.all(rankings.map((one) => api.get(path(one))));
      byId("agreement-lists").replaceChildren(...rankings.map((one, i) => this.#section(one, told[i])));
    } catch (error) {
      this.#shown = "";
      byId("agreement-lists").textContent = error instanceof ApiError ? error.message : "";
    }
  }

  /** @param {Ranking} ranking @param {Agreement} agreement */
  #section({ outcome, order }, agreement) {
    const { part, find } = copyOf("agreement-part");
    part.dataset.outcome = outcome;
    find("h3").textContent = capital(PLURAL[outcome]);
    find(".agreement-words").textContent = agreementSentence(agreement);
    const { swapped } = agreement;
    find(".agreement-swapped").textContent = swappedSentence(outcome, swapped.length);
    const [pairs, more] = [find(".swaps"), find(".swaps-more")];
    const ranks = displayRanks(order);
    const show = (/** @type {[string, string][]} */ some) =>
      pairs.append(...some.map((pair) => this.#pair(outcome, pair, ranks)));
    show(swapped.slice(0, FIRST));
    more.hidden = swapped.length <= FIRST;
    more.textContent = `Show all ${swapped.length} pairs`;
    more.addEventListener("click", () => {
      show(swapped.slice(FIRST));
      more.hidden = true;
      /** @type {HTMLElement | null} */ (pairs.children[FIRST]?.querySelector("button") ?? null)?.focus();
    });
    return part;
  }

  /** @param {Outcome} outcome @param {[string, string]} pair @param {Map<string, number>} ranks */
  #pair(outcome, [above, below], ranks) {
    const { part, find } = copyOf("agreement-pair");
    const cards = find(".swap-cards");
    for (const id of [above, below]) {
      const card = this.#cards.make(id);
      card.querySelector(".mini-place")?.replaceChildren(`${ranks.get(id)}.`);
      card.querySelector(".mini-said")?.prepend(`Place ${ranks.get(id)}: `);
      cards.append(card);
    }
    const watch = find("button");
    watch.setAttribute("aria-label", watchWords(outcome, ranks.get(above) ?? 0, ranks.get(below) ?? 0));
    watch.addEventListener("click", () => this.#onCompare(outcome, above, below));
    return part;
  }
}

/** @param {string} id */
function copyOf(id) {
  const template = /** @type {HTMLTemplateElement} */ (byId(id));
  const part = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
  const find = (/** @type {string} */ selector) => /** @type {HTMLElement} */ (part.querySelector(selector));
  return { part, find };
}
