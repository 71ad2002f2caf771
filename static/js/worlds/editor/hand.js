/** The hand at the easel: it takes the tool chosen, and each stroke becomes one step of the history. No DOM here. */

import { brushAt, Stroke } from "#js/worlds/editor/brushes.js";
import { squareAt } from "#js/worlds/editor/plan.js";

/** @typedef {import("#js/worlds/editor/plan.js").Plan} Plan */
/** @typedef {import("#js/worlds/editor/brushes.js").Brush} Brush */

/**
 * What the hand works on.
 * @typedef {object} Studio
 * @property {Plan} plan
 * @property {Brush} brush                                          may be set, to one picked up
 * @property {(square: number) => number} rewardAt
 * @property {(plan: Plan, gesture: unknown) => void} change
 * @property {() => void} settle                                    a stroke is over
 * @property {() => void} undo
 * @property {(sentence: string) => void} refuse                    beside the tools; "" takes it back
 * @property {(square: number) => void} look
 * @property {(sentence: string) => void} say
 */

export class Hand {
  #studio;
  /** @type {Stroke | null} */
  #stroke = null;
  #refusal = "";

  /** @param {Studio} studio */
  constructor(studio) {
    this.#studio = studio;
  }

  /** @param {number} place */
  begin(place) {
    const { plan, brush } = this.#studio;
    this.#refusal = "";
    if (brush.tool === "pick") return this.#pick(place);
    this.#stroke = new Stroke(plan, brush, place);
    this.#paint(this.#stroke.first);
  }

  /** @param {number} place */
  moveTo(place) {
    if (this.#stroke) this.#paint(this.#stroke.moveTo(this.#studio.plan, place));
  }

  end() {
    const stroke = this.#stroke;
    if (!stroke) return;
    this.#paint(stroke.end(this.#studio.plan));
    this.#stroke = null;
    this.#studio.settle();
    if (this.#refusal) this.#studio.say(this.#refusal);
    else this.#studio.look(squareAt(this.#studio.plan, stroke.last));
  }

  /** What was drawn since the press was not meant. */
  cancel() {
    const isChanged = this.#stroke !== null && this.#stroke.before !== this.#studio.plan;
    this.#stroke = null;
    if (isChanged) this.#studio.undo();
  }

  /** @param {number} square */
  look(square) {
    if (!this.#stroke) this.#studio.look(square);
  }

  /** @param {import("#js/worlds/editor/brushes.js").Painted} painted */
  #paint({ plan, refusal }) {
    this.#refusal = refusal || this.#refusal;
    if (plan !== this.#studio.plan) this.#studio.change(plan, this.#stroke);
    this.#studio.refuse(this.#refusal);
  }

  /** @param {number} place */
  #pick(place) {
    const { plan, brush } = this.#studio;
    const picked = brushAt(plan, place, this.#studio.rewardAt(squareAt(plan, place)), brush);
    this.#studio.brush = picked;
    this.#studio.refuse("");
    this.#studio.say(`Picked up: ${picked.tool}.`);
  }
}
