/**
 * Some squares of a board marked, below its arrows: framed in two inks, of which one stands out from any square, or dimmed.
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 * @import {World} from "#js/board/state.js"
 */
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
    board.addEventListener("board:changed", () => this.#place());
  }

  /** @param {readonly number[]} states */
  frame(states) {
    const d = framePath(this.#world, states);
    this.#draw(["why-frame-halo", "why-frame"].map((name) => svgElement("path", { class: name, d })));
  }

  /** @param {readonly number[]} states */
  dim(states) {
    this.#draw([svgElement("path", { class: "why-dim", d: squarePath(this.#world, states) })]);
  }

  /** @param {Element[]} marks */
  #draw(marks) {
    this.#svg.replaceChildren(...marks);
    this.#place();
  }

  /** A board has its canvases once it is on the page. */
  #place() {
    const squares = this.#board.querySelector(".board-squares");
    if (squares && squares.nextElementSibling !== this.#svg) squares.after(this.#svg);
  }
}

/** The frames as the data of one SVG path; a square is 1 wide. @param {Pick<World, "cols">} world @param {readonly number[]} states */
export function framePath(world, states) {
  return squarePath(world, states, 0.08);
}

/** @param {Pick<World, "cols">} world @param {readonly number[]} states @param {number} [inset] */
export function squarePath({ cols }, states, inset = 0) {
  const side = 1 - 2 * inset;
  return states
    .map((state) => `M${(state % cols) + inset},${Math.floor(state / cols) + inset}h${side}v${side}h${-side}z`)
    .join("");
}
