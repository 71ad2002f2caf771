/**
 * What stands open in "Why", as the fragment of the page's address, so that a link shows the same:
 * `#why=irlfr&open=what-if&swap=ID&with=ID`. What another fragment says is none of our business.
 * @import {Change} from "#js/comparisons/why/types.js"
 */

export const PARTS = /** @type {const} */ (["mattered", "what-if", "doubt"]);

/** @typedef {typeof PARTS[number]} PartName */
/** @typedef {{ learner: string, open: PartName[], change: Change | null }} Shown */

/** @param {string} hash with or without its # @returns {Shown | null} null where the fragment is not ours */
export function readShown(hash) {
  const said = new URLSearchParams(hash.replace(/^#/, ""));
  const learner = said.get("why");
  if (!learner) return null;
  const named = (said.get("open") ?? "").split(",");
  return { learner, open: PARTS.filter((part) => named.includes(part)), change: readChange(said) };
}

/** "" where nothing is open. @param {Shown} shown */
export function writeShown({ learner, open, change }) {
  if (open.length === 0) return "";
  const isAsked = change !== null && open.includes("what-if");
  // A comma may stand as it is: the link is read by people, too.
  return `#why=${encodeURIComponent(learner)}&open=${open.join(",")}${isAsked ? `&${writeChange(change)}` : ""}`;
}

/** @param {URLSearchParams} said @returns {Change | null} */
function readChange(said) {
  const [drop, relabel, swap, other] = ["drop", "relabel", "swap", "with"].map((name) => said.get(name));
  if (drop) return { drop };
  if (relabel) return { relabel };
  return swap && other ? { swap: [swap, other] } : null;
}

/** @param {Change} change */
function writeChange(change) {
  const pairs = "swap" in change ? { swap: change.swap[0], with: change.swap[1] } : change;
  return new URLSearchParams(pairs).toString();
}
