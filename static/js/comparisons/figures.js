/**
 * The result in words and figures: the sentence at the head of the page, the table and the dot plot.
 * @import {Parts} from "#js/elements/compare-page.js"
 */
import { mountDotPlot } from "#js/charts/dot-plot.js";
import { resultRows } from "#js/comparisons/result-table.js";
import { backgroundSentence, posteriorSentences, resultSentence, softSentence } from "#js/comparisons/sentences.js";
import { runAddress } from "#js/lib/run-address.js";

export class Figures {
  #root;
  #data;
  #entries;

  /** @param {Parts} parts */
  constructor({ root, data, entries }) {
    this.#root = root;
    this.#data = data;
    this.#entries = entries;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const { run, rollouts } = this.#data;
    const attempts = (rollouts.human ?? []).map(({ total }) => total);
    this.#part("sentence").textContent = resultSentence(this.#entries);
    this.#part("background").textContent = backgroundSentence(this.#entries, attempts);
    this.#part("rows").replaceChildren(...resultRows(this.#entries));
    this.#part("intervals").replaceChildren(
      ...posteriorSentences(this.#entries, run.learners, this.#data.world).map(paragraph),
    );
    this.#part("soft-words").textContent = softSentence(this.#entries, run.learners);
    this.#part("failure-words").hidden = !("irlf" in run.learners || "irlfr" in run.learners);
    this.#part("watch-link").href = runAddress(run.id);
    mountDotPlot(this.#part("plot"), this.#entries, signal);
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"]`);
  }
}

/** @param {string} text */
function paragraph(text) {
  const made = document.createElement("p");
  made.textContent = text;
  return made;
}
