/** The list of finished attempts: a small board with the path, the outcome in word and sign, total, steps, what can be done. */

import { number, plural, signed } from "#js/lib/format.js";

/** @typedef {import("#js/board/state.js").World} World */

/**
 * @typedef {object} Entry
 * @property {string} id
 * @property {readonly number[]} states
 * @property {readonly number[]} actions
 * @property {"success" | "failure"} outcome
 * @property {number} total
 * @property {boolean} discarded
 * @property {"saved" | "waiting" | "refused"} sync
 * @property {string | null} note
 */

/** @typedef {{replay: (entry: Entry, n: number) => void, discard: (entry: Entry) => void, restore: (entry: Entry) => void}} Acts */

export class AttemptStrip {
  #list;
  #template;
  #world;
  #acts;
  /** @type {Map<string, HTMLElement>} */
  #cards = new Map();

  /** @param {HTMLElement} list @param {HTMLTemplateElement} template @param {World} world @param {Acts} acts */
  constructor(list, template, world, acts) {
    this.#list = list;
    this.#template = template;
    this.#world = world;
    this.#acts = acts;
  }

  /** Newest first. @param {Entry[]} entries oldest first */
  show(entries) {
    const ids = new Set(entries.map((entry) => entry.id));
    for (const [id, card] of this.#cards) {
      if (ids.has(id)) continue;
      card.remove();
      this.#cards.delete(id);
    }
    for (const [i, entry] of entries.entries()) this.#update(entry, i + 1);
  }

  /** @param {Entry} entry @param {number} n */
  #update(entry, n) {
    let card = this.#cards.get(entry.id);
    if (!card) {
      card = this.#make(entry);
      this.#cards.set(entry.id, card);
      this.#list.prepend(card);
    }
    card.dataset.sync = entry.sync;
    card.dataset.discarded = String(entry.discarded);
    for (const act of /** @type {const} */ (["replay", "discard", "restore"])) {
      const button = find(card, `[data-act="${act}"]`);
      button.setAttribute("aria-label", `${ACT_WORDS[act]} attempt ${n}`);
      button.title = `${ACT_WORDS[act]} attempt ${n}`;
      button.onclick = () => this.#acts[act](entry, n);
    }
    const [discard, restore] = [find(card, '[data-act="discard"]'), find(card, '[data-act="restore"]')];
    const focused = document.activeElement;
    discard.hidden = entry.discarded || entry.sync === "waiting";
    restore.hidden = !entry.discarded;
    // One takes the other's place, and its focus.
    if (focused === discard && discard.hidden) restore.focus();
    if (focused === restore && restore.hidden) discard.focus();
    const note = find(card, ".attempt-note");
    note.textContent = entry.note ?? (entry.discarded ? "Discarded: it does not count." : "");
    note.hidden = note.textContent === "";
  }

  /** @param {Entry} entry */
  #make(entry) {
    const card = /** @type {HTMLElement} */ (document.importNode(this.#template.content, true).firstElementChild);
    const isSuccess = entry.outcome === "success";
    const nSteps = entry.actions.length;
    card.dataset.demonstrationId = entry.id;
    card.dataset.outcome = entry.outcome;
    find(card, ".attempt-outcome").textContent = isSuccess ? "✓ success" : "✗ failure";
    find(card, ".attempt-figures").textContent = `${signed(entry.total)} · ${plural(nSteps, "step")}`;
    const board = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (find(card, "irl-board"));
    board.world = this.#world;
    board.view = { ...board.view, paths: [{ states: [...entry.states], who: "human", width: 0.7 }] };
    board.label = `The path of a ${entry.outcome}: ${plural(nSteps, "step")}, total ${number(entry.total)}`;
    return card;
  }
}

const ACT_WORDS = { replay: "Replay", discard: "Discard", restore: "Restore" };

/** @param {Element} within @param {string} selector */
function find(within, selector) {
  return /** @type {HTMLElement} */ (within.querySelector(selector));
}
