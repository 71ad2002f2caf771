/** The presets as small cards: a drawn board and a title each; the words of the one looked at stand below. */

import { api } from "#js/lib/api.js";
import { toQuery } from "#js/worlds/query.js";

/** @typedef {{name: string, title: string, text: string, spec: import("#js/worlds/query.js").Spec}} Preset */

export class Presets {
  #list;
  #words;
  #presets;
  #usual;

  /** @param {{list: HTMLElement, words: HTMLElement, presets: Preset[]}} parts */
  constructor({ list, words, presets }) {
    this.#list = list;
    this.#words = words;
    this.#presets = presets;
    this.#usual = words.textContent;
  }

  /** @param {(preset: Preset) => void} choose @param {AbortSignal} signal */
  listen(choose, signal) {
    for (const preset of this.#presets) {
      const card = this.#cardOf(preset);
      card?.addEventListener("click", () => choose(preset), { signal });
      for (const kind of ["pointerenter", "focus"]) card?.addEventListener(kind, () => this.#tell(preset), { signal });
      for (const kind of ["pointerleave", "blur"]) card?.addEventListener(kind, () => this.#tell(null), { signal });
    }
  }

  /** Boards one after the other, so that the board of the page has the server to itself first. */
  async draw() {
    for (const preset of this.#presets) {
      const board = this.#cardOf(preset)?.querySelector("irl-board");
      const world = await api.get(`/worlds/preview?${toQuery(preset.spec)}`).catch(() => null);
      if (board && world) /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (board).world = world;
    }
  }

  /** Mark the preset that the board shows, if it is one. @param {string} query */
  show(query) {
    for (const preset of this.#presets)
      this.#cardOf(preset)?.setAttribute("aria-pressed", String(toQuery(preset.spec) === query));
  }

  /** @param {Preset | null} preset */
  #tell(preset) {
    this.#words.textContent = preset?.text ?? this.#usual;
  }

  /** @param {Preset} preset */
  #cardOf({ name }) {
    return this.#list.querySelector(`[data-preset="${name}"]`);
  }
}
