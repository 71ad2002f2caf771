/**
 * "What does it not know?": the squares on which the draws disagree, and what that means for what it earns.
 * @import {About, Asked} from "#js/comparisons/why/about.js"
 * @import {Uncertainty} from "#js/comparisons/why/types.js"
 */
import { MarkedBoard, readTogether } from "#js/comparisons/why/marked-board.js";
import { Panel } from "#js/comparisons/why/panel.js";
import { othersMarks, showReturns } from "#js/comparisons/why/return-scale.js";
import { doubtWords } from "#js/comparisons/why/square-words.js";
import { doubtful, doubtSentence, isSpread, methodSentence } from "#js/comparisons/why/words.js";
import { api } from "#js/lib/api.js";
import { runApi } from "#js/lib/run-address.js";

export class Doubt {
  #about;
  #board;
  #looking;
  /** One square in words. @type {(state: number) => string} */
  #wordsOf = () => "";
  /** @type {Panel<Uncertainty>} */
  panel;

  /**
   * @param {HTMLDetailsElement} details
   * @param {About} about
   * @param {AbortSignal} signal
   */
  constructor(details, about, signal) {
    this.#about = about;
    this.panel = new Panel(details, (answer) => this.#draw(answer), signal);
    const template = /** @type {HTMLTemplateElement} */ (document.querySelector("#why-board"));
    this.#board = new MarkedBoard(template, about.world, "Where it is sure");
    this.panel.part("board").replaceChildren(this.#board.element);
    this.#looking = readTogether(about.world, {
      boards: [this.#board],
      words: this.panel.part("reading"),
      wordsOf: (state) => this.#wordsOf(state),
      signal,
    });
  }

  /** @param {Asked} who */
  ask({ name }) {
    const path = runApi(this.#about.runId, `/uncertainty?learner=${name}`);
    this.panel.ask(name, (options) => api.get(path, options));
  }

  /** @param {Uncertainty} found */
  #draw(found) {
    const { learners, world, others, voice } = this.#about;
    const who = /** @type {Asked} */ (learners.find(({ name }) => name === found.learner));
    const belief = { reward: (who.result.reward ?? []).flat(), policy: who.result.policy ?? [] };
    this.#wordsOf = (state) => doubtWords(world, state, belief, found);
    this.#looking.again();
    const unsure = doubtful(found.policy_agreement, world);
    this.#board.show({
      dimmed: unsure.flatMap((isUnsure, state) => (isUnsure ? [state] : [])),
      view: {
        values: new Array(belief.reward.length).fill(0), // plain ground: the hatch is what there is to see
        arrows: belief.policy,
        unknown: unsure,
      },
      ends: null,
      caption: `Where ${who.title} is sure of its step`,
      note: `Grey, hatched: fewer than three draws in four take the same step. ${methodSentence(found)}`,
      label: `The arrows of ${who.title}, hatched where it is not sure of its step.`,
    });
    const expected = who.entry?.expected_return ?? null;
    showReturns(this.panel.part("returns"), {
      interval: isSpread(found) ? [found.return_low, found.return_high] : undefined,
      marks: [
        ...(expected === null ? [] : [{ who: who.name, at: expected, words: "as it is" }]),
        ...othersMarks(others, voice.your),
      ],
    });
    this.panel.part("interval").textContent = found.sentence;
    this.panel.part("method").textContent = isSpread(found) ? methodSentence(found) : "";
    return doubtSentence(found, { who, world });
  }
}
