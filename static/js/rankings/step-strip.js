/**
 * An attempt as a strip: one cell a step, with the colour and the sign of the square it reached, and below it how it is
 * marked. Steps are chosen by dragging, by Shift and arrows, or from one place to another by buttons.
 */

import { shade, wantsDarkInk, worldDepth } from "#js/board/colours.js";
import { wordsOf } from "#js/board/describe.js";
import { make } from "#js/board/dom.js";
import { rewardOf } from "#js/board/state.js";
import { onThemeChange, theme } from "#js/board/theme.js";
import { endsOf, kindOf, select, stepsOf } from "#js/rankings/segments.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/rankings/segments.js").Selection} Selection */
/** @typedef {import("#js/rankings/segments.js").Step} Step */
/** @typedef {import("#js/rankings/sitting-state.js").Stretch} Stretch */

const PAGE = 10;
/** A long stretch says again what it is after so many steps, for its beginning may be out of sight. */
const SAID_AGAIN = 8;

export class StepStrip {
  #list;
  #world;
  #onSelect;
  /** @type {HTMLElement[]} */
  #cells = [];
  /** @type {Step[]} */
  #steps = [];
  /** @type {readonly Stretch[]} */
  #stretches = [];
  /** @type {Selection | null} */
  #selection = null;
  /** While a start is set, every step gone to ends the choice there. */
  #isPinned = false;
  /** @type {number | null} the pointer that drags */
  #pointer = null;
  /** @type {Selection | null} */
  #before = null;

  /** @param {HTMLElement} list @param {World} world @param {(selection: Selection | null) => void} onSelect */
  constructor(list, world, onSelect) {
    this.#list = list;
    this.#world = world;
    this.#onSelect = onSelect;
  }

