import assert from "node:assert/strict";
import test from "node:test";
import { crop, cropTo, cropView, windowAround } from "#js/board/crop.js";
import { describeSquare, describeWay, wordsOf } from "#js/board/describe.js";
import { EMPTY_VIEW } from "#js/board/state.js";
import { makeWorld } from "./factories.js";

const small = makeWorld(
  [
    [0, -3.24, -1],
    [-0.5, -0.2, 5],
  ],
  { walls: [3] },
);
const large = makeWorld(
  Array.from({ length: 20 }, (_, row) => Array.from({ length: 30 }, (_, col) => -row - col / 100)),
);

test("a square is told with its place, its colour and its reward", () => {
  assert.equal(describeSquare(small, 1), "Row 1, column 2: red, \u22123.2.");
  assert.equal(describeSquare(small, 0), "Row 1, column 1: blue, 0.0, the start.");
  assert.equal(describeSquare(small, 3), "Row 2, column 1: a wall.");
  assert.equal(describeSquare(small, 5), "Row 2, column 3: the goal, plus 5.");
  assert.deepEqual(
    [1, 3, 5].map((state) => wordsOf(small, state)),
    ["red \u22123.2", "wall", "goal +5"],
  );
});

test("a goal that pays a part of a point does not pay nothing", () => {
  const painted = makeWorld([[0, 0.4]]);
  assert.equal(describeSquare(painted, 1), "Row 1, column 2: the goal, plus 0.4.");
  assert.equal(wordsOf(painted, 1), "goal +0.4");
});

test("the way to the nearest goal is told as steps down and aside", () => {
  assert.equal(describeWay(small, 0), "The goal is 1 down and 2 right.");
  assert.equal(describeWay(small, 2), "The goal is 1 down.");
  assert.equal(describeWay(small, 5), "This is the goal.");
  const two = { ...large, goals: [0, 599] };
  assert.equal(describeWay(two, 33), "The nearest goal is 1 up and 3 left.");
});

test("a crop is a world of its own, whose squares are those of the world", () => {
  const { world, toLocal, toGlobal } = crop(large, 10 * 30 + 15, 5);
  assert.deepEqual([world.rows, world.cols], [5, 5]);
  for (let state = 0; state < 25; state++) {
    assert.equal(toLocal(toGlobal(state)), state);
    const [row, col] = [Math.floor(toGlobal(state) / 30), toGlobal(state) % 30];
    assert.equal(world.rewards[Math.floor(state / 5)]?.[state % 5], large.rewards[row]?.[col]);
  }
  assert.equal(toLocal(0), null);
  assert.deepEqual([world.start, world.goal, world.goals], [-1, -1, []]);
});

test("at the edge of the world a crop stays inside it, and it is never larger than the world", () => {
  const corner = crop(large, 599, 5);
  assert.equal(corner.toGlobal(24), 599);
  assert.deepEqual(corner.world.goals, [24]);
  assert.deepEqual([crop(small, 0, 9).world.rows, crop(small, 0, 9).world.cols], [2, 3]);
});

test("what is shown stays while somebody walks in its middle and moves on before they leave it", () => {
  const first = windowAround(large, 10 * 30 + 15, 9);
  assert.equal(windowAround(large, 10 * 30 + 17, 9, first), first);
  const next = windowAround(large, 10 * 30 + 18, 9, first);
  assert.notEqual(next, first);
  assert.ok(next.left <= 16 && next.left + 9 > 20);
  const corner = windowAround(large, 0, 9);
  assert.equal(windowAround(large, 1, 9, corner), corner);
});

test("a cropped view keeps its scale and the last stretch of the path", () => {
  const part = cropTo(large, { top: 0, left: 0, rows: 5, cols: 5 });
  const values = Array.from({ length: 600 }, (_, state) => state - 300);
  const view = {
    ...EMPTY_VIEW,
    values,
    paths: [{ states: [3, 4, 5, 4, 34], who: "human" }],
    agents: [{ state: 34, who: "human" }],
  };
  const near = cropView(view, part);
  assert.deepEqual(near.scale, [-300, 300]);
  assert.equal(near.values?.[5], values[30]);
  assert.deepEqual(near.paths[0]?.states, [4, 9]);
  assert.deepEqual(near.agents, [{ state: 9, who: "human" }]);
  assert.deepEqual(cropView({ ...view, agents: [{ state: 599, who: "human" }] }, part).agents, []);
});
