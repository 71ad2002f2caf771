/**
 * Where everything on the two charts lies. Both have a row for each standing, in one order and of one height, so that side
 * by side they read as one.
 * @import {Standing} from "#js/results/types.js"
 */
import { linearScale, ticks } from "#js/charts/scales.js";

export const ROW = 40;
export const BAR = 28;
export const TOP = 34;
const AXIS = 30;
/** A character of a name or a figure is at most so wide, in pixels. */
const CHARACTER = 8.2;
const MARKER = 24;
/** Room for "−100 %" at the right. */
const FIGURE = 66;
const MOST_FOR_NAMES = 0.42;
/** What lies further below zero than the optimum lies above it is cut off: the share is an arrow with its figure then. */
const LOWEST = -1;

/** @param {Standing[]} standings @param {number} width */
export function nameWidth(standings, width) {
  const longest = Math.max(...standings.map(({ title }) => title.length));
  return Math.min(MARKER + CHARACTER * longest + 8, Math.max(96, MOST_FOR_NAMES * width));
}

/** A name in one line, or in two where it is too long for its place. @param {string} title @param {number} room pixels */
export function lines(title, room) {
  const cut = title.lastIndexOf(" ");
  return title.length * CHARACTER <= room - MARKER || cut < 0 ? [title] : [title.slice(0, cut), title.slice(cut + 1)];
}

/**
 * Bars of places: as long as the comparisons somebody took part in, a segment for each place they had.
 * @param {Standing[]} standings @param {number} width
 */
export function layOutPlaces(standings, width) {
  const left = nameWidth(standings, width);
  const most = Math.max(...standings.map(({ n_comparisons }) => n_comparisons));
  const x = linearScale([0, most], [left, width - 2]);
  return {
    width,
    height: TOP + standings.length * ROW + AXIS,
    left,
    n_places: Math.max(...standings.map(({ places }) => places.length)),
    rows: standings.map((standing, i) => ({ standing, y: TOP + i * ROW, segments: segmentsOf(standing, x) })),
  };
}

/** @param {Standing} standing @param {(n: number) => number} x */
function segmentsOf(standing, x) {
  let before = 0;
  return standing.places.flatMap(({ count }, i) => {
    const from = x(before);
    before += count;
    const width = x(before) - from;
    const hasRoom = width > 6 + CHARACTER * String(count).length;
    return count === 0 ? [] : [{ place: i + 1, count, x: from, width, hasRoom }];
  });
}

/**
 * Shares of the optimum, each with its interval, on an axis that always has nothing and the optimum on it.
 * @param {Standing[]} standings @param {number} width
 */
export function layOutShares(standings, width) {
  const left = nameWidth(standings, width);
  const right = width - FIGURE;
  const values = standings.flatMap(({ share_of_optimum: { value, low, high } }) =>
    [value, low, high].filter((one) => one !== null),
  );
  /** @type {[number, number]} */
  const domain = [Math.max(LOWEST, Math.min(0, ...values)), Math.min(1.5, Math.max(1, ...values))];
  const x = linearScale(domain, [left, right]);
  const within = (/** @type {number} */ value) => x(Math.min(domain[1], Math.max(domain[0], value)));
  const bottom = TOP + standings.length * ROW;
  return {
    width,
    height: bottom + AXIS,
    left,
    right,
    bottom,
    zero: x(0),
    optimum: x(1),
    ticks: ticks(domain[0], domain[1], Math.max(2, Math.floor((right - left) / 60))).map((value) => ({
      x: x(value),
      value,
    })),
    rows: standings.map((standing, i) => {
      const { value, low, high } = standing.share_of_optimum;
      return {
        standing,
        y: TOP + (i + 0.5) * ROW,
        x: value === null ? null : within(value),
        isOffScale: value !== null && value < domain[0],
        interval: low === null || high === null ? null : [within(low), within(high)],
      };
    }),
  };
}
