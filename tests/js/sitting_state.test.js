import assert from "node:assert/strict";
import test from "node:test";
import { flat, holdsTheSame } from "#js/rankings/order.js";
import { apply, beginState } from "#js/rankings/sitting-state.js";
import { dice, drawnOrder } from "./random.js";

const N_WALKS = 400;
const begin = (orders) => ({ type: "begin", means: "page", orders, way: "lists" });
const after = (state, ...changes) =>
  changes.reduce((now, change) => apply(now, { means: "key", ...change }) ?? now, state);
const success = (more) => ({ outcome: "success", ...more });
const ABC = beginState(begin({ success: [["a"], ["b"], ["c"]], failure: [["x"], ["y"]] }));
const UNDO = { type: "undo" };
const REDO = { type: "redo" };
const TOP = success({ type: "place", id: "c", group: 0, joins: false });
const TIE = success({ type: "place", id: "c", group: 0, joins: true });

/** Any change, most of them possible. @param {any} state @param {any} rng */
function drawn(state, rng) {
  const outcome = rng.of(["success", "failure"]);
  const order = state.present.orders[outcome];
  const ids = flat(order);
  const [id, other] = [rng.of(ids), rng.of(ids)];
  return rng.of([
    { type: "place", outcome, id, group: rng.upTo(order.length + 1), joins: rng.next() < 0.4 },
    { type: "place", outcome, id, group: rng.upTo(order.length + 1), joins: rng.next() < 0.4 },
    { type: "swap", outcome, id, with: other },
    { type: "set", outcome, order: [...order].reverse(), by: "score" },
    { type: "lift", outcome, id },
    { type: rng.of(["drop", "put_back", "undo", "redo"]) },
    { type: "answer", outcome, a: id, b: other, said: rng.of(["a", "b", "alike"]) },
    { type: "gap", outcome, above: id, below: other, value: rng.of([null, 10, 90]) },
    { type: "stretch", id, from: 1 + rng.upTo(5), to: 5 + rng.upTo(5), kind: rng.of(["good", "bad", null]) },
  ]);
}

/** A walk of so many changes; each step is told. @param {number} seed @param {(before: any, change: any, after: any, rng: any) => void} [step] */
function walk(seed, step = () => {}) {
  const rng = dice(seed);
  let state = beginState(
    begin({ success: drawnOrder(rng, 1 + rng.upTo(6), "s"), failure: drawnOrder(rng, 1 + rng.upTo(6), "f") }),
  );
  for (let n = rng.upTo(40); n > 0; n -= 1) {
    const change = drawn(state, rng);
    const next = apply(state, change);
    step(state, change, next, rng);
    state = next ?? state;
  }
  return state;
}

test("any sequence of changes keeps, in past, present and future, an order of exactly the cards there are", () => {
  for (let seed = 0; seed < N_WALKS; seed += 1) {
    walk(seed, (before, _change, next) => {
      for (const { orders } of next ? [...next.past, next.present, ...next.future] : [])
        for (const outcome of ["success", "failure"])
          assert.ok(holdsTheSame(before.present.orders[outcome], orders[outcome]));
    });
  }
});

test("from anywhere, undo all the way comes to the beginning, and redo all the way comes back exactly", () => {
  for (let seed = 0; seed < N_WALKS; seed += 1) {
    const end = after(walk(seed), { type: "drop" });
    let state = end;
    while (state.past.length > 0) state = apply(state, UNDO);
    assert.equal(state.future.length, end.past.length + end.future.length);
    for (const _ of end.past) state = apply(state, REDO);
    assert.deepEqual(state, end);
  }
});

test("k steps back and k forward change nothing, for any k", () => {
  for (let seed = 0; seed < N_WALKS; seed += 1) {
    const end = after(walk(seed), { type: "drop" });
    const k = dice(seed).upTo(end.past.length + 1);
    let state = end;
    for (let i = 0; i < k; i += 1) state = apply(state, UNDO);
    for (let i = 0; i < k; i += 1) state = apply(state, REDO);
    assert.deepEqual(state, end);
  }
});

test("a change is one step of undo, and undo brings back what was there before it", () => {
  for (let seed = 0; seed < N_WALKS; seed += 1) {
    walk(seed, (before, change, next) => {
      const isChange = ["place", "swap", "set", "answer", "gap", "stretch"].includes(change.type);
      if (!isChange || !next || next === before || before.mark) return;
      assert.deepEqual(apply(next, UNDO).present, before.present);
      assert.equal(next.past.length, before.past.length + 1);
    });
  }
});

test("every state is frozen in time: a change leaves the one before it as it was", () => {
  for (let seed = 0; seed < N_WALKS; seed += 1) {
    /** @type {[any, string][]} */
    const seen = [];
    walk(seed, (before) => seen.push([before, JSON.stringify(before)]));
    for (const [state, text] of seen) assert.equal(JSON.stringify(state), text);
  }
});

