/** Good and bad stretches: one attempt at a time on a large board, its steps as a strip below, and the order that follows. */

import "#js/elements/irl-board.js";
import { facingOf } from "#js/board/facing.js";
import { Replay } from "#js/board/replay.js";
import { announce } from "#js/lib/announce.js";
import { byId } from "#js/lib/dom.js";
import { signed } from "#js/lib/format.js";
import { isTaken, letterOf } from "#js/lib/keys.js";
import { flat } from "#js/rankings/order.js";
import { endsOf, isSameOrder, kindOf, markedWords, orderFromScores, runWords, scoreOf } from "#js/rankings/segments.js";
import { cardWords } from "#js/rankings/sentences.js";
import { StepStrip } from "#js/rankings/step-strip.js";
import { StretchInk } from "#js/rankings/stretch-ink.js";
import { StretchList } from "#js/rankings/stretch-list.js";

/** @typedef {import("#js/rankings/segments.js").Kind} Kind */
/** @typedef {import("#js/rankings/sitting-state.js").Outcome} Outcome */
/** @typedef {import("#js/rankings/sitting-state.js").Means} Means */
/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */

/** @type {Outcome[]} */
const OUTCOMES = ["success", "failure"];
/** What a key says of the chosen steps. @type {Record<string, Kind | null>} */
const KEYS = { g: "good", b: "bad", delete: null, backspace: null };

export class SegmentsPanel {
  #parts;
  #root = byId("stretches");
  #board = /** @type {IrlBoard} */ (byId("stretches-board"));
  #replay = new Replay(this.#board, () => this.#showPlay());
  #strip;
  /** @type {StretchInk | null} */
  #ink = null;
  /** @type {Record<Outcome, StretchList>} */
  #lists;
  /** @type {string | null} */
  #chosen = null;

  /** @param {import("#js/rankings/rank.js").Parts} parts */
  constructor(parts) {
    this.#parts = parts;
    this.#strip = new StepStrip(byId("stretches-strip"), parts.world, () => this.#showSelection());
    const listOf = (/** @type {Outcome} */ outcome) => new StretchList(byId(`stretches-${outcome}`), parts.world);
    this.#lists = { success: listOf("success"), failure: listOf("failure") };
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    this.#strip.start(signal);
    this.#ink = new StretchInk(this.#board, signal);
    this.#root.addEventListener("click", (event) => this.#onClick(event), { signal });
    this.#root.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    this.#parts.sitting.subscribe(() => this.#show());
    this.#show();
  }

  /** @param {string} id */
  choose(id) {
    this.#open(id);
    announce(`${byId("stretches-title").textContent}: ${byId("stretches-words").textContent}.`);
  }

  /** @param {Kind | null} kind @param {Means} means */
  mark(kind, means) {
    const { selection } = this.#strip;
    const id = this.#chosen;
    if (!selection || id === null) return announce("Choose some steps first.");
    const run = endsOf(selection);
    if (this.#strip.isPinned) this.#strip.endHere();
    const isNew = this.#parts.sitting.do({ type: "stretch", means, id, ...run, kind });
    const said = kind === null ? "neither good nor bad" : `a ${kind} stretch`;
    const score = `Score ${signed(this.#scoreOf(id), 2)}`;
    announce(`${capital(runWords(run))}: ${said}${isNew ? "" : ", as before"}. ${score}.`);
  }

  /** The order of a list becomes what follows from the marks. @param {Outcome} outcome */
  use(outcome) {
    if (byId(`stretches-use-${outcome}`).ariaDisabled === "true")
      return announce(byId(`stretches-used-${outcome}`).textContent ?? "");
    const order = this.#follows(outcome);
    this.#parts.sitting.do({ type: "set", means: "button", outcome, order, by: "segments" });
    const which = outcome === "success" ? "successes" : "failures";
    announce(`Your ${which} stand in this order now. Look it over in the lists below, then confirm it.`);
  }

  /** @param {MouseEvent} event */
  #onClick(event) {
    const button = event.target instanceof Element ? event.target.closest("button") : null;
    if (!button) return;
    const { demonstrationId, mark, use, act, needsRun } = button.dataset;
    if (needsRun !== undefined && !this.#strip.selection) announce("Choose some steps first.");
    else if (demonstrationId) this.choose(demonstrationId);
    else if (mark) this.mark(mark === "neither" ? null : /** @type {Kind} */ (mark), "button");
    else if (use) this.use(/** @type {Outcome} */ (use));
    else if (act === "before" || act === "next") this.#goBy(act === "next" ? 1 : -1);
    else if (act === "play") this.#play("button");
    else if (act === "from") this.#strip.beginHere();
    else if (act === "to") this.#strip.endHere();
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (isTaken(event) || event.shiftKey || event.repeat) return;
    const letter = letterOf(event);
    if (letter in KEYS) this.mark(KEYS[letter] ?? null, "key");
    else if (letter === "p") this.#play("key");
    else return;
    event.preventDefault();
  }

  /** As they were played: what is marked moves nobody under the hand. @returns {string[]} */
  get #ids() {
    const { demonstrations, sitting } = this.#parts;
    const there = new Set(OUTCOMES.flatMap((outcome) => flat(sitting.orders[outcome])));
    return [...demonstrations.keys()].filter((id) => there.has(id));
  }

