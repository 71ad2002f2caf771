/**
 * The JSON of learning again, as the server answers it, and what the page makes of an attempt.
 * @import {Demonstration} from "#js/learning/types.js"
 *
 * @typedef {{ drop: string } | { swap: [string, string] } | { relabel: string }} Change
 *
 * @typedef {object} Influence what one attempt changed: learning with it against learning without it
 * @property {string} id
 * @property {"success" | "failure"} outcome
 * @property {number} n_steps
 * @property {number | null} policy_change share of steps taken otherwise, 0…1; null: nothing can be learned without it
 * @property {number | null} reward_change mean |R − R₋ᵢ| of a square
 * @property {number | null} return_change with it minus without it
 * @property {string | null} sentence why nothing can be learned
 * @property {number | null} expected_return without it
 * @property {number[] | null} turned squares whose likeliest step is another without it
 *
 * @typedef {{ learner: string, influences: Influence[], compute_ms: number }} Influences
 *
 * @typedef {object} Learned
 * @property {string | null} outcome
 * @property {string} sentence
 * @property {number[][]} reward rows × cols
 * @property {number[][]} policy (S, 4)
 *
 * @typedef {{ expected_return: number, greedy_return: number | null }} Returns
 *
 * @typedef {Returns & { learner: string, change: Change, result: Learned, before: Returns, difference: Difference, compute_ms: number }} WhatIf
 *
 * @typedef {object} Difference new minus old
 * @property {number} policy_change
 * @property {number} reward_change
 * @property {number} return_change
 * @property {number[]} turned squares whose likeliest step is another
 * @property {number[]} reward (S,)
 *
 * @typedef {object} Uncertainty
 * @property {string} learner
 * @property {"posterior" | "bootstrap"} method
 * @property {number} level the probability of its intervals
 * @property {number} n_draws
 * @property {number} seed
 * @property {number[]} policy_agreement (S,) share of the draws that take the executed step
 * @property {number[]} reward_low (S,)
 * @property {number[]} reward_high (S,)
 * @property {number} return_low in the units of the world
 * @property {number} return_high
 * @property {string} sentence how it was found out
 * @property {number} compute_ms
 *
 * @typedef {object} Attempt one of the attempts that the run learned from
 * @property {string} id
 * @property {"success" | "failure"} outcome
 * @property {number} place 1, 2, … in its list: the best success first, the worst failure first
 * @property {number} count attempts of its list
 * @property {boolean} isOrdered somebody said where it stands; else it stands where it was played
 * @property {string[]} tiedWith ids
 * @property {Demonstration} demonstration
 */

export {};
