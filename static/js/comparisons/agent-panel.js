/**
 * One agent on the stage of the Compare page: its board, its running total, its flag.
 * @import {Result, World} from "#js/learning/types.js"
 * @import {Role} from "#js/comparisons/cast.js"
 * @import {Comparison} from "#js/comparisons/types.js"
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 */
import { figure } from "#js/charts/figures.js";
import { marker } from "#js/charts/marker.js";
import { lossLayer, worstOf } from "#js/comparisons/losses.js";
import { episodeOf, momentAt } from "#js/comparisons/rollouts.js";

/** @typedef {"true" | "learned" | "lost"} Ground   what lies under the walkers: the world's reward, the learner's, value lost */
/** @typedef {{ ground: Ground, arrows: boolean, numbers: boolean }} Shown */

export class AgentPanel {
  #unknown;
  #reward;
  #losses;
  #policy;
  #worst;

  /**
   * @param {HTMLTemplateElement} template
   * @param {{ role: Role, world: World, comparison: Comparison, result: Result | undefined, unknown: boolean[] | null }} agent
   */
  constructor(template, { role, world, comparison, result, unknown }) {
    const copy = document.importNode(template.content, true);
    const { who } = role.entry;
    this.element = /** @type {HTMLElement} */ (copy.firstElementChild);
    this.role = role;
    this.world = world;
    this.#unknown = unknown;
    this.#policy = result?.policy ?? null;
    this.#reward = result?.reward?.flat() ?? null;
    this.#losses = lossLayer(comparison, who);
    this.#worst = worstOf(world, comparison, who);
    Object.assign(this.element.dataset, { who, role: role.key });
    this.#part("marker").replaceWith(marker(who));
    this.#part("title").textContent = role.title;
    this.#part("mark").hidden = result?.outcome !== "diverged";
    this.board.world = world;
  }

  get board() {
    return /** @type {IrlBoard} */ (this.element.querySelector("irl-board"));
  }

  /** Where a menu to save the board stands. */
  get save() {
    return this.#part("save");
  }

  /** @param {number} number of the episode, from 0 @param {number} step @param {Shown} shown */
  show(number, step, shown) {
    const episode = episodeOf(this.role.episodes, number);
    if (!episode) return;
    const { who } = this.role.entry;
    const moment = momentAt(this.world, episode, step);
    const name = this.role.nameOf(number);
    this.board.view = {
      ...this.#groundOf(shown.ground),
      arrows: shown.arrows ? this.#policy : null,
      numbers: shown.numbers,
      paths: [{ states: moment.trail, who, width: 0.5, opacity: 0.8 }],
      agents: [{ state: moment.state, who, facing: moment.facing }],
    };
    const lost = shown.ground === "lost" ? this.#worst : null;
    this.board.label =
      `${this.role.title}, ${name}: ${episode.states.length - 1} steps, earns ${figure(episode.total)}. ${lost?.sentence ?? ""}`.trimEnd();
    this.#part("note").textContent = lost?.short || this.role.standing;
    this.#part("total").textContent = figure(moment.total);
    this.#part("line").textContent = `step ${moment.step} of ${moment.steps}`;
    this.#part("flag").textContent = flagOf(moment);
    this.element.dataset.over = String(moment.isOver);
    this.element.dataset.goal = String(moment.reachedGoal);
  }

  /** @param {Ground} ground */
  #groundOf(ground) {
    if (ground === "lost" && this.#losses) return this.#losses;
    if (ground === "learned" && this.#reward) return { values: this.#reward, unknown: this.#unknown };
    return {};
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
