/** How much better: a slider between each two neighbouring groups of the lists, and above them a scale with what was said. */

import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { plural } from "#js/lib/format.js";
import { drawScale } from "#js/rankings/gap-scale.js";
import { GapSlider } from "#js/rankings/gap-slider.js";
import { gapsBetween, saidGaps } from "#js/rankings/magnitude.js";
import { displayRanks } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {readonly string[]} Group */

/** @type {Outcome[]} */
const OUTCOMES = ["success", "failure"];

export class MagnitudePanel {
  #sitting;
  #lists;
  #isOn = false;
  /** What is drawn: a slider in use is left alone by events that do not concern it. @type {unknown[]} */
  #drawn = [];
  /** By the first of the group above and the first of the one below. @type {Map<string, {slider: GapSlider, outcome: Outcome, above: Group, below: Group}>} */
  #sliders = new Map();

  /** @param {import("#js/rankings/rank.js").Parts & {lists: import("#js/rankings/lists.js").RankLists}} parts */
  constructor({ sitting, lists }) {
    this.#sitting = sitting;
    this.#lists = lists;
  }

  start() {
    this.#sitting.subscribe(() => this.#show());
    this.#show();
  }

  /** A gap that was said under other attempts of the two groups is said anew under these. @param {Outcome} outcome @param {Group} above @param {Group} below @param {number | null} value @param {Means} means */
  say(outcome, above, below, value, means) {
    const said = gapsBetween(this.#sitting.state.present.gaps[outcome], above, below);
    const pair = said.at(-1) ?? { above: above[0], below: below[0] };
    const meant = value === null ? said : [pair];
    for (const one of meant)
      this.#sitting.do({ type: "gap", means, outcome, above: one.above, below: one.below, value });
    if (value === null || said.length === 0)
      announce(`${value === null ? "Taken back" : `Said: ${value}`}. ${this.#countWords(outcome)}.`);
  }

  #show() {
    const isOn = this.#sitting.state.way === "magnitude";
    if (isOn !== this.#isOn) {
      this.#isOn = isOn;
      this.#lists.setBetween(isOn ? (outcome, above, below) => this.#between(outcome, above, below) : null);
    }
    const { orders, gaps } = this.#sitting.state.present;
    if (!isOn || (this.#drawn[0] === orders && this.#drawn[1] === gaps)) return;
    this.#drawn = [orders, gaps];
    for (const one of this.#sliders.values()) if (one.slider.element.isConnected) this.#update(one);
    for (const outcome of OUTCOMES) this.#showScale(outcome);
  }

  /** The same two groups keep their slider, and with it the focus. @param {Outcome} outcome @param {Group} above @param {Group} below */
  #between(outcome, above, below) {
    const key = `${above[0]} ${below[0]}`;
    let one = this.#sliders.get(key);
    if (!one) {
      const template = /** @type {HTMLTemplateElement} */ (byId("gap-slider"));
      const slider = new GapSlider(template, (value, means) => {
        const { above: now, below: next } = /** @type {{above: Group, below: Group}} */ (this.#sliders.get(key));
        this.say(outcome, now, next, value, means);
      });
      one = { slider, outcome, above, below };
    }
    this.#sliders.set(key, { ...one, above, below });
    this.#update({ ...one, above, below });
    return one.slider.element;
  }

  /** @param {{slider: GapSlider, outcome: Outcome, above: Group, below: Group}} one */
  #update({ slider, outcome, above, below }) {
    const value = gapsBetween(this.#sitting.state.present.gaps[outcome], above, below).at(-1)?.value ?? null;
    const ranks = displayRanks(this.#sitting.orders[outcome]);
    const better = outcome === "success" ? "better" : "worse";
    slider.show(value, `How much ${better} is place ${ranks.get(above[0])} than place ${ranks.get(below[0])}?`);
  }

  /** @param {Outcome} outcome */
  #showScale(outcome) {
    const order = this.#sitting.orders[outcome];
    const isThere = order.length > 1;
    byId(`gaps-${outcome}`).hidden = !isThere;
    if (!isThere) return;
    byId(`gaps-count-${outcome}`).textContent = this.#countWords(outcome);
    drawScale(byId(`gaps-scale-${outcome}`), order, this.#sitting.state.present.gaps[outcome]);
  }

  /** "2 of 5 gaps said". @param {Outcome} outcome */
  #countWords(outcome) {
    const said = saidGaps(this.#sitting.orders[outcome], this.#sitting.state.present.gaps[outcome]);
    return `${said.filter((gap) => gap !== null).length} of ${plural(said.length, "gap")} said`;
  }
}
