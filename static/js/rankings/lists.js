/** The two lists of cards: they draw the sitting's orders, and hand on what is done to a card. */

import { byId } from "#js/lib/dom.js";
import { Card } from "#js/rankings/card.js";
import { CardDrag } from "#js/rankings/drag.js";
import { GroupList } from "#js/rankings/group-list.js";
import { Hands } from "#js/rankings/hands.js";
import { CardKeys } from "#js/rankings/keyboard.js";
import { isSame } from "#js/rankings/order.js";
import { Watching } from "#js/rankings/watching.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/group-list.js").Between} Between */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */

/** @type {Outcome[]} */
const OUTCOMES = ["success", "failure"];

export class RankLists {
  #parts;
  /** @type {Record<Outcome, GroupList>} */
  #lists;
  #hands;
  #drag;
  #watching;
  /** What a focus came from; null: the keyboard. @type {Means | null} */
  #pointer = null;
  /** Boards out of sight cost nothing, however many they are. */
  #eye = new IntersectionObserver((seen) => this.#drawSeen(seen), { rootMargin: "400px" });

  /** @param {import("#js/rankings/rank.js").Parts & {root: HTMLElement, onWatch: (id: string, means: Means) => void, onCompare: (outcome: Outcome, a: string, b: string, means: Means) => void}} parts */
  constructor(parts) {
    this.#parts = parts;
    this.#lists = { success: this.#listOf("success"), failure: this.#listOf("failure") };
    this.#hands = new Hands({ sitting: parts.sitting, lists: this.#lists, onCompare: parts.onCompare });
    const center = /** @type {IrlBoard} */ (byId("rank-board"));
    center.world = parts.world;
    this.#watching = new Watching({ center, caption: byId("rank-caption"), onWatch: parts.onWatch });
    this.#drag = new CardDrag({
      find: (element) => this.#hands.find(element),
      drop: () => this.#hands.drop(),
      land: (card, where, means) => this.#hands.land(card, where, means),
      sayPutBack: (card) => this.#hands.sayPutBack(card),
      tap: (card, means) => this.#watching.play(card, means),
    });
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const { root, sitting } = this.#parts;
    // Before all others, so that the focus is known to come from a pointer.
    document.addEventListener("pointerdown", (event) => this.#onPointer(event), { signal, capture: true });
    document.addEventListener("keydown", () => this.#onPointer(null), { signal, capture: true });
    root.addEventListener("pointerover", (event) => this.#onHover(event), { signal });
    root.addEventListener("focusin", (event) => this.#onFocus(event), { signal });
    root.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.#drag.listen(root, signal);
    new CardKeys(this.#hands).listen(root, signal);
    signal.addEventListener("abort", () => this.#eye.disconnect());
    keepClearOfFoot(root, signal);
    sitting.subscribe(() => this.#show());
    this.#show();
  }

  /** Draw θ as it would be with another order; null: as it is. @param {Outcome} outcome @param {Order | null} order */
  preview(outcome, order) {
    this.#lists[outcome].preview(order);
  }

  /** @param {string} id */
  focus(id) {
    const card = this.#lists.success.card(id) ?? this.#lists.failure.card(id);
    card?.element.focus();
    card?.element.scrollIntoView({ block: "nearest", behavior: "instant" });
  }

  /** What stands between two groups, asked anew when the order changes; null: nothing does. @param {Between | null} render */
  setBetween(render) {
    for (const outcome of OUTCOMES) this.#lists[outcome].setBetween(render);
  }

  /** @param {Outcome} outcome */
  #listOf(outcome) {
    const { world, demonstrations, showTotals } = this.#parts;
    const template = /** @type {HTMLTemplateElement} */ (byId("rank-card"));
    return new GroupList(byId(`list-${outcome}`), outcome, (id) => {
      const card = new Card(template, world, demonstrations.get(id), showTotals);
      this.#eye.observe(card.element);
      return card;
    });
  }

  #show() {
    const { lifted, present } = this.#parts.sitting.state;
    for (const outcome of OUTCOMES) {
      const list = this.#lists[outcome];
      if (this.#drag.isFlying && !isSame(list.order, present.orders[outcome])) this.#drag.abandon();
      list.show(present.orders[outcome]);
      list.lift(lifted);
    }
  }

  /** @param {IntersectionObserverEntry[]} seen */
  #drawSeen(seen) {
    for (const { isIntersecting, target } of seen) {
      if (!isIntersecting) continue;
      this.#eye.unobserve(target);
      this.#hands.find(target)?.card.draw();
    }
  }

  /** @param {PointerEvent | null} event */
  #onPointer(event) {
    this.#pointer = /** @type {Means | null} */ (event?.pointerType ?? null);
  }

  /** @param {PointerEvent} event */
  #onHover(event) {
    if (event.pointerType !== "mouse" || this.#drag.isFlying || event.buttons !== 0) return;
    this.#watching.hover(this.#cardAt(event));
  }

  /** @param {FocusEvent} event */
  #onFocus(event) {
    const found = this.#hands.find(/** @type {Element} */ (event.target));
    if (!found) return;
    found.list.setCurrent(found.card.id);
    this.#watching.watch(found.card, this.#pointer ?? "key");
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = /** @type {HTMLButtonElement | null} */ (
      event.target instanceof Element ? event.target.closest("button") : null
    );
    const { act, sort } = button?.dataset ?? {};
    if (sort) this.#hands.sort(/** @type {Outcome} */ (sort), this.#parts.demonstrations);
    const card = this.#cardAt(event);
    if (!card || !button) return;
    if (act === "up") this.#hands.step(card, -1, "button");
    else if (act === "down") this.#hands.step(card, 1, "button");
    else if (act === "tie") this.#hands.tie(card, "button");
    else if (act === "compare") this.#hands.compare(card, "button");
    // A button at the end of its list is switched off under the finger: its card takes the focus.
    if (button.disabled) card.element.focus();
  }

  /** @param {Event} event */
  #cardAt({ target }) {
    return this.#hands.find(target instanceof Element ? target : null)?.card ?? null;
  }
}

/** The ends of the lists stay in sight above whatever stands at the foot of the window. @param {HTMLElement} root @param {AbortSignal} signal */
function keepClearOfFoot(root, signal) {
  const foot = root.querySelector(".rank-next");
  if (!foot) return;
  const size = new ResizeObserver(() => {
    const height = getComputedStyle(foot).position === "sticky" ? foot.getBoundingClientRect().height : 0;
    root.style.setProperty("--rank-foot", `${height}px`);
  });
  size.observe(foot);
  signal.addEventListener("abort", () => size.disconnect());
}
