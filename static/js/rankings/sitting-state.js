/**
 * What a sitting has come to, from its events alone: the orders, what was said beside them, and the way back. No page, no
 * clock. `app/rankings/replay.py` is the twin on the server; docs/codebook.md lists the events.
 *
 * The *content* is what a person states: both orders, answers about pairs, gaps, stretches. Undo and redo go from content
 * to content. While a card is lifted everything done is one step of undo (`mark` is where that began).
 */

import { flat, groupOf, holdsTheSame, place, reconcile, swap } from "#js/rankings/order.js";

/** @typedef {import("#js/rankings/order.js").Order} Order */
/** @typedef {"success" | "failure"} Outcome */
/** @typedef {"lists" | "pairwise" | "magnitude" | "segments"} Way */
/** @typedef {"mouse" | "touch" | "pen" | "key" | "button" | "page"} Means */
/** @typedef {{a: string, b: string, said: "a" | "b" | "alike"}} Answer */
/** @typedef {{above: string, below: string, value: number}} Gap */
/** @typedef {{from: number, to: number, kind: "good" | "bad"}} Stretch   steps from … to, counted from 1 */

/**
 * @typedef {object} Content
 * @property {Readonly<Record<Outcome, Order>>} orders
 * @property {Readonly<Record<Outcome, readonly Answer[]>>} answers
 * @property {Readonly<Record<Outcome, readonly Gap[]>>} gaps
 * @property {Readonly<Record<string, readonly Stretch[]>>} stretches   by attempt; none, no entry
 */

/** @typedef {{past: readonly Content[], present: Content, future: readonly Content[]}} History */

/**
 * @typedef {object} Rest
 * @property {History | null} mark       where things stood when a card was lifted
 * @property {string | null} lifted
 * @property {Way} way
 * @property {Readonly<Record<Outcome, boolean>>} touched
 */
/** @typedef {Readonly<History & Rest>} State */

/** @typedef {{type: string, [field: string]: any}} Change   an event without its number and time */

/** @param {Change} begin @returns {State} */
export function beginState({ orders, way }) {
  const present = {
    orders,
    answers: { success: [], failure: [] },
    gaps: { success: [], failure: [] },
    stretches: {},
  };
  const touched = { success: false, failure: false };
  return { past: [], present, future: [], mark: null, lifted: null, way, touched };
}

/** The state after a change; null where it is none that can be made. @param {State} state @param {Change} change @returns {State | null} */
export function apply(state, change) {
  const make = CHANGES[change.type];
  return make ? make(state, change) : null;
}

/** @type {Record<string, (state: State, change: Change) => State | null>} */
const CHANGES = {
  place(state, { outcome, id, group, joins }) {
    const order = state.present.orders[/** @type {Outcome} */ (outcome)];
    const nOthers = order.length - (order[groupOf(order, id)]?.length === 1 ? 1 : 0);
    if (groupOf(order, id) < 0 || group < 0 || group > nOthers - (joins ? 1 : 0)) return null;
    return reorder(state, outcome, place(order, id, { group, joins }));
  },
  swap(state, { outcome, id, with: other }) {
    const order = state.present.orders[/** @type {Outcome} */ (outcome)];
    if (id === other || groupOf(order, id) < 0 || groupOf(order, other) < 0) return null;
    return reorder(state, outcome, swap(order, id, other));
  },
  set(state, { outcome, order }) {
    const before = state.present.orders[/** @type {Outcome} */ (outcome)];
    return holdsTheSame(before, order) ? reorder(state, outcome, order) : null;
  },
  lift(state, { outcome, id }) {
    if (groupOf(state.present.orders[/** @type {Outcome} */ (outcome)], id) < 0) return null;
    const { past, present, future } = state;
    return { ...state, mark: { past, present, future }, lifted: id };
  },
  drop: (state) => (state.mark ? putDown(state) : null),
  put_back: (state) => (state.mark ? { ...putDown(state), ...state.mark } : null),
  undo(state) {
    const { past, present, future } = state;
    const last = past.at(-1);
    return last ? { ...putDown(state), past: past.slice(0, -1), present: last, future: [present, ...future] } : null;
  },
  redo(state) {
    const { past, present, future } = state;
    const [next, ...rest] = future;
    return next ? { ...putDown(state), past: [...past, present], present: next, future: rest } : null;
  },
  answer(state, { outcome, a, b, said }) {
    const order = state.present.orders[/** @type {Outcome} */ (outcome)];
    if (a === b || groupOf(order, a) < 0 || groupOf(order, b) < 0) return null;
    const answers = [...state.present.answers[/** @type {Outcome} */ (outcome)], { a, b, said }];
    return record(state, outcome, { answers: { ...state.present.answers, [outcome]: answers } });
  },
  gap(state, { outcome, above, below, value }) {
    const order = state.present.orders[/** @type {Outcome} */ (outcome)];
    if (above === below || groupOf(order, above) < 0 || groupOf(order, below) < 0) return null;
    const all = state.present.gaps[/** @type {Outcome} */ (outcome)];
    const gaps = withGap(all, { above, below, value });
    return record(state, outcome, { gaps: { ...state.present.gaps, [outcome]: gaps } });
  },
  stretch(state, { id, from, to, kind }) {
    const outcome = outcomeOf(state, id);
    if (outcome === null || from < 1 || to < from) return null;
    const { [id]: before = [], ...others } = state.present.stretches;
    const painted = paint(before, { from, to, kind });
    return record(state, outcome, { stretches: painted.length > 0 ? { ...others, [id]: painted } : others });
  },
  cards(state, { outcome, added, removed }) {
    const ids = new Set(flat(state.present.orders[/** @type {Outcome} */ (outcome)]));
    const isNew =
      new Set(added).size === added.length && added.every((/** @type {string} */ id) => !outcomeOf(state, id));
    if (!isNew || !removed.every((/** @type {string} */ id) => ids.has(id))) return null;
    const bring = (/** @type {Content} */ content) => bringUpToDate(content, outcome, added, removed);
    const { past, present, future } = state;
    return { ...putDown(state), past: past.map(bring), present: bring(present), future: future.map(bring) };
  },
  way: (state, { way }) => ({ ...state, way }),
  confirm: putDown,
  watch: (state) => state,
  compare: (state) => state,
  hidden: (state) => state,
  visible: (state) => state,
  resumed: (state) => state,
};

