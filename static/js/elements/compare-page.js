/**
 * `<compare-page>`: everybody walks the same world in step; around the stage, the figures, what each learner believes, why,
 * and what one takes away. Each part shows itself; this puts them together.
 * @import {ComparePageData, Entry} from "#js/comparisons/types.js"
 */
import "#js/elements/irl-board.js";
import { Beliefs } from "#js/comparisons/beliefs.js";
import { Figures } from "#js/comparisons/figures.js";
import { Stage } from "#js/comparisons/stage.js";
import { TakeAway } from "#js/comparisons/take-away.js";
import { voiceOf } from "#js/comparisons/voice.js";
import { Why } from "#js/comparisons/why/why.js";
import { untouched } from "#js/learning/material.js";
import { pageData } from "#js/lib/page-data.js";

/**
 * What every part of the page gets.
 * @typedef {object} Parts
 * @property {HTMLElement} root
 * @property {ComparePageData} data
 * @property {Entry[]} entries                               by place, the person "You" or "The player"
 * @property {(learner: string) => boolean[]} unknownTo      squares that no attempt the learner uses came to
 */

export class ComparePage extends HTMLElement {
  #life = new AbortController();

  connectedCallback() {
    this.#life = new AbortController();
    const { signal } = this.#life;
    const parts = this.#parts(pageData());
    for (const part of [
      new Figures(parts),
      new Stage(parts),
      new Beliefs(parts),
      new Why(parts),
      new TakeAway(parts),
    ]) {
      part.start(signal);
    }
  }

  disconnectedCallback() {
    this.#life.abort();
  }

  /** @param {ComparePageData} data @returns {Parts} */
  #parts(data) {
    const { world, demonstrations, learners, comparison } = data;
    return {
      root: this,
      data,
      entries: comparison.entries.map((entry) =>
        entry.who === "human" ? { ...entry, title: voiceOf(data.is_own).You } : entry,
      ),
      unknownTo: (name) => {
        // Who does not look at failures does not know a square where only a failure came.
        const uses_failures = learners.find((learner) => learner.name === name)?.uses_failures ?? true;
        return untouched(world, demonstrations, { uses_failures });
      },
    };
  }
}

customElements.define("compare-page", ComparePage);
