import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import {
  beginAttempt,
  branch,
  canBranch,
  giveUp,
  lastStep,
  outcomeOf,
  replayActions,
  runOutOfTime,
  slipDirection,
  step,
  totalOf,
  undo,
} from "#js/board/moves.js";
import { makeWorld } from "./factories.js";

const UP = 0;
const RIGHT = 1;
const DOWN = 2;
const LEFT = 3;

const walk = (world, actions, id = "a") => replayActions(world, { id, actions, stepMs: actions.map(() => 1) });

test("the start square is not paid, each square reached is", () => {
  const world = makeWorld([
    [-9, -1, -2],
    [-3, -4, 6],
  ]);
  const attempt = walk(world, [RIGHT, RIGHT, DOWN]);
  assert.deepEqual(attempt.states, [0, 1, 2, 5]);
  assert.deepEqual(attempt.rewards, [-1, -2, 6]);
  assert.equal(totalOf(attempt), 3);
  assert.equal(attempt.ending, "goal");
  assert.equal(outcomeOf(attempt), "success");
});

test("an edge leaves one where one is, and the square is paid again", () => {
  const attempt = walk(
    makeWorld([
      [-9, -1],
      [-3, 4],
    ]),
    [UP],
  );
  assert.deepEqual(attempt.states, [0, 0]);
  assert.deepEqual(attempt.rewards, [-9]);
});

test("a wall is like an edge", () => {
  const world = makeWorld(
    [
      [-9, 0],
      [-3, 4],
    ],
    { walls: [1] },
  );
  assert.deepEqual(walk(world, [RIGHT, DOWN]).states, [0, 0, 2]);
});

test("reaching the goal with less than nothing is a failure", () => {
  assert.equal(
    outcomeOf(
      walk(
        makeWorld([
          [0, -5],
          [-1, 4],
        ]),
        [RIGHT, DOWN],
      ),
    ),
    "failure",
  );
});

test("after the goal nothing moves and nothing is taken back", () => {
  const world = makeWorld([[0, 2]]);
  const done = walk(world, [RIGHT]);
  assert.equal(step(world, done, RIGHT, 1), done);
  assert.equal(undo(done), done);
  assert.equal(giveUp(done), done);
});

test("the last step of the horizon ends the attempt", () => {
  const world = makeWorld([[0, -1, 3]], { horizon: 2 });
  assert.equal(walk(world, [UP, UP]).ending, "out_of_steps");
  assert.equal(walk(world, [RIGHT, RIGHT]).ending, "goal");
});

test("undo takes the last step back wholly", () => {
  const world = makeWorld([[0, -1, 3]]);
  const one = step(world, beginAttempt(world, "a"), RIGHT, 120);
  assert.deepEqual(undo(step(world, one, UP, 80)), one);
  assert.equal(undo(beginAttempt(world, "a")).actions.length, 0);
});

test("giving up, or running out of time, needs a step", () => {
  const world = makeWorld([[0, -1, 3]]);
  const fresh = beginAttempt(world, "a");
  assert.equal(giveUp(fresh), fresh);
  assert.equal(runOutOfTime(fresh), fresh);
  const stopped = giveUp(step(world, fresh, RIGHT, 5));
  assert.equal(stopped.ending, "gave_up");
  assert.equal(outcomeOf(stopped), "failure");
});

test("when the time is up the attempt has failed", () => {
  const world = makeWorld([[0, -1, 3]], { time_limit_s: 5 });
  const late = runOutOfTime(walk(world, [RIGHT]));
  assert.equal(late.ending, "out_of_time");
  assert.equal(outcomeOf(late), "failure");
  assert.equal(step(world, late, RIGHT, 1), late);
  const arrived = walk(world, [RIGHT, RIGHT]);
  assert.equal(runOutOfTime(arrived), arrived, "who is at the goal has arrived");
});

test("a total of exactly nothing is a success, though adding one by one would end below it", () => {
  const ulp = 2 ** -52;
  const cost = -0.75 * ulp;
  const world = makeWorld([[0, -1, cost, cost, cost, cost, 1 + 3 * ulp]]);
  const attempt = walk(world, Array(6).fill(RIGHT));
  assert.ok(attempt.rewards.reduce((sum, reward) => sum + reward) < 0);
  assert.equal(totalOf(attempt), 0);
  assert.equal(outcomeOf(attempt), "success");
});

