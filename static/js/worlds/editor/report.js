/** What the world is like, in words below the board: figures at once, the verdict when the server has looked. */

import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { plural } from "#js/lib/format.js";
import { limitWords } from "#js/worlds/editor/sentences.js";

/** @typedef {import("#js/worlds/editor/plan.js").Plan} Plan */
/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/worlds/editor/sentences.js").Verdict} Verdict */

/** @type {Verdict} */
const LOOKING = { state: "checking", text: "Looking at it …" };

export class Report {
  /** @type {Verdict} */
  #verdict = LOOKING;
  /** @type {number | null} the usual step limit, as the server last had it */
  #horizon = null;

  get state() {
    return this.#verdict.state;
  }

  get text() {
    return this.#verdict.text;
  }

  /** What can be said without asking. @param {Plan} plan @param {number | null} nSteps the shortest way */
  showFacts(plan, nSteps) {
    byId("fact-size").textContent = `${plan.rows} × ${plan.cols}`;
    byId("fact-way").textContent = nSteps === null ? "none" : plural(nSteps, "step");
    this.#showLimit(plan);
  }

  /** The last verdict stays until there is another, unless it was about what may be mended now. */
  look() {
    if (this.state === "refused") this.show(LOOKING);
  }

  /** @param {Plan} plan @param {World} world of the server */
  learn(plan, world) {
    if (plan.stepLimit === null) this.#horizon = world.horizon;
    this.#showLimit(plan);
  }

  /** @param {Verdict} verdict */
  show(verdict) {
    const isNews = verdict.text !== this.text;
    this.#verdict = verdict;
    const line = byId("verdict");
    line.dataset.state = verdict.state;
    line.textContent = verdict.text;
    if (isNews && verdict.state !== "checking") announce(verdict.text);
  }

  /** @param {Plan} plan */
  #showLimit(plan) {
    const horizon = plan.stepLimit ?? this.#horizon;
    byId("fact-limit").textContent = limitWords({ horizon, timeLimitS: plan.timeLimitS });
    /** @type {HTMLInputElement} */ (byId("step_limit")).placeholder = String(this.#horizon ?? "usual");
  }
}
