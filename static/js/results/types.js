/**
 * What the page of results is given: `ResultsOut` of the API as far as the pictures need it.
 *
 * @typedef {object} Often
 * @property {number} count
 * @property {number} of
 *
 * @typedef {object} Standing
 * @property {string} who
 * @property {string} title
 * @property {number} n_comparisons
 * @property {Often[]} places           how often at place 1, 2, …
 * @property {{value: number | null, low: number | null, high: number | null}} share_of_optimum
 *
 * @typedef {object} ResultsPageData
 * @property {{scope: "own" | "pooled", n_comparisons: number, standings: Standing[]}} results
 * @property {Record<string, import("#js/board/state.js").World>} worlds   by id
 */

export {};
