/**
 * A link by which others see this run: made, copied, and taken back.
 * @import {Run, World} from "#js/learning/types.js"
 */
import { announce } from "#js/lib/announce.js";
import { ApiError, api } from "#js/lib/api.js";
import { copyText } from "#js/lib/clipboard.js";
import { byId } from "#js/lib/dom.js";

export class Sharing {
  #root;
  #worldAddress;
  #complain;
  /** @type {Run | null} */
  #run = null;
  /** @type {string | null} */
  #key = null;

  /**
   * @param {HTMLElement} root
   * @param {World} world
   * @param {(sentence: string) => void} complain
   */
  constructor(root, world, complain) {
    this.#root = root;
    this.#worldAddress = `/worlds/${world.id}`;
    this.#complain = complain;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const on = (/** @type {string} */ name, /** @type {() => unknown} */ act) =>
      this.#part(name)?.addEventListener("click", () => void act(), { signal });
    on("share-run", () => this.#make());
    on("copy-link", () => this.#copy());
    on("take-back", () => this.#takeBack());
  }

  /** @param {Run | null} run that on the boards */
  paint(run) {
    if (run?.id !== this.#run?.id || this.#frameShare.dataset.url === undefined) this.#show(null);
    this.#run = run;
    this.#part("share-run").hidden = run === null;
  }

  async #make() {
    const run = this.#run;
    if (!run) return;
    const made = await this.#ask(() => api.post(`/runs/${run.id}/shares`, {}));
    if (!made || run !== this.#run) return;
    this.#show(made.key);
    await this.#copy();
  }

  async #copy() {
    const field = /** @type {HTMLInputElement} */ (this.#part("share-link"));
    const isCopied = await copyText(field.value);
    this.#say(isCopied ? "The link is copied." : "Copy the link from here.");
    if (isCopied) return;
    field.focus();
    field.select();
  }

  async #takeBack() {
    const [run, key] = [this.#run, this.#key];
    if (!run || !key) return;
    const isDone = await this.#ask(async () => {
      await api.delete(`/runs/${run.id}/shares/${key}`);
      return true;
    });
    if (!isDone) return;
    this.#show(null);
    this.#part("share-run").focus();
    announce("The link is taken back: it opens nothing any more.");
  }

  /**
   * @template Answer
   * @param {() => Promise<Answer>} call
   * @returns {Promise<Answer | null>}
   */
  async #ask(call) {
    try {
      this.#complain("");
      return await call();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      this.#complain(error.message);
      return null;
    }
  }

  /** @param {string | null} key */
  #show(key) {
    this.#key = key;
    this.#part("sharing").hidden = key === null;
    // A run's own address opens nothing for others: "Share" at the top of the page gives the link, or else the world.
    this.#frameShare.dataset.url = this.#worldAddress;
    if (key === null || !this.#run) return;
    const address = `/runs/${this.#run.id}?key=${encodeURIComponent(key)}`;
    this.#frameShare.dataset.url = address;
    /** @type {HTMLInputElement} */ (this.#part("share-link")).value = new URL(address, location.href).href;
  }

  get #frameShare() {
    return byId("share");
  }

  /** @param {string} sentence */
  #say(sentence) {
    this.#part("share-told").textContent = sentence;
    announce(sentence);
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"], [data-action="${name}"]`);
  }
}
