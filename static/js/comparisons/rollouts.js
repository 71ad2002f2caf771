/**
 * Where everybody is in an episode: positions, totals and flags from recorded states. Each has a number of episodes of their
 * own (an attempt of the person is one), so episode k of the chooser is episode k modulo that number.
 * @import {Episode} from "#js/comparisons/types.js"
 * @import {World} from "#js/learning/types.js"
 */

/**
 * @typedef {object} Moment
 * @property {number} state
 * @property {number | null} facing 0 up, 1 right, 2 down, 3 left
 * @property {number[]} trail states so far
 * @property {number} step steps this agent has done
 * @property {number} steps steps of its whole episode
 * @property {number} total
 * @property {boolean} isOver
 * @property {boolean} reachedGoal the goal has been reached by now
 */

/**
 * @param {Episode[] | undefined} episodes
 * @param {number} episode 0, 1, …
 * @returns {Episode | null}
 */
export function episodeOf(episodes, episode) {
  return episodes?.length ? (episodes[episode % episodes.length] ?? null) : null;
}

/**
 * Steps of the longest walk of an episode.
 * @param {{ episodes: Episode[] }[]} cast
 * @param {number} episode
 */
export function lengthOf(cast, episode) {
  const lengths = cast.map(({ episodes }) => (episodeOf(episodes, episode)?.states.length ?? 1) - 1);
  return Math.max(0, ...lengths);
}

/**
 * @param {World} world
 * @param {Episode} episode
 * @param {number} step
 * @returns {Moment}
 */
export function momentAt(world, episode, step) {
  const steps = episode.states.length - 1;
  const done = Math.min(step, steps);
  const trail = episode.states.slice(0, done + 1);
  return {
    state: trail[done] ?? world.start,
    facing: facingOf(world, trail),
    trail,
    step: done,
    steps,
    total: done === steps ? episode.total : totalOf(world, trail),
    isOver: done === steps,
    reachedGoal: done === steps && episode.reached_goal,
  };
}

/**
 * Every step pays the reward of the square reached; the start's own is not paid at the beginning.
 * @param {World} world
 * @param {number[]} trail
 */
function totalOf(world, trail) {
  let total = 0;
  for (const state of trail.slice(1)) {
    total += world.rewards[Math.floor(state / world.cols)]?.[state % world.cols] ?? 0;
  }
  return total;
}

/**
 * Where the last real move led; a bump into the edge does not turn the head.
 * @param {World} world
 * @param {number[]} trail
 */
function facingOf(world, trail) {
  const here = trail.at(-1) ?? world.start;
  const before = trail.findLast((state) => state !== here);
  if (before === undefined || trail.length < 2) return null;
  const previous = trail[trail.lastIndexOf(before)] ?? here;
  const rows = Math.floor(here / world.cols) - Math.floor(previous / world.cols);
  const cols = (here % world.cols) - (previous % world.cols);
  if (rows !== 0) return rows < 0 ? 0 : 2;
  return cols > 0 ? 1 : 3;
}
