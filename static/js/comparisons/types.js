/**
 * The JSON of the comparison room, as ARCHITECTURE.md draws it.
 * @import {Demonstration, LearnerInfo, Rankings, Run, World} from "#js/learning/types.js"
 *
 * @typedef {object} Entry how one agent did, measured on the same world
 * @property {string} who "human", a learner's name or "optimal"
 * @property {string} title
 * @property {number} mean_return
 * @property {number | null} standard_error
 * @property {number | null} expected_return null for the human
 * @property {number | null} greedy_return null for the human
 * @property {number | null} share_of_optimum null when the optimum is not above 0
 * @property {number} place 1, 2, …; ties share one
 * @property {number} episodes
 *
 * @typedef {{ run_id: string, seed: number, horizon: number, entries: Entry[] }} Comparison
 * @typedef {{ states: number[], total: number, reached_goal: boolean }} Episode
 * @typedef {Record<string, Episode[]>} Rollouts
 *
 * @typedef {object} ComparePageData
 * @property {World} world
 * @property {Demonstration[]} demonstrations
 * @property {Rankings} rankings
 * @property {Run} run
 * @property {Omit<LearnerInfo, "missing" | "preselected">[]} learners those of the run
 * @property {Comparison} comparison
 * @property {Rollouts} rollouts
 */

export {};
