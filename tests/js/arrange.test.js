import assert from "node:assert/strict";
import { test } from "node:test";
import { longestRising } from "#js/rankings/arrange.js";

test("the longest rising run stays where it is", () => {
  assert.deepEqual(longestRising([0, 1, 2]), [0, 1, 2]);
  assert.deepEqual(longestRising([3, 0, 1, 2]), [1, 2, 3], "one moved up: the others stay");
  assert.deepEqual(longestRising([1, 2, 3, 0]), [0, 1, 2], "one moved down: the others stay");
  assert.equal(longestRising([4, 3, 2, 1]).length, 1);
  assert.deepEqual(longestRising([]), []);
});

test("what is not there yet is no part of it", () => {
  assert.deepEqual(longestRising([-1, 0, -1, 1]), [1, 3]);
  assert.deepEqual(longestRising([-1, -1]), []);
});
