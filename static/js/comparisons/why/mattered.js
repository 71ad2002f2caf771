/**
 * "Which attempt mattered most?": each is left out once and the learner learns again; the greatest change first.
 * @import {About, Asked} from "#js/comparisons/why/about.js"
 * @import {Attempt, Influence, Influences} from "#js/comparisons/why/types.js"
 */
import { percent } from "#js/charts/figures.js";
import { byInfluence } from "#js/comparisons/why/attempts.js";
import { Marks } from "#js/comparisons/why/marks.js";
import { Panel } from "#js/comparisons/why/panel.js";
import { pathBoard } from "#js/comparisons/why/path-board.js";
import { capital, factsOf, mattersSentence, nameOf, withoutSentence } from "#js/comparisons/why/words.js";
import { api } from "#js/lib/api.js";
import { signed } from "#js/lib/format.js";
import { runApi } from "#js/lib/run-address.js";

/** A bar is as long as the largest of all, unless even that is small: then it looks small. */
const LEAST = { policy: 0.1, earned: 1 };

export class Mattered {
  #about;
  #template;
  /** @type {Panel<Influences>} */
  panel;

  /**
   * @param {HTMLDetailsElement} details
   * @param {About} about
   * @param {AbortSignal} signal
   */
  constructor(details, about, signal) {
    this.#about = about;
    this.#template = /** @type {HTMLTemplateElement} */ (details.querySelector("template"));
    this.panel = new Panel(details, (answer) => this.#draw(answer), signal);
  }

  /** @param {Asked} who */
  ask({ name }) {
    const path = runApi(this.#about.runId, `/influence?learner=${name}`);
    this.panel.ask(name, (options) => api.get(path, options));
  }

  /** @param {Influences} answer */
  #draw({ learner, influences }) {
    const { learners, attempts, world } = this.#about;
    const who = /** @type {Asked} */ (learners.find(({ name }) => name === learner));
    const sorted = byInfluence(influences);
    this.panel.part("list").replaceChildren(...this.#rows(sorted));
    return mattersSentence(sorted, attempts, { ...this.#about, who, world });
  }

  /** @param {Influence[]} sorted */
  #rows(sorted) {
    const known = sorted.filter((one) => one.policy_change !== null);
    const largest = {
      policy: Math.max(LEAST.policy, ...known.map((one) => one.policy_change ?? 0)),
      earned: Math.max(LEAST.earned, ...known.map((one) => Math.abs(one.return_change ?? 0))),
    };
    return sorted.flatMap((influence) => {
      const attempt = this.#about.attempts.find(({ id }) => id === influence.id);
      return attempt ? [this.#row(influence, attempt, largest)] : [];
    });
  }

  /**
   * @param {Influence} influence
   * @param {Attempt} attempt
   * @param {{ policy: number, earned: number }} largest the whole length of a bar
   */
  #row(influence, attempt, largest) {
    const { world } = this.#about;
    const row = /** @type {HTMLElement} */ (document.importNode(this.#template.content, true).firstElementChild);
    const part = (/** @type {string} */ name) => /** @type {HTMLElement} */ (row.querySelector(`[data-why="${name}"]`));
    row.dataset.id = attempt.id;
    row.dataset.needed = String(influence.policy_change === null);
    const board = pathBoard(world, attempt);
    part("board").append(board);
    new Marks(board, world).frame(influence.turned ?? []);
    part("name").textContent = capital(nameOf(attempt));
    part("facts").textContent = factsOf(attempt);
    part("words").textContent = withoutSentence(influence, world);
    part("bars").hidden = influence.policy_change === null;
    part("try").hidden = influence.policy_change === null;
    part("policy").textContent = percent(influence.policy_change);
    part("earned").textContent = influence.return_change === null ? "–" : signed(influence.return_change);
    part("policy-bar").style.inlineSize = `${100 * ((influence.policy_change ?? 0) / largest.policy)}%`;
    const earned = (influence.return_change ?? 0) / largest.earned;
    part("earned-bar").style.inlineSize = `${50 * Math.abs(earned)}%`;
    part("earned-bar").dataset.sign = String(Math.sign(earned));
    part("try").dataset.id = attempt.id;
    part("try").setAttribute("aria-label", `What if it had not been played: ${nameOf(attempt)}`);
    return row;
  }
}
