/**
 * One agent on the stage of the Compare page: its board, its running total, its flag.
 * @import {Result, World} from "#js/learning/types.js"
 * @import {Entry, Episode} from "#js/comparisons/types.js"
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 */
import { figure } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";
import { momentAt } from "#js/comparisons/rollouts.js";
import { isLearner } from "#js/comparisons/sentences.js";

/** @typedef {{ ground: "true" | "learned", arrows: boolean, numbers: boolean }} Shown */

export class AgentPanel {
  /** @type {number[] | null} */
  #values;

  /**
   * @param {HTMLTemplateElement} template
   * @param {{ entry: Entry, world: World, result: Result | undefined, unknown: boolean[] | null }} agent
   */
  constructor(template, { entry, world, result, unknown }) {
    const copy = document.importNode(template.content, true);
    this.element = /** @type {HTMLElement} */ (copy.firstElementChild);
    this.entry = entry;
    this.world = world;
    this.result = result;
    this.unknown = unknown;
    this.#values = result?.reward?.flat() ?? null;
    this.element.dataset.who = entry.who;
    this.#part("marker").replaceWith(marker(entry.who));
    this.#part("title").textContent = entry.title;
    this.board.world = world;
  }

  get board() {
    return /** @type {IrlBoard} */ (this.element.querySelector("irl-board"));
  }

  /**
   * @param {Episode} episode
   * @param {number} step
   * @param {Shown} shown
   * @param {string} name what this episode is called: "episode 3" or "attempt 3 of 6"
   */
  show(episode, step, shown, name) {
    const { who } = this.entry;
    const moment = momentAt(this.world, episode, step);
    const isLearned = shown.ground === "learned" && this.#values !== null;
    this.board.view = {
      values: isLearned ? this.#values : null,
      unknown: isLearned ? this.unknown : null,
      arrows: shown.arrows ? (this.result?.policy ?? null) : null,
      numbers: shown.numbers,
      paths: [{ states: moment.trail, who, width: 0.5, opacity: 0.8 }],
      agents: [{ state: moment.state, who, facing: moment.facing }],
    };
    this.board.label = `${this.entry.title}, ${name}: ${episode.states.length - 1} steps, earns ${figure(episode.total)}.`;
    this.#part("total").textContent = figure(moment.total);
    this.#part("line").textContent =
      who === "human" ? `${name} · step ${moment.step}/${moment.steps}` : `step ${moment.step} of ${moment.steps}`;
    this.#part("flag").textContent = flagOf(moment);
    this.element.dataset.over = String(moment.isOver);
    this.element.dataset.goal = String(moment.reachedGoal);
  }

  get isLearner() {
    return isLearner(this.entry);
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.element.querySelector(`[data-part="${name}"]`));
  }
}

/** @param {{ isOver: boolean, reachedGoal: boolean }} moment */
function flagOf({ isOver, reachedGoal }) {
  if (reachedGoal) return "⚑ goal";
  return isOver ? "stopped" : "";
}
