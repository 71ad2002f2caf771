/**
 * The squares as the server drew them, remembered below what is painted over, so that a stroke shows at once and an
 * erased one gives the old square back. Squares never seen are a plain blue until the server's answer. No DOM here.
 */

import { layoutOf, placeAt, usualPay } from "#js/worlds/editor/plan.js";

/** @typedef {import("#js/worlds/editor/plan.js").Plan} Plan */
/** @typedef {import("#js/board/state.js").World} World */

const UNKNOWN = -0.5;
const RED_BELOW = -1;

export class Ground {
  /** @type {Map<number, number>} place → reward */
  #rewards = new Map();
  #origin = "";

  /** @param {World & {spec?: import("#js/worlds/query.js").Spec}} world of the server */
  learn(world) {
    const origin = [world.rows, world.cols, world.seed, world.red_probability].join();
    if (origin !== this.#origin) this.#rewards.clear();
    this.#origin = origin;
    const isCovered = new Set([...world.goals, ...(world.spec?.painted ?? []).map(([at]) => at)]);
    world.rewards.flat().forEach((reward, square) => {
      if (!isCovered.has(square)) this.#rewards.set(placeAt(world, square), reward);
    });
  }

  /** The world of a plan, as far as it is known here. @param {Plan} plan @returns {World} */
  draw(plan) {
    const { rows, cols } = plan;
    const { start, goals, walls, painted } = layoutOf(plan);
    const rewards = Array.from({ length: rows * cols }, (_, at) => this.#rewards.get(placeAt(plan, at)) ?? UNKNOWN);
    for (const [square, reward] of painted) rewards[square] = reward;
    for (const [square, pay] of goals) rewards[square] = pay ?? usualPay(plan);
    /** @type {string[]} */
    const colours = rewards.map((reward) => (reward < RED_BELOW ? "red" : "blue"));
    for (const square of walls) colours[square] = "wall";
    for (const square of goals.keys()) colours[square] = "goal";
    const inRows = (/** @type {any[]} */ list) =>
      Array.from({ length: rows }, (_, row) => list.slice(row * cols, (row + 1) * cols));
    return {
      id: "",
      ...{ rows, cols, start, walls },
      goal: [...goals.keys()][0] ?? rows * cols - 1,
      goals: [...goals.keys()],
      rewards: inRows(rewards),
      colours: inRows(colours),
      seed: plan.seed,
      red_probability: plan.redProbability,
      slip: plan.slip,
      horizon: plan.stepLimit ?? 2 * rows * cols,
      time_limit_s: plan.timeLimitS,
    };
  }
}
