/** The badge beside the list: saved, waiting, offline, busy, or in this page alone; with a sentence where that needs one. */

import { announceToo } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { Guard } from "#js/lib/guard.js";
import { savingNews, savingWords } from "#js/worlds/saving-words.js";

/** @typedef {import("#js/lib/outbox.js").News} News */
/** @typedef {import("#js/lib/parcels.js").Parcel} Parcel */

export class SavingBadge {
  #nUnstored;
  /** What waits, by id. @type {Map<string, "attempt" | "wish">} */
  #waiting = new Map();
  /** @type {import("#js/worlds/saving-words.js").Saving["trouble"]} */
  #trouble = null;
  /** @type {import("#js/worlds/saving-words.js").SavingWords["sync"]} */
  #sync = "saved";
  #guard = new Guard(() => this.#nUnstored() > 0);

  /** @param {() => number} nUnstored parcels that live in this page alone */
  constructor(nUnstored) {
    this.#nUnstored = nUnstored;
  }

  /** @param {Pick<Parcel, "id" | "kind">} parcel */
  wait({ id, kind }) {
    this.#waiting.set(id, kind === "discard" ? "wish" : "attempt");
  }

  /** @param {News} news */
  hear({ kind, parcel, status, retryAfterMs }) {
    if (kind === "kept") return;
    if (kind === "waiting") this.#trouble = { status: status ?? 0, retryAfterMs: retryAfterMs ?? null };
    else {
      this.#waiting.delete(parcel.id);
      this.#trouble = null;
    }
  }

  /** @param {{sync: string}[]} entries all that could be saved */
  show(entries) {
    const kinds = [...this.#waiting.values()];
    const words = savingWords({
      nAttempts: kinds.filter((kind) => kind === "attempt").length,
      nWishes: kinds.filter((kind) => kind === "wish").length,
      nUnstored: this.#nUnstored(),
      nRefused: entries.filter(({ sync }) => sync === "refused").length,
      trouble: this.#trouble,
    });
    const badge = byId("sync");
    badge.hidden = entries.length === 0;
    badge.dataset.sync = words.sync;
    badge.dataset.kind = words.sync === "saved" || words.sync === "waiting" ? "" : "attention";
    badge.textContent = words.badge;
    byId("saving").textContent = words.sentence;
    byId("saving").hidden = words.sentence === "";
    this.#tell(words);
    this.#guard.look();
  }

  /** @param {import("#js/worlds/saving-words.js").SavingWords} words */
  #tell(words) {
    const news = savingNews(words, this.#sync);
    this.#sync = words.sync;
    if (news) announceToo(news);
  }
}
