/**
 * What a person takes away from a comparison: the link, the file and the command that compute it again.
 * @import {Parts} from "#js/elements/compare-page.js"
 */
import { fileName, reproduceCommand } from "#js/comparisons/reproduce.js";
import { announce } from "#js/lib/announce.js";
import { runApi } from "#js/lib/run-address.js";

export class TakeAway {
  #root;
  #data;

  /** @param {Parts} parts */
  constructor({ root, data }) {
    this.#root = root;
    this.#data = data;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const { run } = this.#data;
    this.#part("command").textContent = reproduceCommand(run);
    this.#part("download").href = `/api/v1${runApi(run.id, "/demonstrations.jsonl")}`;
    this.#part("download").download = fileName(run);
    this.#root.addEventListener("click", (event) => this.#onClick(event), { signal });
  }

  /** @param {Event} event */
  #onClick(event) {
    const action =
      event.target instanceof Element ? event.target.closest("[data-action]")?.getAttribute("data-action") : null;
    if (action === "copy-command") this.#copy(reproduceCommand(this.#data.run), "The command is copied.");
    if (action === "copy-link") this.#copy(location.href, "The link is copied.");
  }

  /** @param {string} text @param {string} sentence */
  async #copy(text, sentence) {
    try {
      await navigator.clipboard.writeText(text);
      this.#part("copied").textContent = sentence;
    } catch {
      this.#part("copied").textContent = `Your browser does not let this page copy. Here it is: ${text}`;
    }
    announce(this.#part("copied").textContent);
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"]`);
  }
}
