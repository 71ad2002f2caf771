import assert from "node:assert/strict";
import test from "node:test";
import { differenceOf, largestSize, visitsOfAttempts } from "#js/learning/visits.js";
import { makeWorld } from "./factories.js";

const world = makeWorld([
  [-0.5, -0.5],
  [-3, 4],
]);
const attempt = (id, outcome, states) => ({ id, outcome, states, discarded: false });
const attempts = [
  attempt("a", "success", [0, 1, 3]),
  attempt("b", "success", [0, 1, 0, 1, 3]),
  attempt("c", "failure", [0, 2, 2]),
];
const rankings = { success: { order: [["a"], ["b"]], weights: { a: 0.75, b: 0.25 } }, failure: null };

test("visits of the successes count by the order, for who looks at the order, else all alike; failures do not", () => {
  assert.deepEqual(visitsOfAttempts(world, attempts, rankings, { uses_ranking: true }), [1.25, 1.25, 0, 1]);
  assert.deepEqual(visitsOfAttempts(world, attempts, rankings, { uses_ranking: false }), [1.5, 1.5, 0, 1]);
});

test("the difference is above zero where the policy comes more often", () => {
  assert.deepEqual(differenceOf([1, 0.5], [0.25, 1]), [0.75, -0.5]);
  assert.equal(largestSize([0.75, -2, Number.NaN]), 2);
});
