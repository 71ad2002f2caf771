/** The play page: keys move the agent in the browser; what is finished goes to the server by itself. An entry script. */

import "#js/elements/irl-board.js";
import { describePosition, describeSquare, describeWay } from "#js/board/describe.js";
import { facingOf } from "#js/board/facing.js";
import { listenToKeys, listenToPointer } from "#js/board/input.js";
import { outcomeOf, totalOf } from "#js/board/moves.js";
import { DELTAS, DIRECTIONS, nextState, placeOf, rewardOf } from "#js/board/state.js";
import { announce, announceToo } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { number, signed } from "#js/lib/format.js";
import { pageData } from "#js/lib/page-data.js";
import { uuid } from "#js/lib/uuid.js";
import { noteAttention } from "#js/worlds/attention.js";
import { Client } from "#js/worlds/client.js";
import { Collection } from "#js/worlds/collection.js";
import { Feedback } from "#js/worlds/feedback.js";
import { listenToGamepad } from "#js/worlds/gamepad.js";
import { Hint } from "#js/worlds/hint.js";
import { keepInSight } from "#js/worlds/in-sight.js";
import { LeftBehind } from "#js/worlds/left-behind.js";
import { startOptions } from "#js/worlds/options.js";
import { offerPractice, startPractice } from "#js/worlds/practice.js";
import { toQuery } from "#js/worlds/query.js";
import { Replaying } from "#js/worlds/replaying.js";
import { Scoreboard } from "#js/worlds/scoreboard.js";
import { finishSentence } from "#js/worlds/sentences.js";
import { PlaySession } from "#js/worlds/session.js";
import { Surroundings } from "#js/worlds/surroundings.js";

/** @typedef {import("#js/board/input.js").Press} Press */
/** @typedef {import("#js/board/input.js").Command} Command */
/** @typedef {import("#js/worlds/attempt-strip.js").Entry} Entry */

const TICK_MS = 200;

class PlayPage {
  #life = new AbortController();
  /** @type {{world: import("#js/board/state.js").World, saved: boolean, demonstrations: any[], options: {show_totals: boolean, hold_to_move: boolean}}} */
  #data = pageData();
  #world = this.#data.world;
  #options = { showTotals: this.#data.options.show_totals, holdToMove: this.#data.options.hold_to_move };
  #nWanted = Number(byId("play").dataset.nWanted);
  #board = /** @type {import("#js/elements/irl-board.js").IrlBoard} */ (byId("board"));
  #slot = byId("now");
  #session = new PlaySession({ world: this.#world, newId: uuid, at: performance.now() });
  #client = new Client(this.#options);
  #scoreboard = new Scoreboard(announceToo, this.#world.time_limit_s);
  #feedback = new Feedback();
  #surroundings = new Surroundings(this.#board, this.#world);
  #numbers = false;
  #hint = new Hint();
  #withdrawPractice = () => {};
  #bringIntoSight = keepInSight(byId("boards"), this.#life.signal);
  #replay;
  #collection;
  #leftBehind;

