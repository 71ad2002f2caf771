/** All attempts of one list, in the order that follows from what is marked; one of them can be chosen to mark. */

import "#js/elements/irl-board.js";
import { make } from "#js/board/dom.js";
import { signed } from "#js/lib/format.js";
import { displayRanks } from "#js/rankings/order.js";
import { markedWords, scoreOf } from "#js/rankings/segments.js";

/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */
/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Stretch} Stretch */

export class StretchList {
  #list;
  #world;
  /** @type {Map<string, {item: HTMLElement, button: HTMLButtonElement, walk: any}>} */
  #items = new Map();

  /** @param {HTMLElement} list @param {any} world */
  constructor(list, world) {
    this.#list = list;
    this.#world = world;
  }

  /**
   * @param {Order} order @param {object} what
   * @param {Map<string, any>} what.demonstrations
   * @param {(id: string) => string} what.wordsOf
   * @param {Readonly<Record<string, readonly Stretch[]>>} what.stretches
   * @param {string | null} what.chosen
   */
  show(order, { demonstrations, wordsOf, stretches, chosen }) {
    const ranks = displayRanks(order);
    const ids = order.flat();
    for (const id of ids) if (!this.#items.has(id)) this.#add(id, demonstrations.get(id), wordsOf(id));
    for (const [id, one] of this.#items) {
      if (!ranks.has(id)) one.item.remove();
      else
        this.#describe(one, { rank: ranks.get(id) ?? 1, isTied: isShared(order, id), stretches: stretches[id] ?? [] });
      one.button.setAttribute("aria-current", String(id === chosen));
    }
    this.#arrange(ids);
  }

  /** Moving a node drops its focus: those that stand right stay, and a button that was moved has it back. @param {string[]} ids */
  #arrange(ids) {
    const focused = document.activeElement;
    for (const [i, id] of ids.entries()) {
      const item = this.#items.get(id)?.item;
      if (item && this.#list.children[i] !== item) this.#list.insertBefore(item, this.#list.children[i] ?? null);
    }
    if (focused instanceof HTMLElement && focused !== document.activeElement && this.#list.contains(focused))
      focused.focus({ preventScroll: true });
  }

  /** @param {string} id @param {any} walk @param {string} words */
  #add(id, walk, words) {
    const [item, button] = [make("li", "stretch-item"), /** @type {HTMLButtonElement} */ (make("button", "attempt"))];
    button.type = "button";
    button.dataset.demonstrationId = id;
    const board = /** @type {IrlBoard} */ (document.createElement("irl-board"));
    board.world = this.#world;
    board.view = { paths: [{ states: walk.states, who: "human", width: 0.7 }] };
    board.setAttribute("aria-hidden", "true");
    const [place, title, bar, said] = [
      make("span", "attempt-place figures"),
      make("span", "attempt-title figures"),
      make("span", "attempt-bar"),
      make("span", "attempt-said soft figures"),
    ];
    title.textContent = words;
    bar.setAttribute("aria-hidden", "true");
    button.append(place, board, title, bar, said);
    item.append(button);
    this.#items.set(id, { item, button, walk });
  }

  /** @param {{button: HTMLElement, walk: any}} one @param {{rank: number, isTied: boolean, stretches: readonly Stretch[]}} what */
  #describe({ button, walk }, { rank, isTied, stretches }) {
    const nSteps = walk.actions.length;
    part(button, ".attempt-place").textContent = `${rank}${isTied ? "=" : "."}`;
    const score = stretches.length > 0 ? ` · ${signed(scoreOf(stretches, nSteps), 2)}` : "";
    part(button, ".attempt-said").textContent = `${markedWords(stretches)}${score}`;
    const marks = stretches.map(({ from, to, kind }) => {
      const mark = make("span", `attempt-mark attempt-mark--${kind}`);
      mark.style.insetInlineStart = `${(100 * (from - 1)) / nSteps}%`;
      mark.style.inlineSize = `${(100 * (to - from + 1)) / nSteps}%`;
      return mark;
    });
    part(button, ".attempt-bar").replaceChildren(...marks);
  }
}

/** @param {Order} order @param {string} id */
function isShared(order, id) {
  return order.some((group) => group.length > 1 && group.includes(id));
}

/** @param {Element} within @param {string} selector */
function part(within, selector) {
  return /** @type {HTMLElement} */ (within.querySelector(selector));
}
