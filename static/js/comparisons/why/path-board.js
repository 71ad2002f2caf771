/**
 * An attempt as a small board with its path.
 * @import {Attempt} from "#js/comparisons/why/types.js"
 * @import {World} from "#js/board/state.js"
 */
import { nameOf } from "#js/comparisons/why/words.js";
import { IrlBoard } from "#js/elements/irl-board.js";

/** @param {World} world @param {Attempt} attempt */
export function pathBoard(world, attempt) {
  const board = new IrlBoard();
  board.world = world;
  board.view = { ...board.view, paths: [{ states: attempt.demonstration.states, who: "human", width: 0.7 }] };
  board.label = `The path of the ${nameOf(attempt)}`;
  return board;
}
