import assert from "node:assert/strict";
import test from "node:test";
import {
  begin,
  isTiedAbove,
  move,
  reconcile,
  record,
  redo,
  sortByScore,
  toggleTie,
  undo,
  weights,
} from "#js/rankings/order.js";

const ABC = [["a"], ["b"], ["c"]];

test("a card goes to the place it is put", () => {
  assert.deepEqual(move(ABC, "c", 0), [["c"], ["a"], ["b"]]);
  assert.deepEqual(move(ABC, "a", 1), [["b"], ["a"], ["c"]]);
  assert.deepEqual(move(ABC, "a", 2), [["b"], ["c"], ["a"]]);
  assert.deepEqual(move(ABC, "b", 1), ABC);
});

test("a card put beside a tie stands alone, one put into it joins", () => {
  const order = [["a", "b"], ["c"]];
  assert.deepEqual(move(order, "c", 0), [["c"], ["a", "b"]]);
  assert.deepEqual(move(order, "c", 1), [["a", "c", "b"]]);
  assert.deepEqual(move(order, "c", 2), order);
});

test("a card that leaves its tie leaves the others tied", () => {
  assert.deepEqual(move([["a", "b", "c"]], "b", 0), [["b"], ["a", "c"]]);
});

test("tying joins the group above, again parts it", () => {
  const tied = toggleTie(ABC, "b");
  assert.deepEqual(tied, [["a", "b"], ["c"]]);
  assert.ok(isTiedAbove(tied, "b"));
  assert.ok(!isTiedAbove(tied, "a"));
  assert.deepEqual(toggleTie(tied, "b"), ABC);
  assert.deepEqual(toggleTie([["a"], ["b", "c"]], "b"), [["a", "b", "c"]]);
  assert.deepEqual(toggleTie(ABC, "a"), ABC);
});

test("weights are 2i / (N (N + 1)), the first most", () => {
  const theta = weights(ABC);
  assert.deepEqual([...theta.values()], [3 / 6, 2 / 6, 1 / 6]);
});

test("a tie shares the mean of its weights, and all weights sum to one", () => {
  const theta = weights([["a", "b"], ["c"], ["d", "e"]]);
  assert.equal(theta.get("a"), (5 + 4) / 2 / 15);
  assert.equal(theta.get("a"), theta.get("b"));
  assert.ok(Math.abs([...theta.values()].reduce((sum, one) => sum + one) - 1) < 1e-15);
});

test("by score: successes from the highest, failures from the lowest, equal totals tied", () => {
  const totals = new Map([
    ["a", 1],
    ["b", 3],
    ["c", 1],
  ]);
  assert.deepEqual(sortByScore(ABC, totals, "success"), [["b"], ["a", "c"]]);
  assert.deepEqual(sortByScore(ABC, totals, "failure"), [["a", "c"], ["b"]]);
});

test("an older order keeps what is still there and takes in what is new", () => {
  assert.deepEqual(reconcile([["c", "x"], ["a"]], ["a", "b", "c"]), [["c"], ["a"], ["b"]]);
});

test("undo and redo walk the same way back and forth", () => {
  const moved = record(record(begin(1), 2), 3);
  const back = undo(undo(moved));
  assert.equal(back.present, 1);
  assert.equal(undo(back), back);
  assert.deepEqual(redo(redo(back)), moved);
  assert.deepEqual(record(back, 9).future, []);
});
