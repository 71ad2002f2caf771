/**
 * The boards of the page: the play, the true reward, a board a learner; what they show is chosen once for all.
 * @import {LearnPageData} from "#js/learning/types.js"
 * @import {Layers, Visits} from "#js/learning/learner-panel.js"
 * @import {WatchedRun} from "#js/learning/watched-run.js"
 */
import { GivenBoards } from "#js/learning/given-boards.js";
import { LineUp } from "#js/learning/line-up.js";

export class Boards {
  #root;
  #data;
  #given;
  lineUp;

  /**
   * @param {HTMLElement} root
   * @param {LearnPageData} data
   */
  constructor(root, data) {
    this.#root = root;
    this.#data = data;
    this.#given = new GivenBoards(root, data);
    this.lineUp = new LineUp(root, data);
  }

  /** @param {AbortSignal} signal @param {() => void} changed */
  start(signal, changed) {
    this.#root.addEventListener(
      "change",
      ({ target }) => {
        const control = /** @type {HTMLInputElement} */ (target);
        if (control.name === "learner" || control.name === "more-learner") this.lineUp.change(control);
        if (control.name === "drawn") this.#given.drawPlay(control.value);
        if (control.name === "large") this.#part("boards").classList.toggle("learn-boards--large", control.checked);
        changed();
      },
      { signal },
    );
  }

  /** @param {WatchedRun | null} watched */
  paint(watched) {
    const layers = this.#layers;
    const material = watched?.material ?? this.#data;
    this.#given.material = material;
    this.lineUp.material = material;
    this.#given.showNumbers(layers.numbers);
    this.#paintKey(layers.visits);
    if (!watched) return;
    const { progress, store, run } = watched;
    for (const panel of this.lineUp.panels) {
      const { name } = panel.learner;
      if (!(name in run.learners)) continue;
      const frame = watched.shownOf(name);
      if (frame) panel.show(frame, store.largestReward(panel.learner), layers);
      panel.progress({
        stage: progress.stageOf(name),
        share: progress.shareOf(name),
        line: progress.sentenceOf(name, frame),
        outcome: progress.outcomeOf(name),
        ending: progress.endingOf(name),
      });
    }
  }

  /** What colours and discs on the learners' boards mean. @param {Visits} visits */
  #paintKey(visits) {
    const yours = this.#data.is_own === false ? "the player’s" : "yours";
    this.#say("colours", visits === "difference" ? `visits: the learner’s minus ${yours}` : "learned reward");
    this.#say("discs-words", `visits: ${visits === "yours" ? `${yours}, in successes` : "the learner’s"}`);
    this.#part("discs").hidden = visits !== "learned" && visits !== "yours";
  }

  /** @returns {Layers} */
  get #layers() {
    return { arrows: this.#isOn("arrows"), visits: this.#visits, numbers: this.#isOn("numbers") };
  }

  /** @returns {Visits} */
  get #visits() {
    const chosen = this.#root.querySelector('input[name="visits"]:checked');
    return /** @type {Visits} */ (/** @type {HTMLInputElement} */ (chosen).value);
  }

  /** @param {string} name */
  #isOn(name) {
    return /** @type {HTMLInputElement} */ (this.#root.querySelector(`.learn-toggles input[name="${name}"]`)).checked;
  }

  /** @param {string} name @param {string} text */
  #say(name, text) {
    const part = this.#part(name);
    if (part.textContent !== text) part.textContent = text;
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.#root.querySelector(`[data-part="${name}"]`));
  }
}
