import assert from "node:assert/strict";
import test from "node:test";
import {
  displayRanks,
  flat,
  groupOf,
  holdsTheSame,
  isInTie,
  place,
  reconcile,
  sortByScore,
  step,
  swap,
  toggleTie,
  weights,
} from "#js/rankings/order.js";
import { dice, drawnOrder } from "./random.js";

const ABC = [["a"], ["b"], ["c"]];
const alone = (group) => ({ group, joins: false });
const into = (group) => ({ group, joins: true });
const stepped = (order, id, by) => place(order, id, step(order, id, by));
const tied = (order, id) => place(order, id, toggleTie(order, id));

test("a card goes alone before a group, or after the last", () => {
  assert.deepEqual(place(ABC, "c", alone(0)), [["c"], ["a"], ["b"]]);
  assert.deepEqual(place(ABC, "a", alone(1)), [["b"], ["a"], ["c"]]);
  assert.deepEqual(place(ABC, "a", alone(2)), [["b"], ["c"], ["a"]]);
  assert.deepEqual(place(ABC, "b", alone(1)), ABC);
});

test("a card goes into a group, as its last", () => {
  assert.deepEqual(place(ABC, "c", into(0)), [["a", "c"], ["b"]]);
  assert.deepEqual(place([["a", "b"], ["c"]], "c", into(0)), [["a", "b", "c"]]);
});

test("a card that leaves its tie leaves the others tied", () => {
  assert.deepEqual(place([["a", "b", "c"]], "b", alone(0)), [["b"], ["a", "c"]]);
});

test("two cards change places, out of their ties as well", () => {
  assert.deepEqual(swap([["a", "b"], ["c"]], "b", "c"), [["a", "c"], ["b"]]);
});

test("a step goes past one group; out of a tie it goes beside it", () => {
  assert.deepEqual(stepped(ABC, "b", -1), [["b"], ["a"], ["c"]]);
  assert.deepEqual(stepped(ABC, "b", 1), [["a"], ["c"], ["b"]]);
  assert.deepEqual(stepped([["a", "b"], ["c"]], "b", -1), [["b"], ["a"], ["c"]]);
  assert.deepEqual(stepped([["a", "b"], ["c"]], "a", 1), [["b"], ["a"], ["c"]]);
  assert.deepEqual(stepped(ABC, "a", 5), [["b"], ["c"], ["a"]]);
  assert.equal(step(ABC, "a", -1), null);
  assert.equal(step(ABC, "c", 1), null);
});

test("tying joins the group above, again parts it", () => {
  assert.deepEqual(tied(ABC, "b"), [["a", "b"], ["c"]]);
  assert.deepEqual(tied([["a", "b"], ["c"]], "b"), ABC);
  assert.deepEqual(tied([["a"], ["b", "c"]], "b"), [["a"], ["c"], ["b"]]);
  assert.equal(toggleTie(ABC, "a"), null);
});

test("by score: successes from the highest, failures from the lowest, equal totals tied", () => {
  const totals = new Map(Object.entries({ a: 1, b: 3, c: 1 }));
  assert.deepEqual(sortByScore(ABC, totals, "success"), [["b"], ["a", "c"]]);
  assert.deepEqual(sortByScore(ABC, totals, "failure"), [["a", "c"], ["b"]]);
});

test("an older order keeps what is still there and takes in what is new, last", () => {
  assert.deepEqual(reconcile([["c", "x"], ["a"]], ["b"], ["x"]), [["c"], ["a"], ["b"]]);
});

test("an order holds the same cards as another only if it holds each once and no empty group", () => {
  assert.ok(holdsTheSame(ABC, [["c", "b"], ["a"]]));
  for (const other of [
    [["a"], ["b"]],
    [["a"], ["b"], ["c"], ["c"]],
    [["a"], ["b"], ["d"]],
    [["a", "b", "c"], []],
  ])
    assert.ok(!holdsTheSame(ABC, other), JSON.stringify(other));
});

test("places are counted from the top, and a tie shares its first", () => {
  const ranks = displayRanks([["a"], ["b", "c"], ["d"]]);
  assert.deepEqual(Object.fromEntries(ranks), { a: 1, b: 2, c: 2, d: 4 });
});

test("weights are 2i / (N (N + 1)), the first most", () => {
  assert.deepEqual([...weights(ABC).values()], [3 / 6, 2 / 6, 1 / 6]);
});

test("of any order: weights sum to one, rise with rank, are equal in a tie, and its mean of those without ties", () => {
  for (let seed = 1; seed <= 500; seed += 1) {
    const rng = dice(seed);
    const order = drawnOrder(rng, 1 + rng.upTo(40));
    const n = flat(order).length;
    const theta = weights(order);
    const plain = flat(order).map((_, i) => (2 * (n - i)) / (n * (n + 1)));
    assert.ok(Math.abs([...theta.values()].reduce((sum, one) => sum + one, 0) - 1) < 1e-12);
    let at = 0;
    let above = Number.POSITIVE_INFINITY;
    for (const group of order) {
      const here = group.map((id) => theta.get(id));
      const mean = plain.slice(at, at + group.length).reduce((sum, one) => sum + one, 0) / group.length;
      assert.ok(here.every((one) => one === here[0] && Math.abs(one - mean) < 1e-12 && one < above));
      above = here[0];
      at += group.length;
    }
  }
});

test("wherever a card goes, the order stays one of the same cards, and all others keep theirs", () => {
  for (let seed = 1; seed <= 2000; seed += 1) {
    const rng = dice(seed);
    const order = drawnOrder(rng, 1 + rng.upTo(12));
    const id = rng.of(flat(order));
    for (const where of [
      step(order, id, -1),
      step(order, id, 1),
      step(order, id, rng.upTo(9) - 4),
      toggleTie(order, id),
    ]) {
      if (!where) continue;
      const next = place(order, id, where);
      assert.ok(holdsTheSame(order, next));
      const others = (one) => one.map((group) => group.filter((other) => other !== id)).filter((group) => group[0]);
      assert.deepEqual(others(next), others(order));
      assert.equal(isInTie(next, id), where.joins);
    }
  }
});

test("from anywhere, steps up come to the top in as many as there are groups above", () => {
  for (let seed = 1; seed <= 300; seed += 1) {
    const rng = dice(seed);
    let order = drawnOrder(rng, 1 + rng.upTo(12));
    const id = rng.of(flat(order));
    let nSteps = groupOf(order, id) + (isInTie(order, id) ? 1 : 0);
    for (let where = step(order, id, -1); where; where = step(order, id, -1), nSteps -= 1)
      order = place(order, id, where);
    assert.equal(nSteps, 0);
    assert.deepEqual(order[0], [id]);
  }
});
