/**
 * "What if?": one thing otherwise, the learner learns again, and the difference is drawn. Every change is against the run
 * as it is.
 * @import {About, Asked} from "#js/comparisons/why/about.js"
 * @import {Change, WhatIf as Answer} from "#js/comparisons/why/types.js"
 */
import { symmetricRange } from "#js/board/colours.js";
import { significant } from "#js/charts/figures.js";
import { changedPlay } from "#js/comparisons/why/attempts.js";
import { Chooser } from "#js/comparisons/why/chooser.js";
import { copyLink } from "#js/comparisons/why/link.js";
import { MarkedBoard, readTogether } from "#js/comparisons/why/marked-board.js";
import { Panel } from "#js/comparisons/why/panel.js";
import { othersMarks, showReturns } from "#js/comparisons/why/return-scale.js";
import { changeWords } from "#js/comparisons/why/square-words.js";
import { whatIfSentence } from "#js/comparisons/why/words.js";
import { untouched } from "#js/learning/material.js";
import { announce } from "#js/lib/announce.js";
import { api } from "#js/lib/api.js";
import { plural } from "#js/lib/format.js";
import { runApi } from "#js/lib/run-address.js";

export class WhatIf {
  #about;
  #details;
  #signal;
  #onChange;
  /** @type {Chooser | null} */
  #chooser = null;
  /** @type {Record<"before" | "after" | "difference", MarkedBoard> | null} */
  #boards = null;
  /** @type {import("#js/comparisons/looking.js").Looking | null} */
  #looking = null;
  /** One square in words. @type {(state: number) => string} */
  #wordsOf = () => "";
  /** @type {Change | null} */
  #change = null;
  /** @type {Panel<Answer>} */
  panel;

  /**
   * @param {HTMLDetailsElement} details
   * @param {About} about
   * @param {() => void} onChange somebody asked for another change
   * @param {AbortSignal} signal
   */
  constructor(details, about, onChange, signal) {
    this.#details = details;
    this.#about = about;
    this.#onChange = onChange;
    this.#signal = signal;
    this.panel = new Panel(details, (answer) => this.#draw(answer), signal);
    this.panel.part("undo").addEventListener("click", () => this.#undo(), { signal });
    this.panel.part("link").addEventListener("click", () => this.#copyLink(), { signal });
  }

  get change() {
    return this.#change;
  }

  /** One that speaks of attempts that are not in this run is none. @param {Change | null} change */
  set change(change) {
    const ids = change === null ? [] : Object.values(change).flat();
    const isKnown = ids.every((id) => this.#about.attempts.some((one) => one.id === id));
    this.#change = isKnown ? change : null;
    if (this.#chooser) this.#chooser.change = this.#change;
    if (this.#change === null) this.panel.clear();
  }

  focus() {
    this.#chooser?.focus();
  }

  /** @param {Asked} who */
  ask({ name }) {
    this.#furnish();
    const change = this.#change;
    if (!change) return;
    const path = runApi(this.#about.runId, "/what-ifs");
    this.panel.ask(JSON.stringify([name, change]), (options) => api.post(path, { learner: name, change }, options));
  }

  /** The attempts and the boards are made when the part is first opened. */
  #furnish() {
    if (this.#chooser) return;
    const choose = (/** @type {Change} */ change) => {
      this.#change = change;
      this.#onChange();
    };
    this.#chooser = new Chooser(this.#details, this.#about, choose, this.#signal);
    this.#chooser.change = this.#change;
    const template = /** @type {HTMLTemplateElement} */ (document.querySelector("#why-board"));
    const board = (/** @type {string} */ title) => new MarkedBoard(template, this.#about.world, title);
    this.#boards = { before: board("As it is"), after: board("What if"), difference: board("What changes") };
    this.panel.part("boards").replaceChildren(...Object.values(this.#boards).map(({ element }) => element));
    this.#looking = readTogether(this.#about.world, {
      boards: Object.values(this.#boards),
      words: this.panel.part("reading"),
      wordsOf: (state) => this.#wordsOf(state),
      signal: this.#signal,
    });
  }

  #undo() {
    this.change = null;
    this.#onChange();
    this.focus();
  }

  async #copyLink() {
    const told = await copyLink(this.#about);
    this.panel.part("copied").textContent = told;
    announce(told);
  }

  /** @param {Answer} answer */
  #draw(answer) {
    this.panel.part("copied").textContent = "";
    const { learners, attempts, world } = this.#about;
    const who = /** @type {Asked} */ (learners.find(({ name }) => name === answer.learner));
    const sentence = whatIfSentence(answer, attempts, { ...this.#about, who, world });
    this.#drawBoards(answer, who, sentence);
    this.#drawReturns(answer, who);
    return answer.result.outcome === "diverged" ? `${sentence} ${answer.result.sentence}` : sentence;
  }

  /** Before and after on one scale, so that the same colour is the same reward. @param {Answer} answer @param {Asked} who @param {string} sentence */
  #drawBoards({ result, difference, change }, who, sentence) {
    const { world, attempts } = this.#about;
    const before = { reward: (who.result.reward ?? []).flat(), policy: who.result.policy ?? [] };
    const after = { reward: result.reward.flat(), policy: result.policy };
    this.#wordsOf = (state) => changeWords(world, state, before, after);
    this.#looking?.again();
    const play = attempts.map(({ demonstration }) => demonstration);
    const scale = symmetricRange([...before.reward, ...after.reward]);
    const shared = { framed: difference.turned, ends: endsOf(scale), note: "Framed: the likeliest step is another." };
    this.#boards?.before.show({
      ...shared,
      view: { values: before.reward, arrows: before.policy, scale, unknown: untouched(world, play, who) },
      label: `The reward ${who.title} learned and its arrows, as they are.`,
      caption: `What ${who.title} learned`,
    });
    const unknown = untouched(world, changedPlay(play, change), who);
    this.#boards?.after.show({
      ...shared,
      view: { values: after.reward, arrows: after.policy, scale, unknown },
      label: `The same after the change; ${plural(difference.turned.length, "arrow")} turned.`,
      caption: sentence,
    });
    const range = symmetricRange(difference.reward);
    this.#boards?.difference.show({
      ...shared,
      view: { values: difference.reward, scale: range },
      ends: [`${significant(range[1])} less`, `${significant(range[1])} more`],
      label: "How the learned reward of each square changes.",
      caption: `How the learned reward changes. ${sentence}`,
    });
  }

  /** @param {Answer} answer @param {Asked} who */
  #drawReturns({ before, expected_return }, { name }) {
    const { others, voice } = this.#about;
    showReturns(this.panel.part("returns"), {
      moves: [before.expected_return, expected_return],
      marks: [
        { who: name, at: before.expected_return, words: "as it is", isGhost: true },
        { who: name, at: expected_return, words: "what if" },
        // Without the person, who often stands so far off that the move itself could not be seen.
        ...othersMarks({ ...others, human: null }, voice.your),
      ],
    });
  }
}

/** @param {[number, number]} scale @returns {[string, string]} */
function endsOf([low, high]) {
  return [significant(low), `+${significant(high)}`];
}
