/** Attempts that came or went while the page was open: they join or leave the lists, and nothing else moves. */

import { api } from "#js/lib/api.js";
import { flat } from "#js/rankings/order.js";
import { OUTCOMES } from "#js/rankings/standing.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {{outcome: Outcome, added: string[], removed: string[]}} CardNews */

/**
 * Ask the server what there is now, and bring the lists up to it.
 * @param {{sitting: import("#js/rankings/sitting.js").Sitting, worldId: string, demonstrations: Map<string, any>}} parts
 * @returns {Promise<CardNews[] | "stranger">} "stranger": the server knows none of these attempts as this browser's
 */
export async function bringUpToDate({ sitting, worldId, demonstrations }) {
  /** @type {any[]} */
  const told = await api.get(`/worlds/${worldId}/demonstrations`);
  const known = new Set(told.map(({ id }) => id));
  const here = OUTCOMES.flatMap((outcome) => flat(sitting.orders[outcome]));
  if (here.length > 0 && !here.some((id) => known.has(id))) return "stranger";
  // First the attempts, then the event: whoever shows it looks them up.
  for (const one of told) demonstrations.set(one.id, one);
  const news = OUTCOMES.map((outcome) => newsOf(outcome, told, flat(sitting.orders[outcome])));
  return news.filter(({ outcome, added, removed }) => {
    const isNews = added.length + removed.length > 0;
    return isNews && sitting.do({ type: "cards", means: "page", outcome, added, removed });
  });
}

/** @param {Outcome} outcome @param {any[]} told @param {string[]} here @returns {CardNews} */
function newsOf(outcome, told, here) {
  const kept = told.filter((one) => one.outcome === outcome && !one.discarded).map(({ id }) => id);
  return {
    outcome,
    added: shuffled(kept.filter((id) => !here.includes(id))),
    removed: here.filter((id) => !kept.includes(id)),
  };
}

/** As at the beginning, no order is suggested; which one it was is in the log. @template T @param {readonly T[]} items @returns {T[]} */
function shuffled(items) {
  const drawn = [...items];
  for (let i = drawn.length - 1; i > 0; i -= 1) {
    const j = Math.floor(Math.random() * (i + 1));
    [drawn[i], drawn[j]] = [/** @type {T} */ (drawn[j]), /** @type {T} */ (drawn[i])];
  }
  return drawn;
}
