/**
 * The world being made, as a frozen value. Marks stand at places (row · 100 + column), which stay where they are when
 * the size changes: a world that shrinks keeps what no longer fits for the day it grows again. No DOM here.
 */

import { DEFAULT_SIDE } from "#js/worlds/query.js";

/** @typedef {import("#js/worlds/query.js").Spec} Spec */
/** @typedef {import("#js/board/state.js").Way} Way */

export const SMALLEST_SIDE = 2;
export const LARGEST_SIDE = 100;
export const LARGEST_SEED = Number.MAX_SAFE_INTEGER;
export const MOST_SLIP = 0.9;
export const LOWEST_REWARD = -7;
export const HIGHEST_PAY = 200;
export const TIME_LIMITS_S = /** @type {const} */ ([5, 3600]);
/** @type {readonly Way[]} */
export const WAYS = ["lists", "pairwise", "magnitude", "segments"];
const DEFAULT_RED_PROBABILITY = 0.3;
const SHEET = LARGEST_SIDE;

/**
 * @typedef {object} Plan
 * @property {number} rows
 * @property {number} cols
 * @property {number} seed
 * @property {number} redProbability
 * @property {number} slip
 * @property {number | null} stepLimit           null: as many as the server finds usual
 * @property {number | null} timeLimitS          null: none
 * @property {Way | null} rankBy                 null: attempts are put in order as people like
 * @property {boolean} pooled                    everybody's comparisons are pooled, without names
 * @property {number} start                      place
 * @property {ReadonlyMap<number, number | null>} goals   place → pay, null: rows + cols; empty: the last square alone
 * @property {ReadonlySet<number>} walls         places
 * @property {ReadonlyMap<number, number>} painted        place → reward
 */

/**
 * What of a plan lies inside its size, in squares (row · cols + column).
 * @typedef {object} Layout
 * @property {number} start
 * @property {Map<number, number | null>} goals
 * @property {number[]} walls
 * @property {[number, number][]} painted        ordinary squares alone
 */

/** Read leniently: what cannot be is left out, so that an impossible address still opens with the rest. @param {Spec} spec @returns {Plan} */
export function planOf(spec) {
  const [rows, cols] = [sideOf(spec.rows), sideOf(spec.cols)];
  const size = { rows, cols };
  const squares = (/** @type {number[] | undefined} */ list) => (list ?? []).filter((square) => isInside(size, square));
  const painted = new Map((spec.painted ?? []).filter(([square]) => isInside(size, square)));
  const goals = squares(spec.goals);
  if (goals.length === 0 && (painted.get(rows * cols - 1) ?? 0) > 0) goals.push(rows * cols - 1);
  const isStart = spec.start !== undefined && isInside(size, spec.start);
  return {
    ...size,
    seed: within(spec.seed, 0, LARGEST_SEED) ?? 0,
    redProbability: within(spec.red_probability, 0, 1) ?? DEFAULT_RED_PROBABILITY,
    slip: within(spec.slip, 0, MOST_SLIP) ?? 0,
    stepLimit: spec.step_limit ?? null,
    timeLimitS: spec.time_limit_s ?? null,
    rankBy: WAYS.find((way) => way === spec.rank_by) ?? null,
    pooled: spec.pooled === true,
    start: isStart ? placeAt(size, spec.start ?? 0) : 0,
    goals: tidyGoals(size, new Map(goals.map((square) => [placeAt(size, square), painted.get(square) ?? null]))),
    walls: new Set(squares(spec.walls).map((square) => placeAt(size, square))),
    painted: new Map(
      [...painted].filter(([, reward]) => reward <= 0).map(([square, reward]) => [placeAt(size, square), reward]),
    ),
  };
}

/** The smallest body that makes this world. @param {Plan} plan @returns {Spec} */
export function specOf(plan) {
  const { start, goals, walls, painted } = layoutOf(plan);
  /** @type {[number, number][]} */
  const paid = [...goals].flatMap(([square, pay]) => (pay === null ? [] : [[square, pay]]));
  const hasUsualGoal = goals.size === 1 && goals.has(plan.rows * plan.cols - 1);
  return dropDefaults({
    rows: plan.rows,
    cols: plan.cols,
    seed: plan.seed,
    red_probability: plan.redProbability,
    slip: plan.slip,
    walls,
    start,
    goals: hasUsualGoal ? [] : [...goals.keys()],
    painted: [...painted, ...paid].sort(([a], [b]) => a - b),
    step_limit: plan.stepLimit,
    time_limit_s: plan.timeLimitS,
    rank_by: plan.rankBy,
    pooled: plan.pooled,
  });
}

/** @type {WeakMap<Plan, Layout>} a stroke asks for the same one several times */
const layouts = new WeakMap();

