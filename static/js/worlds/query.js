/** A world in the query of an address: `/?rows=7&cols=9&seed=5&walls=3-5,9`. The server reads it (`WorldQuery`). */

/**
 * What `POST /worlds` needs to make a world again; what is left out has its default.
 * @typedef {object} Spec
 * @property {number} [rows]
 * @property {number} [cols]
 * @property {number | null} [seed]
 * @property {number} [red_probability]
 * @property {number} [slip]
 * @property {number[]} [walls]
 * @property {number} [start]
 * @property {number[]} [goals]
 * @property {[number, number][]} [painted]      [square, reward]
 * @property {number | null} [step_limit]
 * @property {number | null} [time_limit_s]
 * @property {import("#js/board/state.js").Way | null} [rank_by]
 * @property {boolean} [pooled]
 */

/** @typedef {{first: number, last: number, reward?: number}} Run   neighbouring squares of one reward */

export const DEFAULT_SIDE = 7;

/** The query without its question mark. @param {Spec} spec */
export function toQuery(spec) {
  return Object.entries(partsOf(spec))
    .filter(([, text]) => text !== "")
    .map(([name, text]) => `${name}=${text}`)
    .join("&");
}

/** Digits, signs, dots, commas, colons and plain words alone, so that nothing needs to be escaped. @param {Spec} spec @returns {Record<string, string>} */
function partsOf(spec) {
  // One side alone would mean a square world.
  const isSized = spec.rows !== undefined || spec.cols !== undefined;
  return {
    rows: isSized ? String(spec.rows ?? DEFAULT_SIDE) : "",
    cols: isSized ? String(spec.cols ?? DEFAULT_SIDE) : "",
    seed: textOf(spec.seed),
    red_probability: textOf(spec.red_probability),
    slip: textOf(spec.slip),
    walls: squaresText(spec.walls ?? []),
    start: textOf(spec.start),
    goals: squaresText(spec.goals ?? []),
    painted: paintedText(spec.painted ?? []),
    step_limit: textOf(spec.step_limit),
    time_limit_s: textOf(spec.time_limit_s),
    rank_by: textOf(spec.rank_by),
    pooled: spec.pooled ? "1" : "",
  };
}

/** @param {number | string | null | undefined} value */
function textOf(value) {
  return value === null || value === undefined ? "" : String(value);
}

/** @param {readonly number[]} squares */
function squaresText(squares) {
  return runsOf(squares.map((square) => [square, 0]))
    .map(rangeText)
    .join(",");
}

/** @param {readonly (readonly [number, number])[]} painted */
function paintedText(painted) {
  return runsOf(painted)
    .map((run) => `${rangeText(run)}:${run.reward}`)
    .join(",");
}

/** @param {Run} run */
function rangeText({ first, last }) {
  return first === last ? `${first}` : `${first}-${last}`;
}

/** In the order given: that of goals has a meaning. @param {readonly (readonly [number, number])[]} squares @returns {Run[]} */
function runsOf(squares) {
  /** @type {Run[]} */
  const runs = [];
  for (const [square, reward] of squares) {
    const run = runs.at(-1);
    if (run && square === run.last + 1 && reward === run.reward) run.last = square;
    else runs.push({ first: square, last: square, reward });
  }
  return runs;
}
