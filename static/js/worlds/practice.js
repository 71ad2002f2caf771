/** The practice on the page: a dialog with a board of its own, and the card that offers it to somebody new. */

import "#js/elements/irl-board.js";
import { describePosition, describeSquare, describeWay } from "#js/board/describe.js";
import { facingOf } from "#js/board/facing.js";
import { listenToKeys, listenToPointer } from "#js/board/input.js";
import { outcomeOf, stateOf, totalOf } from "#js/board/moves.js";
import { nextState } from "#js/board/state.js";
import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { number, signed } from "#js/lib/format.js";
import { hasGamepad, listenToGamepad } from "#js/worlds/gamepad.js";
import { Lesson, PRACTICE_WORLD } from "#js/worlds/lesson.js";

const KEY = "irlfr:practice";
const PARTS = ["move", "goal", "fail", "done"];

/**
 * The card in the rail, for whoever has neither practised nor said no. Returns what takes it away again.
 * @param {{practise: () => void, onSkip: () => void}} parts
 */
export function offerPractice({ practise, onSkip }) {
  const card = document.getElementById("practice-offer");
  if (!card) return () => {};
  card.hidden = hasAnswered();
  byId("practice-begin").addEventListener("click", practise);
  byId("practice-skip").addEventListener("click", () => {
    remember("skipped");
    onSkip();
  });
  return () => remember("skipped");
}

/**
 * Open the practice; `onDone` is called when it is closed, done or not.
 * @param {object} parts
 * @param {HTMLDialogElement} parts.dialog
 * @param {() => void} parts.onDone
 * @param {import("#js/worlds/feedback.js").Feedback} [parts.feedback]
 */
export function startPractice({ dialog, onDone, feedback }) {
  if (!dialog.open) new Practice(dialog, feedback).open(onDone);
}

class Practice {
  #life = new AbortController();
  #dialog;
  #feedback;
  /** None where a study hides totals. */
  #total = document.getElementById("practice-total");
  #lesson = new Lesson(meansAtHand(), { showTotals: this.#total !== null });
  #board;

  /** @param {HTMLDialogElement} dialog @param {import("#js/worlds/feedback.js").Feedback} [feedback] */
  constructor(dialog, feedback) {
    this.#dialog = dialog;
    this.#feedback = feedback;
    this.#board = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (byId("practice-board"));
  }

