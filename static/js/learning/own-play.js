/**
 * The board of one's own play: the attempts as lines, the wider the more they weigh.
 * @import {Demonstration, Rankings} from "#js/learning/types.js"
 * @import {IrlBoard} from "#js/elements/irl-board.js"
 */
import { weighted } from "#js/learning/material.js";

/**
 * @param {IrlBoard} board
 * @param {{ demonstrations: Demonstration[], rankings: Rankings }} play
 * @param {string} which "all", "success" or "failure"
 */
export function drawOwnPlay(board, { demonstrations, rankings }, which) {
  const outcomes = /** @type {const} */ (["failure", "success"]).filter(
    (outcome) => which === "all" || which === outcome,
  );
  const drawn = outcomes.flatMap((outcome) => weighted(demonstrations, rankings, outcome).reverse());
  const heaviest = Math.max(...drawn.map(({ weight }) => weight));
  board.view = {
    paths: drawn.map(({ demonstration, weight }) => ({
      states: demonstration.states,
      who: "human",
      width: weight / heaviest,
      opacity: demonstration.outcome === "success" || which !== "all" ? 0.9 : 0.45,
    })),
  };
  board.label = `The world with ${drawn.length} of your attempts drawn as lines; the heavier its weight, the wider.`;
}
