/** Passing the world on: "Play this world", "Share", and the Share button of the header where the address is too short. */

import { announce } from "#js/lib/announce.js";
import { ApiError } from "#js/lib/api.js";
import { copyText } from "#js/lib/clipboard.js";
import { byId } from "#js/lib/dom.js";
import { disableLink, enableLink } from "#js/lib/path.js";
import { GONE } from "#js/worlds/editor/sentences.js";

/** @typedef {import("#js/worlds/editor/address.js").Address} Address */
/** @typedef {import("#js/worlds/editor/report.js").Report} Report */

export class Sharing {
  #address;
  #report;
  #play = byId("play-link");
  #told = byId("told");

  /** @param {Address} address @param {Report} report */
  constructor(address, report) {
    this.#address = address;
    this.#report = report;
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    this.#play.addEventListener("click", (event) => this.#onPlay(event), { signal });
    byId("share-world").addEventListener("click", () => this.#share(), { signal });
    const onHeaderShare = (/** @type {Event} */ event) => {
      this.#address.write();
      if (!this.#address.isLong) return;
      event.stopImmediatePropagation();
      void this.#share();
    };
    byId("share").addEventListener("click", onHeaderShare, { capture: true, signal });
  }

  /** The world is another: what was told of the last one no longer holds. */
  forget() {
    this.#told.hidden = true;
    this.show();
  }

  /** Impossible worlds cannot be played; the verdict says why. */
  show() {
    if (this.#report.state === "refused") disableLink(this.#play);
    else enableLink(this.#play, this.#address.playAddress ?? "/worlds");
  }

  /** @param {MouseEvent} event */
  async #onPlay(event) {
    this.#address.write();
    const { state, text } = this.#report;
    if (state === "refused" || state === "gone") {
      event.preventDefault();
      this.#tell(text);
    } else if (this.#address.isLong) {
      event.preventDefault();
      await this.#trying(async () => location.assign(await this.#address.store()));
    }
  }

  async #share() {
    await this.#trying(async () => {
      const link = await this.#address.link();
      const isCopied = await copyText(link);
      this.#tell(
        isCopied ? "The link is copied: it opens this world to play." : `The link to play this world: ${link}`,
      );
    });
  }

  /** @param {() => Promise<void>} act */
  async #trying(act) {
    try {
      await act();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.#tell(error.status === 0 ? GONE : error.message);
    }
  }

  /** @param {string} sentence */
  #tell(sentence) {
    this.#told.textContent = sentence;
    this.#told.hidden = false;
    announce(sentence);
  }
}
