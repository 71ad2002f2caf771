/** The tools: which one is in the hand, what it paints, and a drop of its paint. */

import { byId } from "#js/lib/dom.js";
import { TOOLS } from "#js/worlds/editor/brushes.js";
import { Fields } from "#js/worlds/editor/fields.js";
import { usualPay } from "#js/worlds/editor/plan.js";
import { TOOL_HINTS } from "#js/worlds/editor/sentences.js";

/** @typedef {import("#js/worlds/editor/brushes.js").Tool} Tool */
/** @typedef {import("#js/worlds/editor/brushes.js").Brush} Brush */

const FIRST_REWARD = -3.5;

export class ToolBox {
  #box = byId("tools");
  #swatch = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (byId("swatch"));
  /** @type {Tool} */
  #tool = "wall";
  #reward = FIRST_REWARD;
  /** @type {number | null} null: as much as goals pay in a world of this size */
  #pay = null;
  #size = { rows: 2, cols: 2 };
  #fields = new Fields(["reward", "pay"], {
    set: (name, value) => this.#set(name, value ?? 0),
    end: () => {},
    refuse: (sentence) => this.#refuse(sentence),
  });
  #refuse;

  /** @param {(sentence: string) => void} refuse */
  constructor(refuse) {
    this.#refuse = refuse;
  }

  /** @param {AbortSignal} signal */
  listen(signal) {
    const onChange = () => {
      const chosen = this.#box.querySelector("input:checked");
      if (chosen instanceof HTMLInputElement) this.choose(/** @type {Tool} */ (chosen.value));
    };
    this.#box.addEventListener("change", onChange, { signal });
    this.#fields.listen(signal);
    onChange();
  }

  /** @returns {Brush} */
  get brush() {
    return { tool: this.#tool, reward: this.#reward, pay: this.#pay ?? usualPay(this.#size) };
  }

  /** A brush picked up from the board. */
  set brush({ tool, reward, pay }) {
    this.#reward = reward;
    this.#pay = pay === usualPay(this.#size) ? null : pay;
    this.choose(tool);
  }

  /** @param {Tool} tool */
  choose(tool) {
    this.#tool = tool;
    const radio = this.#box.querySelector(`[value="${tool}"]`);
    if (radio instanceof HTMLInputElement) radio.checked = true;
    byId("tool-hint").textContent = TOOL_HINTS[tool];
    for (const name of /** @type {const} */ (["reward", "pay"])) {
      const field = /** @type {HTMLElement} */ (document.querySelector(`[data-field="${name}"]`));
      field.hidden = tool !== (name === "reward" ? "paint" : "goal");
    }
    this.#show();
  }

  /** The tool of a number key. @param {number} n from 1 */
  chooseNth(n) {
    const tool = TOOLS[n - 1];
    if (tool) this.choose(tool);
    return tool;
  }

  /** @param {{rows: number, cols: number}} size */
  fit(size) {
    this.#size = size;
    this.#show();
  }

  /** @param {string} name @param {number} value */
  #set(name, value) {
    if (name === "reward") this.#reward = value;
    else this.#pay = value === usualPay(this.#size) ? null : value;
    this.#show();
  }

  #show() {
    const { reward, pay } = this.brush;
    this.#fields.show({ reward, pay });
    this.#swatch.world = dropOf(reward);
  }
}

/** A world of one square. @param {number} reward @returns {import("#js/board/state.js").World} */
function dropOf(reward) {
  return {
    id: "",
    ...{ rows: 1, cols: 1, start: -1, goal: -1, goals: [], walls: [], horizon: 0, slip: 0 },
    ...{ seed: null, red_probability: null, time_limit_s: null },
    rewards: [[reward]],
    colours: [[reward < -1 ? "red" : "blue"]],
  };
}
