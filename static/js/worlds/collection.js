/** The finished attempts of this world: counted, listed, saved, discarded, restored; and the way on to ranking. */

import { announce, announceToo } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { openOutbox } from "#js/lib/outbox.js";
import { isOfRankings, isRefused } from "#js/lib/parcels.js";
import { disableLink, enableLink, setStep, showCounts } from "#js/lib/path.js";
import { AttemptStrip } from "#js/worlds/attempt-strip.js";
import { bodyOf, entryOfAttempt, entryOfDemonstration, entryOfParcel, fileOf } from "#js/worlds/entries.js";
import { toQuery } from "#js/worlds/query.js";
import { SavingBadge } from "#js/worlds/saving-badge.js";
import { refusalSentence, wishSentence } from "#js/worlds/saving-words.js";
import { canRank, missingSentence } from "#js/worlds/sentences.js";

/** @typedef {import("#js/board/moves.js").Attempt} Attempt */
/** @typedef {import("#js/lib/outbox.js").News} News */
/** @typedef {import("#js/lib/parcels.js").Parcel} Parcel */
/** @typedef {import("#js/worlds/entries.js").Entry} Entry */

export class Collection {
  #world;
  #spec;
  #isSaved;
  #nWanted;
  /** @type {Entry[]} oldest first */
  #entries;
  #strip;
  #outbox = openOutbox((news) => this.#hear(news));
  /** Before that nobody knows whether all is saved. */
  #isOutboxRead = false;
  #badge = new SavingBadge(() => this.#outbox.nUnstored);

