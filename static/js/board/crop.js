/** A part of a world, as a world of its own: for a close-up and for a board told as text. No DOM here. */

import { symmetricRange } from "#js/board/colours.js";
import { colourOf, placeOf, rewardOf } from "#js/board/state.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").View} View */
/** @typedef {{top: number, left: number, rows: number, cols: number}} Window   a rectangle of squares */
/** @typedef {{world: World, toLocal: (state: number) => number | null, toGlobal: (state: number) => number}} Crop */

/** How near to the edge of what is shown somebody may come before it moves on with them. */
const MARGIN = 2;

/**
 * The squares around a state, `size` each way or as many as there are. What was shown before stays while the state
 * keeps off its edge: a window that moved with every step would make the agent stand still and the world jump.
 * @param {World} world @param {number} state @param {number} size @param {Window | null} [before] @returns {Window}
 */
export function windowAround(world, state, size, before = null) {
  const [row, col] = placeOf(world, state);
  const [rows, cols] = [Math.min(size, world.rows), Math.min(size, world.cols)];
  if (
    before?.rows === rows &&
    before.cols === cols &&
    isWellInside(row, before.top, rows, world.rows) &&
    isWellInside(col, before.left, cols, world.cols)
  )
    return before;
  return { top: firstOf(row, rows, world.rows), left: firstOf(col, cols, world.cols), rows, cols };
}

/** The squares around a state as a world of its own. @param {World} world @param {number} state @param {number} size @returns {Crop} */
export function crop(world, state, size) {
  return cropTo(world, windowAround(world, state, size));
}

/** @param {World} world @param {Window} window @returns {Crop} */
export function cropTo(world, window) {
  const { top, left, rows, cols } = window;
  const toGlobal = (/** @type {number} */ state) =>
    (top + Math.floor(state / cols)) * world.cols + left + (state % cols);
  const toLocal = (/** @type {number} */ state) => {
    const [row, col] = placeOf(world, state);
    const isInside = row >= top && row < top + rows && col >= left && col < left + cols;
    return isInside ? (row - top) * cols + col - left : null;
  };
  const inside = (/** @type {number[]} */ states) => states.map(toLocal).filter((state) => state !== null);
  const cut = (/** @type {(state: number) => any} */ of) =>
    Array.from({ length: rows }, (_, row) => Array.from({ length: cols }, (_, col) => of(toGlobal(row * cols + col))));
  const goals = inside(world.goals);
  /** @type {World} */
  const part = {
    ...world,
    rows,
    cols,
    start: toLocal(world.start) ?? -1,
    goal: goals[0] ?? -1,
    goals,
    walls: inside(world.walls),
    rewards: cut((state) => rewardOf(world, state)),
    colours: cut((state) => colourOf(world, state)),
  };
  return { world: part, toLocal, toGlobal };
}

/** What a view shows of the squares of a crop; of a path its last stretch inside. @param {View} view @param {Crop} part @returns {View} */
export function cropView(view, { world, toLocal, toGlobal }) {
  const cut = (/** @type {ArrayLike<any> | null} */ of) =>
    of && Array.from({ length: world.rows * world.cols }, (_, state) => of[toGlobal(state)]);
  return {
    ...view,
    values: cut(view.values),
    scale: view.scale ?? (view.values && symmetricRange(view.values)),
    arrows: cut(view.arrows),
    visits: cut(view.visits),
    unknown: cut(view.unknown),
    paths: view.paths.map((path) => ({ ...path, states: lastStretch(path.states, toLocal) })),
    agents: view.agents.flatMap((agent) => {
      const state = toLocal(agent.state);
      return state === null ? [] : [{ ...agent, state }];
    }),
  };
}

/** @param {readonly number[]} states @param {Crop["toLocal"]} toLocal */
function lastStretch(states, toLocal) {
  /** @type {number[]} */
  const stretch = [];
  for (let i = states.length - 1; i >= 0; i--) {
    const state = toLocal(states[i] ?? 0);
    if (state === null) break;
    stretch.push(state);
  }
  return stretch.reverse();
}

/** @param {number} at @param {number} first @param {number} n @param {number} most */
function isWellInside(at, first, n, most) {
  const isOffStart = first === 0 ? at >= 0 : at >= first + MARGIN;
  const isOffEnd = first + n === most ? at < most : at < first + n - MARGIN;
  return isOffStart && isOffEnd;
}

/** @param {number} at @param {number} n @param {number} most */
function firstOf(at, n, most) {
  return Math.max(0, Math.min(most - n, at - Math.floor(n / 2)));
}