test("to try again from a step is to begin with the steps before it", () => {
  const world = makeWorld([[0, -1, -2, 3]]);
  const parent = replayActions(world, { id: "p", actions: [RIGHT, RIGHT, LEFT], stepMs: [10, 20, 30] });
  const child = branch(world, parent, 2, "c");
  assert.deepEqual(child, {
    id: "c",
    states: [0, 1, 2],
    actions: [RIGHT, RIGHT],
    rewards: [-1, -2],
    stepMs: [10, 20],
    ending: null,
    slipSeeds: [
      ["p", 0],
      ["c", 2],
    ],
    parentId: "p",
    parentStep: 2,
  });
  assert.equal(step(world, child, RIGHT, 5).ending, "goal");
  assert.equal(parent.actions.length, 3, "the parent stays as it is");
});

test("what was copied is not taken back, and alone it cannot end", () => {
  const world = makeWorld([[0, -1, -2, 3]]);
  const child = branch(world, walk(world, [RIGHT, RIGHT]), 1, "c");
  assert.equal(undo(child), child);
  assert.equal(giveUp(child), child);
  assert.equal(runOutOfTime(child), child);
  assert.deepEqual(undo(step(world, child, RIGHT, 5)), child);
});

test("one can try again where steps were taken, one is left, and it is not over", () => {
  const world = makeWorld([[0, -1, 3]], { horizon: 3 });
  const isPossible = (actions) => [0, 1, 2, 3, 4].map((k) => canBranch(world, walk(world, actions), k));
  assert.deepEqual(isPossible([UP, UP, UP]), [false, true, true, false, false]);
  assert.deepEqual(isPossible([RIGHT, RIGHT]), [false, true, false, false, false]);
  assert.throws(() => branch(world, walk(world, [RIGHT, RIGHT]), 2, "c"), RangeError);
});

test("copied steps slip as they did, own steps by the new id", () => {
  const world = makeWorld([[0, -1, -1, -1, -1, 3]], { slip: 0.6 });
  const actions = Array(6).fill(UP);
  const grandparent = walk(world, actions, "g");
  const parent = [UP, UP].reduce((a, up) => step(world, a, up, 1), branch(world, grandparent, 3, "p"));
  const child = step(world, branch(world, parent, 4, "c"), UP, 1);
  assert.deepEqual(child.slipSeeds, [
    ["g", 0],
    ["p", 3],
    ["c", 4],
  ]);
  assert.deepEqual(child.states.slice(0, 4), grandparent.states.slice(0, 4));
  assert.deepEqual(child.states.slice(0, 5), parent.states.slice(0, 5));
  assert.equal(lastStep(world, child).taken, slipDirection("c", 4, UP, 0.6));
  const early = branch(world, child, 3, "e");
  assert.deepEqual(
    early.slipSeeds,
    [
      ["g", 0],
      ["e", 3],
    ],
    "a seed that never decided a step is left out",
  );
});

test("an attempt that is walked again is the same, its parent included", () => {
  const world = makeWorld([[0, -1, -1, -1, -1, 3]], { slip: 0.4 });
  const parent = walk(world, [RIGHT, UP, UP], "p");
  const child = [RIGHT, UP].reduce((a, action) => step(world, a, action, 7), branch(world, parent, 2, "c"));
  assert.deepEqual(replayActions(world, child), child);
});

test("walking again stops where the attempt is over, and a time that is missing is 0", () => {
  const world = makeWorld([[0, -1, 3]]);
  const attempt = replayActions(world, { id: "a", actions: [RIGHT, RIGHT, UP], stepMs: [5] });
  assert.deepEqual(attempt.actions, [RIGHT, RIGHT]);
  assert.deepEqual(attempt.stepMs, [5, 0]);
  assert.equal(attempt.ending, "goal");
});

test("browser and core slip alike", () => {
  const rows = JSON.parse(readFileSync(new URL("../core/slip_vectors.json", import.meta.url), "utf8"));
  assert.ok(rows.length > 0);
  for (const { attempt_id, step: number, intended, slip, direction } of rows) {
    assert.equal(slipDirection(attempt_id, number, intended, slip), direction, `${attempt_id}:${number}`);
  }
});

test("a slip of p is taken with probability p, each other way a third of it", () => {
  const counts = [0, 0, 0, 0];
  for (let i = 0; i < 30_000; i++) counts[slipDirection("some attempt", i, DOWN, 0.3)] += 1;
  const expected = [3000, 3000, 21_000, 3000];
  for (const [i, n] of counts.entries()) assert.ok(Math.abs(n - expected[i]) < 300, `${counts}`);
});
