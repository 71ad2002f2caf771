/** One list: an order drawn as groups of cards, the tied ones side by side; cards glide to where they now stand. */

import { arrange } from "#js/rankings/arrange.js";
import { displayRanks, flat, isSame, weights } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/card.js").Card} Card */
/** @typedef {import("#js/rankings/landing.js").Box} Box */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** What stands between two groups. @typedef {(outcome: Outcome, above: readonly string[], below: readonly string[]) => HTMLElement | null} Between */

const GLIDE_MS = 160;
/** Lists longer than this are drawn smaller. */
const ROOMY = 7;
const MIDDLING = 14;

export class GroupList {
  /** @type {Map<string, Card>} */
  #cards = new Map();
  /** @type {Order} */
  #order = [];
  /** @type {Order | null} */
  #preview = null;
  /** @type {Between | null} */
  #between = null;
  /** @type {string | null} */
  #current = null;
  /** @type {HTMLElement | null} */
  #flying = null;

  #makeCard;

  /** @param {HTMLElement} list @param {Outcome} outcome @param {(id: string) => Card} makeCard */
  constructor(list, outcome, makeCard) {
    this.list = list;
    this.outcome = outcome;
    this.#makeCard = makeCard;
  }

  get order() {
    return this.#order;
  }

  /** @param {Order} order */
  show(order) {
    if (isSame(order, this.#order) && order.length > 0) return;
    const before = this.#order.length > 0 ? this.#places() : new Map();
    const focused = document.activeElement;
    this.#order = order;
    this.#preview = null;
    this.#endFlight();
    this.#draw();
    if (this.list.contains(focused)) this.#followFocus(/** @type {HTMLElement} */ (focused));
    this.#glide(before);
  }

  /** The card the keyboard holds. @param {string | null} id */
  lift(id) {
    for (const card of this.#cards.values()) card.element.dataset.lifted = String(card.id === id);
  }

  /** A card follows the pointer; its place stays empty, and nothing else moves. @param {string} id @param {{x: number, y: number}} by */
  fly(id, { x, y }) {
    this.#flying = this.#elementOf(id);
    this.#flying.dataset.flying = "true";
    this.#flying.style.translate = `${x}px ${y}px`;
  }

  /** The card in flight goes back to its place. */
  comeHome() {
    const before = this.#places();
    this.#endFlight();
    this.preview(null);
    this.#glide(before);
  }

  /** θ as it would be with another order. @param {Order | null} order */
  preview(order) {
    this.#preview = order;
    this.#weigh();
  }

  /** @param {Between | null} render */
  setBetween(render) {
    this.#between = render;
    this.#fillBetween();
  }

  /** @param {string} id */
  card(id) {
    return this.#cards.get(id) ?? null;
  }

  /** The card on the way of the Tab key. @param {string} id */
  setCurrent(id) {
    this.#current = id;
    for (const card of this.#cards.values()) card.setCurrent(card.id === id);
  }

  /** Where the groups stand, in coordinates of the page; nothing may be moving. @returns {{ids: readonly string[], box: Box}[]} */
  measure() {
    for (const { element } of this.#cards.values()) for (const motion of element.getAnimations()) motion.finish();
    return this.#order.map((ids, i) => ({ ids, box: boxOf(find(this.list.children[i], ".group-cards")) }));
  }

  #draw() {
    const ids = flat(this.#order);
    for (const id of ids) if (!this.#cards.has(id)) this.#cards.set(id, this.#makeCard(id));
    for (const [id, { element }] of this.#cards) {
      if (ids.includes(id)) continue;
      element.remove();
      this.#cards.delete(id);
    }
    this.list.dataset.size = ids.length <= ROOMY ? "roomy" : ids.length <= MIDDLING ? "middling" : "dense";
    /** @type {HTMLElement} */ (this.list.closest(".column")).dataset.count = String(ids.length);
    this.#group();
    this.#describe(ids);
    this.#weigh();
    this.#fillBetween();
    this.setCurrent(this.#current !== null && ids.includes(this.#current) ? this.#current : ids[0]);
  }

  /** Cards go into their groups before groups that lost all of theirs go out: nobody leaves the page on the way. */
  #group() {
    /** @type {Set<Element>} */
    const taken = new Set();
    for (const ids of this.#order) {
      const group = this.#homeOf(ids, taken) ?? this.list.appendChild(makeGroup());
      taken.add(group);
      arrange(
        find(group, ".group-cards"),
        ids.map((id) => this.#elementOf(id)),
      );
    }
    for (const group of [...this.list.children]) if (!taken.has(group)) group.remove();
    arrange(this.list, [...taken]);
  }

  /** The group in which most of these cards stand already. @param {readonly string[]} ids @param {Set<Element>} taken */
  #homeOf(ids, taken) {
    const homes = ids.map((id) => this.#elementOf(id).closest(".group")).filter((one) => one && !taken.has(one));
    const votes = (/** @type {Element | null} */ home) => homes.filter((one) => one === home).length;
    return homes.reduce((best, one) => (votes(one) > votes(best) ? one : best), homes[0] ?? null);
  }

  /** Taken from one group into another, a node may drop its focus, or leave the window. @param {HTMLElement} focused */
  #followFocus(focused) {
    if (focused !== document.activeElement) focused.focus({ preventScroll: true });
    focused.closest(".card")?.scrollIntoView({ block: "nearest", behavior: "instant" });
  }

  #endFlight() {
    if (!this.#flying) return;
    delete this.#flying.dataset.flying;
    this.#flying.style.translate = "";
    this.#flying = null;
  }

  /** @param {string[]} ids */
  #describe(ids) {
    const ranks = displayRanks(this.#order);
    for (const [i, group] of this.#order.entries()) {
      const rank = ranks.get(group[0]) ?? 1;
      const element = /** @type {HTMLElement} */ (this.list.children[i]);
      element.dataset.tied = String(group.length > 1);
      find(element, ".group-place").textContent = `${rank}${group.length > 1 ? "=" : "."}`;
      const standing = { rank, n: ids.length, nOthers: group.length - 1 };
      const ends = { isFirst: i === 0, isLast: i === this.#order.length - 1 };
      for (const id of group) this.#cards.get(id)?.standAt({ ...standing, ...ends, position: ids.indexOf(id) + 1 });
    }
  }

  #weigh() {
    const [now, would] = [weights(this.#order), weights(this.#preview ?? this.#order)];
    for (const [id, weight] of now) this.#cards.get(id)?.weigh(weight, now.size, would.get(id) ?? weight);
  }

  #fillBetween() {
    for (const [i, above] of this.#order.entries()) {
      const below = this.#order[i + 1];
      const slot = find(this.list.children[i], ".group-between");
      const filling = below ? (this.#between?.(this.outcome, above, below) ?? null) : null;
      if (slot.firstElementChild !== filling) slot.replaceChildren(...(filling ? [filling] : []));
      slot.hidden = filling === null;
    }
  }

  /** Where each card is seen just now, on its way, too, in coordinates of the page. @returns {Map<string, {x: number, y: number}>} */
  #places() {
    return new Map(
      [...this.#cards].map(([id, { element }]) => {
        const { left, top } = element.getBoundingClientRect();
        return [id, { x: left + scrollX, y: top + scrollY }];
      }),
    );
  }

  /** From where each card was seen to where it stands now. @param {Map<string, {x: number, y: number}>} before */
  #glide(before) {
    for (const { element } of this.#cards.values()) for (const motion of element.getAnimations()) motion.cancel();
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    for (const [id, { x, y }] of this.#places()) {
      const from = before.get(id);
      if (!from || Math.hypot(from.x - x, from.y - y) < 1) continue;
      const frames = [{ translate: `${from.x - x}px ${from.y - y}px` }, { translate: "none" }];
      this.#cards.get(id)?.element.animate(frames, { duration: GLIDE_MS, easing: "cubic-bezier(0.2, 0.7, 0.3, 1)" });
    }
  }

  /** @param {string} id */
  #elementOf(id) {
    return /** @type {Card} */ (this.#cards.get(id)).element;
  }
}

/** The lists within a list are for the eye; whoever hears them hears one list of cards. */
function makeGroup() {
  const [group, place, cards, between] = [
    make("li", "group"),
    make("span", "group-place figures"),
    make("ul", "group-cards"),
    make("div", "group-between"),
  ];
  group.setAttribute("role", "none");
  cards.setAttribute("role", "none");
  place.setAttribute("aria-hidden", "true");
  between.setAttribute("role", "listitem");
  between.hidden = true;
  group.append(place, cards, between);
  return group;
}

/** @param {string} tag @param {string} name */
function make(tag, name) {
  const element = document.createElement(tag);
  element.className = name;
  return element;
}

/** In coordinates of the page. @param {Element} element @returns {Box} */
export function boxOf(element) {
  const { left, top, right, bottom } = element.getBoundingClientRect();
  return { left: left + scrollX, top: top + scrollY, right: right + scrollX, bottom: bottom + scrollY };
}

/** @param {Element} within @param {string} selector */
function find(within, selector) {
  return /** @type {HTMLElement} */ (within.querySelector(selector));
}
