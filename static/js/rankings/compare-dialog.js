/** Two attempts of one list side by side: played in step, told which stands higher, and what swapping them would change. */

import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { isTaken } from "#js/lib/keys.js";
import { displayRanks, groupOf, swap, weights } from "#js/rankings/order.js";
import { PairView } from "#js/rankings/pair-view.js";
import { questionOf, saidWords } from "#js/rankings/pair-words.js";
import { PolicySwap } from "#js/rankings/policy-swap.js";
import { cardWords, weightText } from "#js/rankings/sentences.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {import("#js/rankings/merge-insertion.js").Said} Said */

/** @type {Record<string, Said>} */
const ANSWERS = { ArrowLeft: "a", ArrowRight: "b", ArrowDown: "alike", "=": "alike" };

export class CompareDialog {
  #parts;
  #dialog = /** @type {HTMLDialogElement} */ (byId("compare"));
  #view;
  #policy;
  /** @type {{outcome: Outcome, a: string, b: string} | null} */
  #pair = null;

  /** @param {import("#js/rankings/rank.js").Parts & {lists: import("#js/rankings/lists.js").RankLists, policy: import("#js/rankings/policy-panel.js").PolicyPanel | null}} parts */
  constructor(parts) {
    this.#parts = parts;
    const onPlay = (/** @type {string[]} */ ids, /** @type {Means} */ means) => {
      for (const id of ids) parts.sitting.do({ type: "watch", means, id });
    };
    this.#view = new PairView(this.#dialog, { world: parts.world, onPlay });
    this.#policy = parts.policy ? new PolicySwap(byId("compare-swap-policy"), parts.world, parts.policy) : null;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const dialog = this.#dialog;
    this.#view.start(signal);
    dialog.addEventListener("click", (event) => this.#onClick(event), { signal });
    dialog.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    dialog.addEventListener("close", () => this.#onClose(), { signal });
    const swapping = byId("compare-swap");
    for (const type of ["pointerenter", "focus"])
      swapping.addEventListener(type, () => this.#preview(true), { signal });
    for (const type of ["pointerleave", "blur"])
      swapping.addEventListener(type, () => this.#preview(false), { signal });
    this.#parts.sitting.subscribe(() => this.#show());
  }

  /** @param {Outcome} outcome @param {string} a @param {string} b @param {Means} [means] */
  open(outcome, a, b, means = "button") {
    const { sitting, demonstrations } = this.#parts;
    this.#pair = { outcome, a, b };
    sitting.do({ type: "compare", means, a, b });
    byId("compare-title").textContent = questionOf(outcome);
    this.#dialog.showModal();
    this.#view.show(demonstrations.get(a), demonstrations.get(b), { a: this.#words(a), b: this.#words(b) });
    this.#show();
  }

  /** The one said to belong higher goes right above the other; what stands so already stays. @param {Said} said @param {Means} means */
  answer(said, means) {
    const pair = this.#pair;
    if (!pair) return;
    const { sitting } = this.#parts;
    const { outcome } = pair;
    const [id, other] = said === "b" ? [pair.b, pair.a] : [pair.a, pair.b];
    const isNew =
      this.#said !== said && sitting.do({ type: "place", means, outcome, id, ...this.#beside(id, other, said) });
    announce(`${saidWords(said, outcome)} ${isNew ? this.#standsWords : "They stand so already."}`);
  }

  /** @param {Means} means */
  swap(means) {
    if (!this.#pair) return;
    const { outcome, a, b } = this.#pair;
    if (!this.#parts.sitting.do({ type: "swap", means, outcome, id: a, with: b })) return;
    announce(`Swapped. ${this.#standsWords}`);
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (!button) return;
    if (button.dataset.said) this.answer(/** @type {Said} */ (button.dataset.said), "button");
    else if (button.dataset.act === "close") this.#dialog.close();
    else if (button.id === "compare-swap") this.swap("button");
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (isTaken(event, this.#dialog) || event.repeat) return;
    const on = /** @type {Element} */ (event.target);
    const said = ANSWERS[event.key];
    if (said && (!on.matches("input") || event.key === "=")) this.answer(said, "key");
    else if (event.key === " " && !on.closest("button, input")) this.#view.toggle("key");
    else return;
    event.preventDefault();
  }

  #onClose() {
    this.#view.stop();
    this.#preview(false);
    this.#policy?.wonder(null);
    this.#pair = null;
  }

  /** Where a card lands right above another, or tied with it, counted without itself. @param {string} id @param {string} other @param {Said} said */
  #beside(id, other, said) {
    const others = this.#order.map((group) => group.filter((one) => one !== id)).filter((group) => group.length > 0);
    return { group: groupOf(others, other), joins: said === "alike" };
  }

  get #order() {
    return this.#pair ? this.#parts.sitting.orders[this.#pair.outcome] : [];
  }

  /** What the list says of the two. @returns {Said} */
  get #said() {
    const [a, b] = [this.#pair?.a ?? "", this.#pair?.b ?? ""].map((id) => groupOf(this.#order, id));
    return a === b ? "alike" : Number(a) < Number(b) ? "a" : "b";
  }

  get #swapped() {
    return this.#pair ? swap(this.#order, this.#pair.a, this.#pair.b) : [];
  }

  get #standsWords() {
    const { a = "", b = "" } = this.#pair ?? {};
    return `Left: ${standing(this.#order, a)}. Right: ${standing(this.#order, b)}.`;
  }

  /** @param {string} id */
  #words(id) {
    return cardWords(this.#parts.demonstrations.get(id), this.#parts.showTotals);
  }

  /** The cards may go while they are looked at. */
  #show() {
    const pair = this.#pair;
    if (!pair) return;
    if (groupOf(this.#order, pair.a) < 0 || groupOf(this.#order, pair.b) < 0) return this.#dialog.close();
    const said = this.#said;
    for (const button of /** @type {NodeListOf<HTMLElement>} */ (this.#dialog.querySelectorAll("[data-said]")))
      button.setAttribute("aria-pressed", String(button.dataset.said === said));
    for (const side of /** @type {const} */ (["a", "b"]))
      this.#view.part(`stands-${side}`).textContent = standing(this.#order, pair[side]);
    byId("compare-swap-none").hidden = said !== "alike";
    byId("compare-swap").setAttribute("aria-disabled", String(said === "alike"));
    byId("compare-swap-list").replaceChildren(...(said === "alike" ? [] : this.#changes()));
    this.#policy?.wonder(said === "alike" ? null : { ...this.#parts.sitting.orders, [pair.outcome]: this.#swapped });
  }

  /** Every card whose θ would be another, as it is and as it would be. */
  #changes() {
    const [now, then] = [this.#order, this.#swapped];
    const [theta, would] = [weights(now), weights(then)];
    const changed = [...theta.keys()].filter((id) => Math.abs((theta.get(id) ?? 0) - (would.get(id) ?? 0)) > 1e-12);
    return changed.flatMap((id) => {
      const [name, change] = [document.createElement("dt"), document.createElement("dd")];
      name.textContent = id === this.#pair?.a ? "Left" : id === this.#pair?.b ? "Right" : this.#words(id);
      change.textContent = `${standing(now, id)} → ${standing(then, id)}`;
      return [name, change];
    });
  }

  /** The lists below show it, too. @param {boolean} isOn */
  #preview(isOn) {
    if (this.#pair) this.#parts.lists.preview(this.#pair.outcome, isOn ? this.#swapped : null);
  }
}

/** "place 2, θ 0.29". @param {Order} order @param {string} id */
function standing(order, id) {
  const theta = weights(order);
  return `place ${displayRanks(order).get(id)}, θ ${weightText(theta.get(id) ?? 0, theta.size)}`;
}
