/**
 * Two at a time: asks which of two attempts belongs higher until the order is settled, first of the successes, then of the
 * failures. All it knows it reads from the sitting's answers, so that undo and a reload bring back the question that was.
 */

import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { isTaken } from "#js/lib/keys.js";
import { flat, isSame } from "#js/rankings/order.js";
import { PairView } from "#js/rankings/pair-view.js";
import { askedWords, doneWords, leftWords, questionOf, saidWords, whichWords } from "#js/rankings/pair-words.js";
import { pairwise } from "#js/rankings/pairwise.js";
import { cardWords } from "#js/rankings/sentences.js";

/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {import("#js/rankings/sitting-state.js").State} State */
/** @typedef {import("#js/rankings/merge-insertion.js").Said} Said */
/** @typedef {import("#js/rankings/pairwise.js").Standing} Standing */

/** @type {Outcome[]} */
const OUTCOMES = ["success", "failure"];
/** @type {Record<string, Said>} */
const ANSWERS = { ArrowLeft: "a", ArrowRight: "b", ArrowDown: "alike", "=": "alike" };

export class PairwisePanel {
  #parts;
  #root = byId("rank");
  #panel = byId("pairs");
  #view;
  /** The question on show. @type {{outcome: Outcome, next: [string, string], standing: Standing} | null} */
  #asked = null;

  /** @param {import("#js/rankings/rank.js").Parts} parts */
  constructor(parts) {
    this.#parts = parts;
    const { sitting, world } = parts;
    const onPlay = (/** @type {string[]} */ ids, /** @type {Means} */ means) => {
      for (const id of ids) sitting.do({ type: "watch", means, id });
    };
    this.#view = new PairView(byId("pairs-asking"), { world, onPlay });
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#view.start(signal);
    this.#panel.addEventListener("click", (event) => this.#onClick(event), { signal });
    document.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    document.getElementById("ways")?.addEventListener("click", (event) => this.#onWay(event), { signal });
    this.#parts.sitting.subscribe((_, event) => {
      if (event.type === "undo" || event.type === "redo") queueMicrotask(() => this.#followUp(event));
      this.#show();
    });
    this.#show();
  }

  /** @param {Said} said @param {Means} means */
  answer(said, means) {
    const asked = this.#asked;
    if (!asked) return;
    const { outcome } = asked;
    const [a, b] = asked.next;
    if (!this.#parts.sitting.do({ type: "answer", means, outcome, a, b, said })) return;
    this.#settle(outcome);
    this.#tell(saidWords(said, outcome));
  }

  /** @param {Means} means */
  takeBack(means) {
    if (this.#nAnswers === 0) return announce("There is no answer to take back yet.");
    this.#parts.sitting.do({ type: "undo", means });
  }

  /** The lists stand as the answers say. @param {Outcome} outcome @param {Means} means */
  takeOrder(outcome, means) {
    const { order } = this.#standing(outcome);
    this.#parts.sitting.do({ type: "set", means, outcome, order, by: "pairwise" });
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (!button) return;
    if (button.dataset.said) this.answer(/** @type {Said} */ (button.dataset.said), "button");
    else if (button.id === "pairs-back") this.takeBack("button");
    else if (button.id === "pairs-take") for (const outcome of OUTCOMES) this.takeOrder(outcome, "button");
  }

  /** Chosen by mouse or finger, this way has the keyboard at once; by keyboard, the arrows go on choosing a way. @param {MouseEvent} event */
  #onWay({ target, detail }) {
    if (detail === 0 || !(target instanceof HTMLInputElement) || target.value !== "pairwise") return;
    // The choice itself comes after the click.
    setTimeout(() => byId("pairs-title").focus());
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (!this.#asked || isTaken(event)) return;
    const act = this.#actOf(event);
    if (!act) return;
    event.preventDefault();
    if (!event.repeat) act();
  }

  /** @param {KeyboardEvent} event @returns {(() => void) | null} */
  #actOf({ key, target }) {
    const on = target instanceof Element ? target : document.body;
    const said = ANSWERS[key];
    // A slider and the ways to order have a use of their own for the arrows, a button for the space bar.
    if (said) return on.matches("input") && key !== "=" ? null : () => this.answer(said, "key");
    if (key === "Backspace") return () => this.takeBack("key");
    if (key === " ") return on.closest("button, input, a, summary") ? null : () => this.#view.toggle("key");
    return null;
  }

  /** As they were when the sitting began: what is asked does not depend on the order that comes of it. @param {Outcome} outcome */
  #idsOf(outcome) {
    const { past, present } = this.#parts.sitting.state;
    return flat((past[0] ?? present).orders[outcome]);
  }

  /** @param {Outcome} outcome @returns {Standing} */
  #standing(outcome) {
    return pairwise(this.#idsOf(outcome), this.#parts.sitting.state.present.answers[outcome]);
  }

