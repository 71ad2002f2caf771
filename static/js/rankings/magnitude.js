/**
 * How much better: distances said between neighbouring groups, 1 (hardly) to 100 (far). Plain data, no page.
 * `irl_core/preferences/gaps.py` is the twin; tests/core/gap_and_stretch_vectors.json holds both to one table.
 *
 * A gap is kept under one attempt of the group above and one of the group below. It counts wherever the two stand in
 * neighbouring groups, so it comes back when they are neighbours again; of several that fit, the last of the list counts.
 */

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {import("#js/rankings/sitting-state.js").Gap} Gap */

export const HARDLY = 1;
export const FAR = 100;

/** On a scale, what was not said takes the room of a middling gap. */
const UNSAID_ROOM = 50;
/** Two figures nearer to each other than this (per cent of the scale) would touch. */
const LABEL_ROOM = 7;

/** All that was said between two groups, whoever of them it named. @param {readonly Gap[]} gaps @param {readonly string[]} above @param {readonly string[]} below @returns {Gap[]} */
export function gapsBetween(gaps, above, below) {
  return gaps.filter((gap) => above.includes(gap.above) && below.includes(gap.below));
}

/** Between each group and the next, from the top; null where nothing was said. @param {Order} order @param {readonly Gap[]} gaps @returns {(number | null)[]} */
export function saidGaps(order, gaps) {
  return order.slice(1).map((below, i) => gapsBetween(gaps, order[i] ?? [], below).at(-1)?.value ?? null);
}

/** How far above the last group each attempt stands; null while a gap is not said. @param {Order} order @param {readonly Gap[]} gaps @returns {Record<string, number> | null} */
export function positionsFromGaps(order, gaps) {
  const said = saidGaps(order, gaps);
  if (said.includes(null)) return null;
  const heightOf = (/** @type {number} */ i) => said.slice(i).reduce((sum, gap) => Number(sum) + Number(gap), 0);
  return Object.fromEntries(order.flatMap((group, i) => group.map((id) => [id, Number(heightOf(i))])));
}

/**
 * The groups on a line from 0 (top of the list) to 100 (bottom), as far apart as was said. What was not said takes the
 * room of a middling gap, and is drawn so that nobody takes it for an answer.
 * @param {Order} order @param {readonly Gap[]} gaps
 * @returns {{stops: {rank: number, n: number, at: number, isLabelled: boolean}[], spans: {from: number, to: number, value: number | null}[]}}
 */
export function scaleOf(order, gaps) {
  const said = saidGaps(order, gaps);
  const total = said.reduce((sum, gap) => Number(sum) + (gap ?? UNSAID_ROOM), 0) || 1;
  let [at, rank] = [0, 1];
  const stops = order.map((group, i) => {
    const stop = { rank, n: group.length, at, isLabelled: false };
    at += (100 * (said[i] ?? UNSAID_ROOM)) / Number(total);
    rank += group.length;
    return stop;
  });
  const spans = said.map((value, i) => ({ from: stops[i]?.at ?? 0, to: stops[i + 1]?.at ?? 100, value }));
  return { stops: labelled(stops), spans };
}

/** Both ends have their figure, the others where there is room. @param {{rank: number, n: number, at: number, isLabelled: boolean}[]} stops */
function labelled(stops) {
  let last = Number.NEGATIVE_INFINITY;
  return stops.map((stop, i) => {
    const isEnd = i === 0 || i === stops.length - 1;
    const isLabelled = isEnd || (stop.at - last >= LABEL_ROOM && (stops.at(-1)?.at ?? 100) - stop.at >= LABEL_ROOM);
    if (isLabelled) last = stop.at;
    return { ...stop, isLabelled };
  });
}
