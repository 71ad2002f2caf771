/** The notice above the button: what stands against the order, and what can be done about it. */

import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";

/** @typedef {{newIds?: readonly string[], canSave?: boolean}} Help */

export class Told {
  #box = byId("rank-told");
  /** @type {string | undefined} */
  #newId;

  /** @param {AbortSignal} signal @param {{onShow: (id: string) => void, onSave: () => void}} hands */
  start(signal, { onShow, onSave }) {
    byId("show-new").addEventListener("click", () => this.#newId && onShow(this.#newId), { signal });
    byId("save-order").addEventListener("click", onSave, { signal });
    byId("close-told").addEventListener("click", () => this.#close(), { signal });
  }

  /** @param {string} sentence @param {Help} [help] */
  say(sentence, { newIds = [], canSave = false } = {}) {
    this.#box.hidden = false;
    byId("rank-told-text").textContent = sentence;
    this.#newId = newIds[0];
    byId("show-new").hidden = newIds.length === 0;
    byId("show-new").textContent = newIds.length === 1 ? "Go to the new one" : "Go to the new ones";
    byId("save-order").hidden = !canSave;
    announce(sentence);
  }

  clear() {
    this.#box.hidden = true;
  }

  /** The focus goes on to what can be done next. */
  #close() {
    this.clear();
    for (const id of ["confirm", "learn"]) if (!byId(id).hidden) return byId(id).focus();
  }
}
