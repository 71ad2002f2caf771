/**
 * What of a path must be painted when it grows by a step: the squares that changed and the lines between squares that
 * touch them. A path of twenty thousand steps costs a step no more than one of twenty. No DOM here.
 */

import { placeOf } from "#js/board/state.js";

/** @typedef {import("#js/board/state.js").World} World */
/** @typedef {import("#js/board/state.js").Path} Path */
/** @typedef {{top: number, left: number, bottom: number, right: number}} Box   rows and columns, all inclusive */
/** @typedef {{from: number, to: number, age: number}} Edge   between two squares; how many steps ago */

/** A path that fades is at its palest when this many steps have followed. */
export const FADED_AFTER = 11;
export const FAINTEST = 0.22;

/** How strong a line is drawn that was walked some steps ago. @param {number} age steps */
export function strengthOf(age) {
  return age >= FADED_AFTER ? FAINTEST : 1 - (age * (1 - FAINTEST)) / FADED_AFTER;
}

/** The squares whose ink differs between two paths; null: none. @param {World} world @param {Path | null} before @param {Path | null} after @returns {Box | null} */
export function changedSquares(world, before, after) {
  const [old, fresh] = [before?.states ?? [], after?.states ?? []];
  const shared = before && after && isDrawnAlike(before, after) ? sharedLength(old, fresh) : 0;
  if (shared === old.length && shared === fresh.length) return null;
  const fading = after?.fade ? FADED_AFTER : 0;
  const from = Math.max(0, shared - 2 - fading);
  /** @type {Box} */
  const box = { top: world.rows, left: world.cols, bottom: -1, right: -1 };
  for (const states of [old, fresh]) {
    for (let i = from; i < states.length; i++) include(box, placeOf(world, states[i] ?? 0));
  }
  return box.bottom < 0 ? null : box;
}

/**
 * The lines of a path that touch a box of squares (all lines without one), each once, as it was walked last; those
 * that still fade come in their own list, oldest first.
 * @param {World} world @param {Path} path @param {Box | null} box @returns {{settled: Edge[], fading: Edge[]}}
 */
export function edgesOf(world, path, box) {
  const { states } = path;
  const last = states.length - 1;
  const seen = new Set();
  /** @type {{settled: Edge[], fading: Edge[]}} */
  const found = { settled: [], fading: [] };
  for (let i = last; i > 0; i--) {
    const [from, to] = [states[i - 1] ?? 0, states[i] ?? 0];
    if (from === to || (box && !touches(box, world, from) && !touches(box, world, to))) continue;
    const key = from < to ? from * 2 + Number(to - from === 1) : to * 2 + Number(from - to === 1);
    if (seen.has(key)) continue;
    seen.add(key);
    const age = last - i;
    (path.fade && age < FADED_AFTER ? found.fading : found.settled).push({ from, to, age });
  }
  found.fading.reverse();
  return found;
}

/** @param {Path} a @param {Path} b */
function isDrawnAlike(a, b) {
  return a.who === b.who && a.width === b.width && a.opacity === b.opacity && a.fade === b.fade;
}

/** @param {readonly number[]} a @param {readonly number[]} b */
function sharedLength(a, b) {
  const shorter = Math.min(a.length, b.length);
  for (let i = 0; i < shorter; i++) if (a[i] !== b[i]) return i;
  return shorter;
}

/** @param {Box} box @param {[number, number]} place */
function include(box, [row, col]) {
  box.top = Math.min(box.top, row);
  box.bottom = Math.max(box.bottom, row);
  box.left = Math.min(box.left, col);
  box.right = Math.max(box.right, col);
}

/** A line is as broad as to reach into the next square at most. @param {Box} box @param {World} world @param {number} state */
function touches(box, world, state) {
  const row = Math.floor(state / world.cols);
  const col = state - row * world.cols;
  return row >= box.top - 1 && row <= box.bottom + 1 && col >= box.left - 1 && col <= box.right + 1;
}
