/** The finished attempts of this world: counted, listed, saved, discarded, restored; and the way on to ranking. */

import { outcomeOf, replayActions, totalOf } from "#js/board/moves.js";
import { announce } from "#js/lib/announce.js";
import { ApiError, api } from "#js/lib/api.js";
import { byId } from "#js/lib/dom.js";
import { plural } from "#js/lib/format.js";
import { Outbox, openStore } from "#js/lib/outbox.js";
import { disableLink, enableLink, setStep, showCounts } from "#js/lib/path.js";
import { AttemptStrip } from "#js/worlds/attempt-strip.js";
import { canRank, missingSentence } from "#js/worlds/sentences.js";

/** @typedef {import("#js/board/moves.js").Attempt} Attempt */
/** @typedef {import("#js/worlds/attempt-strip.js").Entry} Entry */

export class Collection {
  #world;
  #isSaved;
  #nWanted;
  /** @type {Entry[]} oldest first */
  #entries;
  #strip;
  /** @type {Promise<Outbox>} */
  #outbox;
  #lasts = true;
  #isReachable = true;

  /**
   * @param {{world: import("#js/board/state.js").World, saved: boolean, demonstrations: any[]}} data
   * @param {number} nWanted
   * @param {{replay: (entry: Entry, n: number) => void}} acts
   */
  constructor({ world, saved, demonstrations }, nWanted, { replay }) {
    this.#world = world;
    this.#isSaved = saved;
    this.#nWanted = nWanted;
    this.#entries = demonstrations.map(entryOf);
    this.#outbox = this.#openOutbox();
    const template = /** @type {HTMLTemplateElement} */ (byId("attempt-card"));
    this.#strip = new AttemptStrip(byId("attempts"), template, world, {
      replay,
      discard: (entry) => this.#setDiscarded(entry, true),
      restore: (entry) => this.#setDiscarded(entry, false),
    });
  }

  /** @param {AbortSignal} signal */
  async start(signal) {
    this.#show();
    const outbox = await this.#outbox;
    for (const parcel of await outbox.all()) {
      if (parcel.worldId === this.#world.id && !this.#find(parcel.id)) this.#entries.push(this.#entryOfParcel(parcel));
    }
    this.#show();
    outbox.watch(signal);
  }

  /** Keep a finished attempt and send it. @param {Attempt} attempt */
  add(attempt) {
    const { id, states, actions, stepMs, ending } = attempt;
    const shared = { id, states, actions, outcome: outcomeOf(attempt), total: totalOf(attempt) };
    this.#entries.push({ ...shared, discarded: false, sync: "waiting", note: null });
    this.#outdateOrder();
    this.#show();
    const body = { id, actions, step_ms: stepMs, ending: ending ?? "gave_up" };
    const parcel = { id, worldId: this.#world.id, world: this.#spec(), body };
    void this.#outbox.then((outbox) => outbox.add(parcel));
  }

  /** Attempts of this outcome that count. @param {"success" | "failure"} outcome */
  count(outcome) {
    return this.#entries.filter((entry) => entry.outcome === outcome && !entry.discarded && entry.sync !== "refused")
      .length;
  }

  /** Put the seed into the address, so that a reload or a copied link opens this world even before it is stored. */
  shareSeed() {
    if (this.#isSaved || this.#world.seed === null || this.#world.walls.length > 0) return;
    const { seed, rows, cols, red_probability, slip } = this.#world;
    const query = new URLSearchParams({ seed: String(seed), rows: String(rows), cols: String(cols) });
    if (red_probability !== null) query.set("red_probability", String(red_probability));
    if (slip > 0) query.set("slip", String(slip));
    history.replaceState(null, "", `/?${query}`);
  }

  /** @returns {Promise<Outbox>} */
  async #openOutbox() {
    const { store, lasts } = await openStore();
    this.#lasts = lasts;
    return new Outbox({ store, report: (news) => this.#hear(news) });
  }

  /** @param {import("#js/lib/outbox.js").News} news */
  #hear({ kind, parcel, demonstration }) {
    if (kind === "saved" && parcel.worldId === this.#world.id)
      this.#becomeSaved(demonstration?.world_id ?? parcel.worldId);
    this.#isReachable = kind !== "waiting";
    const entry = this.#find(parcel.id);
    if (entry) this.#note(entry, { kind, parcel, demonstration });
    this.#show();
  }

  /** @param {Entry} entry @param {import("#js/lib/outbox.js").News} news */
  #note(entry, { kind, parcel, demonstration }) {
    entry.sync = kind;
    if (kind === "saved") entry.total = demonstration?.total ?? entry.total;
    if (kind === "refused") {
      entry.note = `The server did not accept this attempt: ${parcel.refusal}`;
      announce(entry.note);
    }
  }

  /** @param {string} worldId */
  #becomeSaved(worldId) {
    if (this.#isSaved) return;
    this.#isSaved = true;
    history.replaceState(null, "", `/worlds/${worldId}`);
  }

  /** @param {Entry} entry @param {boolean} isDiscarded */
  async #setDiscarded(entry, isDiscarded) {
    if (entry.sync === "refused") return this.#forget(entry);
    entry.discarded = isDiscarded;
    entry.note = null;
    this.#outdateOrder();
    this.#show();
    announce(isDiscarded ? "Discarded. It can be restored." : "Restored.");
    try {
      const path = `/demonstrations/${entry.id}/discard`;
      await (isDiscarded ? api.put(path) : api.delete(path));
    } catch (error) {
      entry.discarded = !isDiscarded;
      entry.note = error instanceof ApiError ? error.message : "That did not work.";
      this.#show();
      announce(entry.note);
    }
  }

  /** @param {Entry} entry */
  async #forget(entry) {
    this.#entries = this.#entries.filter((other) => other !== entry);
    this.#show();
    await (await this.#outbox).forget(entry.id);
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
    this.#showSync();
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

  #showSync() {
    const nWaiting = this.#entries.filter((entry) => entry.sync === "waiting").length;
    const badge = byId("sync");
    badge.hidden = this.#entries.length === 0;
    badge.dataset.sync = nWaiting > 0 ? (this.#isReachable && navigator.onLine ? "waiting" : "offline") : "saved";
    badge.dataset.kind = badge.dataset.sync === "offline" ? "attention" : "";
    badge.textContent = this.#syncWords(badge.dataset.sync, nWaiting);
  }

  /** @param {string} sync @param {number} nWaiting */
  #syncWords(sync, nWaiting) {
    if (sync === "saved") return "✓ all saved";
    if (sync === "waiting") return `saving ${nWaiting} …`;
    return this.#lasts ? `offline: ${plural(nWaiting, "attempt")} kept here` : "offline: keep this page open";
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

  /** @param {string} id */
  #find(id) {
    return this.#entries.find((entry) => entry.id === id);
  }

  /** @param {import("#js/lib/outbox.js").Parcel} parcel @returns {Entry} */
  #entryOfParcel(parcel) {
    const walked = replayActions(this.#world, {
      id: parcel.id,
      actions: parcel.body.actions,
      stepMs: parcel.body.step_ms,
    });
    return {
      id: parcel.id,
      states: walked.states,
      actions: walked.actions,
      outcome: outcomeOf(walked),
      total: totalOf(walked),
      discarded: false,
      sync: parcel.refusal === null ? "waiting" : "refused",
      note: parcel.refusal === null ? null : `The server did not accept this attempt: ${parcel.refusal}`,
    };
  }

  /** What makes this world again, on a server that does not have it yet. */
  #spec() {
    const { rows, cols, seed, red_probability, slip, walls } = this.#world;
    const spec = { rows, cols, seed, red_probability, slip, walls };
    return Object.fromEntries(Object.entries(spec).filter(([, value]) => value !== null));
  }
}

/** @param {any} demonstration of the API @returns {Entry} */
function entryOf({ id, states, actions, outcome, total, discarded }) {
  return { id, states, actions, outcome, total, discarded, sync: "saved", note: null };
}
