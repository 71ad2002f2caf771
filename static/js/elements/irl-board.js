/**
 * `<irl-board>`: the one board of all pages. Give it a `world` and a `view` (ARCHITECTURE.md, "Browser"); whatever is
 * assigned is painted in the next animation frame. It fills the box the page gives it, with whole device pixels a square.
 */

import { Agents } from "#js/board/agents.js";
import { make } from "#js/board/dom.js";
import { Effects } from "#js/board/effects.js";
import { Painter } from "#js/board/painter.js";
import { EMPTY_VIEW } from "#js/board/state.js";
import { figureTags } from "#js/board/tags.js";
import { onThemeChange } from "#js/board/theme.js";
import { isTaken, letterOf } from "#js/lib/keys.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */
/** @typedef {import("#js/board/close-up.js").CloseUpOf} CloseUpOf */

const SMALLEST_WHOLE_CELL = 4;
/** On squares smaller than this (CSS pixels) the agent is drawn larger than its square. */
const FINE_CELL = 14;

export class IrlBoard extends HTMLElement {
  #life = new AbortController();
  /** @type {World | null} */
  #world = null;
  /** @type {View} */
  #view = EMPTY_VIEW;
  #frame = 0;
  #numbersHeld = false;
  #cell = 0;
  #ratio = 1;
  #stage = make("div", "board-stage");
  #painter = new Painter();
  #agents = new Agents(make("div", "board-agents"));
  #effects = new Effects();
  #tags = make("div", "board-tags");
  /** @type {number | null} the square under the pointer */
  #pointed = null;
  /** @type {number | null} */
  #cursor = null;
  /** @type {CloseUpOf | null} */
  #closeUp = null;
  #paintedAt = Number.NaN;

