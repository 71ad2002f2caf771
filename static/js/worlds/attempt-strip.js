/** The list of finished attempts: a small board with the path, the outcome in word and sign, total, steps, what can be done. */

import { plural, signed } from "#js/lib/format.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/worlds/entries.js").Entry} Entry */
/** @typedef {"replay" | "discard" | "restore" | "save" | "forget"} Act */
/** @typedef {Record<Act, (entry: Entry, n: number) => void>} Acts */

export class AttemptStrip {
  #list;
  #template;
  #world;
  #showTotals;
  #acts;
  /** @type {Map<string, HTMLElement>} */
  #cards = new Map();
  /** @type {WeakMap<Element, () => void>} */
  #drawings = new WeakMap();
  /** Boards out of sight cost nothing, however many they are. */
  #eye = new IntersectionObserver((seen) => this.#drawSeen(seen), { rootMargin: "200px" });

  /**
   * @param {HTMLElement} list
   * @param {HTMLTemplateElement} template
   * @param {World} world
   * @param {{showTotals: boolean, acts: Acts}} options
   */
  constructor(list, template, world, { showTotals, acts }) {
    this.#list = list;
    this.#template = template;
    this.#world = world;
    this.#showTotals = showTotals;
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
    const numbers = new Map(entries.map(({ id }, i) => [id, i + 1]));
    for (const [i, entry] of entries.entries()) this.#update(entry, i + 1, originWords(entry, numbers));
  }

  /** @param {Entry} entry @param {number} n @param {string} origin */
  #update(entry, n, origin) {
    const card = this.#cards.get(entry.id) ?? this.#make(entry);
    card.dataset.sync = entry.sync;
    card.dataset.discarded = String(entry.discarded);
    find(card, ".attempt-figures").textContent = this.#figures(entry);
    find(card, ".attempt-origin").textContent = origin;
    for (const button of card.querySelectorAll("button")) {
      const act = /** @type {Act} */ (button.dataset.act);
      const words = `${ACT_WORDS[act]} attempt ${n}${act === "save" ? " as a file" : ""}`;
      if (!button.dataset.asked) button.setAttribute("aria-label", words);
      button.title = words;
      button.onclick = () => this.#act(button, act, entry, n);
    }
    this.#showActs(card, entry);
    const note = find(card, ".attempt-note");
    note.textContent = entry.note ?? (entry.discarded ? "Discarded: it does not count." : "");
    note.hidden = note.textContent === "";
  }

  /** What cannot be taken back is asked for twice. @param {HTMLButtonElement} button @param {Act} act @param {Entry} entry @param {number} n */
  #act(button, act, entry, n) {
    if (act !== "forget" || button.dataset.asked) return this.#acts[act](entry, n);
    button.dataset.asked = "true";
    button.textContent = "Forget for good";
    button.setAttribute("aria-label", `Forget attempt ${n} for good`);
  }

  /** @param {HTMLElement} card @param {Entry} entry */
  #showActs(card, entry) {
    const [discard, restore] = [find(card, '[data-act="discard"]'), find(card, '[data-act="restore"]')];
    const focused = document.activeElement;
    discard.hidden = entry.discarded || entry.sync === "refused";
    restore.hidden = !entry.discarded || entry.sync === "refused";
    find(card, ".attempt-rescue").hidden = entry.sync !== "refused";
    // One takes the other's place, and its focus.
    if (focused === discard && discard.hidden) restore.focus();
    if (focused === restore && restore.hidden) discard.focus();
  }

  /** @param {Entry} entry */
  #make(entry) {
    const card = /** @type {HTMLElement} */ (document.importNode(this.#template.content, true).firstElementChild);
    card.dataset.demonstrationId = entry.id;
    card.dataset.outcome = entry.outcome;
    find(card, ".attempt-outcome").textContent = entry.outcome === "success" ? "✓ success" : "✗ failure";
    const board = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (find(card, "irl-board"));
    board.label = `The path of a ${entry.outcome}: ${this.#figures(entry)}`;
    this.#drawings.set(board, () => {
      board.world = this.#world;
      board.view = { ...board.view, paths: [{ states: [...entry.states], who: "human", width: 0.7 }] };
    });
    this.#cards.set(entry.id, card);
    this.#list.prepend(card);
    this.#eye.observe(board);
    return card;
  }

  /** @param {Entry} entry */
  #figures({ total, actions }) {
    const steps = plural(actions.length, "step");
    return this.#showTotals ? `${signed(total)} · ${steps}` : steps;
  }

  /** @param {IntersectionObserverEntry[]} seen */
  #drawSeen(seen) {
    for (const { target, isIntersecting } of seen) {
      if (!isIntersecting) continue;
      this.#drawings.get(target)?.();
      this.#eye.unobserve(target);
    }
  }
}

const ACT_WORDS = { replay: "Replay", discard: "Discard", restore: "Restore", save: "Save", forget: "Forget" };

/** @param {Entry} entry @param {Map<string, number>} numbers of the attempts, by id */
function originWords({ parentId, parentStep }, numbers) {
  const n = parentId === null ? undefined : numbers.get(parentId);
  return n === undefined ? "" : `from attempt ${n}, step ${parentStep}`;
}

/** @param {Element} within @param {string} selector */
function find(within, selector) {
  return /** @type {HTMLElement} */ (within.querySelector(selector));
}