  /** @param {() => void} onDone */
  open(onDone) {
    const { signal } = this.#life;
    this.#board.world = PRACTICE_WORLD;
    listenToKeys(this, { signal, root: this.#dialog });
    listenToPointer(this.#board, this, signal);
    listenToGamepad(this, signal, { root: this.#dialog });
    this.#dialog.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.#dialog.addEventListener("close", () => this.#leave(onDone), { signal });
    this.#show();
    this.#dialog.showModal();
    this.#focusBoard();
  }

  /** @param {number} action */
  move(action) {
    const happened = this.#lesson.move(action);
    if (!happened) return false;
    const { reached, reward, isBump } = happened;
    const { attempt, words } = this.#lesson;
    this.#show();
    this.#board.float(reached, signed(reward), reward > 0 ? "gain" : "loss");
    this.#feedback?.step({ reward, isSlip: false });
    if (isBump) this.#board.bump(action);
    if (isBump) this.#feedback?.bump();
    if (attempt.ending !== null) this.#finish();
    else this.#speak(`${signed(reward)}. ${isBump ? "Bumped. " : ""}${words} `);
    return attempt.ending === null;
  }

  /** @param {number} state */
  tap(state) {
    const here = stateOf(this.#lesson.attempt);
    const action = [0, 1, 2, 3].find((way) => state !== here && nextState(PRACTICE_WORLD, here, way) === state);
    if (action !== undefined) this.move(action);
  }

  /** @param {number} direction */
  look(direction) {
    const from = this.#board.cursor ?? stateOf(this.#lesson.attempt);
    this.#board.cursor = nextState(PRACTICE_WORLD, from, direction);
    announce(describeSquare(PRACTICE_WORLD, this.#board.cursor));
  }

  /** @param {import("#js/board/input.js").Command} command */
  command(command) {
    const lesson = this.#lesson;
    if (command === "again") return this.#goOn();
    if (command === "sound") return this.#feedback?.toggleSound();
    if (command === "where") return this.#speak("", describeWay(PRACTICE_WORLD, stateOf(lesson.attempt)));
    if (command === "giveUp" && lesson.canGiveUp) {
      lesson.giveUp();
      this.#show();
      return this.#finish();
    }
    if (command === "undo") lesson.undo();
    if (command === "restart") lesson.restart();
    this.#show();
    if (command !== "endReplay" && command !== "giveUp") this.#speak(`${lesson.words} `);
  }

  #goOn() {
    if (this.#lesson.next === null) return;
    if (this.#lesson.part === "done") return this.#dialog.close();
    this.#lesson.goOn();
    this.#show();
    this.#focusBoard();
    this.#speak(`${this.#lesson.words} `);
  }

  #finish() {
    const { attempt, words, next } = this.#lesson;
    const outcome = outcomeOf(attempt);
    this.#feedback?.finish(outcome);
    if (outcome === "success") this.#board.celebrate(stateOf(attempt));
    this.#button("goOn").scrollIntoView({ block: "nearest" });
    announce(`${words} ${next}: Enter.`);
  }

  #show() {
    const { attempt, part, words, next, canGiveUp } = this.#lesson;
    const state = stateOf(attempt);
    this.#board.cursor = null;
    this.#board.view = {
      numbers: true,
      paths: [{ states: [...attempt.states], who: "human", width: 0.35, fade: attempt.ending === null }],
      agents: [{ state, who: "human", facing: facingOf(PRACTICE_WORLD, attempt, attempt.actions.length) }],
    };
    this.#dialog.dataset.part = part;
    byId("practice-words").textContent = words;
    if (this.#total) this.#total.textContent = number(totalOf(attempt));
    byId("practice-position").textContent = describePosition(PRACTICE_WORLD, state);
    for (const item of this.#all("[data-practice-part]")) {
      const ahead = PARTS.indexOf(item.dataset.practicePart ?? "") - PARTS.indexOf(part);
      item.dataset.done = String(ahead < 0);
      item.ariaCurrent = ahead === 0 ? "step" : null;
    }
    this.#button("goOn").hidden = next === null;
    byId("practice-next").textContent = next ?? "";
    this.#button("giveUp").hidden = part !== "fail" || next !== null;
    this.#button("giveUp").disabled = !canGiveUp;
    for (const pad of this.#all("[data-practice-move]")) pad.ariaDisabled = String(next !== null);
  }

  /** @param {string} before @param {string} [after] */
  #speak(before, after = "") {
    announce(`${before}${describePosition(PRACTICE_WORLD, stateOf(this.#lesson.attempt))} ${after}`.trim());
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const target = event.target instanceof Element ? event.target : null;
    const button = /** @type {HTMLButtonElement | null} */ (target?.closest("button") ?? null);
    const { practice, practiceMove } = button?.dataset ?? {};
    if (practiceMove !== undefined) this.move(Number(practiceMove));
    else if (practice === "giveUp") this.command("giveUp");
    else if (practice === "goOn") this.#goOn();
    else if (practice === "leave") this.#dialog.close();
    // A button that has done its work would take the focus with it.
    if (this.#dialog.open && (button?.disabled || button?.hidden)) this.#focusBoard();
  }

  /** @param {() => void} onDone */
  #leave(onDone) {
    this.#life.abort();
    remember(this.#lesson.part === "done" ? "done" : "skipped");
    onDone();
  }

  #focusBoard() {
    this.#board.focus({ preventScroll: true });
    this.#board.scrollIntoView({ block: "nearest" });
  }

  /** @param {string} selector @returns {NodeListOf<HTMLElement>} */
  #all(selector) {
    return this.#dialog.querySelectorAll(selector);
  }

  /** @param {string} name */
  #button(name) {
    return /** @type {HTMLButtonElement} */ (this.#dialog.querySelector(`[data-practice="${name}"]`));
  }
}

/** @returns {import("#js/worlds/lesson.js").Means} */
function meansAtHand() {
  if (hasGamepad()) return "gamepad";
  return matchMedia("(pointer: coarse)").matches ? "touch" : "keys";
}

function hasAnswered() {
  try {
    return localStorage.getItem(KEY) !== null;
  } catch {
    return false;
  }
}

/** Whoever has done the practice stays somebody who has. @param {"done" | "skipped"} answer */
function remember(answer) {
  const card = document.getElementById("practice-offer");
  if (card) card.hidden = true;
  try {
    if (answer === "done" || !hasAnswered()) localStorage.setItem(KEY, answer);
  } catch {
    // A browser that keeps nothing offers the practice again next time.
  }
}
