/**
 * A board of "Why": some squares framed, a legend of its own scale, and the square that one points at or walks to read out
 * in words, with the mouse, a finger or the arrow keys.
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 * @import {View, World} from "#js/board/state.js"
 */

import { nextState, placeOf } from "#js/board/state.js";
import { Marks } from "#js/comparisons/why/marks.js";
import { whyPicture } from "#js/comparisons/why/picture.js";
import { announce } from "#js/lib/announce.js";
import { fileNameOf } from "#js/pictures/files.js";
import { saveMenu } from "#js/pictures/save-menu.js";

const HINT = "Point at a square to read it.";
const KEYS = ["ArrowUp", "ArrowRight", "ArrowDown", "ArrowLeft"];

/**
 * @typedef {object} Shown
 * @property {Partial<View>} view
 * @property {number[]} [framed] squares
 * @property {number[]} [dimmed] squares, in place of any that are framed
 * @property {[low: string, high: string] | null} ends words at the ends of its scale; null where it has none
 * @property {string} label what the picture says, for whom does not see it
 * @property {string} caption what the picture is called when it is saved
 * @property {string} [note] what is to be said below it then
 * @property {(state: number) => string} read one square in words
 */

export class MarkedBoard {
  #world;
  #marks;
  /** @type {Shown | null} */
  #shown = null;

  /** @param {HTMLTemplateElement} template @param {World} world @param {string} title @param {AbortSignal} signal */
  constructor(template, world, title, signal) {
    this.#world = world;
    this.element = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    this.#part("title").textContent = title;
    this.board.world = world;
    this.#marks = new Marks(this.board, world);
    this.#part("save").append(this.#saveMenu(title));
    this.board.addEventListener("pointermove", (event) => this.#point(event), { signal });
    this.board.addEventListener("pointerdown", (event) => this.#point(event), { signal });
    this.board.addEventListener("pointerleave", () => this.#look(null), { signal });
    this.board.addEventListener("blur", () => this.#look(null), { signal });
    this.board.addEventListener("keydown", (event) => this.#onKey(event), { signal });
  }

  get board() {
    return /** @type {IrlBoard} */ (this.element.querySelector("irl-board"));
  }

  /** @param {Shown} shown */
  show(shown) {
    this.#shown = shown;
    const { view, framed = [], dimmed, ends, label } = shown;
    this.board.view = view;
    this.board.label = `${label} Arrow keys read it square by square.`;
    if (dimmed) this.#marks.dim(dimmed);
    else this.#marks.frame(framed);
    this.#part("ramp").hidden = ends === null;
    [this.#part("lowest").textContent, this.#part("highest").textContent] = ends ?? ["", ""];
    this.#look(this.board.cursor);
  }

  /** @param {string} title */
  #saveMenu(title) {
    const menu = saveMenu(this.board, { title });
    menu.source = () => {
      const { view, framed = [], dimmed = [], ends, caption, note = "" } = /** @type {Shown} */ (this.#shown);
      const svg = () => whyPicture(this.#world, { view, framed, dimmed, ends }, { title: caption, note });
      return { name: `irlfr-${fileNameOf(title)}`, title, svg };
    };
    return menu;
  }

  /** @param {PointerEvent} event */
  #point(event) {
    this.#look(this.board.stateAt(event.clientX, event.clientY));
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    const action = KEYS.indexOf(event.key);
    if (action < 0 || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    const from = this.board.cursor;
    this.#look(from === null ? this.#world.start : nextState({ ...this.#world, walls: [] }, from, action));
    announce(this.#part("reading").textContent ?? "");
  }

  /** @param {number | null} state */
  #look(state) {
    if (this.board.cursor !== state) this.board.cursor = state;
    const words = state === null ? HINT : `${squareName(this.#world, state)}: ${this.#shown?.read(state) ?? ""}`;
    this.#part("reading").textContent = words;
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.element.querySelector(`[data-why="${name}"]`));
  }
}

/** "Row 2, column 3". @param {World} world @param {number} state */
function squareName(world, state) {
  const [row, col] = placeOf(world, state);
  return `Row ${row + 1}, column ${col + 1}`;
}
