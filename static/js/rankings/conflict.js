/** The two questions that confirming may ask, each a dialog: is a random order yours; and which of two orders counts. */

import { byId } from "#js/lib/dom.js";
import {
  bothKeptSentence,
  clockWords,
  conflictSentence,
  PLURAL,
  untouchedSentence,
} from "#js/rankings/confirm-words.js";
import { displayRanks, flat } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Way} Way */

/** From so many cards on, those that stand alike can be left out. */
const MANY = 8;

/** @param {Outcome[]} outcomes @param {Way} way @returns {Promise<string>} "yes", "no"; empty if the question was left */
export function askUntouched(outcomes, way) {
  byId("untouched-text").textContent = untouchedSentence(outcomes, way);
  return answerOf("untouched");
}

/**
 * @param {import("#js/rankings/mini-cards.js").MiniCards} cards
 * @param {{outcome: Outcome, mine: Order, theirs: {order: Order, version: number, created_at: string}}} conflict
 * @returns {Promise<"mine" | "theirs" | "later">}
 */
export async function askWhichCounts(cards, { outcome, mine, theirs }) {
  const { version, created_at, order } = theirs;
  const [at, nElsewhere, n] = [clockWords(created_at), countElsewhere(mine, order), flat(mine).length];
  byId("conflict-title").textContent = `Two orders of your ${PLURAL[outcome]}`;
  byId("conflict-text").textContent = conflictSentence({ outcome, version, at, nElsewhere, n });
  byId("conflict-kept").textContent = bothKeptSentence(version);
  byId("conflict-theirs").textContent = `Version ${version}, ${at}`;
  for (const ends of document.querySelectorAll(".conflict-ends"))
    ends.textContent = outcome === "success" ? "best first" : "worst first";
  byId("conflict-only").hidden = n < MANY || nElsewhere === 0 || nElsewhere === n;
  const only = /** @type {HTMLInputElement} */ (byId("conflict-only-box"));
  only.checked = false;
  cards.fill(byId("orders-mine"), mine, order);
  cards.fill(byId("orders-theirs"), order, mine);
  const life = new AbortController();
  showTwins(byId("orders"), life.signal);
  const answer = await answerOf("conflict");
  life.abort();
  return answer === "mine" || answer === "theirs" ? answer : "later";
}

/** Open a dialog and wait for the button that closes it; empty if it was left by Escape. @param {string} id @returns {Promise<string>} */
function answerOf(id) {
  const dialog = /** @type {HTMLDialogElement} */ (byId(id));
  dialog.returnValue = "";
  dialog.showModal();
  return new Promise((resolve) => {
    const heard = new AbortController();
    const onClose = () => {
      // The event comes a moment after the closing: it may be that of the time before.
      if (dialog.open) return;
      heard.abort();
      resolve(dialog.returnValue);
    };
    dialog.addEventListener("close", onClose, { signal: heard.signal });
  });
}

/** @param {Order} a @param {Order} b */
function countElsewhere(a, b) {
  const [here, there] = [displayRanks(a), displayRanks(b)];
  return [...here].filter(([id, rank]) => there.get(id) !== rank).length;
}

/** What is pointed at in one order is marked in the other, too. @param {HTMLElement} orders @param {AbortSignal} signal */
function showTwins(orders, signal) {
  const show = (/** @type {Event} */ { target }) => {
    const id =
      target instanceof Element ? /** @type {HTMLElement | null} */ (target.closest(".mini"))?.dataset.id : undefined;
    for (const card of /** @type {NodeListOf<HTMLElement>} */ (orders.querySelectorAll(".mini")))
      card.dataset.twin = String(card.dataset.id === id);
  };
  orders.addEventListener("pointerover", show, { signal });
}