  connectedCallback() {
    this.#life = new AbortController();
    const { signal } = this.#life;
    this.#adopt("world");
    this.#adopt("view");
    this.#adopt("cursor");
    if (!this.#stage.isConnected) {
      this.#stage.append(...this.#painter.canvases, this.#agents.layer, this.#tags, this.#effects.layer);
      this.#stage.setAttribute("aria-hidden", "true");
      // A clone of a board brings a copy of the other's stage along, empty as cloned canvases are.
      this.querySelector(".board-stage")?.remove();
      this.prepend(this.#stage);
    }
    if (!this.hasAttribute("role")) this.setAttribute("role", "img");
    const resizes = new ResizeObserver(() => this.#resize());
    resizes.observe(this);
    signal.addEventListener("abort", () => resizes.disconnect());
    onThemeChange(() => this.#redrawAll(), signal);
    this.#watchZoom(signal);
    document.addEventListener("keydown", (event) => this.#onKey(event, true), { signal });
    document.addEventListener("keyup", (event) => this.#onKey(event, false), { signal });
    window.addEventListener("blur", () => this.#holdNumbers(false), { signal });
    this.addEventListener("pointermove", (event) => this.#point(event), { signal });
    this.addEventListener("pointerleave", () => this.#point(null), { signal });
    this.#redrawAll();
  }

  disconnectedCallback() {
    this.#life.abort();
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
  }

  /** @returns {World | null} */
  get world() {
    return this.#world;
  }

  set world(world) {
    this.#world = world;
    if (world) this.style.setProperty("--board-ratio", `${world.cols} / ${world.rows}`);
    this.cursor = null;
    this.closeUp = null;
    this.#resize();
    this.#paintedAt = Number.NaN;
    this.#redrawAll();
    this.#tell();
  }

  /** @returns {View} */
  get view() {
    return this.#view;
  }

  /** @param {Partial<View>} view */
  set view(view) {
    const [before, after] = [this.#view, { ...EMPTY_VIEW, ...view }];
    this.#view = after;
    this.#painter.compare(before, after);
    this.#effects.follow(after.agents[0]?.state);
    if (before.agents !== after.agents || before.paths !== after.paths) this.#paintedAt = Number.NaN;
    this.#schedule();
    this.#tell();
  }

  /**
   * When the agents and paths of the present view were painted: the time of that animation frame (ms, the clock of
   * `event.timeStamp`); NaN while they wait for one. Figures that are shown or hidden leave it as it is.
   */
  get paintedAt() {
    return this.#paintedAt;
  }

  /** The square that somebody looking around has reached, or null. @returns {number | null} */
  get cursor() {
    return this.#cursor;
  }

  set cursor(state) {
    this.#cursor = state;
    if (this.#world) this.#effects.pointAt(this.#world, state);
    this.#tell();
  }

  /** Who shows some squares large takes over what would be too small to see here. @param {CloseUpOf | null} closeUp */
  set closeUp(closeUp) {
    this.#closeUp = closeUp;
    if (this.#world) this.#effects.frame(this.#world, closeUp?.window ?? null);
  }

  /** Side of a square in CSS pixels; 0 before there is room for one. */
  get cell() {
    return this.#cell;
  }

  get label() {
    return this.getAttribute("aria-label") ?? "";
  }

  set label(text) {
    this.setAttribute("aria-label", text);
  }

  /** The square under a point of the window, or null. @param {number} clientX @param {number} clientY @returns {number | null} */
  stateAt(clientX, clientY) {
    if (!this.#world || !this.#cell) return null;
    const box = this.#stage.getBoundingClientRect();
    const col = Math.floor((clientX - box.left) / this.#cell);
    const row = Math.floor((clientY - box.top) / this.#cell);
    const isInside = row >= 0 && col >= 0 && row < this.#world.rows && col < this.#world.cols;
    return isInside ? row * this.#world.cols + col : null;
  }

  /** The first agent leans against an edge or a wall and comes back. @param {number} direction 0…3 */
  bump(direction) {
    const state = this.#view.agents[0]?.state;
    if (!this.#world || state === undefined) return;
    this.#agents.lean(direction);
    if (this.#closeUp) this.#closeUp.bump(direction);
    else this.#effects.bump(this.#world, state, direction);
  }

  /** Let a short text rise from a square and fade (a cost, a reward). @param {number} state @param {string} text @param {"gain" | "loss"} kind */
  float(state, text, kind) {
    if (this.#closeUp) this.#closeUp.float(state, text, kind);
    else if (this.#world) this.#effects.float(this.#world, state, text, kind);
  }

  /** Quiet joy around a square, for less than a second. @param {number} state */
  celebrate(state) {
    if (!this.#world) return;
    this.#agents.hop();
    this.#effects.celebrate(this.#world, state);
  }

  /** What was assigned before the browser knew this element hides the accessor: assign it again. @param {"world" | "view" | "cursor"} name */
  #adopt(name) {
    if (!Object.hasOwn(this, name)) return;
    const value = /** @type {any} */ (this)[name];
    delete (/** @type {any} */ (this)[name]);
    /** @type {any} */ (this)[name] = value;
  }

  /** World, view, cursor or size are others: whoever shows a part of this board draws it in the same frame. */
  #tell() {
    this.dispatchEvent(new Event("board:changed"));
  }

  #redrawAll() {
    this.#painter.redrawAll();
    this.#schedule();
  }

  #schedule() {
    if (this.#frame || !this.isConnected) return;
    this.#frame = requestAnimationFrame((time) => {
      this.#frame = 0;
      this.#paint(time);
    });
  }

  /** @param {number} time of this animation frame */
  #paint(time) {
    const world = this.#world;
    if (!world || this.#cell === 0) return;
    const view = { ...this.#view, numbers: this.#view.numbers || this.#numbersHeld };
    this.#painter.paint(world, view, this.#geometry);
    this.#agents.place(world, view.agents, this.#cell);
    this.#placeTags(world, view);
    if (Number.isNaN(this.#paintedAt)) this.#paintedAt = time;
  }

  /** In device pixels. */
  get #geometry() {
    return { cell: this.#cell * this.#ratio, ratio: this.#ratio };
  }

  #resize() {
    const world = this.#world;
    if (!world) return;
    const [width, height, ratio] = [this.clientWidth, this.clientHeight, window.devicePixelRatio || 1];
    const exact = Math.min((width * ratio) / world.cols, (height * ratio) / world.rows);
    const cell = (exact >= SMALLEST_WHOLE_CELL ? Math.floor(exact) : exact) / ratio;
    const isSame =
      cell === this.#cell && ratio === this.#ratio && this.#stage.dataset.size === `${world.cols}×${world.rows}`;
    if (isSame || cell <= 0) return;
    [this.#cell, this.#ratio] = [cell, ratio];
    this.#stage.dataset.size = `${world.cols}×${world.rows}`;
    this.#stage.style.width = `${cell * world.cols}px`;
    this.#stage.style.height = `${cell * world.rows}px`;
    this.#stage.style.setProperty("--cell", `${cell}px`);
    this.#stage.dataset.isFine = String(cell < FINE_CELL);
    this.#painter.resize(world, this.#geometry);
    if (this.isConnected) this.#paint(Number(document.timeline.currentTime));
    this.#tell();
  }

  /** @param {World} world @param {View} view */
  #placeTags(world, view) {
    const tags = figureTags(world, view, { cell: this.#cell, pointed: this.#pointed });
    if (tags.length === 0 && this.#tags.childElementCount === 0) return;
    const notes = tags.map(({ x, y, text }) => {
      const note = make("span", "board-tag");
      note.textContent = text;
      note.style.translate = `calc(${x}px - 50%) calc(${y}px - 50%)`;
      return note;
    });
    this.#tags.replaceChildren(...notes);
  }

  /** @param {PointerEvent | null} event */
  #point(event) {
    const pointed = event?.pointerType === "mouse" ? this.stateAt(event.clientX, event.clientY) : null;
    if (pointed === this.#pointed) return;
    this.#pointed = pointed;
    if (this.#numbersHeld || this.#view.numbers) this.#schedule();
  }

  /** @param {KeyboardEvent} event @param {boolean} isDown */
  #onKey(event, isDown) {
    if (letterOf(event) !== "n" || event.repeat || (isDown && isTaken(event, this.closest("dialog")))) return;
    this.#holdNumbers(isDown);
  }

  /** @param {boolean} isHeld */
  #holdNumbers(isHeld) {
    if (this.#numbersHeld === isHeld) return;
    this.#numbersHeld = isHeld;
    // Shown or hidden by this key, unless they are shown anyway.
    if (!this.#view.numbers) this.dispatchEvent(new CustomEvent("board:numbers", { detail: { shown: isHeld } }));
    this.#painter.redrawInk();
    this.#schedule();
  }

  /** Zoom and a move to another screen change the device pixels without changing the box. @param {AbortSignal} signal */
  #watchZoom(signal) {
    const query = matchMedia(`(resolution: ${window.devicePixelRatio}dppx)`);
    const onChange = () => {
      this.#resize();
      if (!signal.aborted) this.#watchZoom(signal);
    };
    query.addEventListener("change", onChange, { once: true, signal });
  }
}

customElements.define("irl-board", IrlBoard);
