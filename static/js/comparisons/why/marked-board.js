/**
 * A board of "Why": some squares marked, the words of its own scale, and a way to save it.
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 * @import {View, World} from "#js/board/state.js"
 */
import { DELTAS } from "#js/board/state.js";
import { Looking } from "#js/comparisons/looking.js";
import { Marks } from "#js/comparisons/why/marks.js";
import { whyPicture } from "#js/comparisons/why/picture.js";
import { fileNameOf } from "#js/pictures/files.js";
import { saveMenu } from "#js/pictures/save-menu.js";

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
 */

export class MarkedBoard {
  #world;
  #marks;
  /** @type {Shown | null} */
  #shown = null;

  /** @param {HTMLTemplateElement} template @param {World} world @param {string} title */
  constructor(template, world, title) {
    this.#world = world;
    this.element = /** @type {HTMLElement} */ (document.importNode(template.content, true).firstElementChild);
    this.#part("title").textContent = title;
    this.board.world = world;
    this.#marks = new Marks(this.board, world);
    this.#part("save").append(this.#saveMenu(title));
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
  }

  /** @param {string} title */
  #saveMenu(title) {
    const menu = saveMenu(this.board, { title });
    menu.source = () => ({ name: `irlfr-${fileNameOf(title)}`, title, svg: () => this.#picture() });
    return menu;
  }

  /** What is shown at the moment of saving. */
  #picture() {
    if (!this.#shown) throw new Error("This board shows nothing yet.");
    const { view, framed = [], dimmed = [], ends, caption, note = "" } = this.#shown;
    return whyPicture(this.#world, { view, framed, dimmed, ends }, { title: caption, note });
  }

  /** @param {string} name */
  #part(name) {
    return /** @type {HTMLElement} */ (this.element.querySelector(`[data-why="${name}"]`));
  }
}

/**
 * The same square of several boards is looked at, and read out in words: by mouse, by a tap, or by the arrow keys on one of
 * them.
 * @param {World} world
 * @param {{ boards: MarkedBoard[], words: HTMLElement, wordsOf: (state: number) => string, signal: AbortSignal }} shown
 */
export function readTogether(world, { boards, words, wordsOf, signal }) {
  const looking = new Looking(world, { boards: boards.map(({ board }) => board), words, wordsOf });
  looking.start(signal);
  for (const { board } of boards) {
    board.addEventListener("keydown", (event) => onKey(event, looking), { signal });
    board.addEventListener("blur", () => looking.away(), { signal });
  }
  return looking;
}

/** @param {KeyboardEvent} event @param {Looking} looking */
function onKey(event, looking) {
  const [down, right] = DELTAS[KEYS.indexOf(event.key)] ?? [0, 0];
  if ((!down && !right) || event.altKey || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  looking.step(down, right);
}