  /** @param {AbortSignal} signal */
  start(signal) {
    const list = this.#list;
    list.addEventListener("pointerdown", (event) => this.#onDown(event), { signal });
    list.addEventListener("pointermove", (event) => this.#onMove(event), { signal });
    list.addEventListener("pointerup", () => this.#letGo(), { signal });
    list.addEventListener("pointercancel", () => this.#onCancel(), { signal });
    list.addEventListener("keydown", (event) => this.#onKey(event), { signal });
    list.addEventListener("focusin", (event) => this.#onFocus(event), { signal });
    onThemeChange(() => this.#paint(), signal);
  }

  get selection() {
    return this.#selection;
  }

  get isPinned() {
    return this.#isPinned;
  }

  get nSteps() {
    return this.#steps.length;
  }

  /** @param {{states: readonly number[], actions: readonly number[]}} walk */
  fill(walk) {
    this.#steps = stepsOf(this.#world, walk);
    this.#cells = this.#steps.map((step) => makeCell(step));
    this.#list.replaceChildren(...this.#cells);
    this.#stretches = [];
    [this.#selection, this.#isPinned] = [null, false];
    this.#paint();
    this.#describe();
  }

  /** @param {readonly Stretch[]} stretches */
  mark(stretches) {
    this.#stretches = stretches;
    this.#describe();
  }

  /** The step gone to last begins what is chosen; what is gone to next ends it. */
  beginHere() {
    if (!this.#selection) return;
    this.#isPinned = true;
    this.#choose(select(null, this.#selection.head, { extends: false, nSteps: this.nSteps }));
  }

  /** What began with `beginHere` ends at the step gone to last. */
  endHere() {
    this.#isPinned = false;
    this.#choose(this.#selection);
  }

  focus() {
    this.#cells[(this.#selection?.head ?? 1) - 1]?.focus();
  }

  /** @param {Selection | null} selection */
  #choose(selection) {
    this.#selection = selection;
    this.#describe();
    this.#onSelect(selection);
  }

  /** @param {number} step @param {boolean} reaches */
  #goTo(step, reaches) {
    this.#choose(select(this.#selection, step, { extends: reaches || this.#isPinned, nSteps: this.nSteps }));
  }

  /** @param {PointerEvent} event */
  #onDown(event) {
    const step = stepAt(event.target);
    if (step === null || event.button !== 0) return;
    this.#before = this.#selection;
    this.#pointer = event.pointerId;
    // A touch holds what it came down on, and would tell of no other cell.
    if (this.#list.hasPointerCapture(event.pointerId)) this.#list.releasePointerCapture(event.pointerId);
    event.preventDefault();
    this.#goTo(step, event.shiftKey);
    this.#cells[step - 1]?.focus({ preventScroll: true });
    this.#list.setPointerCapture(event.pointerId);
  }

  /** @param {PointerEvent} event */
  #onMove(event) {
    if (event.pointerId !== this.#pointer) return;
    const step = stepAt(document.elementFromPoint(event.clientX, event.clientY));
    if (step === null || step === this.#selection?.head) return;
    this.#goTo(step, true);
    this.#cells[step - 1]?.focus({ preventScroll: true });
  }

  #letGo() {
    this.#pointer = null;
  }

  /** A finger that turned out to scroll has chosen nothing. */
  #onCancel() {
    if (this.#pointer === null) return;
    this.#letGo();
    this.#choose(this.#before);
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const isAll = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "a";
    if (isAll) this.#choose({ anchor: 1, head: this.nSteps });
    else if (event.ctrlKey || event.metaKey || event.altKey) return;
    else {
      const head = this.#selection?.head ?? 1;
      const to = this.#target(event.key, head);
      if (to === null) return;
      this.#goTo(to, event.shiftKey);
    }
    event.preventDefault();
    this.focus();
  }

  /** @param {string} key @param {number} head @returns {number | null} */
  #target(key, head) {
    if (key === "Escape") return this.#unpin(head);
    if (key === "ArrowLeft") return head - 1;
    if (key === "ArrowRight") return head + 1;
    if (key === "ArrowUp") return Math.max(1, head - this.#rowLength());
    if (key === "ArrowDown") return head + this.#rowLength();
    if (key === "Home") return 1;
    if (key === "End") return this.nSteps;
    if (key === "PageUp") return head - PAGE;
    return key === "PageDown" ? head + PAGE : null;
  }

  /** @param {number} head */
  #unpin(head) {
    this.#isPinned = false;
    return head;
  }

  /** Cells of the first line, as the strip is wrapped just now. */
  #rowLength() {
    const top = this.#cells[0]?.offsetTop;
    const next = this.#cells.findIndex((cell) => cell.offsetTop !== top);
    return next < 0 ? this.nSteps : next;
  }

  /** Whoever comes by Tab stands on a step, and has chosen it. @param {FocusEvent} event */
  #onFocus(event) {
    const step = stepAt(event.target);
    if (step !== null && this.#selection === null) this.#goTo(step, false);
  }

  #describe() {
    const run = this.#selection ? endsOf(this.#selection) : null;
    const head = this.#selection?.head ?? 1;
    for (const [i, cell] of this.#cells.entries()) {
      const n = i + 1;
      const kind = kindOf(this.#stretches, n);
      cell.tabIndex = n === head ? 0 : -1;
      cell.setAttribute("aria-selected", String(run !== null && run.from <= n && n <= run.to));
      cell.dataset.head = String(this.#selection !== null && n === head);
      cell.dataset.kind = kind ?? "";
      const beginning = this.#stretches.find(({ from, to }) => from <= n && n <= to)?.from ?? n;
      const isSaid = (n - beginning) % SAID_AGAIN === 0;
      /** @type {HTMLElement} */ (cell.lastElementChild).textContent = kind && isSaid ? kind : "";
      cell.setAttribute("aria-label", `${labelOf(this.#world, this.#steps[i])}${kind ? `, ${kind}` : ""}`);
    }
  }

  /** The squares' colours are data of the board: the same, from the same scale. */
  #paint() {
    const { scale, goal } = theme();
    for (const [i, cell] of this.#cells.entries()) {
      const { state, colour } = this.#steps[i];
      const { arm, depth } = worldDepth(colour, rewardOf(this.#world, state));
      const rgb = colour === "goal" ? goal : shade(scale, arm, depth);
      const square = /** @type {HTMLElement} */ (cell.querySelector(".step-square"));
      square.style.backgroundColor = `rgb(${rgb.join(" ")})`;
      square.dataset.ink = wantsDarkInk(rgb) ? "dark" : "light";
    }
  }
}

/** @param {Step} step */
function makeCell({ n, colour, sign }) {
  const cell = make("div", "step");
  cell.setAttribute("role", "option");
  cell.dataset.step = String(n);
  const [number, square, mark] = [make("span", "step-number"), make("span", "step-square"), make("span", "step-mark")];
  number.textContent = String(n);
  square.textContent = sign;
  square.dataset.colour = colour;
  cell.append(number, square, mark);
  return cell;
}

/** "Step 4: right, onto red −3.2". @param {World} world @param {Step} step */
function labelOf(world, { n, moved, state }) {
  return `Step ${n}: ${moved === "stays" ? "stays on" : `${moved}, onto`} ${wordsOf(world, state)}`;
}

/** @param {EventTarget | null} target @returns {number | null} */
function stepAt(target) {
  const cell = target instanceof Element ? /** @type {HTMLElement | null} */ (target.closest(".step")) : null;
  return cell ? Number(cell.dataset.step) : null;
}
