/**
 * Good and bad stretches drawn upon the path of a board: a good one a solid line with a plus, a bad one dashed with a
 * minus, each on its side of the path; beneath them, broad, the steps that are chosen.
 */

import { makeSvg } from "#js/board/dom.js";
import { placeOf } from "#js/board/state.js";

/** @typedef {import("#js/elements/irl-board.js").IrlBoard} IrlBoard */
/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/rankings/sitting-state.js").Stretch} Stretch */
/** @typedef {{from: number, to: number}} Run */

/** In squares: off the middle of the path, so that a way gone twice shows both. */
const SHIFT = { good: -0.12, bad: 0.12, chosen: 0 };
/** On squares smaller than these (CSS pixels) lines and signs are drawn larger than their share, to be seen at all. */
const FINE_LINES = 16;
const FINE_SIGNS = 30;

export class StretchInk {
  #board;
  #layer = makeSvg("svg", { class: "stretch-ink", "aria-hidden": "true" });

  /** @param {IrlBoard} board @param {AbortSignal} signal */
  constructor(board, signal) {
    this.#board = board;
    // Above the squares and the path, below whoever stands there.
    board.querySelector(".board-agents")?.before(this.#layer);
    board.addEventListener("board:changed", () => this.#fit(), { signal });
  }

  /** @param {World} world @param {readonly number[]} states @param {readonly Stretch[]} stretches @param {Run | null} chosen */
  draw(world, states, stretches, chosen) {
    this.#layer.setAttribute("viewBox", `0 0 ${world.cols} ${world.rows}`);
    const pointsOf = (/** @type {Run} */ { from, to }, /** @type {keyof typeof SHIFT} */ kind) =>
      states.slice(from - 1, to + 1).map((state) => pointAt(world, state, SHIFT[kind]));
    this.#layer.replaceChildren(
      ...(chosen ? [line("chosen", pointsOf(chosen, "chosen"))] : []),
      ...stretches.flatMap((one) => {
        const points = pointsOf(one, one.kind);
        return [line(`${one.kind}-halo`, points), line(one.kind, points)];
      }),
      ...stretches.map((one) => tag(one.kind, middleOf(pointsOf(one, one.kind)))),
    );
    this.#fit();
  }

  #fit() {
    const { cell } = this.#board;
    if (cell === 0) return;
    this.#layer.style.setProperty("--thick", String(Math.max(1, FINE_LINES / cell)));
    this.#layer.style.setProperty("--large", String(Math.max(1, FINE_SIGNS / cell)));
  }
}

/** @typedef {[x: number, y: number]} Point */

/** @param {World} world @param {number} state @param {number} shift @returns {Point} */
function pointAt(world, state, shift) {
  const [row, col] = placeOf(world, state);
  return [col + 0.5 + shift, row + 0.5 + shift];
}

/** Steps against a wall lead nowhere; a line of no length still has its round ends. @param {string} kind @param {Point[]} points */
function line(kind, points) {
  const way = points.map(([x, y], i) => `${i === 0 ? "M" : "L"}${x} ${y}`).join("");
  return makeSvg("path", { class: `stretch-line stretch-line--${kind}`, d: way });
}

/** @param {Point[]} points @returns {Point} */
function middleOf(points) {
  const half = (points.length - 1) / 2;
  const [a, b] = [points[Math.floor(half)] ?? [0, 0], points[Math.ceil(half)] ?? [0, 0]];
  return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
}

/** @param {"good" | "bad"} kind @param {Point} at */
function tag(kind, [x, y]) {
  const sign = kind === "good" ? "M-.1 0H.1M0-.1V.1" : "M-.1 0H.1";
  return makeSvg(
    "g",
    { transform: `translate(${x} ${y})` },
    makeSvg(
      "g",
      { class: `stretch-tag stretch-tag--${kind}` },
      makeSvg("circle", { r: 0.19 }),
      makeSvg("path", { d: sign }),
    ),
  );
}
