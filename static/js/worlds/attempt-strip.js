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
  /** What is on show, by id; `face`: all that a card says, so that only those that changed are touched. @type {Map<string, {card: HTMLElement, entry: Entry, n: number, face: string}>} */
  #shown = new Map();
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
    list.addEventListener("click", (event) => this.#onClick(event));
  }

  /** Newest first. @param {Entry[]} entries oldest first */
  show(entries) {
    const numbers = new Map(entries.map(({ id }, i) => [id, i + 1]));
    for (const [id, { card }] of this.#shown) {
      if (numbers.has(id)) continue;
      card.remove();
      this.#shown.delete(id);
    }
    for (const [i, entry] of entries.entries()) this.#update(entry, i + 1, originWords(entry, numbers));
  }

  /** @param {Entry} entry @param {number} n @param {string} origin */
  #update(entry, n, origin) {
    const { total, sync, discarded, note } = entry;
    const face = JSON.stringify([n, total, sync, discarded, note, origin]);
    const { card, face: before } = this.#shown.get(entry.id) ?? { card: this.#make(entry), face: "" };
    this.#shown.set(entry.id, { card, entry, n, face });
    if (face === before) return;
    card.dataset.sync = sync;
    card.dataset.discarded = String(discarded);
    find(card, ".attempt-n").textContent = String(n);
    find(card, ".attempt-figures").textContent = this.#figures(entry);
    find(card, ".attempt-origin").textContent = origin;
    const words = note ?? (discarded ? "Discarded: it does not count." : "");
    find(card, ".attempt-note").textContent = words;
    find(card, ".attempt-note").hidden = words === "";
    this.#nameActs(card, n);
    this.#showActs(card, entry);
  }

  /** @param {HTMLElement} card @param {number} n */
  #nameActs(card, n) {
    for (const button of card.querySelectorAll("button")) {
      const act = /** @type {Act} */ (button.dataset.act);
      button.title = `${ACT_WORDS[act]} attempt ${n}${act === "save" ? " as a file" : ""}`;
      button.setAttribute("aria-label", button.title);
    }
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

  /** @param {MouseEvent} event */
  #onClick(event) {
    const target = event.target instanceof Element ? event.target : null;
    const button = /** @type {HTMLButtonElement | null} */ (target?.closest("button[data-act]") ?? null);
    const id = /** @type {HTMLElement | null} */ (button?.closest(".attempt"))?.dataset.demonstrationId ?? "";
    const shown = this.#shown.get(id);
    if (!button || !shown) return;
    const act = /** @type {Act} */ (button.dataset.act);
    if (act === "forget" && !button.dataset.asked) askAgain(button, shown.n);
    else this.#acts[act](shown.entry, shown.n);
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

/** What cannot be taken back is asked for twice. @param {HTMLButtonElement} button @param {number} n */
function askAgain(button, n) {
  button.dataset.asked = "true";
  button.textContent = "Forget for good";
  button.setAttribute("aria-label", `Forget attempt ${n} for good`);
}

/** @param {Entry} entry @param {Map<string, number>} numbers of the attempts, by id */
function originWords({ parentId, parentStep }, numbers) {
  const n = parentId === null ? undefined : numbers.get(parentId);
  return n === undefined ? "" : `from attempt ${n}, step ${parentStep}`;
}

/** @param {Element} within @param {string} selector */
function find(within, selector) {
  return /** @type {HTMLElement} */ (within.querySelector(selector));
}
