/** One list of cards, drawn from an order: places, ties, weights; dragged by SortableJS, which only tells where a card went. */

import Sortable from "sortablejs";
import { number, plural, signed } from "#js/lib/format.js";
import { flat, isInTie, weights } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {"success" | "failure"} Outcome */
/** @typedef {{id: string, states: number[], actions: number[], total: number, outcome: Outcome}} Demonstration */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */

export class CardList {
  /** @type {Map<string, HTMLElement>} */
  #cards = new Map();
  /** @type {Order} */
  #order = [];

  /**
   * @param {HTMLElement} list
   * @param {Outcome} outcome
   * @param {(card: HTMLElement, list: Outcome, position: number) => void} place
   */
  constructor(list, outcome, place) {
    this.list = list;
    this.outcome = outcome;
    this.place = place;
  }

  /** @param {HTMLTemplateElement} template @param {import("#js/board/state.js").World} world @param {Demonstration[]} demonstrations */
  fill(template, world, demonstrations) {
    for (const demonstration of demonstrations) {
      const card = makeCard(template, world, demonstration);
      this.#cards.set(demonstration.id, card);
      this.list.append(card);
    }
    this.#makeSortable();
  }

  /** @param {Order} order */
  show(order) {
    this.#order = order;
    const ids = flat(order);
    const focused = document.activeElement;
    for (const id of ids) {
      const card = this.#cards.get(id);
      // Moving a node drops its focus and restarts its scroll: leave those that stand right.
      if (card && this.list.children[ids.indexOf(id)] !== card)
        this.list.insertBefore(card, this.list.children[ids.indexOf(id)] ?? null);
    }
    if (focused instanceof HTMLElement && focused !== document.activeElement && this.list.contains(focused))
      focused.focus();
    ids.forEach((id, i) => {
      this.#describe(id, i, ids.length);
    });
    this.showWeights(order);
  }

  /** @param {string} id @param {number} i @param {number} n */
  #describe(id, i, n) {
    const card = this.#cards.get(id);
    if (!card) return;
    const isTied = isInTie(this.#order, id);
    card.dataset.position = String(i + 1);
    card.dataset.tied = String(isTied);
    find(card, ".card-place").textContent = isTied ? "=" : `${this.#placeOf(id)}.`;
    const what = `${card.dataset.words}, place ${this.#placeOf(id)} of ${n}${isTied ? ", tied with the one above" : ""}`;
    card.setAttribute("aria-label", what);
    const [up, down, tie] = ["up", "down", "tie"].map(
      (act) => /** @type {HTMLButtonElement} */ (find(card, `[data-act="${act}"]`)),
    );
    if (up) up.disabled = i === 0;
    if (down) down.disabled = i === n - 1;
    if (tie) {
      tie.disabled = i === 0;
      tie.setAttribute("aria-pressed", String(isTied));
    }
  }

  /** Places as people count them: a tie shares its first. @param {string} id */
  #placeOf(id) {
    let place = 1;
    for (const group of this.#order) {
      if (group.includes(id)) return place;
      place += group.length;
    }
    return place;
  }

  /** @param {Order} order */
  showWeights(order) {
    const theta = weights(order);
    const largest = Math.max(...theta.values());
    for (const [id, weight] of theta) {
      const card = this.#cards.get(id);
      if (!card) continue;
      card.dataset.weight = weight.toFixed(6);
      for (const one of [card, flyingCopyOf(card)]) {
        if (!one) continue;
        find(one, ".card-theta").textContent = number(weight, 2);
        find(one, ".card-bar-fill").style.inlineSize = `${(100 * weight) / largest}%`;
      }
    }
  }

  #makeSortable() {
    const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
    Sortable.create(this.list, {
      group: this.outcome,
      animation: isStill ? 0 : 140,
      forceFallback: true,
      fallbackTolerance: 3,
      fallbackOnBody: true,
      draggable: ".card",
      filter: isNoGrip,
      preventOnFilter: false,
      ghostClass: "card--ghost",
      fallbackClass: "card--flying",
      onStart: ({ item }) => fillFlying(item),
      onEnd: ({ item, newDraggableIndex }) => this.place(item, this.outcome, newDraggableIndex ?? 0),
    });
  }
}

/**
 * A finger drags by the small board only, so that the rest of a card scrolls the page; a mouse drags by anything but a button.
 * @param {Event} event
 */
function isNoGrip(event) {
  const target = event.target instanceof Element ? event.target : null;
  if (target?.closest("button")) return true;
  const isTouch = event instanceof TouchEvent || (event instanceof PointerEvent && event.pointerType === "touch");
  return isTouch && !target?.closest(".card-grip");
}

/** The copy that follows the pointer while its card is dragged. @param {HTMLElement} card @returns {HTMLElement | null} */
function flyingCopyOf(card) {
  const copy = /** @type {HTMLElement | null} */ (document.querySelector(".card--flying"));
  return copy !== card && copy?.dataset.demonstrationId === card.dataset.demonstrationId ? copy : null;
}

/** A copied board is empty: give it what the card's own board shows. @param {HTMLElement} card */
function fillFlying(card) {
  const copy = flyingCopyOf(card);
  if (!copy) return;
  const [from, to] = [card, copy].map((one) => /** @type {IrlBoard} */ (find(one, "irl-board")));
  if (!from || !to) return;
  to.world = from.world;
  to.view = from.view;
}

/** @param {HTMLTemplateElement} template @param {import("#js/board/state.js").World} world @param {Demonstration} demonstration */
function makeCard(template, world, demonstration) {
  const card = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
  const { id, outcome, states, actions, total } = demonstration;
  card.dataset.demonstrationId = id;
  card.dataset.list = outcome;
  // Where a study hides the totals, the card has no place for one.
  const place = card.querySelector(".card-total");
  const earned = place ? ` with ${signed(total)}` : "";
  card.dataset.words = `${outcome === "success" ? "Success" : "Failure"}${earned} in ${plural(actions.length, "step")}`;
  if (place) place.textContent = signed(total);
  find(card, ".card-steps").textContent = plural(actions.length, "step");
  const board = /** @type {IrlBoard} */ (find(card, "irl-board"));
  board.world = world;
  board.view = { ...board.view, paths: [{ states, who: "human", width: 0.7 }] };
  board.label = `The path of a ${outcome}`;
  return card;
}

/** @param {Element} within @param {string} selector */
function find(within, selector) {
  return /** @type {HTMLElement} */ (within.querySelector(selector));
}
