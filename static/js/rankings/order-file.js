/** An order that the server will not take leaves as a file: ranking lines as a demonstration file has them. */

import { announce } from "#js/lib/announce.js";
import { flat } from "#js/rankings/order.js";
import { givenOf, OUTCOMES } from "#js/rankings/standing.js";

/** @typedef {import("#js/rankings/standing.js").Stated} Stated */

/** @param {string} worldId @param {Stated} stated */
export function linesOf(worldId, stated) {
  const outcomes = OUTCOMES.filter((outcome) => flat(stated.present.orders[outcome]).length > 0);
  return outcomes
    .map((outcome) => ({
      kind: "ranking",
      world_id: worldId,
      outcome,
      order: stated.present.orders[outcome],
      confirmed: false,
      way: stated.way,
      given: givenOf(stated, outcome),
    }))
    .map((line) => `${JSON.stringify(line)}\n`)
    .join("");
}

/** @param {string} worldId @param {Stated} stated */
export function saveOrders(worldId, stated) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([linesOf(worldId, stated)], { type: "application/jsonl" }));
  link.download = `order-${worldId.slice(0, 8)}.jsonl`;
  link.click();
  // Long enough for the browser to have taken it.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  announce(`Your order is saved as the file ${link.download}.`);
}