  /**
   * @param {{world: import("#js/board/state.js").World, saved: boolean, demonstrations: any[]}} data
   * @param {number} nWanted
   * @param {{replay: (entry: Entry, n: number) => void, showTotals?: boolean}} options
   */
  constructor({ world, saved, demonstrations }, nWanted, { replay, showTotals = true }) {
    if (!world.spec) throw new Error("This world does not say how it is made, so it could not be sent.");
    this.#world = world;
    this.#spec = world.spec;
    this.#isSaved = saved;
    this.#nWanted = nWanted;
    this.#entries = demonstrations.map(entryOfDemonstration);
    this.#strip = new AttemptStrip(byId("attempts"), templateOf("attempt-card"), world, {
      showTotals,
      acts: {
        replay,
        discard: (entry) => this.#setDiscarded(entry, true),
        restore: (entry) => this.#setDiscarded(entry, false),
        save: (entry, n) => this.#saveAsFile(entry, n),
        forget: (entry) => this.#forget(entry),
      },
    });
  }

  /** Show what the page knows, then what waits in this browser, and send it. @param {AbortSignal} signal */
  async start(signal) {
    this.#show();
    await this.#outbox.recover();
    for (const parcel of await this.#outbox.all()) if (this.#isOfThisWorld(parcel)) this.#takeIn(parcel);
    this.#isOutboxRead = true;
    this.#show();
    this.#outbox.watch(signal);
  }

  /** Keep a finished attempt and send it. @param {Attempt} attempt @param {unknown} [record] @returns {Promise<boolean>} whether it is in the storage by now */
  async add(attempt, record) {
    this.#entries.push(entryOfAttempt(attempt));
    const { id, slipSeeds } = attempt;
    const parcel = { id, worldId: this.#world.id, world: { ...this.#spec }, body: bodyOf(attempt, record), slipSeeds };
    this.#badge.wait(parcel);
    this.#outdateOrder();
    this.#show();
    await this.#outbox.add(parcel);
    return this.#outbox.nUnstored === 0;
  }

  /** @param {string} id */
  entry(id) {
    return this.#entries.find((entry) => entry.id === id);
  }

  /** Attempts of this outcome that count. @param {"success" | "failure"} outcome */
  count(outcome) {
    return this.#entries.filter((entry) => entry.outcome === outcome && !entry.discarded && entry.sync !== "refused")
      .length;
  }

  /** Put the world into the address, so that a reload or a copied link opens it even before it is stored. */
  shareQuery() {
    if (!this.#isSaved) history.replaceState(null, "", `/?${toQuery(this.#spec)}`);
  }

  /** @param {News} news */
  #hear(news) {
    const { parcel, kind } = news;
    if (isOfRankings(parcel)) return;
    if (this.#isOfThisWorld(parcel)) {
      if (kind === "kept") this.#takeIn(parcel);
      else if (kind === "saved") this.#settle(news);
      else if (kind === "refused") this.#refuse(news);
      else if (kind === "forgotten") this.#remove(parcel.id);
    }
    this.#badge.hear(news);
    this.#show();
  }

  /** A parcel of an earlier visit, or of another tab. @param {Parcel} parcel */
  #takeIn(parcel) {
    if (isOfRankings(parcel)) return;
    if (!isRefused(parcel)) this.#badge.wait(parcel);
    if (parcel.kind === "discard") {
      const entry = this.entry(parcel.attemptId);
      if (entry) Object.assign(entry, { discarded: parcel.discarded, note: null });
    } else if (!this.entry(parcel.id)) this.#entries.push(entryOfParcel(this.#world, parcel));
  }

  /** @param {News} news */
  #settle({ parcel, answer }) {
    if (parcel.kind === "discard") return;
    const { total, world_id: worldId } = answer;
    const entry = this.entry(parcel.id);
    if (entry) Object.assign(entry, { total, sync: "saved", note: null });
    else this.#entries.push(entryOfDemonstration(answer));
    this.#becomeSaved(worldId);
  }

  /** @param {string} worldId */
  #becomeSaved(worldId) {
    this.#isSaved = true;
    // Somebody else may have stored this world before.
    if (location.pathname === "/") history.replaceState(null, "", `/worlds/${worldId}`);
  }

  /** @param {News} news */
  #refuse({ parcel }) {
    const entry = this.entry(parcel.kind === "discard" ? parcel.attemptId : parcel.id);
    if (!entry || (parcel.kind === "discard" && entry.sync === "refused")) return;
    if (parcel.kind === "discard") {
      entry.discarded = !parcel.discarded;
      entry.note = wishSentence({ message: parcel.refusal ?? "", isDiscarded: parcel.discarded });
    } else {
      Object.assign(entry, { sync: "refused", discarded: false, note: refusalSentence(parcel) });
    }
    announceToo(entry.note ?? "");
  }

  /** @param {Entry} entry @param {boolean} discarded */
  #setDiscarded(entry, discarded) {
    entry.discarded = discarded;
    entry.note = null;
    this.#outdateOrder();
    this.#show();
    announce(discarded ? "Discarded. It can be restored." : "Restored.");
    void this.#outbox.setDiscarded({ attemptId: entry.id, worldId: this.#world.id, discarded });
  }

  /** @param {Entry} entry @param {number} n */
  async #saveAsFile(entry, n) {
    const parcel = (await this.#outbox.all()).find(({ id }) => id === entry.id);
    if (!parcel || parcel.kind !== undefined) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([fileOf(this.#world, entry, parcel)], { type: "application/jsonl" }));
    link.download = `attempt-${n}-${entry.id.slice(0, 8)}.jsonl`;
    link.click();
    // The download has its own hold on the data by then.
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
    announce(`Attempt ${n} is saved as the file ${link.download}.`);
  }

  /** @param {Entry} entry */
  async #forget(entry) {
    await this.#outbox.forget(entry.id);
    announce("Forgotten.");
    byId("board").focus({ preventScroll: true });
  }

  /** @param {string} id */
  #remove(id) {
    this.#entries = this.#entries.filter((entry) => entry.id !== id);
  }

  /** A damaged parcel has to be shown somewhere. @param {Parcel} parcel */
  #isOfThisWorld({ worldId }) {
    return worldId === this.#world.id || typeof worldId !== "string";
  }

  /** A confirmed order no longer holds once the attempts are others. */
  #outdateOrder() {
    setStep("rank", { state: "", isDone: false });
  }

  #show() {
    const counts = { nSuccesses: this.count("success"), nFailures: this.count("failure"), nWanted: this.#nWanted };
    this.#strip.show(this.#entries);
    byId("attempts-empty").hidden = this.#entries.length > 0;
    this.#showTally("success", counts.nSuccesses);
    this.#showTally("failure", counts.nFailures);
    if (this.#isOutboxRead) this.#badge.show(this.#entries);
    showCounts({ worldId: this.#world.id, isSaved: this.#isSaved, ...counts });
    this.#showNext(counts);
  }

  /** @param {"success" | "failure"} outcome @param {number} n */
  #showTally(outcome, n) {
    byId(outcome === "success" ? "n-successes" : "n-failures").textContent = String(n);
    const words = document.querySelector(`#tally [data-outcome="${outcome}"]`);
    words?.setAttribute("data-full", String(n >= this.#nWanted));
    words?.querySelector(".tally-wanted")?.toggleAttribute("hidden", n > this.#nWanted);
  }

  /** @param {{nSuccesses: number, nFailures: number, nWanted: number}} counts */
  #showNext(counts) {
    const next = byId("next");
    const isPossible = canRank(counts) && this.#isSaved;
    const isHopeless = this.#world.success_possible === false && counts.nSuccesses === 0;
    byId("missing").textContent = isHopeless
      ? "In this world every way costs more than the goal gives, so no success is possible. Try a new world."
      : missingSentence(counts);
    byId("elsewhere").hidden = !isHopeless;
    next.hidden = isHopeless;
    next.dataset.ready = String(counts.nSuccesses >= this.#nWanted && counts.nFailures >= this.#nWanted);
    if (isPossible) enableLink(next, `/worlds/${this.#world.id}/rank`);
    else disableLink(next);
  }
}

/** @param {string} id */
function templateOf(id) {
  return /** @type {HTMLTemplateElement} */ (byId(id));
}