/** @param {Plan} plan @returns {Layout} */
export function layoutOf(plan) {
  const known = layouts.get(plan) ?? layOut(plan);
  layouts.set(plan, known);
  return known;
}

/** Where marks of different sizes meet, goals win over the start, and both over walls. @param {Plan} plan @returns {Layout} */
function layOut(plan) {
  const squares = (/** @type {Iterable<number>} */ places) => [...places].filter((place) => fits(plan, place));
  /** @type {Map<number, number | null>} */
  const goals = new Map(squares(plan.goals.keys()).map((at) => [squareAt(plan, at), plan.goals.get(at) ?? null]));
  const last = plan.rows * plan.cols - 1;
  if (goals.size === 0) goals.set(last, null);
  const wanted = fits(plan, plan.start) ? squareAt(plan, plan.start) : 0;
  const start = goals.has(wanted) ? firstFree(goals) : wanted;
  const walls = squares(plan.walls)
    .map((place) => squareAt(plan, place))
    .filter((square) => square !== start && !goals.has(square))
    .sort((a, b) => a - b);
  const isWall = new Set(walls);
  /** @type {[number, number][]} */
  const painted = squares(plan.painted.keys()).map((at) => [squareAt(plan, at), plan.painted.get(at) ?? 0]);
  return { start, goals, walls, painted: painted.filter(([square]) => !goals.has(square) && !isWall.has(square)) };
}

/** What a goal pays unless somebody says otherwise. @param {{rows: number, cols: number}} size */
export function usualPay({ rows, cols }) {
  return rows + cols;
}

/** A single goal in the corner that pays as usual is no mark: it moves along when the size changes. @param {{rows: number, cols: number}} size @param {Map<number, number | null>} goals */
export function tidyGoals({ rows, cols }, goals) {
  const isUsual = goals.size === 1 && goals.get(placeAt({ cols }, rows * cols - 1)) === null;
  return isUsual ? new Map() : goals;
}

/** Nothing painted, no walls, start and goal in their corners; numbers stay. @param {Plan} plan @returns {Plan} */
export function cleared(plan) {
  return { ...plan, start: 0, goals: new Map(), walls: new Set(), painted: new Map() };
}

/** @param {{cols: number}} size @param {number} square */
export function placeAt({ cols }, square) {
  return Math.floor(square / cols) * SHEET + (square % cols);
}

/** @param {{cols: number}} size @param {number} place */
export function squareAt({ cols }, place) {
  return Math.floor(place / SHEET) * cols + (place % SHEET);
}

/** @param {{rows: number, cols: number}} size @param {number} place */
export function fits({ rows, cols }, place) {
  return Math.floor(place / SHEET) < rows && place % SHEET < cols;
}

/** The square of a place, or the one nearest to it that fits. @param {{rows: number, cols: number}} size @param {number} place */
export function nearestSquare({ rows, cols }, place) {
  return Math.min(Math.floor(place / SHEET), rows - 1) * cols + Math.min(place % SHEET, cols - 1);
}

/** The places from one to another, both included, so that a fast hand leaves no gaps. @param {number} from @param {number} to */
export function lineOf(from, to) {
  const [row, col] = [Math.floor(from / SHEET), from % SHEET];
  const [down, right] = [Math.floor(to / SHEET) - row, (to % SHEET) - col];
  const n = Math.max(Math.abs(down), Math.abs(right));
  const at = (/** @type {number} */ i) =>
    (row + Math.round((i * down) / n)) * SHEET + col + Math.round((i * right) / n);
  return n === 0 ? [from] : Array.from({ length: n + 1 }, (_, i) => at(i));
}

/** @param {Required<Spec>} spec @returns {Spec} */
function dropDefaults(spec) {
  /** @type {Record<string, unknown>} */
  const usual = {
    rows: DEFAULT_SIDE,
    cols: DEFAULT_SIDE,
    red_probability: DEFAULT_RED_PROBABILITY,
    slip: 0,
    start: 0,
    pooled: false,
  };
  const isTold = (/** @type {[string, unknown]} */ [name, value]) =>
    value !== null && usual[name] !== value && !(Array.isArray(value) && value.length === 0);
  return Object.fromEntries(Object.entries(spec).filter(isTold));
}

/** @param {Map<number, unknown>} goals */
function firstFree(goals) {
  let square = 0;
  while (goals.has(square)) square++;
  return square;
}

/** @param {unknown} side */
function sideOf(side) {
  return within(side, SMALLEST_SIDE, LARGEST_SIDE) ?? DEFAULT_SIDE;
}

/** @param {unknown} value @param {number} least @param {number} most */
function within(value, least, most) {
  return typeof value === "number" && value >= least && value <= most ? value : null;
}

/** @param {{rows: number, cols: number}} size @param {number} square */
function isInside({ rows, cols }, square) {
  return Number.isInteger(square) && square >= 0 && square < rows * cols;
}
