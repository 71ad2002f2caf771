/**
 * The link by which others see a comparison: made, copied, taken back. Until it is made, the address in the bar opens for
 * this visitor alone, so the page's own Share button makes it, too.
 */
import { ApiError, api } from "#js/lib/api.js";
import { copyText } from "#js/lib/clipboard.js";

/** @typedef {{key: string, address: string}} Share */

export class ShareLink {
  #runId;
  #part;
  #tell;
  /** @type {Share | null} */
  #share = null;

  /**
   * @param {string} runId
   * @param {{part: (name: string) => any, tell: (sentence: string) => void}} page
   */
  constructor(runId, { part, tell }) {
    this.#runId = runId;
    this.#part = part;
    this.#tell = tell;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const button = document.getElementById("share");
    button?.addEventListener("click", (event) => this.#shareFirst(event), { capture: true, signal });
    this.#look();
  }

  async make() {
    const made = await this.#ask(() => api.post(`/runs/${this.#runId}/shares`, {}));
    if (made) this.#show(made);
    return made !== null;
  }

  /** The button that makes it goes away: the link takes its focus. */
  async makeAndCopy() {
    if (!(await this.make())) return;
    this.#part("link").focus();
    await this.copy();
  }

  async copy() {
    const field = this.#part("link");
    const isCopied = await copyText(field.value);
    this.#tell(
      isCopied ? "The link is copied." : "Your browser does not let this page copy. The link is marked: copy it.",
    );
    if (isCopied) return;
    field.focus();
    field.select();
  }

  async takeBack() {
    const share = this.#share;
    if (!share) return;
    const isDone = await this.#ask(async () => {
      await api.delete(`/runs/${this.#runId}/shares/${share.key}`);
      return true;
    });
    if (!isDone) return;
    this.#show(null);
    this.#tell("The link is taken back: it opens nothing any more.");
    this.#part("make-link").focus();
  }

  /** A link made on another day still stands. */
  async #look() {
    const shares = await this.#ask(() => api.get(`/runs/${this.#runId}/shares`));
    if (shares?.length && !this.#share) this.#show(shares[0]);
  }

  /** The Share button of the page copies an address that opens for others. @param {Event} event */
  async #shareFirst(event) {
    if (this.#share) return;
    event.stopImmediatePropagation();
    const button = /** @type {HTMLButtonElement} */ (event.currentTarget);
    if (await this.make()) button.click();
  }

  /** @param {Share | null} share */
  #show(share) {
    this.#share = share;
    this.#part("no-link").hidden = share !== null;
    this.#part("has-link").hidden = share === null;
    const button = document.getElementById("share");
    if (share) {
      this.#part("link").value = new URL(share.address, location.href).href;
      if (button) button.dataset.url = share.address;
    } else delete button?.dataset.url;
  }

  /**
   * @template Answer
   * @param {() => Promise<Answer>} call
   * @returns {Promise<Answer | null>}
   */
  async #ask(call) {
    try {
      return await call();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.#tell(error.message);
      return null;
    }
  }
}
