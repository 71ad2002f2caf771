/**
 * The JSON of the learning room, as ARCHITECTURE.md draws it.
 *
 * @typedef {"queued" | "running" | "done" | "failed" | "cancelled"} RunStatus
 *
 * @typedef {object} Frame what a learner shows of itself at one iteration
 * @property {string} learner
 * @property {number} iteration
 * @property {number} iterations the limit
 * @property {number} gap ‖μ^π − μ̃‖∞, visits
 * @property {number | null} log_likelihood
 * @property {number[]} reward (S,)
 * @property {number[][]} policy (S, 4)
 * @property {number[]} visitation (S,)
 * @property {number} [compute_ms] how long the learner itself has computed; runs of older versions lack it
 * @property {number} [number] that of the event
 *
 * @typedef {object} Result how a learner ended
 * @property {"converged" | "iteration_limit" | "diverged" | "stopped" | null} outcome null: not there yet
 * @property {string} [sentence]
 * @property {number} [iterations]
 * @property {number} [gap]
 * @property {number | null} [log_likelihood]
 * @property {number[][]} [reward] rows × cols
 * @property {number[][]} [policy] (S, 4)
 * @property {number[][]} [visitation] rows × cols
 * @property {number} [n_left_out]
 * @property {number[] | null} [weights] (K,), null where they are the reward
 * @property {Posterior | null} [posterior]
 *
 * @typedef {object} Posterior what a Bayesian learner does not know
 * @property {number} level the probability of its intervals
 * @property {number[]} reward_low (S,)
 * @property {number[]} reward_high (S,)
 * @property {number[]} policy_agreement (S,) share of draws whose plan takes the executed action
 * @property {number} return_low of the executed policy, in units of the learned reward
 * @property {number} return_high
 * @property {number} n_draws
 * @property {number} acceptance
 *
 * @typedef {object} Run
 * @property {string} id
 * @property {string} world_id
 * @property {RunStatus} status
 * @property {string | null} reason
 * @property {number} seed
 * @property {Record<string, number | string>} settings
 * @property {Record<string, Result>} learners
 * @property {Record<string, number>} [compute_ms] of each learner that has begun
 * @property {string} created_at
 * @property {number} [n_demonstrations]
 * @property {number} [n_left_out]
 * @property {number | null} [ahead] how many runs come before it; null unless queued
 * @property {WorkerState} [worker]
 * @property {boolean} [is_own]
 *
 * @typedef {"ready" | "warming" | "none"} WorkerState
 *
 * @typedef {object} Preset learners and settings that go together
 * @property {string} name
 * @property {string} title
 * @property {string[]} learners
 * @property {Record<string, number | string>} settings what differs from the defaults
 * @property {string} sentence
 *
 * @typedef {object} LearnerInfo
 * @property {string} name
 * @property {string} title
 * @property {string} summary what it does, in a sentence
 * @property {"paper" | "ours" | "baseline"} family
 * @property {boolean} uses_ranking
 * @property {boolean} uses_failures
 * @property {boolean} uses_scores
 * @property {boolean} takes_anything one attempt is enough, of whatever kind
 * @property {boolean} seeks_visits its iterations close the gap to the play
 * @property {boolean} preselected it learns unless somebody says otherwise
 * @property {string | null} missing why it cannot run yet, as a sentence
 *
 * @typedef {object} SettingInfo
 * @property {string} name
 * @property {string} symbol
 * @property {number | string} default
 * @property {number | null} minimum
 * @property {number | null} maximum
 * @property {string[] | null} [choices]
 * @property {boolean} [whole] a whole number
 * @property {string} [group] whom or what it is for
 * @property {string} help
 *
 * @typedef {import("#js/board/state.js").World} World
 *
 * @typedef {object} Demonstration
 * @property {string} id
 * @property {number[]} states
 * @property {number[]} actions
 * @property {number[]} rewards
 * @property {number} total
 * @property {"success" | "failure"} outcome
 * @property {string} ending
 * @property {boolean} discarded
 * @property {string} created_at
 *
 * @typedef {object} Ranking
 * @property {"success" | "failure"} outcome
 * @property {string[][]} order
 * @property {number} version
 * @property {boolean} confirmed
 * @property {Record<string, number>} weights
 * @property {string} created_at
 *
 * @typedef {{ success: Ranking | null, failure: Ranking | null }} Rankings
 *
 * @typedef {object} LearnPageData
 * @property {World} world
 * @property {Demonstration[]} demonstrations
 * @property {Rankings} rankings
 * @property {Run | null} run
 * @property {LearnerInfo[]} learners
 * @property {SettingInfo[]} settings
 * @property {Preset[]} [presets]
 * @property {boolean} [is_own] false: opened by a shared link; demonstrations and rankings are the run's snapshot
 * @property {string | null} [key] that of the shared link
 */

export {};
