/** The rank page: two lists, one function `place` behind drag, keys and buttons; confirmed by one button. An entry script. */

import "#js/elements/irl-board.js";
import { Replay } from "#js/board/replay.js";
import { announce } from "#js/lib/announce.js";
import { ApiError, api } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { isTaken } from "#js/lib/keys.js";
import { openOutbox } from "#js/lib/outbox.js";
import { pageData } from "#js/lib/page-data.js";
import { setStep } from "#js/lib/path.js";
import { CardList } from "#js/rankings/card-list.js";
import { forgetDraft, keepDraft, keptDraft } from "#js/rankings/draft.js";
import { CardKeys } from "#js/rankings/keyboard.js";
import {
  begin,
  flat,
  isSame,
  isTiedAbove,
  move,
  reconcile,
  record,
  redo,
  sortByScore,
  toggleTie,
  undo,
} from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/card-list.js").Outcome} Outcome */
/** @typedef {Record<Outcome, Order>} Orders */

/** @type {Outcome[]} */
const OUTCOMES = ["success", "failure"];

class RankPage {
  #life = new AbortController();
  /** @type {{world: any, demonstrations: any[], rankings: Record<Outcome, any>, start_order: Record<Outcome, string[]>}} */
  #data = pageData();
  #root = byId("rank");
  #center = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (byId("rank-board"));
  #replay = new Replay(this.#center);
  /** What the card that plays by itself showed before. @type {{board: import("#js/elements/irl-board.js").IrlBoard, view: import("#js/board/state.js").View} | null} */
  #still = null;
  /** @type {Map<string, any>} */
  #byId = new Map(this.#data.demonstrations.map((one) => [one.id, one]));
  #history = begin(this.#startOrders());
  /** @type {Orders | null} */
  #confirmed = this.#confirmedOrders();
  /** @type {Record<Outcome, CardList>} */
  #lists = { success: this.#listOf("success"), failure: this.#listOf("failure") };
  #keys = new CardKeys({
    place: (card, position) => this.place(card, outcomeOf(card), position),
    tie: (card) => this.tie(card),
    mark: () => this.#history,
    back: (mark) => {
      this.#history = mark;
      this.#show();
    },
  });

  start() {
    const { signal } = this.#life;
    this.#center.world = this.#data.world;
    const template = /** @type {HTMLTemplateElement} */ (byId("rank-card"));
    for (const outcome of OUTCOMES) this.#lists[outcome].fill(template, this.#data.world, this.#kept(outcome));
    this.#keys.listen(this.#root, signal);
    this.#root.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.#root.addEventListener("focusin", (event) => this.#onWatch(event), { signal });
    this.#root.addEventListener("pointerover", (event) => this.#onWatch(event), { signal });
    document.addEventListener("keydown", (event) => this.#onUndoKey(event), { signal });
    void this.#watchOutbox(signal);
    this.#show();
  }

  /** The one way a card changes its place. @param {HTMLElement} card @param {Outcome} list @param {number} position 0-based */
  place(card, list, position) {
    this.#change(list, move(this.#orders[list], idOf(card), position));
    announce(`${card.getAttribute("aria-label")}. Weight ${Number(card.dataset.weight).toFixed(2)}.`);
  }

  /** @param {HTMLElement} card */
  tie(card) {
    const list = outcomeOf(card);
    this.#change(list, toggleTie(this.#orders[list], idOf(card)));
    const isTied = isTiedAbove(this.#orders[list], idOf(card));
    announce(
      `${isTied ? "Tied with the one above" : "No longer tied with the one above"}. ${card.getAttribute("aria-label")}.`,
    );
  }

  /** @param {Outcome} list */
  sort(list) {
    const totals = new Map(this.#kept(list).map((one) => [one.id, one.total]));
    this.#change(list, sortByScore(this.#orders[list], totals, list));
    announce(list === "success" ? "Sorted by total, the highest first." : "Sorted by total, the lowest first.");
  }

  async confirm() {
    const button = /** @type {HTMLButtonElement} */ (byId("confirm"));
    button.disabled = true;
    const orders = this.#orders;
    try {
      for (const outcome of OUTCOMES.filter((one) => orders[one].length > 0)) {
        await api.put(`/worlds/${this.#data.world.id}/rankings/${outcome}`, {
          order: orders[outcome],
          confirmed: true,
        });
      }
      this.#confirmed = orders;
      forgetDraft(this.#data.world.id);
      this.#tell(null);
      announce("Your order is confirmed. Next: Learn.");
    } catch (error) {
      this.#refuse(error);
    } finally {
      button.disabled = false;
      this.#show();
    }
    if (this.#isConfirmed) byId("learn").focus();
  }

  get #orders() {
    return this.#history.present;
  }

  get #isConfirmed() {
    const confirmed = this.#confirmed;
    return confirmed !== null && OUTCOMES.every((one) => isSame(confirmed[one], this.#orders[one]));
  }

  /** @param {Outcome} outcome @returns {any[]} */
  #kept(outcome) {
    return this.#data.demonstrations.filter((one) => one.outcome === outcome && !one.discarded);
  }

  /** @param {Outcome} outcome */
  #listOf(outcome) {
    return new CardList(byId(`list-${outcome}`), outcome, (card, list, position) => this.place(card, list, position));
  }

  /** What was confirmed or left half done before, brought up to date; else the order the server drew. @returns {Orders} */
  #startOrders() {
    const draft = keptDraft(this.#data.world.id);
    const orderOf = (/** @type {Outcome} */ outcome) => {
      const ids = this.#kept(outcome).map((one) => one.id);
      const shuffled = this.#data.start_order[outcome].filter((id) => ids.includes(id));
      const before = draft?.[outcome] ?? this.#data.rankings[outcome]?.order ?? [];
      return reconcile(before, [...shuffled, ...ids.filter((id) => !shuffled.includes(id))]);
    };
    return { success: orderOf("success"), failure: orderOf("failure") };
  }

  /** @returns {Orders | null} */
  #confirmedOrders() {
    const { success, failure } = this.#data.rankings;
    return success || failure ? { success: success?.order ?? [], failure: failure?.order ?? [] } : null;
  }

  /** @param {Outcome} list @param {Order} order */
  #change(list, order) {
    if (!isSame(order, this.#orders[list])) this.#history = record(this.#history, { ...this.#orders, [list]: order });
    keepDraft(this.#data.world.id, this.#orders);
    this.#show();
  }

  #show() {
    for (const outcome of OUTCOMES) this.#lists[outcome].show(this.#orders[outcome]);
    const nCards = OUTCOMES.reduce((n, outcome) => n + flat(this.#orders[outcome]).length, 0);
    const isConfirmed = this.#isConfirmed;
    this.#root.dataset.confirmed = String(isConfirmed);
    byId("confirm").hidden = isConfirmed || nCards === 0;
    byId("learn").hidden = !isConfirmed;
    byId("rank-state").textContent = isConfirmed
      ? "✓ Confirmed. You can still change it and confirm again."
      : "An order counts once you confirm it.";
    byId("rank-state").hidden = nCards === 0;
    setStep("rank", { state: isConfirmed ? "ranked" : "", isDone: isConfirmed });
    /** @type {HTMLButtonElement} */ (byId("undo")).disabled = this.#history.past.length === 0;
    /** @type {HTMLButtonElement} */ (byId("redo")).disabled = this.#history.future.length === 0;
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (!button) return;
    const card = /** @type {HTMLElement | null} */ (button.closest(".card"));
    const { act, sort } = button.dataset;
    if (card && act === "up") this.place(card, outcomeOf(card), Number(card.dataset.position) - 2);
    else if (card && act === "down") this.place(card, outcomeOf(card), Number(card.dataset.position));
    else if (card && act === "tie") this.tie(card);
    else if (sort) this.sort(/** @type {Outcome} */ (sort));
    else if (button.id === "undo") this.#travel(undo(this.#history), "Undone.");
    else if (button.id === "redo") this.#travel(redo(this.#history), "Done again.");
    else if (button.id === "confirm") void this.confirm();
    else if (button.id === "reload") location.reload();
    // A button at the end of its list is switched off under the finger: its card takes the focus.
    if (card && /** @type {HTMLButtonElement} */ (button).disabled) card.focus();
  }

  /** @param {KeyboardEvent} event */
  #onUndoKey(event) {
    const isChord = (event.ctrlKey || event.metaKey) && !event.altKey;
    const key = event.key.toLowerCase();
    if (isTaken(event) && !isChord) return;
    if (key === "z" && event.shiftKey) this.#travel(redo(this.#history), "Done again.");
    else if (key === "z") this.#travel(undo(this.#history), "Undone.");
    else if (key === "y" && isChord) this.#travel(redo(this.#history), "Done again.");
    else return;
    event.preventDefault();
  }

  /** @param {import("#js/rankings/order.js").History<Orders>} history @param {string} word */
  #travel(history, word) {
    if (history === this.#history) return;
    this.#history = history;
    keepDraft(this.#data.world.id, this.#orders);
    this.#show();
    announce(word);
  }

  /** What is pointed at or focused plays again: on the board between the lists, or on the card where there is none. @param {Event} event */
  #onWatch(event) {
    const card =
      event.target instanceof Element ? /** @type {HTMLElement | null} */ (event.target.closest(".card")) : null;
    const one = card ? this.#byId.get(idOf(card)) : null;
    if (!card || !one || (card.dataset.watching === "true" && this.#replay.isPlaying)) return;
    for (const other of this.#root.querySelectorAll("[data-watching]"))
      delete (/** @type {HTMLElement} */ (other).dataset.watching);
    card.dataset.watching = "true";
    const isThere = this.#center.clientWidth > 0;
    const board = isThere
      ? this.#center
      : /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (card.querySelector("irl-board"));
    if (this.#replay.board !== board) {
      this.#replay.stop();
      this.#rest();
      this.#still = isThere ? null : { board, view: board.view };
      this.#replay = new Replay(board);
      this.#replay.speed = 2;
    }
    byId("rank-caption").textContent = card.dataset.words ?? "";
    this.#replay.play(one, () => this.#rest());
  }

  /** A card that played by itself shows its whole path again. */
  #rest() {
    if (this.#still) this.#still.board.view = this.#still.view;
  }

  /** @param {unknown} error */
  #refuse(error) {
    if (!(error instanceof ApiError)) throw error;
    const isStale = error.status === 422 || error.status === 404;
    const sentence = isStale
      ? "Your attempts have changed since this page was opened, so this order is not complete any more. Load the page again; your order is kept."
      : `${error.message} Your order is kept here; try again in a moment.`;
    this.#tell(sentence, isStale);
  }

  /** @param {string | null} sentence @param {boolean} [canReload] */
  #tell(sentence, canReload = false) {
    byId("rank-notice").hidden = sentence === null;
    byId("rank-notice-text").textContent = sentence ?? "";
    byId("reload").hidden = !canReload;
    if (sentence) announce(sentence);
  }

  /** Attempts that still wait in this browser belong into the lists once they are saved. @param {AbortSignal} signal */
  #watchOutbox(signal) {
    const report = (/** @type {import("#js/lib/outbox.js").News} */ { kind, parcel }) => {
      if (
        kind !== "saved" ||
        parcel.kind === "discard" ||
        parcel.worldId !== this.#data.world.id ||
        this.#byId.has(parcel.id)
      )
        return;
      this.#tell(
        "An attempt that was waiting has just been saved. Load the page again to rank it too; your order is kept.",
        true,
      );
    };
    openOutbox(report).watch(signal);
  }
}

/** @param {HTMLElement} card */
function idOf(card) {
  return card.dataset.demonstrationId ?? "";
}

/** @param {HTMLElement} card @returns {Outcome} */
function outcomeOf(card) {
  return card.dataset.list === "failure" ? "failure" : "success";
}

new RankPage().start();