  constructor() {
    this.#board.world = this.#world;
    this.#replay = new Replaying(this.#board, this.#slot, {
      showTotals: this.#options.showTotals,
      onShow: (entry, at) => {
        this.#scoreboard.show(rewardsOf(this.#world, entry.states.slice(0, at + 1)));
        this.#surroundings.show(entry.states[at] ?? this.#world.start);
      },
      onEnd: () => this.#show(),
      onBranch: (entry, at) => this.#beginFrom(entry, at),
      signal: this.#life.signal,
    });
    this.#collection = new Collection(this.#data, this.#nWanted, {
      replay: (entry, n) => this.#replay.begin(entry, n),
      showTotals: this.#options.showTotals,
    });
    this.#leftBehind = new LeftBehind(this.#world, this.#session, {
      isKnown: (id) => this.#collection.entry(id) !== undefined,
      warn: (sentence) => this.#hint.say(sentence, { stays: true }),
    });
  }

  start() {
    const { signal } = this.#life;
    byId("play").style.setProperty("--world-ratio", String(this.#world.cols / this.#world.rows));
    listenToKeys(this, { signal, holdToMove: this.#options.holdToMove });
    listenToPointer(this.#board, this, signal);
    listenToGamepad(this, signal, { holdToMove: this.#options.holdToMove });
    noteAttention(this.#session, { signal, onClockJump: (sentence) => this.#hint.say(sentence, { stays: true }) });
    this.#listenToButtons();
    this.#offerHelp();
    if (this.#world.time_limit_s) this.#watchTime();
    this.#show();
    void this.#recall();
  }

  /** @param {number} action @param {Press} press @returns {boolean} whether a held key may go on */
  move(action, { when, device }) {
    if (this.#replay.isOn) {
      this.#replay.steer(action);
      return true;
    }
    if (this.#session.isOver) return false;
    if (!this.#session.hasOwnSteps) this.#collection.shareQuery();
    if (device === "key" || device === "gamepad") this.#bringIntoSight();
    this.#hint.forget();
    const done = this.#session.move(action, { when, device, paintedAt: this.#board.paintedAt });
    this.#show();
    if (done) this.#tellStep(done);
    this.#keepOrFinish(when);
    return !this.#session.isOver && done?.isBump === false;
  }

  /** A tap on a square beside the agent is a step to it; on a replay it pauses. @param {number} state @param {Press} press */
  tap(state, press) {
    if (this.#replay.isOn) return this.#replay.toggle();
    const here = this.#session.state;
    const action = [0, 1, 2, 3].find((way) => state !== here && nextState(this.#world, here, way) === state);
    if (action !== undefined) this.move(action, press);
  }

  /** The cursor looks at the next square, without anybody moving. @param {number} direction */
  look(direction) {
    if (this.#replay.isOn) return;
    const [row, col] = placeOf(this.#world, this.#board.cursor ?? this.#session.state);
    const [down, right] = DELTAS[direction] ?? [0, 0];
    const isInside = row + down in this.#world.rewards && col + right >= 0 && col + right < this.#world.cols;
    if (!isInside) return announce("The edge.");
    const square = (row + down) * this.#world.cols + col + right;
    this.#board.cursor = square;
    this.#session.note("look", performance.now(), square);
    this.#hint.say(describeSquare(this.#world, square));
  }

  /** @param {Command} command */
  command(command) {
    if (command === "where") return this.#tellWhere();
    if (command === "sound") return this.#feedback.toggleSound();
    if (this.#replay.isOn) return this.#replay.command(command);
    if (command === "endReplay") this.#board.cursor = null;
    else if (command === "undo") this.#undo();
    else if (command === "giveUp") this.#giveUp();
    else if (command === "again" && this.#shows === "result") this.#begin();
    else if (command === "restart" && this.#session.attempt.actions.length > 0) this.#begin();
  }

  /** What the slot beside the board shows: "playing", "result", or "replay" (replaying.js). */
  get #shows() {
    return this.#slot.dataset.shows;
  }

  /** An attempt that a reload or a crash interrupted goes on where it stood, unless another has begun meanwhile. */
  async #recall() {
    await this.#collection.start(this.#life.signal);
    const words = await this.#leftBehind.recall();
    if (!words) return;
    this.#show();
    this.#hint.say(words);
  }

  #begin() {
    // What is unfinished is thrown away, as asked.
    if (!this.#session.isOver) this.#leftBehind.drop(this.#session.attempt.id);
    this.#session.begin(performance.now());
    this.#showBeginning("A new attempt.");
  }

  /** Try again from where another attempt stood. @param {Entry} entry @param {number} at */
  #beginFrom(entry, at) {
    const now = performance.now();
    this.#leftBehind.setAside(now);
    this.#session.beginFrom(entry, at, now);
    this.#showBeginning(`A new attempt, from step ${at} on.`);
    this.#hint.show(`A new attempt, from step ${at} on. Restart goes back to the start.`);
  }

  /** @param {string} words */
  #showBeginning(words) {
    this.#slot.dataset.shows = "playing";
    this.#hint.forget();
    this.#show();
    this.#leftBehind.show();
    this.#board.focus({ preventScroll: true });
    announce(`${words} ${describePosition(this.#world, this.#session.state)}`);
  }

  #undo() {
    const when = performance.now();
    if (!this.#session.undo(when)) return;
    this.#show();
    this.#keepOrFinish(when);
    this.#speak("One step back. ", false);
  }

  #giveUp() {
    if (this.#session.giveUp()) this.#keepOrFinish(performance.now());
  }

  /** @param {number} when */
  #keepOrFinish(when) {
    if (!this.#session.isOver) this.#leftBehind.keep(when);
    else if (this.#shows === "playing") this.#finish(when);
  }

  /** @param {number} when */
  #finish(when) {
    const { attempt, state } = this.#session;
    const outcome = outcomeOf(attempt);
    this.#show();
    const kept = this.#collection.add(attempt, this.#session.record(when, this.#client.describe()));
    // Only what is safe in the outbox may leave the storage of unfinished attempts.
    void kept.then((isSafe) => isSafe && this.#leftBehind.drop(attempt.id));
    const { title, text } = finishSentence({
      outcome,
      ending: attempt.ending,
      total: this.#options.showTotals ? totalOf(attempt) : null,
      nSteps: attempt.actions.length,
      nSame: this.#collection.count(outcome),
      nWanted: this.#nWanted,
    });
    byId("result").dataset.outcome = outcome;
    byId("result-title").textContent = `${outcome === "success" ? "✓" : "✗"} ${title}`;
    byId("result-text").textContent = text;
    this.#slot.dataset.shows = "result";
    // Zoomed in, it lies below the window.
    this.#slot.scrollIntoView({ block: "nearest" });
    this.#leftBehind.show();
    if (outcome === "success") this.#board.celebrate(state);
    this.#feedback.finish(outcome);
    this.#withdrawPractice();
    announce(`${title}. ${text} Enter plays again.`);
  }

  #show() {
    const { attempt, state } = this.#session;
    const last = attempt.actions.length;
    this.#board.view = {
      numbers: this.#numbers,
      paths: [{ states: attempt.states, who: "human", width: 0.35, fade: attempt.ending === null }],
      agents: [{ state, who: "human", facing: facingOf(this.#world, attempt, last) }],
    };
    this.#board.cursor = null;
    this.#board.dataset.state = String(state);
    this.#scoreboard.show(attempt.rewards);
    this.#scoreboard.showTime(this.#session.timeLeft(performance.now()));
    this.#surroundings.show(state);
    for (const button of document.querySelectorAll(".now-actions button")) {
      // What was begun from the midst of another can be left for the start without a step of one's own.
      const isOfUse = button.matches('[data-command="restart"]') ? last > 0 : this.#session.hasOwnSteps;
      /** @type {HTMLButtonElement} */ (button).disabled = this.#session.isOver || !isOfUse;
    }
  }

  /** @param {import("#js/worlds/session.js").Step} step */
  #tellStep({ reached, reward, taken, isSlip, isBump }) {
    this.#board.float(reached, `${isSlip ? "slipped " : ""}${signed(reward)}`, reward > 0 ? "gain" : "loss");
    if (isBump) {
      this.#board.bump(taken);
      this.#feedback.bump();
    } else this.#feedback.step({ reward, isSlip });
    this.#speak(`${isSlip ? `Slipped ${DIRECTIONS[taken]}. ` : ""}${isBump ? "Bumped. " : ""}`);
  }

  #tellWhere() {
    const state = this.#replay.state ?? this.#session.state;
    const words = `${describePosition(this.#world, state)} ${describeWay(this.#world, state)}`;
    if (this.#replay.isOn) announce(words);
    else this.#hint.say(`${words}${this.#totalWords()}`);
  }

  /** @param {string} before @param {boolean} [hasPaid] */
  #speak(before, hasPaid = true) {
    const { attempt, state } = this.#session;
    const cost = attempt.rewards.at(-1);
    const paid = cost === undefined || !hasPaid ? "" : `${signed(cost)}. `;
    announce(before + paid + describePosition(this.#world, state) + this.#totalWords());
  }

  #totalWords() {
    return this.#options.showTotals ? ` Total ${number(totalOf(this.#session.attempt))}.` : "";
  }

  #watchTime() {
    const timer = setInterval(() => {
      const now = performance.now();
      if (this.#session.tick(now)) this.#endByTime(now);
      else if (!this.#session.isOver) this.#scoreboard.showTime(this.#session.timeLeft(now));
    }, TICK_MS);
    this.#life.signal.addEventListener("abort", () => clearInterval(timer));
  }

  /** @param {number} now */
  #endByTime(now) {
    this.#replay.end();
    this.#keepOrFinish(now);
  }

  #listenToButtons() {
    const { signal } = this.#life;
    byId("play").addEventListener("click", (event) => this.#onClick(event), { signal });
    byId("numbers").addEventListener("click", () => this.#toggleNumbers(), { signal });
    document.addEventListener("click", (event) => this.#afterClick(event), { signal });
    this.#board.addEventListener("board:numbers", (event) => {
      this.#session.note("numbers", performance.now(), Number(/** @type {CustomEvent} */ (event).detail.shown));
    });
  }

  /** Options, the practice for whoever is new, and the way to a world of one's own. */
  #offerHelp() {
    const { signal } = this.#life;
    const feedback = this.#feedback;
    const dialog = /** @type {HTMLDialogElement} */ (byId("practice"));
    const practise = () => startPractice({ dialog, feedback, onDone: () => this.#comeToBoard() });
    this.#withdrawPractice = offerPractice({ practise, onSkip: () => this.#comeToBoard() });
    startOptions({ feedback, practise, signal });
    if (this.#world.spec) byId("design").setAttribute("href", `/worlds/new?${toQuery(this.#world.spec)}`);
  }

  /** Whoever practised or read first begins to think about this board now. */
  #comeToBoard() {
    if (!this.#session.hasOwnSteps && !this.#session.isOver) this.#session.begin(performance.now());
    this.#board.focus({ preventScroll: true });
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (!button) return;
    const { move, command } = button.dataset;
    if (move !== undefined) this.move(Number(move), { when: event.timeStamp, device: "pad" });
    else if (command === "takeUp") void this.#takeUp();
    else if (command === "forgetLeft") this.#leftBehind.forget();
    else if (command !== undefined) this.command(/** @type {Command} */ (command));
    // A button that has done its work for now would take the focus with it.
    const isGone = button.disabled || !button.checkVisibility({ visibilityProperty: true });
    const isFocusLost = document.activeElement === button || document.activeElement === document.body;
    if (isGone && isFocusLost) this.#board.focus({ preventScroll: true });
  }

  /** After a click by mouse Enter means "again" again, not the same button once more. @param {MouseEvent} event */
  #afterClick(event) {
    const isByMouse = event instanceof PointerEvent && event.pointerType === "mouse";
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (isByMouse && button && !button.closest("dialog, .menu")) this.#board.focus({ preventScroll: true });
  }

  async #takeUp() {
    this.#replay.end();
    const words = await this.#leftBehind.takeUp();
    if (words) this.#showBeginning("");
    this.#hint.say(words || "That attempt is over: another tab went on with it.");
    this.#board.focus({ preventScroll: true });
  }

  #toggleNumbers() {
    this.#numbers = !this.#numbers;
    this.#session.note("numbers", performance.now(), Number(this.#numbers));
    byId("numbers").setAttribute("aria-pressed", String(this.#numbers));
    this.#board.view = { ...this.#board.view, numbers: this.#numbers };
  }
}

/** What was paid on a walk. @param {import("#js/board/state.js").World} world @param {readonly number[]} states */
function rewardsOf(world, states) {
  return states.slice(1).map((state) => rewardOf(world, state));
}

new PlayPage().start();
