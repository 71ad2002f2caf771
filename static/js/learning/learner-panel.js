/**
 * One learner on the Learn page: whether it takes part, its board, its colour scale, its progress and how it ended.
 * @import {Frame, LearnerInfo, World} from "#js/learning/types.js"
 * @import {Material} from "#js/learning/material.js"
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 */
import { figure, significant } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";
import { untouched } from "#js/learning/material.js";
import { differenceOf, largestSize, visitsOfAttempts } from "#js/learning/visits.js";
import { saveMenu } from "#js/pictures/save-menu.js";

/** @typedef {"none" | "learned" | "yours" | "difference"} Visits */
/** @typedef {{ arrows: boolean, visits: Visits, numbers: boolean }} Layers what the boards show */

export class LearnerPanel {
  /** @type {Frame | null} */
  #frame = null;
  #shown = "";
  /** Squares that no demonstration this learner uses came to. @type {boolean[]} */
  #unknown = [];
  /** How often the demonstrations that it draws near to came to each square. @type {number[]} */
  #played = [];

  /**
   * @param {HTMLTemplateElement} template
   * @param {LearnerInfo} learner
   * @param {World} world
   * @param {Material} material
   */
  constructor(template, learner, world, material) {
    const copy = document.importNode(template.content, true);
    this.element = /** @type {HTMLElement} */ (copy.firstElementChild);
    this.learner = learner;
    this.world = world;
    this.#take(material);
    this.blank = new Array(world.rows * world.cols).fill(0);
    this.element.dataset.who = learner.name;
    this.element.dataset.learner = learner.name;
    this.#part("marker").replaceWith(marker(learner.name));
    this.#part("title").textContent = learner.title;
    this.checkbox.value = learner.name;
    this.board.world = world;
    this.#part("save").append(
      saveMenu(this.board, { title: () => this.#titleOfPicture, name: `irlfr-learned-${learner.name}` }),
    );
    this.clear();
  }

  get checkbox() {
    return /** @type {HTMLInputElement} */ (this.element.querySelector("input[name=learner]"));
  }

  get board() {
    return /** @type {IrlBoard} */ (this.element.querySelector("irl-board"));
  }

  /** What it learned from, or will. @param {Material} material */
  learnFrom(material) {
    this.#take(material);
    this.#shown = "";
    if (!this.#frame) this.clear();
  }

  /** Back to the empty board: what this learner will use, or what it misses. */
  clear() {
    this.#frame = null;
    this.#shown = "";
    this.element.dataset.stage = "idle";
    delete this.element.dataset.outcome;
    delete this.element.dataset.iteration;
    const { missing, title } = this.learner;
    this.#part("cover").textContent = missing ?? usesInWords(this.learner);
    this.board.label = `Board of ${title}, nothing learned yet.`;
    this.board.view = { values: this.blank, scale: [-1, 1], unknown: this.#unknown };
    this.#legend("loses", "earns");
    this.#part("save").hidden = true;
    this.progress({ stage: "idle", share: 0, line: "", outcome: "" });
  }

  /** What it misses has changed with a setting: take part, or not. */
  weigh() {
    this.checkbox.checked = this.learner.missing === null;
    if (this.element.dataset.stage === "idle") this.clear();
  }

  /** @param {{ stage: string, share: number, line: string, outcome: string, ending?: string | null }} state */
  progress({ stage, share, line, outcome, ending = null }) {
    this.element.dataset.stage = stage;
    if (ending) this.element.dataset.outcome = ending;
    const bar = /** @type {HTMLProgressElement} */ (this.element.querySelector("progress"));
    bar.value = share;
    bar.setAttribute("aria-label", `${this.learner.title} has learned`);
    this.#say("line", stage === "waiting" ? "" : line);
    this.#say("outcome", outcome);
    if (stage === "waiting") this.#say("cover", line);
  }

  /**
   * @param {Frame} frame
   * @param {number} largest |reward| at the ends of the colour scale
   * @param {Layers} layers
   */
  show(frame, largest, layers) {
    const key = `${layers.arrows} ${layers.visits} ${layers.numbers} ${largest}`;
    if (frame === this.#frame && key === this.#shown) return;
    [this.#frame, this.#shown] = [frame, key];
    this.element.dataset.iteration = String(frame.iteration);
    this.#part("save").hidden = false;
    const painted = layers.visits === "difference" ? this.#difference(frame) : this.#reward(frame, largest);
    this.board.view = {
      ...painted,
      numbers: layers.numbers,
      arrows: layers.arrows ? frame.policy : null,
      visits: this.#visits(frame, layers.visits),
      unknown: this.#unknown,
    };
    this.board.label = describe(this.learner, frame, this.world);
  }

  get #titleOfPicture() {
    const { title } = this.learner;
    return this.#frame ? `What ${title} learned, iteration ${this.#frame.iteration}` : title;
  }

  /** @param {Material} material */
  #take({ demonstrations, rankings }) {
    this.#unknown = untouched(this.world, demonstrations, this.learner);
    this.#played = visitsOfAttempts(this.world, demonstrations, rankings, this.learner);
  }

  /** @param {Frame} frame @param {number} largest */
  #reward(frame, largest) {
    if (largest) this.#legend(figure(-largest), `+${figure(largest)}`);
    else this.#legend("0", "0");
    return { values: frame.reward, scale: symmetric(largest) };
  }

  /** Where its policy comes more often than the attempts did (blue), and where less. @param {Frame} frame */
  #difference(frame) {
    const values = differenceOf(frame.visitation, this.#played);
    const largest = largestSize(values);
    this.#legend(`${significant(-largest)} visits`, `+${significant(largest)}`);
    return { values, scale: symmetric(largest) };
  }

  /** @param {Frame} frame @param {Visits} visits */
  #visits(frame, visits) {
    if (visits === "learned") return frame.visitation;
    return visits === "yours" ? this.#played : null;
  }

  /** @param {string} lowest @param {string} highest */
  #legend(lowest, highest) {
    this.#say("lowest", lowest);
    this.#say("highest", highest);
  }

  /** @param {string} name @param {string} text */
  #say(name, text) {
    const part = this.#part(name);
    if (part.textContent !== text) part.textContent = text;
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.element.querySelector(`[data-part="${name}"]`));
  }
}

/** @param {number} largest @returns {[number, number]} */
function symmetric(largest) {
  return [-(largest || 1), largest || 1];
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
