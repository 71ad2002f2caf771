/** The play page: keys move the agent in the browser; what is finished goes to the server by itself. An entry script. */

import "#js/elements/irl-board.js";
import { describePosition } from "#js/board/describe.js";
import { facingOf } from "#js/board/facing.js";
import { listenToKeys, listenToPointer } from "#js/board/input.js";
import { beginAttempt, giveUp, lastStep, outcomeOf, stateOf, step, totalOf, undo } from "#js/board/moves.js";
import { Replay } from "#js/board/replay.js";
import { DIRECTIONS, nextState } from "#js/board/state.js";
import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { number, plural, signed } from "#js/lib/format.js";
import { pageData } from "#js/lib/page-data.js";
import { keepAttempt, keptAttempt } from "#js/worlds/checkpoint.js";
import { Collection } from "#js/worlds/collection.js";
import { Feedback } from "#js/worlds/feedback.js";
import { listenToGamepad } from "#js/worlds/gamepad.js";
import { startOptions } from "#js/worlds/options.js";
import { offerPractice, startPractice } from "#js/worlds/practice.js";
import { finishSentence } from "#js/worlds/sentences.js";

/** @typedef {import("#js/board/moves.js").Attempt} Attempt */
/** @typedef {import("#js/worlds/attempt-strip.js").Entry} Entry */

const LONGEST_STEP_MS = 86_400_000;

class PlayPage {
  #life = new AbortController();
  /** @type {{world: import("#js/board/state.js").World, saved: boolean, demonstrations: any[]}} */
  #data = pageData();
  #world = this.#data.world;
  #nWanted = Number(byId("play").dataset.nWanted);
  #board = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (byId("board"));
  #replay = new Replay(this.#board);
  #slot = byId("now");
  #attempt = beginAttempt(this.#world, crypto.randomUUID());
  #lastEvent = performance.now();
  #numbers = false;
  #feedback = new Feedback();
  #collection = new Collection(this.#data, this.#nWanted, { replay: (entry, n) => this.#startReplay(entry, n) });

