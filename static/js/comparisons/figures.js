/**
 * The result in words and figures: the sentence at the head of the page, the table, the dot plot, the paired tests.
 * @import {Parts} from "#js/elements/compare-page.js"
 */
import { mountDotPlot } from "#js/charts/dot-plot.js";
import { testSentences } from "#js/comparisons/paired-tests.js";
import { remarks } from "#js/comparisons/remarks.js";
import { resultRows } from "#js/comparisons/result-table.js";
import {
  backgroundSentence,
  isLearner,
  posteriorSentences,
  resultSentence,
  softSentence,
} from "#js/comparisons/sentences.js";
import { testHeads, testRows } from "#js/comparisons/test-table.js";
import { voiceOf } from "#js/comparisons/voice.js";
import { runAddress } from "#js/lib/run-address.js";
import { saveMenu } from "#js/pictures/save-menu.js";

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
    this.#sayResult();
    this.#sayHowSure();
    const { run } = this.#data;
    const isDiverged = (/** @type {string} */ who) => run.learners[who]?.outcome === "diverged";
    this.#part("rows").replaceChildren(...resultRows(this.#entries, isDiverged));
    this.#part("intervals").replaceChildren(
      ...posteriorSentences(this.#entries, run.learners, this.#data.world).map((text) => element("p", text)),
    );
    this.#part("soft-words").textContent = softSentence(this.#entries, run.learners);
    this.#part("failure-words").hidden = !("irlf" in run.learners || "irlfr" in run.learners);
    this.#part("watch-link").href = runAddress(run.id);
    mountDotPlot(this.#part("plot"), this.#entries, signal);
    this.#part("plot-save").append(saveMenu(() => this.#part("plot").firstElementChild, { title: "Average return" }));
  }

  #sayResult() {
    const voice = voiceOf(this.#data.is_own);
    const attempts = (this.#data.rollouts.human ?? []).map(({ total }) => total);
    const told = remarks(this.#data, voice);
    this.#part("sentence").textContent = resultSentence(this.#entries, voice);
    this.#part("background").textContent = backgroundSentence(this.#entries, attempts, voice);
    this.#part("remarks").replaceChildren(...told.map((text) => element("li", text)));
    this.#part("remarks").hidden = told.length === 0;
  }

  /** Nothing where one learner stands alone, or where the comparison was stored before it was tested. */
  #sayHowSure() {
    const tests = this.#data.comparison.tests ?? [];
    const learners = this.#entries.filter(isLearner);
    this.#part("tests").hidden = tests.length === 0;
    this.#part("test-sentences").replaceChildren(
      ...testSentences(this.#entries, tests).map((text) => element("li", text)),
    );
    this.#part("test-heads").replaceChildren(...testHeads(learners));
    this.#part("test-rows").replaceChildren(...testRows(learners, tests));
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"]`);
  }
}

/** @param {"p" | "li"} tag @param {string} text */
function element(tag, text) {
  const made = document.createElement(tag);
  made.textContent = text;
  return made;
}
