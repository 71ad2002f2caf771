/** The two lists of cards: what is done to a card becomes a change of the sitting, and the sitting's orders are drawn. */

import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { CardList } from "#js/rankings/card-list.js";
import { CardKeys } from "#js/rankings/keyboard.js";
import { flat, isInTie, sortByScore, step, toggleTie, without } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/order.js").Place} Place */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */

/** @type {Outcome[]} */
const OUTCOMES = ["success", "failure"];

export class RankLists {
  #parts;
  /** @type {Record<Outcome, CardList>} */
  #lists = { success: this.#listOf("success"), failure: this.#listOf("failure") };

  /** @param {import("#js/rankings/rank.js").Parts & {root: HTMLElement, onWatch: (id: string, means: Means) => void, onCompare: (outcome: Outcome, a: string, b: string, means: Means) => void}} parts */
  constructor(parts) {
    this.#parts = parts;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const { root, world, demonstrations, sitting } = this.#parts;
    const template = /** @type {HTMLTemplateElement} */ (byId("rank-card"));
    for (const outcome of OUTCOMES) {
      const cards = flat(sitting.orders[outcome]).map((id) => demonstrations.get(id));
      this.#lists[outcome].fill(template, world, cards);
    }
    this.#keys.listen(root, signal);
    root.addEventListener("click", (event) => this.#onClick(event), { signal });
    sitting.subscribe(() => this.#show());
    this.#show();
  }

  /** Draw θ as it would be with another order; null: as it is. @param {Outcome} outcome @param {Order | null} order */
  preview(outcome, order) {
    this.#lists[outcome].showWeights(order ?? this.#parts.sitting.orders[outcome]);
  }

  /** @param {string} id */
  focus(id) {
    /** @type {HTMLElement | null} */ (document.querySelector(`.card[data-demonstration-id="${id}"]`))?.focus();
  }

  /** @param {((outcome: Outcome, above: readonly string[], below: readonly string[]) => HTMLElement | null) | null} render */
  setBetween(render) {
    this.between = render;
  }

  #keys = new CardKeys({
    place: (card, position) => this.#placeAt(card, outcomeOf(card), position, "key"),
    tie: (card) => this.#tie(card, "key"),
    lift: (card) => this.#parts.sitting.do({ type: "lift", means: "key", outcome: outcomeOf(card), id: idOf(card) }),
    drop: () => this.#parts.sitting.do({ type: "drop", means: "key" }),
    back: () => this.#parts.sitting.do({ type: "put_back", means: "key" }),
  });

  /** @param {Outcome} outcome */
  #listOf(outcome) {
    return new CardList(byId(`list-${outcome}`), outcome, (card, list, position) =>
      this.#placeAt(card, list, position, "mouse"),
    );
  }

  /** @param {HTMLElement} card @param {Outcome} outcome @param {number} position @param {Means} means */
  #placeAt(card, outcome, position, means) {
    this.#place(card, outcome, placeAt(this.#parts.sitting.orders[outcome], idOf(card), position), means);
  }

  /** @param {HTMLElement} card @param {Means} means */
  #tie(card, means) {
    const outcome = outcomeOf(card);
    this.#place(card, outcome, toggleTie(this.#parts.sitting.orders[outcome], idOf(card)), means);
    const isTied = isInTie(this.#parts.sitting.orders[outcome], idOf(card));
    announce(`${isTied ? "Tied" : "No longer tied"} with the one above. ${card.getAttribute("aria-label")}.`);
  }

  /** @param {HTMLElement} card @param {Outcome} outcome @param {Place | null} where @param {Means} means */
  #place(card, outcome, where, means) {
    if (where) this.#parts.sitting.do({ type: "place", means, outcome, id: idOf(card), ...where });
    this.#show();
    announce(`${card.getAttribute("aria-label")}. Weight ${Number(card.dataset.weight).toFixed(2)}.`);
  }

  #show() {
    for (const outcome of OUTCOMES) this.#lists[outcome].show(this.#parts.sitting.orders[outcome]);
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    const card = /** @type {HTMLElement | null} */ (button?.closest(".card") ?? null);
    const { act, sort } = button?.dataset ?? {};
    if (sort) this.#sort(/** @type {Outcome} */ (sort));
    if (!card || !button) return;
    const outcome = outcomeOf(card);
    const order = this.#parts.sitting.orders[outcome];
    if (act === "up") this.#place(card, outcome, step(order, idOf(card), -1), "button");
    else if (act === "down") this.#place(card, outcome, step(order, idOf(card), 1), "button");
    else if (act === "tie") this.#tie(card, "button");
    if (/** @type {HTMLButtonElement} */ (button).disabled) card.focus();
  }

  /** @param {Outcome} outcome */
  #sort(outcome) {
    const { sitting, demonstrations } = this.#parts;
    const totals = new Map([...demonstrations].map(([id, one]) => [id, one.total]));
    const order = sortByScore(sitting.orders[outcome], totals, outcome);
    sitting.do({ type: "set", means: "button", outcome, order, by: "score" });
    announce(outcome === "success" ? "Sorted by total, the highest first." : "Sorted by total, the lowest first.");
  }
}

/** From a position among all other cards to a place among the groups. @param {Order} order @param {string} id @param {number} position @returns {Place} */
function placeAt(order, id, position) {
  const others = without(order, id);
  let start = 0;
  for (const [group, { length }] of others.entries()) {
    if (position <= start) return { group, joins: false };
    if (position < start + length) return { group, joins: true };
    start += length;
  }
  return { group: others.length, joins: false };
}

/** @param {HTMLElement} card */
function idOf(card) {
  return card.dataset.demonstrationId ?? "";
}

/** @param {HTMLElement} card @returns {Outcome} */
function outcomeOf(card) {
  return card.dataset.list === "failure" ? "failure" : "success";
}
