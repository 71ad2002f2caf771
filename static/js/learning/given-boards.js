/**
 * The two boards that nobody learned: the attempts as lines, the wider the more they weigh; and, where the page has it,
 * the true reward on a scale like the learners'.
 * @import {LearnPageData} from "#js/learning/types.js"
 * @import {Material} from "#js/learning/material.js"
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 */
import { figure } from "#js/charts/figures.js";
import { weighted } from "#js/learning/material.js";
import { saveMenu } from "#js/pictures/save-menu.js";

export class GivenBoards {
  /** @type {HTMLElement} */
  #root;
  #data;
  /** @type {Material} */
  #material;
  #which = "all";

  /**
   * @param {HTMLElement} root
   * @param {LearnPageData} data
   */
  constructor(root, data) {
    this.#root = root;
    this.#data = data;
    this.#material = data;
    const own = this.#board("own-board");
    own.world = data.world;
    this.#part("own-save").append(saveMenu(own, { title: data.is_own ? "My play" : "The player’s attempts" }));
    this.drawPlay(this.#which);
    if (this.#root.querySelector('[data-part="true-board"]')) this.#drawTruth();
  }

  /** What is learned from on the boards. @param {Material} material */
  set material(material) {
    if (material === this.#material) return;
    this.#material = material;
    this.drawPlay(this.#which);
  }

  /** @param {string} which "all", "success" or "failure" */
  drawPlay(which) {
    this.#which = which;
    const { is_own = true } = this.#data;
    const { demonstrations, rankings } = this.#material;
    const outcomes = /** @type {const} */ (["failure", "success"]).filter(
      (outcome) => which === "all" || which === outcome,
    );
    const drawn = outcomes.flatMap((outcome) => weighted(demonstrations, rankings, outcome).reverse());
    const heaviest = Math.max(...drawn.map(({ weight }) => weight));
    const board = this.#board("own-board");
    board.view = {
      paths: drawn.map(({ demonstration, weight }) => ({
        states: demonstration.states,
        who: "human",
        width: weight / heaviest,
        opacity: demonstration.outcome === "success" || which !== "all" ? 0.9 : 0.45,
      })),
    };
    const whose = is_own ? "your" : "the player’s";
    board.label = `The world with ${drawn.length} of ${whose} attempts drawn as lines; the heavier its weight, the wider.`;
  }

  /** Show the figures of the true reward, or not. @param {boolean} numbers */
  showNumbers(numbers) {
    const board = this.#root.querySelector('[data-part="true-board"]') ? this.#board("true-board") : null;
    if (board && board.view.numbers !== numbers) board.view = { ...board.view, numbers };
  }

  /** Each arm of the scale has an end of its own: a goal pays more than any square costs. */
  #drawTruth() {
    const { world } = this.#data;
    const values = world.rewards.flat();
    const [lowest, highest] = [Math.min(0, ...values), Math.max(0, ...values)];
    const board = this.#board("true-board");
    board.world = world;
    board.view = { values, scale: [lowest || -1, highest || 1] };
    board.label = `The true reward of each square, from ${figure(lowest)} to ${figure(highest)}.`;
    this.#part("true-save").append(saveMenu(board, { title: "The true reward" }));
    this.#part("true-lowest").textContent = figure(lowest);
    this.#part("true-highest").textContent = highest > 0 ? `+${figure(highest)}` : figure(highest);
  }

  /** @param {string} name */
  #board(name) {
    return /** @type {IrlBoard} */ (this.#part(name));
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.#root.querySelector(`[data-part="${name}"]`));
  }
}
