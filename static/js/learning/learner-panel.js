/**
 * One learner on the Learn page: whether it takes part, its board, its colour scale, its progress and how it ended.
 * @import {Frame, LearnerInfo, World} from "#js/learning/types.js"
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 */
import { figure } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";

/** @typedef {{ arrows: boolean, visits: boolean, numbers: boolean }} Shown */

export class LearnerPanel {
  /** @type {Frame | null} */
  #frame = null;
  #largest = 0;
  #shown = "";

  /**
   * @param {HTMLTemplateElement} template
   * @param {LearnerInfo} learner
   * @param {World} world
   * @param {boolean[]} unknown squares that no demonstration this learner uses came to
   */
  constructor(template, learner, world, unknown) {
    const copy = document.importNode(template.content, true);
    this.element = /** @type {HTMLElement} */ (copy.firstElementChild);
    this.learner = learner;
    this.world = world;
    this.unknown = unknown;
    this.blank = new Array(world.rows * world.cols).fill(0);
    this.element.dataset.who = learner.name;
    this.element.dataset.learner = learner.name;
    this.#part("marker").replaceWith(marker(learner.name));
    this.#part("title").textContent = learner.title;
    this.checkbox.value = learner.name;
    this.board.world = world;
    this.clear();
  }

  get checkbox() {
    return /** @type {HTMLInputElement} */ (this.element.querySelector("input[name=learner]"));
  }

  get board() {
    return /** @type {IrlBoard} */ (this.element.querySelector("irl-board"));
  }

  /** Back to the empty board: what this learner will use, or what it misses. */
  clear() {
    this.#frame = null;
    this.#shown = "";
    this.element.dataset.stage = "idle";
    const { missing, title } = this.learner;
    this.#part("cover").textContent = missing ?? usesInWords(this.learner);
    this.board.label = `Board of ${title}, nothing learned yet.`;
    this.board.view = { values: this.blank, scale: [-1, 1], unknown: this.unknown };
    this.#scale(0);
    this.progress({ stage: "idle", share: 0, line: "", outcome: "" });
  }

  /** What it misses has changed with a setting: take part, or not. */
  weigh() {
    this.checkbox.checked = this.learner.missing === null;
    if (this.element.dataset.stage === "idle") this.clear();
  }

  /** @param {{ stage: string, share: number, line: string, outcome: string }} state */
  progress({ stage, share, line, outcome }) {
    this.element.dataset.stage = stage;
    const bar = /** @type {HTMLProgressElement} */ (this.element.querySelector("progress"));
    bar.value = share;
    bar.setAttribute("aria-label", `${this.learner.title} has learned`);
    this.#part("line").textContent = stage === "waiting" ? "" : line;
    this.#part("outcome").textContent = outcome;
    if (stage === "waiting") this.#part("cover").textContent = line;
  }

  /**
   * @param {Frame} frame
   * @param {number} largest |reward| at the ends of the colour scale
   * @param {Shown} shown
   */
  show(frame, largest, shown) {
    const key = JSON.stringify(shown);
    if (frame === this.#frame && largest === this.#largest && key === this.#shown) return;
    if (largest !== this.#largest) this.#scale(largest);
    [this.#frame, this.#largest, this.#shown] = [frame, largest, key];
    this.element.dataset.iteration = String(frame.iteration);
    this.board.view = {
      values: frame.reward,
      scale: [-(largest || 1), largest || 1],
      numbers: shown.numbers,
      arrows: shown.arrows ? frame.policy : null,
      visits: shown.visits ? frame.visitation : null,
      unknown: this.unknown,
    };
    this.board.label = describe(this.learner, frame, this.world);
  }

  /** @param {number} largest */
  #scale(largest) {
    this.#largest = largest;
    this.#part("lowest").textContent = largest ? figure(-largest) : "loses";
    this.#part("highest").textContent = largest ? `+${figure(largest)}` : "earns";
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.element.querySelector(`[data-part="${name}"]`));
  }
}

/** @param {LearnerInfo} learner */
function usesInWords({ family, summary, uses_ranking, uses_failures }) {
  if (family !== "paper") return summary;
  const what = uses_failures ? "your successes and your failures" : "your successes";
  return `Learns from ${what}${uses_ranking ? ", in your order" : ", all alike"}.`;
}

/**
 * @param {LearnerInfo} learner
 * @param {Frame} frame
 * @param {World} world
 */
function describe({ title }, frame, world) {
  const best = frame.reward.indexOf(Math.max(...frame.reward));
  const worst = frame.reward.indexOf(Math.min(...frame.reward));
  const place = (/** @type {number} */ state) =>
    `row ${Math.floor(state / world.cols) + 1}, column ${(state % world.cols) + 1}`;
  return (
    `Reward learned by ${title} at iteration ${frame.iteration}: highest ${figure(frame.reward[best])} at ${place(best)}, ` +
    `lowest ${figure(frame.reward[worst])} at ${place(worst)}.`
  );
}