test("a change that changes nothing is no step", () => {
  assert.equal(apply(ABC, success({ type: "place", id: "a", group: 0, joins: false })), ABC);
  assert.equal(apply(ABC, success({ type: "set", order: [["a"], ["b"], ["c"]], by: "score" })), ABC);
  assert.equal(apply(ABC, { type: "stretch", id: "a", from: 1, to: 3, kind: null }), ABC);
});

test("what cannot be is refused", () => {
  for (const change of [
    success({ type: "place", id: "x", group: 0, joins: false }),
    success({ type: "place", id: "a", group: 3, joins: false }),
    success({ type: "place", id: "a", group: 2, joins: true }),
    success({ type: "swap", id: "a", with: "a" }),
    success({ type: "set", order: [["a"], ["b"]], by: "score" }),
    success({ type: "answer", a: "a", b: "x", said: "a" }),
    { type: "stretch", id: "a", from: 0, to: 3, kind: "good" },
    { type: "stretch", id: "nobody", from: 1, to: 3, kind: "good" },
    success({ type: "cards", added: ["x"], removed: [] }),
    { type: "drop" },
    { type: "put_back" },
    UNDO,
    REDO,
    { type: "begin" },
    { type: "nonsense" },
  ])
    assert.equal(apply(ABC, change), null, JSON.stringify(change));
});

test("a new change forgets what had been undone", () => {
  const state = after(ABC, TOP, UNDO, TIE);
  assert.equal(apply(state, REDO), null);
  assert.deepEqual(state.present.orders.success, [["a", "c"], ["b"]]);
});

test("a lift with many moves is one step; put back, it is none", () => {
  const lifted = after(ABC, success({ type: "lift", id: "c" }), TIE, TOP);
  assert.equal(lifted.past.length, 1);
  assert.deepEqual(after(lifted, { type: "drop" }, UNDO).present, ABC.present);
  const back = after(lifted, { type: "put_back" });
  assert.deepEqual([back.present, back.past, back.future], [ABC.present, [], []]);
});

test("a lift that leads back to where it began is no step, and what had been undone can still be done again", () => {
  const undone = after(ABC, TOP, UNDO);
  const home = success({ type: "place", id: "c", group: 2, joins: false });
  const state = after(undone, success({ type: "lift", id: "c" }), TIE, home, { type: "drop" });
  assert.deepEqual([state.past, state.future], [undone.past, undone.future]);
  assert.deepEqual(after(state, REDO).present.orders.success, [["c"], ["a"], ["b"]]);
});

test("a list is touched by the first change in it, undone or not", () => {
  assert.deepEqual(ABC.touched, { success: false, failure: false });
  assert.deepEqual(after(ABC, TOP, UNDO).touched, { success: true, failure: false });
  assert.deepEqual(after(ABC, { type: "stretch", id: "x", from: 1, to: 2, kind: "bad" }).touched, {
    success: false,
    failure: true,
  });
  assert.deepEqual(after(ABC, success({ type: "lift", id: "c" }), { type: "put_back" }).touched.success, false);
});

test("cards that come and go do so in past, present and future, with all that was said of them", () => {
  const said = after(
    ABC,
    success({ type: "answer", a: "a", b: "b", said: "a" }),
    success({ type: "gap", above: "a", below: "b", value: 30 }),
    { type: "stretch", id: "b", from: 1, to: 2, kind: "good" },
    TOP,
    UNDO,
    success({ type: "cards", added: ["d"], removed: ["b"] }),
  );
  for (const content of [...said.past, said.present, ...said.future]) {
    assert.deepEqual(flat(content.orders.success).sort(), ["a", "c", "d"]);
    assert.deepEqual([content.answers.success, content.gaps.success, content.stretches], [[], [], {}]);
  }
  assert.deepEqual(after(said, REDO).present.orders.success, [["c"], ["a"], ["d"]]);
});

test("stretches do not overlap, and neighbours of one kind are one", () => {
  const paint = (from, to, kind) => ({ type: "stretch", id: "a", from, to, kind });
  const of = (...changes) => after(ABC, ...changes).present.stretches.a;
  assert.deepEqual(of(paint(1, 3, "good"), paint(4, 6, "good")), [{ from: 1, to: 6, kind: "good" }]);
  assert.deepEqual(of(paint(1, 9, "good"), paint(4, 5, "bad")), [
    { from: 1, to: 3, kind: "good" },
    { from: 4, to: 5, kind: "bad" },
    { from: 6, to: 9, kind: "good" },
  ]);
  assert.equal(of(paint(1, 9, "good"), paint(1, 12, null)), undefined);
});
