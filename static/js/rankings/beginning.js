/** How a sitting begins, and how one that was left goes on: from the page data and what this browser kept. */

import { isRefused, isSound } from "#js/lib/parcels.js";
import { flat, isSame, reconcile } from "#js/rankings/order.js";
import { apply, beginState } from "#js/rankings/sitting-state.js";
import { Client } from "#js/worlds/client.js";

/** @typedef {import("#js/lib/parcels.js").Parcel} Parcel */
/** @typedef {import("#js/lib/parcels.js").RankingParcel} RankingParcel */
/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Change} Change */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").State} State */
/** @typedef {import("#js/rankings/sitting.js").Event} Event */
/** @typedef {{orders: Record<Outcome, Order>, from: Record<Outcome, string>, versions: Record<Outcome, number>}} Start */

/** @type {readonly Outcome[]} */
export const OUTCOMES = ["success", "failure"];

/** From the order that version 0.3 kept in this tab, else the one confirmed last, else the one the server drew. @param {any} data of the page @returns {Start} */
export function startOf(data) {
  const draft = oldDraft(data.world.id);
  const of = (/** @type {Outcome} */ outcome) => {
    const [kept, ranking] = [draft?.[outcome] ?? [], data.rankings[outcome]];
    const before = kept.length > 0 ? kept : (ranking?.order ?? []);
    const { added, removed } = newsOf(data, outcome, before);
    const order = reconcile(before, added, removed);
    // Where all of it was discarded since, what is there now is as it was drawn.
    const from = added.length === flat(order).length ? "random" : kept.length > 0 ? "draft" : "version";
    return { from, order, version: ranking?.version ?? 0 };
  };
  const [success, failure] = [of("success"), of("failure")];
  return {
    orders: { success: success.order, failure: failure.order },
    from: { success: success.from, failure: failure.from },
    versions: { success: success.version, failure: failure.version },
  };
}

/** @param {Start} start @param {{way: string, client: unknown}} rest @returns {Change} */
export function beginOf({ orders, from, versions }, { way, client }) {
  return { type: "begin", means: "page", orders, from, based_on: { ...versions }, way, client };
}

/** What the browser and the device are like. @param {boolean} showTotals */
export function describeClient(showTotals) {
  const { hold_to_move: _, ...client } = new Client({ showTotals, holdToMove: false }).describe();
  return client;
}

/** Which attempts came since an order was made, in the order that the server drew, and which went. @param {any} data @param {Outcome} outcome @param {Order} order */
export function newsOf(data, outcome, order) {
  const kept = data.demonstrations.filter((/** @type {any} */ one) => one.outcome === outcome && !one.discarded);
  const ids = new Set(kept.map((/** @type {any} */ one) => one.id));
  const known = new Set(flat(order));
  /** @type {string[]} */
  const drawn = data.start_order[outcome].filter((/** @type {string} */ id) => ids.has(id));
  return { added: drawn.filter((id) => !known.has(id)), removed: [...known].filter((id) => !ids.has(id)) };
}

/** As far as it can be followed; null where not even its beginning can. @param {readonly Event[]} events @returns {{state: State, log: Event[]} | null} */
export function rebuilt(events) {
  const [begin, ...rest] = events;
  if (begin?.n !== 0 || begin.type !== "begin" || !OUTCOMES.every((one) => isOrder(begin.orders?.[one]))) return null;
  const log = [begin];
  let state = beginState(begin);
  for (const event of rest) {
    const next = event.n === log.length ? followed(state, event) : null;
    if (next === null) break;
    state = next;
    log.push(event);
  }
  return { state, log };
}

/** A storage can be damaged in any way. @param {State} state @param {Event} event */
function followed(state, event) {
  try {
    return apply(state, event);
  } catch {
    return null;
  }
}

/** @param {Readonly<Record<Outcome, Order>>} orders */
export function isEmpty(orders) {
  return OUTCOMES.every((outcome) => orders[outcome].length === 0);
}

/** Whether the visitor who is here has none of its attempts, not even a discarded one. @param {State} state @param {any} data */
export function isStrange({ present: { orders } }, data) {
  const ids = OUTCOMES.flatMap((outcome) => flat(orders[outcome]));
  return ids.length > 0 && !areKnown(ids, data);
}

/** @param {readonly string[]} ids @param {any} data whether any of them is there */
function areKnown(ids, data) {
  const known = new Set(data.demonstrations.map((/** @type {any} */ one) => one.id));
  return ids.some((id) => known.has(id));
}

/** Orders that wait or were refused; what is damaged cannot be told from nothing. @param {readonly Parcel[]} parcels @returns {RankingParcel[]} */
export function ordersAmong(parcels) {
  return parcels
    .filter((one) => one.kind === "ranking" && isSound(one))
    .map((one) => /** @type {RankingParcel} */ (one));
}

/** The sittings of whoever is here that were refused an order; if their page was closed by then, nobody was told. @param {readonly Parcel[]} parcels @param {any} data */
export function refusedIn(parcels, data) {
  const refused = ordersAmong(parcels).filter((one) => isRefused(one) && areKnown(flat(one.body.order), data));
  return new Set(refused.map(({ sittingId }) => sittingId));
}

/** Whether the newest orders that are confirmed are those of this sitting and say all that was said in it. @param {string} id @param {State} state @param {any} data */
export function isAllConfirmed(id, { present }, data) {
  const filled = OUTCOMES.filter((outcome) => present.orders[outcome].length > 0);
  const isConfirmed = (/** @type {Outcome} */ outcome) => {
    const ranking = data.rankings[outcome];
    return ranking?.sitting_id === id && isSame(ranking.order, present.orders[outcome]);
  };
  return filled.length > 0 && filled.every(isConfirmed) && retold({ present }).length === 0;
}

/** All that was said beside the orders, said again. @param {Pick<State, "present">} state @returns {Change[]} */
export function retold({ present: { answers, gaps, stretches } }) {
  const means = "page";
  const of = (/** @type {Outcome} */ outcome) => [
    ...answers[outcome].map((one) => ({ type: "answer", means, outcome, ...one })),
    ...gaps[outcome].map((one) => ({ type: "gap", means, outcome, ...one })),
  ];
  const marked = Object.entries(stretches).flatMap(([id, all]) =>
    all.map((one) => ({ type: "stretch", means, id, ...one })),
  );
  return [...OUTCOMES.flatMap(of), ...marked];
}

/** @param {string} worldId */
const oldKey = (worldId) => `irlfr:order:${worldId}`;

/** @param {string} worldId @returns {Partial<Record<Outcome, Order>> | null} */
function oldDraft(worldId) {
  try {
    const draft = JSON.parse(sessionStorage.getItem(oldKey(worldId)) ?? "null");
    return OUTCOMES.every((outcome) => isOrder(draft?.[outcome])) ? draft : null;
  } catch {
    return null;
  }
}

/** The sitting has it now. @param {string} worldId */
export function forgetOldDraft(worldId) {
  try {
    sessionStorage.removeItem(oldKey(worldId));
  } catch {
    // Nothing was kept.
  }
}

/** @param {unknown} order */
function isOrder(order) {
  if (!Array.isArray(order) || !order.every((group) => Array.isArray(group) && group.length > 0)) return false;
  return new Set(flat(order)).size === flat(order).length;
}
