/** The order as it stands before it is confirmed, kept for this tab so that a reload loses nothing. */

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {{success: Order, failure: Order}} Orders */

/** @param {string} worldId */
const keyOf = (worldId) => `irlfr:order:${worldId}`;

/** @param {string} worldId @param {Orders} orders */
export function keepDraft(worldId, orders) {
  try {
    sessionStorage.setItem(keyOf(worldId), JSON.stringify(orders));
  } catch {
    // Without storage the order lives as long as the page.
  }
}

/** @param {string} worldId */
export function forgetDraft(worldId) {
  try {
    sessionStorage.removeItem(keyOf(worldId));
  } catch {
    // Nothing was kept.
  }
}

/** @param {string} worldId @returns {Orders | null} */
export function keptDraft(worldId) {
  try {
    const draft = JSON.parse(sessionStorage.getItem(keyOf(worldId)) ?? "null");
    return Array.isArray(draft?.success) && Array.isArray(draft?.failure) ? draft : null;
  } catch {
    return null;
  }
}
