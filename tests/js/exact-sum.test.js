import assert from "node:assert/strict";
import test from "node:test";
import { exactSum } from "#js/lib/exact-sum.js";

test("nothing sums to 0, and 0 has no sign", () => {
  assert.ok(Object.is(exactSum([]), 0));
  assert.ok(Object.is(exactSum([-0]), 0));
  assert.ok(Object.is(exactSum([-0.1, 0.1]), 0));
});

test("what the sum of two rounds away is not lost", () => {
  assert.equal(exactSum(Array(10).fill(0.1)), 1);
  assert.equal(exactSum([1e16, 1, -1e16]), 1);
  assert.equal(exactSum([1, 1e-16, -1]), 1e-16);
  assert.equal(exactSum([1e308, 1, -1e308, 1e-300]), 1);
});

test("the order does not matter", () => {
  const numbers = Array.from({ length: 200 }, (_, i) => Math.sin(i) * 10 ** ((i % 40) - 20));
  assert.equal(exactSum(numbers), exactSum([...numbers].reverse()));
  assert.equal(exactSum(numbers), exactSum([...numbers].sort()));
});

test("half a unit is rounded to the even number, a trace more is rounded up", () => {
  const half = 2 ** -53;
  assert.equal(exactSum([1, half]), 1);
  assert.equal(exactSum([1, half, 2 ** -120]), 1 + 2 * half);
  assert.equal(exactSum([1 + 2 * half, half]), 1 + 4 * half);
  assert.equal(exactSum([1 + 2 * half, half, -(2 ** -120)]), 1 + 2 * half);
  assert.equal(exactSum([-1, -half, -(2 ** -120)]), -1 - 2 * half);
});

test("the smallest numbers are summed as exactly as the largest", () => {
  assert.equal(exactSum([5e-324, 5e-324, -5e-324]), 5e-324);
  assert.equal(exactSum([2 ** 1000, 5e-324, -(2 ** 1000)]), 5e-324);
});
