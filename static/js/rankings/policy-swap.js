/** "What if I swap these two?", answered for the policy too: how many arrows of what is shown below would turn. */

import { plural } from "#js/lib/format.js";
import { questionOf, turnedIn } from "#js/rankings/policy-material.js";
import { Previews } from "#js/rankings/policy-previews.js";

/** @typedef {import("#js/rankings/policy-material.js").Orders} Orders */
/** @typedef {import("#js/rankings/policy-material.js").Preview} Preview */

export class PolicySwap {
  #place;
  #world;
  #panel;
  #previews;
  /** @type {Orders | null} */
  #orders = null;
  /** @type {{text: string, preview: Preview} | null} */
  #answer = null;

  /** @param {HTMLElement} place @param {any} world @param {import("#js/rankings/policy-panel.js").PolicyPanel} panel */
  constructor(place, world, panel) {
    this.#place = place;
    this.#world = world;
    this.#panel = panel;
    this.#previews = new Previews(panel.post, {
      onAnswer: (preview, question) => {
        this.#answer = { text: JSON.stringify(question), preview };
        this.#show();
      },
      onRefusal: () => this.#tell(""),
      onAsking: () => {},
    });
    panel.subscribe(() => this.#show());
  }

  /** The orders with the two swapped; null: nobody wonders. @param {Orders | null} orders */
  wonder(orders) {
    this.#orders = orders;
    if (!orders) this.#previews.stop();
    this.#show();
  }

  #show() {
    const current = this.#panel.current;
    if (!this.#orders || !current) return this.#tell("");
    const question = questionOf(current.learner, this.#orders);
    if (this.#answer?.text !== JSON.stringify(question)) return this.#previews.ask(question);
    const { length } = turnedIn(this.#world, current.preview.policy, this.#answer.preview.policy);
    const arrows = length === 0 ? "no arrow" : plural(length, "arrow");
    this.#tell(`In what ${current.preview.title} would learn, ${arrows} would turn.`);
  }

  /** @param {string} sentence */
  #tell(sentence) {
    this.#place.textContent = sentence;
  }
}
