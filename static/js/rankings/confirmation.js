/** Confirming: what counts, what has yet to be confirmed, and the way on. */

import { announce } from "#js/lib/announce.js";
import { ApiError } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { setStep } from "#js/lib/path.js";
import { isSame } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */

/** @type {Outcome[]} */
const OUTCOMES = ["success", "failure"];

export class Confirmation {
  #parts;
  /** @type {Record<Outcome, import("#js/rankings/order.js").Order>} */
  #confirmed;

  /** @param {import("#js/rankings/rank.js").Parts & {onCompare: Function, onFocus: (id: string) => void}} parts */
  constructor(parts) {
    this.#parts = parts;
    const { success, failure } = parts.data.rankings;
    this.#confirmed = { success: success?.order ?? [], failure: failure?.order ?? [] };
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    byId("confirm").addEventListener("click", () => void this.#confirm(), { signal });
    this.#parts.sitting.subscribe(() => this.#show());
    this.#show();
  }

  async #confirm() {
    try {
      for (const outcome of OUTCOMES.filter((one) => this.#parts.sitting.orders[one].length > 0)) {
        const { ranking } = await this.#parts.sitting.confirm(outcome, { means: "button", untouched: true });
        this.#confirmed = { ...this.#confirmed, [outcome]: ranking.order };
      }
      announce("Your order is confirmed. Next: Learn.");
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      byId("rank-notice").hidden = false;
      byId("rank-notice-text").textContent = error.message;
    }
    this.#show();
    if (!byId("learn").hidden) byId("learn").focus();
  }

  #show() {
    const { orders } = this.#parts.sitting;
    const nCards = orders.success.length + orders.failure.length;
    const isConfirmed = nCards > 0 && OUTCOMES.every((one) => isSame(this.#confirmed[one], orders[one]));
    byId("rank").dataset.confirmed = String(isConfirmed);
    byId("confirm").hidden = isConfirmed || nCards === 0;
    byId("learn").hidden = !isConfirmed;
    byId("rank-state").textContent = isConfirmed ? "✓ Confirmed." : "An order counts once you confirm it.";
    byId("rank-state").hidden = nCards === 0;
    setStep("rank", { state: isConfirmed ? "ranked" : "", isDone: isConfirmed });
  }
}