/** Kinds that are worth a line in the log although they change no content. */
export const SILENT = new Set(["way", "lift", "drop", "confirm", "watch", "compare", "hidden", "visible", "resumed"]);

/** @param {State} state @param {Outcome} outcome @param {Order} order */
function reorder(state, outcome, order) {
  return record(state, outcome, { orders: { ...state.present.orders, [outcome]: order } });
}

/** One step of undo; while a card is lifted, all of it together is one. @param {State} state @param {Outcome} outcome @param {Partial<Content>} change @returns {State} */
function record(state, outcome, change) {
  const present = { ...state.present, ...change };
  if (isSameContent(present, state.present)) return state;
  const touched = { ...state.touched, [outcome]: true };
  const { mark } = state;
  if (mark && isSameContent(present, mark.present)) return { ...state, ...mark, touched };
  const { past, present: before } = mark ?? state;
  return { ...state, past: [...past, before], present, future: [], touched };
}

/** @param {State} state @returns {State} */
function putDown(state) {
  return { ...state, mark: null, lifted: null };
}

/** @param {Content} a @param {Content} b */
function isSameContent(a, b) {
  return JSON.stringify(sorted(a)) === JSON.stringify(sorted(b));
}

/** Attempts may be marked in any order. @param {Content} content */
function sorted({ orders, answers, gaps, stretches }) {
  const marked = Object.entries(stretches).sort(([a], [b]) => (a < b ? -1 : 1));
  return [orders.success, orders.failure, answers.success, answers.failure, gaps.success, gaps.failure, marked];
}

/** @param {State} state @param {string} id @returns {Outcome | null} */
export function outcomeOf({ present: { orders } }, id) {
  if (groupOf(orders.success, id) >= 0) return "success";
  return groupOf(orders.failure, id) >= 0 ? "failure" : null;
}

/** @param {readonly Gap[]} gaps @param {{above: string, below: string, value: number | null}} said @returns {Gap[]} */
function withGap(gaps, { above, below, value }) {
  const isIt = (/** @type {Gap} */ gap) => gap.above === above && gap.below === below;
  if (value === null) return gaps.filter((gap) => !isIt(gap));
  if (gaps.some(isIt)) return gaps.map((gap) => (isIt(gap) ? { above, below, value } : gap));
  return [...gaps, { above, below, value }];
}

/** @param {readonly Stretch[]} stretches @param {{from: number, to: number, kind: "good" | "bad" | null}} brush @returns {Stretch[]} */
function paint(stretches, { from, to, kind }) {
  const left = stretches.flatMap((one) => [
    ...(one.from < from ? [{ ...one, to: Math.min(one.to, from - 1) }] : []),
    ...(one.to > to ? [{ ...one, from: Math.max(one.from, to + 1) }] : []),
  ]);
  const all = kind === null ? left : [...left, { from, to, kind }];
  return merged(all.sort((a, b) => a.from - b.from));
}

/** @param {Stretch[]} stretches @returns {Stretch[]} */
function merged(stretches) {
  /** @type {Stretch[]} */
  const whole = [];
  for (const one of stretches) {
    const last = whole.at(-1);
    if (last && last.kind === one.kind && last.to + 1 === one.from) whole[whole.length - 1] = { ...last, to: one.to };
    else whole.push(one);
  }
  return whole;
}

/** @param {Content} content @param {Outcome} outcome @param {string[]} added @param {string[]} removed @returns {Content} */
function bringUpToDate(content, outcome, added, removed) {
  const gone = new Set(removed);
  const stays = (/** @type {string[]} */ ...ids) => !ids.some((id) => gone.has(id));
  const { orders, answers, gaps, stretches } = content;
  return {
    orders: { ...orders, [outcome]: reconcile(orders[outcome], added, removed) },
    answers: { ...answers, [outcome]: answers[outcome].filter(({ a, b }) => stays(a, b)) },
    gaps: { ...gaps, [outcome]: gaps[outcome].filter(({ above, below }) => stays(above, below)) },
    stretches: Object.fromEntries(Object.entries(stretches).filter(([id]) => stays(id))),
  };
}
