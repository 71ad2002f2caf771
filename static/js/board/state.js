/** Plain data of the board: what a world, a view and an attempt are. No DOM here. */

/** @typedef {"lists" | "pairwise" | "magnitude" | "segments"} Way   how a person says what their order is */

/**
 * @typedef {object} World
 * @property {string} id
 * @property {number} rows
 * @property {number} cols
 * @property {number} start
 * @property {number} goal
 * @property {number[]} goals
 * @property {number[]} walls
 * @property {number[][]} rewards
 * @property {string[][]} colours    "red", "blue", "goal" or "wall"
 * @property {number | null} seed
 * @property {number | null} red_probability
 * @property {number} slip
 * @property {number} horizon        steps
 * @property {number | null} time_limit_s  seconds
 * @property {Way | null} [rank_by]  the one way to put attempts in order here; null: as people like
 * @property {boolean} [pooled]      everybody's comparisons here are pooled, without names
 * @property {WorldSpec} [spec]      what makes this world again
 * @property {boolean} [success_possible]
 */

/**
 * The smallest body from which the server makes a world; what is left out has its default.
 * @typedef {object} WorldSpec
 * @property {number} [seed]
 * @property {number} [rows]
 * @property {number} [cols]
 * @property {number} [red_probability]
 * @property {number} [slip]
 * @property {number[]} [walls]
 * @property {number} [start]
 * @property {number[]} [goals]
 * @property {[square: number, reward: number][]} [painted]
 * @property {number | null} [step_limit]
 * @property {number | null} [time_limit_s]  seconds
 * @property {Way | null} [rank_by]
 * @property {boolean} [pooled]
 */

/**
 * @typedef {object} Path
 * @property {readonly number[]} states
 * @property {string} who
 * @property {number} [width]        0…1
 * @property {number} [opacity]      0…1
 * @property {boolean} [fade]        the older, the paler
 */

/** @typedef {{state: number, who: string, facing?: number | null}} Agent */

/**
 * @typedef {object} View
 * @property {ArrayLike<number> | null} values
 * @property {[number, number] | null} scale
 * @property {boolean} numbers
 * @property {ArrayLike<ArrayLike<number>> | null} arrows
 * @property {ArrayLike<number> | null} visits
 * @property {Path[]} paths
 * @property {Agent[]} agents
 * @property {ArrayLike<boolean | number> | null} unknown
 */

/** @type {Readonly<View>} */
export const EMPTY_VIEW = Object.freeze({
  values: null,
  scale: null,
  numbers: false,
  arrows: null,
  visits: null,
  paths: [],
  agents: [],
  unknown: null,
});

export const DIRECTIONS = /** @type {const} */ (["up", "right", "down", "left"]);

/** Row and column steps of the four actions: 0 up, 1 right, 2 down, 3 left. */
export const DELTAS = /** @type {const} */ ([
  [-1, 0],
  [0, 1],
  [1, 0],
  [0, -1],
]);

/** @param {World} world @param {number} state @returns {[number, number]} row, column */
export function placeOf(world, state) {
  return [Math.floor(state / world.cols), state % world.cols];
}

/** @param {World} world @param {number} state */
export function rewardOf(world, state) {
  const [row, col] = placeOf(world, state);
  return world.rewards[row]?.[col] ?? 0;
}

/** @param {World} world @param {number} state */
export function colourOf(world, state) {
  const [row, col] = placeOf(world, state);
  return world.colours[row]?.[col] ?? "blue";
}

/** The square an action leads to; an edge or a wall leaves one where one is. @param {World} world @param {number} state @param {number} action */
export function nextState(world, state, action) {
  const [row, col] = placeOf(world, state);
  const [down, right] = DELTAS[action] ?? [0, 0];
  const [toRow, toCol] = [row + down, col + right];
  if (toRow < 0 || toCol < 0 || toRow >= world.rows || toCol >= world.cols) return state;
  const next = toRow * world.cols + toCol;
  return world.walls.includes(next) ? state : next;
}