  start() {
    this.#board.world = this.#world;
    byId("play").style.setProperty("--world-ratio", String(this.#world.cols / this.#world.rows));
    this.#resume();
    listenToKeys(this, { signal: this.#life.signal });
    listenToPointer(this.#board, this, this.#life.signal);
    listenToGamepad(this, this.#life.signal);
    this.#listenToButtons();
    this.#offerHelp();
    this.#collection.start(this.#life.signal);
    this.#show();
  }

  /** @param {number} action @param {import("#js/board/input.js").Press} press */
  move(action, { when }) {
    if (this.#slot.dataset.shows === "replay") this.#endReplay();
    if (this.#attempt.ending !== null) return false;
    const before = stateOf(this.#attempt);
    const ms = Math.min(LONGEST_STEP_MS, Math.max(0, Math.round((when - this.#lastEvent) * 10) / 10));
    this.#lastEvent = when;
    if (this.#attempt.actions.length === 0) this.#collection.shareQuery();
    this.#attempt = step(this.#world, this.#attempt, action, ms);
    const reached = stateOf(this.#attempt);
    this.#show();
    const { taken, isSlip } = lastStep(this.#world, this.#attempt);
    if (reached === before) this.#board.bump(taken);
    if (reached === before) this.#feedback.bump();
    this.#feedback.step({ reward: this.#attempt.rewards.at(-1) ?? 0, isSlip });
    this.#floatReward(reached, isSlip);
    if (this.#attempt.ending === null)
      this.#speak(`${isSlip ? `Slipped ${DIRECTIONS[taken]}. ` : ""}${reached === before ? "Bumped. " : ""}`);
    else this.#finish();
    keepAttempt(this.#world.id, this.#attempt);
    return this.#attempt.ending === null;
  }

  /** A tap on a square beside the agent is a step to it. @param {number} state @param {import("#js/board/input.js").Press} press */
  tap(state, press) {
    const here = stateOf(this.#attempt);
    const action = [0, 1, 2, 3].find(
      (direction) => state !== here && nextState(this.#world, here, direction) === state,
    );
    if (action !== undefined) this.move(action, press);
  }

  /** What lies one square on, without going there. @param {number} direction */
  look(direction) {
    announce(describePosition(this.#world, nextState(this.#world, stateOf(this.#attempt), direction)));
  }

  /** @param {string} command */
  command(command) {
    if (command === "where") return this.#speak("", false);
    if (command === "sound") return this.#feedback.toggleSound();
    const shows = this.#slot.dataset.shows;
    if (shows === "replay") this.#endReplay();
    if (command === "endReplay") return;
    if (command === "undo") this.#undo();
    else if (command === "giveUp") this.#giveUp();
    else if (command === "restart" && (this.#attempt.actions.length > 0 || shows === "result")) this.#begin();
    else if (command === "again" && shows === "result") this.#begin();
  }

  #begin() {
    this.#attempt = beginAttempt(this.#world, crypto.randomUUID());
    this.#lastEvent = performance.now();
    this.#slot.dataset.shows = "playing";
    keepAttempt(this.#world.id, this.#attempt);
    this.#show();
    this.#board.focus({ preventScroll: true });
    announce(`A new attempt. ${describePosition(this.#world, stateOf(this.#attempt))}`);
  }

  #undo() {
    if (this.#attempt.actions.length === 0 || this.#attempt.ending !== null) return;
    this.#attempt = undo(this.#attempt);
    keepAttempt(this.#world.id, this.#attempt);
    this.#show();
    this.#speak("One step back. ", false);
  }

  #giveUp() {
    if (this.#attempt.ending !== null) return;
    this.#attempt = giveUp(this.#attempt);
    if (this.#attempt.ending === null) return;
    keepAttempt(this.#world.id, this.#attempt);
    this.#show();
    this.#finish();
  }

  /** An attempt that a reload interrupted goes on where it stood. */
  #resume() {
    const kept = keptAttempt(this.#world);
    if (!kept) return;
    this.#attempt = kept;
    const words = `Welcome back: you stood at step ${kept.actions.length}. Play on, or restart.`;
    byId("hint").textContent = words;
    byId("hint").dataset.isUsual = "false";
    announce(words);
  }

  #finish() {
    const attempt = this.#attempt;
    const outcome = outcomeOf(attempt);
    this.#collection.add(attempt);
    const { title, text } = finishSentence({
      outcome,
      ending: attempt.ending,
      total: totalOf(attempt),
      nSteps: attempt.actions.length,
      nSame: this.#collection.count(outcome),
      nWanted: this.#nWanted,
    });
    byId("result").dataset.outcome = outcome;
    byId("result-title").textContent = `${outcome === "success" ? "✓" : "✗"} ${title}`;
    byId("result-text").textContent = text;
    this.#slot.dataset.shows = "result";
    this.#feedback.finish(outcome);
    if (outcome === "success") this.#board.hop();
    announce(`${title}. ${text} Enter plays again.`);
  }

  /** @param {Entry} entry @param {number} n */
  #startReplay(entry, n) {
    if (this.#slot.dataset.shows !== "replay") this.#slot.dataset.before = this.#slot.dataset.shows;
    this.#slot.dataset.shows = "replay";
    byId("replay-title").textContent = `Attempt ${n}: ${entry.outcome}, ${signed(entry.total)}`;
    this.#board.dataset.mode = "replay";
    const name = `Replay of attempt ${n}`;
    announce(
      `${name}: ${entry.outcome}, ${signed(entry.total)} in ${plural(entry.actions.length, "step")}. Escape goes back to play.`,
    );
    // On a phone the list lies below the board.
    this.#board.scrollIntoView({ block: "nearest" });
    this.#replay.play(entry, () => announce(`${name} is over. Escape goes back to play.`));
  }

  #endReplay() {
    this.#replay.stop();
    delete this.#board.dataset.mode;
    this.#slot.dataset.shows = this.#slot.dataset.before ?? "playing";
    this.#show();
  }

  #show() {
    const attempt = this.#attempt;
    const state = stateOf(attempt);
    const last = attempt.actions.length;
    this.#board.view = {
      numbers: this.#numbers,
      paths: [{ states: [...attempt.states], who: "human", width: 0.35, fade: attempt.ending === null }],
      agents: [{ state, who: "human", facing: facingOf(this.#world, attempt, last) }],
    };
    this.#board.dataset.state = String(state);
    byId("total").textContent = number(totalOf(attempt));
    byId("n-steps").textContent = String(last);
    byId("last-step").textContent = last > 0 ? signed(attempt.rewards[last - 1] ?? 0) : "–";
    byId("position").textContent = describePosition(this.#world, state);
    const hasNone = last === 0 || attempt.ending !== null;
    for (const button of document.querySelectorAll(".now-actions button")) {
      /** @type {HTMLButtonElement} */ (button).disabled = hasNone;
    }
  }

  /** @param {number} state @param {boolean} isSlip */
  #floatReward(state, isSlip) {
    const reward = this.#attempt.rewards.at(-1) ?? 0;
    this.#board.float(state, `${isSlip ? "slipped " : ""}${signed(reward)}`, reward > 0 ? "gain" : "loss");
  }

  /** @param {string} before @param {boolean} [hasPaid] */
  #speak(before, hasPaid = true) {
    const cost = this.#attempt.rewards.at(-1);
    const paid = cost === undefined || !hasPaid ? "" : `${signed(cost)}. `;
    const total = ` Total ${number(totalOf(this.#attempt))}.`;
    announce(before + paid + describePosition(this.#world, stateOf(this.#attempt)) + total);
  }

  #listenToButtons() {
    const { signal } = this.#life;
    const onClick = (/** @type {MouseEvent} */ event) => {
      const button = event.target instanceof Element ? event.target.closest("button") : null;
      if (!button) return;
      const { move, command, speed } = button.dataset;
      if (move !== undefined) this.move(Number(move), { when: event.timeStamp, device: "pad" });
      else if (command !== undefined) this.command(command);
      else if (speed !== undefined) this.#setSpeed(Number(speed));
      // A button that has done its work for now would take the focus with it.
      const isGone = button.disabled || !button.checkVisibility({ visibilityProperty: true });
      const isFocusLost = document.activeElement === button || document.activeElement === document.body;
      if (isGone && isFocusLost) this.#board.focus({ preventScroll: true });
    };
    byId("play").addEventListener("click", onClick, { signal });
    byId("numbers").addEventListener("click", () => this.#toggleNumbers(), { signal });
  }

  /** Options, and the practice for whoever is new. */
  #offerHelp() {
    const { signal } = this.#life;
    const feedback = this.#feedback;
    const toBoard = () => this.#board.focus({ preventScroll: true });
    const dialog = /** @type {HTMLDialogElement} */ (byId("practice"));
    const practise = () => startPractice({ dialog, feedback, onDone: toBoard });
    offerPractice({ practise, onSkip: toBoard });
    startOptions({ feedback, practise, signal });
  }

  /** @param {number} speed */
  #setSpeed(speed) {
    this.#replay.speed = speed;
    for (const button of document.querySelectorAll("[data-speed]")) {
      button.setAttribute("aria-pressed", String(Number(/** @type {HTMLElement} */ (button).dataset.speed) === speed));
    }
  }

  #toggleNumbers() {
    this.#numbers = !this.#numbers;
    byId("numbers").setAttribute("aria-pressed", String(this.#numbers));
    this.#board.view = { ...this.#board.view, numbers: this.#numbers };
  }
}

new PlayPage().start();
