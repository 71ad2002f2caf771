/**
 * The JSON of the comparison room, as ARCHITECTURE.md draws it. Comparisons that an earlier version stored lack what may be
 * null here without another reason.
 * @import {Demonstration, LearnerInfo, Rankings, Run, World} from "#js/learning/types.js"
 *
 * @typedef {object} Entry how one agent did, measured on the same world
 * @property {string} who "human", a learner's name or "optimal"
 * @property {string} title
 * @property {number} mean_return
 * @property {number | null} standard_error
 * @property {number | null} [interval_low] 95 % interval of the mean; null for one episode
 * @property {number | null} [interval_high]
 * @property {number | null} [success_rate] share of episodes at the goal with a total of at least 0
 * @property {number | null} [mean_steps]
 * @property {number | null} expected_return null for the human
 * @property {number | null} greedy_return null for the human
 * @property {number | null} share_of_optimum null when the optimum is not above 0
 * @property {number} place 1, 2, …; ties share one
 * @property {number} episodes
 *
 * @typedef {object} PairedTest how much more a earned than b, episode by episode
 * @property {string} a
 * @property {string} b
 * @property {number} mean_difference
 * @property {number | null} low 95 % interval
 * @property {number | null} high
 * @property {number} p_value
 * @property {number} p_adjusted Holm's, over all pairs
 *
 * @typedef {object} Comparison
 * @property {string} run_id
 * @property {number} seed
 * @property {number} horizon
 * @property {Entry[]} entries by place
 * @property {{ best: string, mean: string } | null} [human] ids of two attempts
 * @property {Record<string, number[]> | null} [value_lost] by learner, V* − V^π of every square, (S,)
 * @property {number | null} [value_lost_scale] where their common scale ends
 * @property {PairedTest[] | null} [tests] every two learners
 *
 * @typedef {{ states: number[], total: number, reached_goal: boolean }} Episode
 * @typedef {Record<string, Episode[]>} Rollouts
 *
 * @typedef {object} ComparePageData
 * @property {World} world
 * @property {Demonstration[]} demonstrations
 * @property {Rankings} rankings
 * @property {Run} run
 * @property {boolean} [is_own] whether the page is seen by who played; else by a shared link
 * @property {string | null} [key] of that link
 * @property {Omit<LearnerInfo, "missing" | "preselected">[]} learners those of the run
 * @property {Comparison} comparison
 * @property {Rollouts} rollouts
 * @property {{ key: string, short: string, bibtex: string }[]} citations of the learners of the run
 */

export {};
