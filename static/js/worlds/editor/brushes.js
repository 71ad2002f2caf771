/** What a tool does to a square: plan in, plan out, and a sentence where it cannot be. No DOM here. */

import { fits, layoutOf, lineOf, placeAt, squareAt, tidyGoals, usualPay } from "#js/worlds/editor/plan.js";

/** @typedef {import("#js/worlds/editor/plan.js").Plan} Plan */

export const TOOLS = /** @type {const} */ (["wall", "paint", "goal", "start", "erase", "pick"]);
const MOST_GOALS = 100;
/** Tools whose work a second press takes back. */
const TAKEN_BACK = new Set(["wall", "paint", "goal"]);

/** @typedef {typeof TOOLS[number]} Tool */
/** @typedef {{tool: Tool, reward: number, pay: number}} Brush   what it paints, and what a goal pays */
/** @typedef {{plan: Plan, refusal: string}} Painted             the very same plan where nothing changed */

/**
 * A plan under a brush, by place; only what is visible is in `goals` and `start`.
 * @typedef {object} Marks
 * @property {Plan} plan
 * @property {number} start
 * @property {Map<number, number | null>} goals
 * @property {Set<number>} walls
 * @property {Map<number, number>} painted
 * @property {number} nChanges
 * @property {string} refusal
 */

/** A brush from the moment it touches the board until it leaves it. */
export class Stroke {
  #brush;
  #last;
  #isSingle = true;

  /** @param {Plan} plan @param {Brush} brush @param {number} place */
  constructor(plan, brush, place) {
    this.#brush = brush;
    this.#last = place;
    this.before = plan;
    this.first = paint(plan, brush, [place]);
  }

  /** The place where the brush is. */
  get last() {
    return this.#last;
  }

  /** Draw on to another place. @param {Plan} plan @param {number} place @returns {Painted} */
  moveTo(plan, place) {
    if (place === this.#last) return { plan, refusal: "" };
    this.#isSingle = false;
    const way = lineOf(this.#last, place);
    this.#last = place;
    return paint(plan, this.#brush, way);
  }

  /** Pressed where it was so already, and lifted at once: taken back. @param {Plan} plan @returns {Painted} */
  end(plan) {
    const wasSo = this.#isSingle && this.first.plan === this.before && this.first.refusal === "";
    if (!wasSo || !TAKEN_BACK.has(this.#brush.tool)) return { plan, refusal: "" };
    return paint(plan, { ...this.#brush, tool: "erase" }, [this.#last]);
  }
}

/** @param {Plan} plan @param {Brush} brush @param {readonly number[]} places @returns {Painted} */
export function paint(plan, brush, places) {
  const marks = marksOf(plan);
  for (const place of places) if (fits(plan, place)) BRUSHES[brush.tool](marks, place, brush);
  return { plan: marks.nChanges > 0 ? planOfMarks(marks) : plan, refusal: marks.refusal };
}

/** The brush that would make a square what it is. @param {Plan} plan @param {number} place @param {number} reward of the square @param {Brush} brush @returns {Brush} */
export function brushAt(plan, place, reward, brush) {
  const { goals, start, walls } = layoutOf(plan);
  const square = squareAt(plan, place);
  if (goals.has(square)) return { ...brush, tool: "goal", pay: goals.get(square) ?? usualPay(plan) };
  if (walls.includes(square)) return { ...brush, tool: "wall" };
  if (start === square) return { ...brush, tool: "start" };
  return { ...brush, tool: "paint", reward };
}

/** @type {Record<Tool, (marks: Marks, place: number, brush: Brush) => void>} */
const BRUSHES = {
  wall(marks, place) {
    if (place === marks.start) return refuse(marks, "The start cannot be a wall. Put the start elsewhere first.");
    if (marks.goals.has(place)) return refuse(marks, "A goal cannot be a wall. Erase the goal first.");
    if (marks.walls.has(place)) return;
    marks.walls.add(place);
    marks.painted.delete(place);
    marks.nChanges++;
  },

  paint(marks, place, { reward }) {
    if (marks.goals.has(place)) return refuse(marks, "A goal pays. The goal tool says how much.");
    if (marks.painted.get(place) === reward && !marks.walls.has(place)) return;
    marks.walls.delete(place);
    marks.painted.set(place, reward);
    marks.nChanges++;
  },

  goal(marks, place, { pay }) {
    const told = pay === usualPay(marks.plan) ? null : pay;
    const isGoal = marks.goals.has(place);
    if (place === marks.start) return refuse(marks, "The start cannot be a goal. Put the start elsewhere first.");
    if (isGoal && marks.goals.get(place) === told) return;
    if (!isGoal && marks.goals.size >= MOST_GOALS) return refuse(marks, `A world has at most ${MOST_GOALS} goals.`);
    marks.goals.set(place, told);
    marks.walls.delete(place);
    marks.painted.delete(place);
    marks.nChanges++;
  },

  start(marks, place) {
    if (marks.goals.has(place)) return refuse(marks, "A goal cannot be the start. Erase the goal first.");
    if (marks.start === place) return;
    marks.start = place;
    marks.walls.delete(place);
    marks.nChanges++;
  },

  erase(marks, place) {
    if (marks.goals.has(place)) return eraseGoal(marks, place);
    const isMarked = marks.walls.delete(place) || marks.painted.delete(place);
    if (isMarked) marks.nChanges++;
    else if (place === marks.start) refuse(marks, "A world needs a start. Put it elsewhere with the start tool.");
  },

  pick() {},
};

/** @param {Marks} marks @param {number} place */
function eraseGoal(marks, place) {
  if (marks.goals.size === 1) return refuse(marks, "A world needs a goal. Put another one first.");
  marks.goals.delete(place);
  marks.nChanges++;
}

/** @param {Marks} marks @param {string} sentence */
function refuse(marks, sentence) {
  marks.refusal = sentence;
}

/** @param {Plan} plan @returns {Marks} */
function marksOf(plan) {
  const layout = layoutOf(plan);
  return {
    plan,
    start: placeAt(plan, layout.start),
    goals: new Map([...layout.goals].map(([square, pay]) => [placeAt(plan, square), pay])),
    walls: new Set(plan.walls),
    painted: new Map(plan.painted),
    nChanges: 0,
    refusal: "",
  };
}

/** What was not touched stays what it was, also where it lies outside the size or goes along with a corner. @param {Marks} marks @returns {Plan} */
function planOfMarks({ plan, start, goals, walls, painted }) {
  const before = marksOf(plan);
  const hidden = [...plan.goals].filter(([place]) => !fits(plan, place));
  return {
    ...plan,
    start: start === before.start ? plan.start : start,
    goals: isSame(goals, before.goals) ? plan.goals : tidyGoals(plan, new Map([...goals, ...hidden])),
    walls,
    painted,
  };
}

/** @param {Map<number, unknown>} one @param {Map<number, unknown>} other */
function isSame(one, other) {
  return one.size === other.size && [...one].every(([place, pay]) => other.has(place) && other.get(place) === pay);
}
