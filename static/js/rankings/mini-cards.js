/** An order to look at, not to change: a list of small cards, each with its place, its path and how far it stands from another order. */

import { plural } from "#js/lib/format.js";
import { attemptWords, movedWords } from "#js/rankings/confirm-words.js";
import { displayRanks, flat, groupOf } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */

export class MiniCards {
  #world;
  #demonstrations;
  #showTotals;
  #template;
  /** @type {WeakMap<Element, () => void>} */
  #drawings = new WeakMap();
  /** Boards out of sight cost nothing, however many they are. */
  #eye = new IntersectionObserver((seen) => this.#drawSeen(seen), { rootMargin: "200px" });

  /** @param {{world: any, demonstrations: Map<string, any>, showTotals: boolean, template: HTMLTemplateElement}} parts */
  constructor({ world, demonstrations, showTotals, template }) {
    this.#world = world;
    this.#demonstrations = demonstrations;
    this.#showTotals = showTotals;
    this.#template = template;
  }

  /** @param {HTMLElement} list @param {Order} order @param {Order} [other]  what differs from it is marked */
  fill(list, order, other = order) {
    const [here, there, n] = [displayRanks(order), displayRanks(other), flat(order).length];
    list.replaceChildren(
      ...flat(order).map((id) => {
        const card = this.make(id);
        const rank = here.get(id) ?? 0;
        mark(card, (there.get(id) ?? rank) - rank);
        const nTied = (order[groupOf(order, id)]?.length ?? 1) - 1;
        find(card, ".mini-place").textContent = `${rank}${nTied > 0 ? "=" : "."}`;
        card.dataset.tied = String(nTied > 0 && order[groupOf(order, id)]?.[0] !== id);
        const tied = nTied > 0 ? `, tied with ${plural(nTied, "other")}` : "";
        find(card, ".mini-said").prepend(`Place ${rank} of ${n}${tied}: `);
        return card;
      }),
    );
  }

  /** One card alone. @param {string} id @returns {HTMLElement} */
  make(id) {
    const card = /** @type {HTMLElement} */ (document.importNode(this.#template.content, true).firstElementChild);
    const one = this.#demonstrations.get(id);
    card.dataset.id = id;
    const words = one ? attemptWords(one, this.#showTotals) : "an attempt that is not here";
    find(card, ".mini-words").textContent = words;
    find(card, ".mini-said").textContent = words;
    const board = /** @type {IrlBoard} */ (find(card, "irl-board"));
    this.#drawings.set(board, () => {
      board.world = this.#world;
      if (one) board.view = { ...board.view, paths: [{ states: one.states, who: "human", width: 0.7 }] };
    });
    this.#eye.observe(board);
    return card;
  }

  /** @param {IntersectionObserverEntry[]} seen */
  #drawSeen(seen) {
    for (const { target, isIntersecting } of seen) {
      if (!isIntersecting) continue;
      this.#drawings.get(target)?.();
      this.#eye.unobserve(target);
    }
  }
}

/** @param {HTMLElement} card @param {number} by */
function mark(card, by) {
  const { sign, words } = movedWords(by);
  card.dataset.moved = String(by);
  find(card, ".mini-mark").textContent = sign;
  find(card, ".mini-said").append(words);
}

/** @param {Element} within @param {string} selector */
function find(within, selector) {
  return /** @type {HTMLElement} */ (within.querySelector(selector));
}