  get #walk() {
    return this.#parts.demonstrations.get(this.#chosen ?? "");
  }

  get #stretches() {
    return this.#parts.sitting.state.present.stretches[this.#chosen ?? ""] ?? [];
  }

  /** @param {string} id */
  #scoreOf(id) {
    const { demonstrations, sitting } = this.#parts;
    return scoreOf(sitting.state.present.stretches[id] ?? [], demonstrations.get(id).actions.length);
  }

  /** @param {Outcome} outcome */
  #follows(outcome) {
    return orderFromScores(flat(this.#parts.sitting.orders[outcome]), (id) => this.#scoreOf(id), outcome);
  }

  /** @param {1 | -1} by */
  #goBy(by) {
    const ids = this.#ids;
    const to = ids.at((ids.indexOf(this.#chosen ?? "") + by) % ids.length);
    if (to) this.choose(to);
  }

  /** @param {string} id */
  #open(id) {
    this.#replay.stop();
    this.#chosen = id;
    this.#strip.fill(this.#walk);
    this.#board.world = this.#parts.world;
    this.#show();
  }

  #show() {
    if (this.#parts.sitting.state.way !== "segments") return this.#replay.stop();
    const ids = this.#ids;
    this.#root.hidden = ids.length === 0;
    if (ids.length === 0) return;
    if (this.#chosen === null || !ids.includes(this.#chosen)) return this.#open(ids[0]);
    this.#strip.mark(this.#stretches);
    this.#showAttempt(ids);
    this.#showSelection();
    for (const outcome of OUTCOMES) this.#showOrder(outcome);
  }

  /** @param {string[]} ids */
  #showAttempt(ids) {
    const { showTotals } = this.#parts;
    const [walk, stretches] = [this.#walk, this.#stretches];
    const score = stretches.length > 0 ? `, score ${signed(this.#scoreOf(walk.id), 2)}` : "";
    byId("stretches-title").textContent = `Attempt ${ids.indexOf(walk.id) + 1} of ${ids.length}`;
    byId("stretches-words").textContent = `${cardWords(walk, showTotals)}, ${markedWords(stretches)}${score}`;
    const runs = stretches.map((one) => `${runWords(one)} ${one.kind}`);
    this.#board.label = `The path of this attempt${runs.length > 0 ? `: ${runs.join(", ")}` : ", nothing marked"}`;
  }

  #showSelection() {
    const walk = this.#walk;
    const { selection, isPinned } = this.#strip;
    const run = selection ? endsOf(selection) : null;
    this.#ink?.draw(this.#parts.world, walk.states, this.#stretches, run);
    if (!this.#replay.isPlaying) this.#rest();
    const chosen = run ? `${capital(runWords(run))} chosen` : "";
    byId("stretches-run").textContent = isPinned && run ? `${chosen}. Go to the last step, then “To here”.` : chosen;
    byId("stretches-hint").hidden = run !== null;
    this.#root.dataset.pinned = String(isPinned);
    for (const button of this.#root.querySelectorAll("[data-needs-run]"))
      button.setAttribute("aria-disabled", String(run === null));
    const kind = run && kindOf(this.#stretches, run.from);
    const isAll = run !== null && this.#stretches.some(({ from, to }) => from <= run.from && run.to <= to);
    for (const button of /** @type {NodeListOf<HTMLElement>} */ (this.#root.querySelectorAll("[data-mark]")))
      button.setAttribute("aria-pressed", String(isAll && button.dataset.mark === kind));
  }

  /** @param {Outcome} outcome */
  #showOrder(outcome) {
    const { sitting, demonstrations, showTotals } = this.#parts;
    const { orders, stretches } = sitting.state.present;
    const order = this.#follows(outcome);
    const wordsOf = (/** @type {string} */ id) => cardWords(demonstrations.get(id), showTotals);
    this.#lists[outcome].show(order, { demonstrations, wordsOf, stretches, chosen: this.#chosen });
    byId(`stretches-order-${outcome}`).hidden = order.length === 0;
    const isMarked = flat(order).some((id) => id in stretches);
    const isUsed = isSameOrder(order, orders[outcome]);
    const button = byId(`stretches-use-${outcome}`);
    button.setAttribute("aria-disabled", String(!isMarked || isUsed));
    byId(`stretches-used-${outcome}`).textContent = !isMarked
      ? "Nothing is marked here yet: all would tie."
      : isUsed
        ? "Your list stands in this order."
        : "Your list stands in another order.";
  }

  /** The chosen steps, or the whole attempt. @param {Means} means */
  #play(means) {
    if (this.#replay.isPlaying) {
      this.#replay.stop();
      return this.#rest();
    }
    const walk = this.#walk;
    const { selection } = this.#strip;
    const { from, to } = selection ? endsOf(selection) : { from: 1, to: walk.actions.length };
    const part = { states: walk.states.slice(from - 1, to + 1), actions: walk.actions.slice(from - 1, to) };
    this.#parts.sitting.do({ type: "watch", means, id: walk.id });
    this.#replay.play(part, () => this.#rest());
  }

  #showPlay() {
    byId("stretches-play-word").textContent = this.#replay.isPlaying ? "Stop" : "Play it";
  }

  /** The whole path, and who walked it where the choice ends. */
  #rest() {
    const walk = this.#walk;
    const at = this.#strip.selection?.head ?? 0;
    const agent = { state: walk.states[at], who: "human", facing: facingOf(this.#parts.world, walk, at) };
    this.#board.view = { paths: [{ states: walk.states, who: "human", width: 0.1 }], agents: [agent] };
  }
}

/** @param {string} text */
function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