  get #nAnswers() {
    const { answers } = this.#parts.sitting.state.present;
    return answers.success.length + answers.failure.length;
  }

  get #askable() {
    return OUTCOMES.filter((outcome) => this.#idsOf(outcome).length > 1);
  }

  /** With the last answer the list takes the order they make. @param {Outcome} outcome */
  #settle(outcome) {
    const { next } = this.#standing(outcome);
    if (next === null) this.takeOrder(outcome, "page");
  }

  /** The last answer and the order that came of it are one step for a person: taken back, and done again, together. @param {{type: string, means?: Means}} event */
  #followUp({ type, means = "page" }) {
    const { sitting } = this.#parts;
    const isHere = sitting.state.way === "pairwise";
    if (isHere && OUTCOMES.some((outcome) => this.#isBeforeItsOrder(outcome))) sitting.do({ type, means });
    else if (isHere) this.#tellAgain(type === "undo" ? "Taken back." : "Done again.");
  }

  /** Whether we stand between the last answer and the order that came of it. @param {Outcome} outcome */
  #isBeforeItsOrder(outcome) {
    const { past, present, future } = this.#parts.sitting.state;
    const [nBefore, n, nAfter] = [past.at(-1), present, future[0]].map((content) => content?.answers[outcome].length);
    const { next, order } = this.#standing(outcome);
    const isSetNext = nAfter === n && isSame(future[0]?.orders[outcome] ?? [], order);
    return nBefore === Number(n) - 1 && next === null && isSetNext && !isSame(present.orders[outcome], order);
  }

  #show() {
    const isChosen = this.#parts.sitting.state.way === "pairwise";
    this.#panel.hidden = !isChosen;
    const before = this.#asked;
    this.#asked = isChosen ? this.#nextQuestion() : null;
    this.#root.dataset.stage = this.#asked ? "asking" : "ordering";
    const [shown, gone, first] = this.#asked
      ? ["pairs-asking", "pairs-done", "pairs-title"]
      : ["pairs-done", "pairs-asking", "pairs-done"];
    const hadFocus = byId(gone).contains(document.activeElement);
    byId(shown).hidden = false;
    byId(gone).hidden = true;
    if (hadFocus) byId(first).focus();
    if (this.#asked) this.#showQuestion(this.#asked, before);
    else this.#showDone();
  }

  #nextQuestion() {
    for (const outcome of this.#askable) {
      const standing = this.#standing(outcome);
      if (standing.next) return { outcome, next: standing.next, standing };
    }
    return null;
  }

  /** @param {{outcome: Outcome, next: [string, string], standing: Standing}} question @param {{outcome: Outcome, next: [string, string]} | null} before */
  #showQuestion({ outcome, next, standing }, before) {
    const nAnswered = this.#parts.sitting.state.present.answers[outcome].length;
    byId("pairs-which").textContent = whichWords(outcome, this.#askable.length > 1);
    byId("pairs-title").textContent = questionOf(outcome);
    byId("pairs-left").textContent = leftWords(standing);
    const progress = /** @type {HTMLProgressElement} */ (byId("pairs-progress"));
    [progress.max, progress.value] = [nAnswered + standing.left.least, nAnswered];
    this.#panel.dataset.phase = standing.phase;
    byId("pairs-back").setAttribute("aria-disabled", String(this.#nAnswers === 0));
    const isOnShow = before?.outcome === outcome && isSame([before.next], [next]);
    if (isOnShow) return;
    const [a, b] = next.map((id) => this.#parts.demonstrations.get(id));
    this.#view.show(a, b, this.#wordsOf(next));
  }

  #showDone() {
    this.#view.stop();
    if (this.#panel.hidden) return;
    const isTheirs = this.#askable.every((one) => isSame(this.#standing(one).order, this.#parts.sitting.orders[one]));
    byId("pairs-done-text").textContent = doneWords(this.#nAnswers, isTheirs);
    byId("pairs-take").hidden = isTheirs;
  }

  /** What came of it, and the next question; the focus stays with the person. @param {string} said */
  #tell(said) {
    if (this.#asked) return announce(`${said} ${this.#questionWords(this.#asked)}`);
    byId("pairs-done").focus();
    announce(`${said} ${byId("pairs-done-text").textContent}`);
  }

  /** The question that is back, in place of any before it: whoever goes back quickly hears the last one. @param {string} said */
  #tellAgain(said) {
    if (this.#asked) announce(`${said} ${this.#questionWords(this.#asked)}`);
  }

  /** @param {{outcome: Outcome, next: [string, string], standing: Standing}} question */
  #questionWords(question) {
    return askedWords({ ...question, words: this.#wordsOf(question.next) });
  }

  /** @param {[string, string]} pair */
  #wordsOf([a, b]) {
    const { demonstrations, showTotals } = this.#parts;
    return { a: cardWords(demonstrations.get(a), showTotals), b: cardWords(demonstrations.get(b), showTotals) };
  }
}
