/** What can be done to a card, whoever does it: a key, a button, a drag. Each becomes a change of the sitting and is announced. */

import { announce } from "#js/lib/announce.js";
import { displayRanks, flat, groupOf, isInTie, sortByScore, step, toggleTie, weights } from "#js/rankings/order.js";
import { say, weightText } from "#js/rankings/sentences.js";

/** @typedef {import("#js/rankings/card.js").Card} Card */
/** @typedef {import("#js/rankings/group-list.js").GroupList} GroupList */
/** @typedef {import("#js/rankings/order.js").Place} Place */
/** @typedef {import("#js/rankings/sentences.js").Told} Told */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */

export class Hands {
  #sitting;
  #lists;
  #onCompare;
  /** The first of two to compare. @type {Card | null} */
  #marked = null;

  /** @param {{sitting: import("#js/rankings/sitting.js").Sitting, lists: Record<Outcome, GroupList>, onCompare: (outcome: Outcome, a: string, b: string, means: Means) => void}} parts */
  constructor({ sitting, lists, onCompare }) {
    this.#sitting = sitting;
    this.#lists = lists;
    this.#onCompare = onCompare;
  }

  /** The card around an element of the page. @param {Element | null} element @returns {{card: Card, list: GroupList} | null} */
  find(element) {
    const { demonstrationId = "", list: outcome } =
      /** @type {HTMLElement | null} */ (element?.closest(".card"))?.dataset ?? {};
    const list = this.#lists[/** @type {Outcome} */ (outcome)];
    const card = list?.card(demonstrationId);
    return card ? { card, list } : null;
  }

  /** @param {Card} card */
  isLifted({ id }) {
    return this.#sitting.state.lifted === id;
  }

  /** @param {Card} card */
  lift(card) {
    this.#sitting.do({ type: "lift", means: "key", outcome: outcomeOf(card), id: card.id });
    announce(say.lifted(this.#told(card)));
  }

  /** Put down what is lifted; said only where the card is told. @param {Card} [card] */
  drop(card) {
    if (this.#sitting.state.lifted === null) return;
    this.#sitting.do({ type: "drop", means: "key" });
    if (card) announce(say.putDown(this.#told(card)));
  }

  /** @param {Card} card */
  putBack(card) {
    this.#sitting.do({ type: "put_back", means: "key" });
    this.sayPutBack(card);
  }

  /** @param {Card} card */
  sayPutBack(card) {
    announce(say.putBack(this.#told(card)));
  }

  /** Past so many groups, up below 0. @param {Card} card @param {number} by @param {Means} means */
  step(card, by, means) {
    const where = step(this.#orderOf(card), card.id, by);
    if (where === null) announce(say.noFurther(by < 0 ? -1 : 1));
    else {
      this.#place(card, where, means);
      announce(means === "key" ? say.stepped(this.#told(card)) : say.placed(this.#told(card)));
    }
  }

  /** @param {Card} card @param {Means} means */
  tie(card, means) {
    const where = toggleTie(this.#orderOf(card), card.id);
    if (where === null) announce(say.nothingAbove);
    else {
      this.#place(card, where, means);
      this.#sayTie(card);
    }
  }

  /** @param {Card} card @param {Place} where @param {Means} means */
  land(card, where, means) {
    this.#place(card, where, means);
    if (where.joins) this.#sayTie(card);
    else announce(say.placed(this.#told(card)));
  }

  /** The first card is marked, with the second both are looked at side by side. @param {Card} card @param {Means} means */
  compare(card, means) {
    const first = this.#marked;
    if (
      first &&
      outcomeOf(first) === outcomeOf(card) &&
      first !== card &&
      this.#orderOf(first).flat().includes(first.id)
    ) {
      this.#mark(null);
      this.#onCompare(outcomeOf(card), first.id, card.id, means);
    } else if (first === card) this.unmark();
    else {
      this.#mark(card);
      announce(say.marked(this.#told(card), means === "key"));
    }
  }

  /** @returns {boolean} whether there was a mark */
  unmark() {
    if (!this.#marked) return false;
    this.#mark(null);
    announce(say.unmarked);
    return true;
  }

  /** @param {Outcome} outcome @param {ReadonlyMap<string, any>} demonstrations */
  sort(outcome, demonstrations) {
    const before = this.#sitting.orders[outcome];
    const totals = new Map(flat(before).map((id) => [id, demonstrations.get(id)?.total ?? 0]));
    const order = sortByScore(before, totals, outcome);
    const isNew = this.#sitting.do({ type: "set", means: "button", outcome, order, by: "score" });
    announce(isNew ? say.sorted(outcome) : say.sortedAlready);
  }

  /** Go to another card of the list: so many on, up below 0. @param {Card} card @param {number} by */
  goTo(card, by) {
    const ids = flat(this.#orderOf(card));
    const to = Math.min(ids.length - 1, Math.max(0, ids.indexOf(card.id) + by));
    this.#lists[outcomeOf(card)].card(ids[to])?.element.focus();
  }

  /** @param {Card} card @param {Place} where @param {Means} means */
  #place(card, { group, joins }, means) {
    this.#sitting.do({ type: "place", means, outcome: outcomeOf(card), id: card.id, group, joins });
  }

  /** @param {Card} card */
  #sayTie(card) {
    const isTied = isInTie(this.#orderOf(card), card.id);
    announce((isTied ? say.tied : say.parted)(this.#told(card)));
  }

  /** @param {Card | null} card */
  #mark(card) {
    for (const one of [this.#marked, card]) {
      if (!one) continue;
      one.element.dataset.marked = String(one === card);
      one.button("compare").setAttribute("aria-pressed", String(one === card));
    }
    this.#marked = card;
  }

  /** @param {Card} card */
  #orderOf(card) {
    return this.#sitting.orders[outcomeOf(card)];
  }

  /** @param {Card} card @returns {Told} */
  #told(card) {
    const [order, list] = [this.#orderOf(card), this.#lists[outcomeOf(card)]];
    const [theta, others] = [weights(order), (order[groupOf(order, card.id)] ?? []).filter((id) => id !== card.id)];
    const n = theta.size;
    return {
      words: card.words,
      standing: { rank: displayRanks(order).get(card.id) ?? n, n, nOthers: others.length },
      weight: weightText(theta.get(card.id) ?? 0, n),
      tiedWith: others.map((id) => list.card(id)?.words ?? ""),
    };
  }
}

/** @param {Card} card @returns {Outcome} */
function outcomeOf({ demonstration }) {
  return demonstration.outcome;
}
