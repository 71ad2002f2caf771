/**
 * What the world pays, and what each learner believes: boards side by side, each on its own scale.
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 * @import {Parts} from "#js/elements/compare-page.js"
 */
import { figure } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";
import { isLearner, onStage } from "#js/comparisons/sentences.js";
import { columnsFor } from "#js/learning/line-up.js";
import { saveMenu } from "#js/pictures/save-menu.js";

export class Beliefs {
  #root;
  #data;
  #entries;
  #unknownTo;

  /** @param {Parts} parts */
  constructor({ root, data, entries, unknownTo }) {
    this.#root = root;
    this.#data = data;
    this.#entries = entries;
    this.#unknownTo = unknownTo;
  }

  start() {
    const learners = onStage(this.#entries, Object.keys(this.#data.run.learners)).filter(isLearner);
    const { world, run } = this.#data;
    const truth = this.#belief("The world", null, `True reward of the world.`);
    const boards = learners.map((entry) => {
      const values = run.learners[entry.who]?.reward?.flat() ?? [];
      const belief = this.#belief(entry.title, entry.who, `Reward that ${entry.title} learned.`);
      const largest = Math.max(...values.map(Math.abs));
      const scale = /** @type {[number, number]} */ ([-(largest || 1), largest || 1]);
      belief.board.view = { values, unknown: this.#unknownTo(entry.who), scale };
      belief.lowest.textContent = figure(-largest);
      belief.highest.textContent = `+${figure(largest)}`;
      if (!largest) wordsFor(belief.ramp, "learns no reward");
      return belief.element;
    });
    wordsFor(truth.ramp, `deeper is dearer; goal +${world.rows + world.cols}`);
    this.#part("beliefs").replaceChildren(truth.element, ...boards);
    this.#part("beliefs").style.setProperty("--columns", String(columnsFor(boards.length + 1)));
  }

  /** @param {string} title @param {string | null} who @param {string} label */
  #belief(title, who, label) {
    const template = /** @type {HTMLTemplateElement} */ (this.#root.querySelector("#belief"));
    const element = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    const part = (/** @type {string} */ name) =>
      /** @type {HTMLElement} */ (element.querySelector(`[data-part="${name}"]`));
    const board = /** @type {IrlBoard} */ (element.querySelector("irl-board"));
    part("title").textContent = title;
    if (who) {
      element.dataset.who = who;
      part("marker").replaceWith(marker(who));
    } else {
      part("marker").remove();
    }
    board.world = this.#data.world;
    board.label = label;
    part("save").append(saveMenu(board, { title: who ? `What ${title} learned` : "What the world pays" }));
    return { element, board, ramp: part("ramp"), lowest: part("lowest"), highest: part("highest") };
  }

  /** @param {string} name @returns {any} */
  #part(name) {
    return this.#root.querySelector(`[data-part="${name}"]`);
  }
}

/** Words in place of a ramp. @param {HTMLElement} ramp @param {string} words */
function wordsFor(ramp, words) {
  ramp.classList.add("ramp--words");
  ramp.textContent = words;
}
