/** The board as a table of words, with headers a screen reader can walk along; of a large world what lies around the agent. */

import { windowAround } from "#js/board/crop.js";
import { wordsOf } from "#js/board/describe.js";
import { make } from "#js/board/dom.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/crop.js").Window} Window */

const MOST = 15;

export class TextBoard {
  /** @type {HTMLDetailsElement | null} */
  #details;
  /** @type {{world: World, state: number} | null} what shall be told */
  #wanted = null;
  /** @type {{world: World, window: Window, state: number} | null} what is told */
  #told = null;
  /** @type {Map<number, HTMLElement>} */
  #cells = new Map();

  /** @param {HTMLTableElement} table inside a `<details>` it is written only while that is open */
  constructor(table) {
    this.table = table;
    this.#details = table.closest("details");
    this.#details?.addEventListener("toggle", () => this.#tell());
  }

  /** @param {World} world @param {number} state where the agent stands */
  update(world, state) {
    this.#wanted = { world, state };
    this.#tell();
  }

  #tell() {
    if (!this.#wanted || this.#details?.open === false) return;
    const { world, state } = this.#wanted;
    const told = this.#told?.world === world ? this.#told : null;
    const window = windowAround(world, state, MOST, told?.window);
    if (told?.window !== window) this.#write(world, window);
    else if (told.state !== state) this.#tellCell(told.state);
    this.#tellCell(state);
    this.#told = { world, window, state };
  }

  /** @param {World} world @param {Window} window */
  #write(world, window) {
    const { top, left, rows, cols } = window;
    this.#cells.clear();
    const head = make("tr", "");
    head.append(make("td", ""), ...Array.from({ length: cols }, (_, i) => header("col", left + i + 1)));
    const body = Array.from({ length: rows }, (_, i) => this.#row(world, window, top + i));
    this.table.replaceChildren(caption(world, window), wrap("thead", head), wrap("tbody", ...body));
  }

  /** @param {World} world @param {Window} window @param {number} row */
  #row(world, { left, cols }, row) {
    const line = make("tr", "");
    line.append(header("row", row + 1));
    for (let col = left; col < left + cols; col++) {
      const state = row * world.cols + col;
      const cell = make("td", "");
      this.#cells.set(state, cell);
      line.append(cell);
      this.#tellCell(state);
    }
    return line;
  }

  /** @param {number} state */
  #tellCell(state) {
    const cell = this.#cells.get(state);
    if (!cell || !this.#wanted) return;
    const { world, state: here } = this.#wanted;
    cell.textContent = textOfSquare(world, state, here);
    if (state === here) cell.setAttribute("aria-current", "location");
    else cell.removeAttribute("aria-current");
  }
}

/** "you, start, blue −0.3" @param {World} world @param {number} state @param {number} here where the agent stands */
function textOfSquare(world, state, here) {
  const words = [state === here ? "you" : "", state === world.start ? "start" : "", wordsOf(world, state)];
  return words.filter(Boolean).join(", ");
}

/** @param {World} world @param {Window} window */
function caption(world, { top, left, rows, cols }) {
  const note = make("caption", "");
  const isWhole = rows === world.rows && cols === world.cols;
  note.textContent = isWhole
    ? `The whole board: ${rows} rows, ${cols} columns.`
    : `Around you: rows ${top + 1} to ${top + rows} of ${world.rows}, columns ${left + 1} to ${left + cols} of ${world.cols}.`;
  return note;
}

/** @param {"row" | "col"} scope @param {number} n */
function header(scope, n) {
  const cell = make("th", "");
  cell.setAttribute("scope", scope);
  cell.textContent = String(n);
  return cell;
}

/** @param {string} tag @param {HTMLElement[]} children */
function wrap(tag, ...children) {
  const element = make(tag, "");
  element.append(...children);
  return element;
}
