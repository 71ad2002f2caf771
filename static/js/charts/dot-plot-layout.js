/**
 * Where everything on the dot plot lies: one row an agent in the order given, its mean with its 95 % interval (two standard
 * errors to each side where an earlier version stored none), its exact expected return and its greedy return on one axis
 * with zero and the optimum.
 * @import {Entry} from "#js/comparisons/types.js"
 */
import { linearScale, roundDomain, ticks } from "#js/charts/scales.js";

export const ROW_HEIGHT = 34;
const TOP = 26;
const AXIS = 30;
const RIGHT = 18;
/** Where a name begins, how wide a character is at most (pixels), and what names may take of the width. */
export const NAME = 20;
const CHARACTER = 7.4;
const MOST_FOR_NAMES = 0.36;

/**
 * @typedef {object} DotRow
 * @property {Entry} entry
 * @property {number} y
 * @property {number} mean x of the marker
 * @property {boolean} isOffScale the mean lies left of the axis
 * @property {[number, number] | null} interval x of both ends
 * @property {number | null} expected
 * @property {number | null} greedy
 *
 * @typedef {object} DotPlotLayout
 * @property {number} width
 * @property {number} height
 * @property {number} left where the plotting area begins
 * @property {number} right
 * @property {number} top
 * @property {number} bottom
 * @property {DotRow[]} rows
 * @property {{ x: number, value: number }[]} ticks
 * @property {number | null} zero x of the zero line, null where it lies outside
 * @property {number | null} optimum
 */

/** How many standard errors the whisker spans to each side where no interval is told. */
export const WHISKER = 2;

/**
 * @param {Entry[]} entries
 * @param {number} width pixels
 * @returns {DotPlotLayout}
 */
export function layOutDotPlot(entries, width) {
  const longest = Math.max(...entries.map(({ title }) => title.length));
  const left = Math.min(Math.max(76, NAME + CHARACTER * longest), Math.max(76, MOST_FOR_NAMES * width));
  const right = width - RIGHT;
  const optimum = entries.find((entry) => entry.who === "optimal");
  const optimal = optimum ? (optimum.expected_return ?? optimum.mean_return) : null;
  const domain = domainOf(
    [0, ...entries.flatMap(extentOf)],
    Math.max(optimal ?? 0, ...entries.map((entry) => entry.mean_return)),
  );
  const exact = linearScale(domain, [left, right]);
  const x = (/** @type {number} */ value) => Math.min(right, Math.max(left, exact(value)));
  const bottom = TOP + entries.length * ROW_HEIGHT;
  return {
    width,
    height: bottom + AXIS,
    left,
    right,
    top: TOP,
    bottom,
    rows: entries.map((entry, i) => ({
      entry,
      y: TOP + (i + 0.5) * ROW_HEIGHT,
      mean: x(entry.mean_return),
      isOffScale: entry.mean_return < domain[0],
      interval: intervalOf(entry, x),
      expected: entry.expected_return === null ? null : x(entry.expected_return),
      greedy: entry.greedy_return === null ? null : x(entry.greedy_return),
    })),
    ticks: ticks(domain[0], domain[1], Math.max(3, Math.floor((right - left) / 70))).map((value) => ({
      x: x(value),
      value,
    })),
    zero: domain[0] < 0 && domain[1] > 0 ? x(0) : null,
    optimum: optimal === null ? null : x(optimal),
  };
}

/**
 * A name shortened until it fits between its marker and the plotting area.
 * @param {string} title
 * @param {number} left where the plotting area begins
 */
export function fitted(title, left) {
  const most = Math.floor((left - NAME) / CHARACTER);
  return title.length <= most ? title : `${title.slice(0, most - 1).trimEnd()}…`;
}

/**
 * One attempt that lost without end would press everybody else into a point: what lies further below zero than twice the
 * best figure, or well above it, is cut off; a mean becomes an arrow with its number.
 * @param {number[]} values
 * @param {number} best
 */
function domainOf(values, best) {
  if (best <= 0) return roundDomain(values);
  const scale = Math.max(1, best);
  return roundDomain(values.map((value) => Math.min(1.3 * scale, Math.max(-2 * scale, value))));
}

/** @param {Entry} entry */
function extentOf(entry) {
  const exact = [entry.expected_return, entry.greedy_return].filter((value) => value !== null);
  return [entry.mean_return, ...(endsOf(entry) ?? []), ...exact];
}

/**
 * @param {Entry} entry
 * @param {(value: number) => number} x
 * @returns {[number, number] | null}
 */
function intervalOf(entry, x) {
  const ends = endsOf(entry);
  return ends && [x(ends[0]), x(ends[1])];
}

/** Of the interval of the mean; none where there is nothing between them. @param {Entry} entry @returns {[number, number] | null} */
function endsOf({ mean_return, standard_error, interval_low, interval_high }) {
  const reach = WHISKER * (standard_error ?? 0);
  const low = interval_low ?? mean_return - reach;
  const high = interval_high ?? mean_return + reach;
  return high > low ? [low, high] : null;
}
