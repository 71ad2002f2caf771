import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import {
  endsOf,
  isSameOrder,
  kindOf,
  markedWords,
  orderFromScores,
  runWords,
  scoreOf,
  select,
  stepsOf,
} from "#js/rankings/segments.js";
import { makeWorld } from "./factories.js";

const VECTORS = JSON.parse(readFileSync(new URL("../core/gap_and_stretch_vectors.json", import.meta.url), "utf8"));
const STRETCHES = [
  { from: 2, to: 3, kind: "good" },
  { from: 6, to: 6, kind: "bad" },
];

for (const { what, outcome, steps, stretches, scores, order } of VECTORS.stretches) {
  test(`as in Python: ${what}`, () => {
    const scoreIn = (id) => scoreOf(stretches[id] ?? [], steps[id]);
    for (const [id, score] of Object.entries(scores)) assert.equal(scoreIn(id), score);
    assert.deepEqual(orderFromScores(Object.keys(steps), scoreIn, outcome), order);
  });
}

test("two orders are the same whoever stands first in a tie", () => {
  assert.ok(isSameOrder([["a", "b"], ["c"]], [["b", "a"], ["c"]]));
  assert.ok(!isSameOrder([["a"], ["b"], ["c"]], [["b", "a"], ["c"]]));
});

test("a step is good, bad or neither", () => {
  assert.deepEqual(
    [1, 2, 3, 4, 5, 6, 7].map((step) => kindOf(STRETCHES, step)),
    [null, "good", "good", null, null, "bad", null],
  );
});

test("steps tell where they led, the colour and the sign of the square, and when they led nowhere", () => {
  const world = makeWorld([
    [-0.5, -3],
    [0, 4],
  ]);
  assert.deepEqual(stepsOf(world, { states: [0, 0, 1, 3], actions: [0, 1, 2] }), [
    { n: 1, state: 0, moved: "stays", colour: "blue", sign: "−" },
    { n: 2, state: 1, moved: "right", colour: "red", sign: "−" },
    { n: 3, state: 3, moved: "down", colour: "goal", sign: "+" },
  ]);
  assert.equal(stepsOf(world, { states: [0, 2], actions: [2] })[0]?.sign, "0");
});

test("a slip is told as the way it went", () => {
  const world = makeWorld([
    [-0.5, -3],
    [0, 4],
  ]);
  assert.equal(stepsOf(world, { states: [0, 2], actions: [1] })[0]?.moved, "down");
});

test("a choice begins anew or reaches on, and never leaves the attempt", () => {
  const nSteps = 9;
  const first = select(null, 4, { extends: true, nSteps });
  assert.deepEqual(first, { anchor: 4, head: 4 });
  const longer = select(first, 7, { extends: true, nSteps });
  assert.deepEqual(longer, { anchor: 4, head: 7 });
  assert.deepEqual(select(longer, 2, { extends: true, nSteps }), { anchor: 4, head: 2 });
  assert.deepEqual(select(longer, 5, { extends: false, nSteps }), { anchor: 5, head: 5 });
  assert.deepEqual(select(longer, 12, { extends: true, nSteps }), { anchor: 4, head: 9 });
  assert.deepEqual(select(longer, -3, { extends: true, nSteps }), { anchor: 4, head: 1 });
  assert.equal(select(null, 1, { extends: false, nSteps: 0 }), null);
});

test("a choice is read from its first step to its last, whichever way it was made", () => {
  assert.deepEqual(endsOf({ anchor: 7, head: 3 }), { from: 3, to: 7 });
  assert.equal(runWords({ from: 3, to: 7 }), "steps 3 to 7");
  assert.equal(runWords({ from: 3, to: 3 }), "step 3");
});

test("what is marked is told in words", () => {
  const [good, bad] = STRETCHES;
  assert.equal(markedWords([]), "nothing marked yet");
  assert.equal(markedWords([good]), "1 good stretch");
  assert.equal(markedWords([good, good]), "2 good stretches");
  assert.equal(markedWords([bad]), "1 bad stretch");
  assert.equal(markedWords([good, good, bad]), "2 good, 1 bad stretch");
  assert.equal(markedWords([good, bad, bad]), "1 good, 2 bad stretches");
});
