/**
 * Frames around some squares of a board. Two inks, so that one of them stands out from any square.
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 * @import {World} from "#js/board/state.js"
 */
import { placeOf } from "#js/board/state.js";
import { svgElement } from "#js/charts/marker.js";

export class Marks {
  #board;
  #world;
  #svg = svgElement("svg", { class: "why-marks", "aria-hidden": "true" });

  /** @param {IrlBoard} board @param {World} world */
  constructor(board, world) {
    this.#board = board;
    this.#world = world;
    this.#svg.setAttribute("viewBox", `0 0 ${world.cols} ${world.rows}`);
    board.append(this.#svg);
    board.addEventListener("board:changed", () => this.#fit());
  }

  /** @param {readonly number[]} states */
  frame(states) {
    const d = framePath(this.#world, states);
    this.#svg.replaceChildren(...["why-frame-halo", "why-frame"].map((name) => svgElement("path", { class: name, d })));
    this.#fit();
  }

  /** The frames lie on the squares, whatever size these have. */
  #fit() {
    const { rows, cols } = this.#world;
    this.#svg.setAttribute("width", String(this.#board.cell * cols));
    this.#svg.setAttribute("height", String(this.#board.cell * rows));
  }
}

/** The frames as the data of one SVG path; a square is 1 wide. @param {Pick<World, "rows" | "cols">} world @param {readonly number[]} states */
export function framePath(world, states) {
  return states
    .map((state) => placeOf(/** @type {World} */ (world), state))
    .map(([row, col]) => `M${col + 0.08},${row + 0.08}h0.84v0.84h-0.84z`)
    .join("");
}
