import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";
import { beginAttempt, giveUp, outcomeOf, replayActions, slipDirection, step, totalOf, undo } from "#js/board/moves.js";
import { makeWorld } from "./factories.js";

const UP = 0;
const RIGHT = 1;
const DOWN = 2;

test("the start square is not paid, each square reached is", () => {
  const world = makeWorld([
    [-9, -1, -2],
    [-3, -4, 6],
  ]);
  const attempt = replayActions(world, "a", [RIGHT, RIGHT, DOWN], []);
  assert.deepEqual(attempt.states, [0, 1, 2, 5]);
  assert.deepEqual(attempt.rewards, [-1, -2, 6]);
  assert.equal(totalOf(attempt), 3);
  assert.equal(attempt.ending, "goal");
  assert.equal(outcomeOf(attempt), "success");
});

test("an edge leaves one where one is, and the square is paid again", () => {
  const attempt = replayActions(
    makeWorld([
      [-9, -1],
      [-3, 4],
    ]),
    "a",
    [UP],
    [],
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
  assert.deepEqual(replayActions(world, "a", [RIGHT, DOWN], []).states, [0, 0, 2]);
});

test("reaching the goal with less than nothing is a failure", () => {
  assert.equal(
    outcomeOf(
      replayActions(
        makeWorld([
          [0, -5],
          [-1, 4],
        ]),
        "a",
        [RIGHT, DOWN],
        [],
      ),
    ),
    "failure",
  );
});

test("after the goal nothing moves and nothing is taken back", () => {
  const world = makeWorld([[0, 2]]);
  const done = replayActions(world, "a", [RIGHT], []);
  assert.equal(step(world, done, RIGHT, 1), done);
  assert.equal(undo(done), done);
  assert.equal(giveUp(done), done);
});

test("the last step of the horizon ends the attempt", () => {
  const world = makeWorld([[0, -1, 3]], { horizon: 2 });
  assert.equal(replayActions(world, "a", [UP, UP], []).ending, "out_of_steps");
  assert.equal(replayActions(world, "a", [RIGHT, RIGHT], []).ending, "goal");
});

test("undo takes the last step back wholly", () => {
  const world = makeWorld([[0, -1, 3]]);
  const one = step(world, beginAttempt(world, "a"), RIGHT, 120);
  assert.deepEqual(undo(step(world, one, UP, 80)), one);
  assert.equal(undo(beginAttempt(world, "a")).actions.length, 0);
});

test("giving up needs a step", () => {
  const world = makeWorld([[0, -1, 3]]);
  const fresh = beginAttempt(world, "a");
  assert.equal(giveUp(fresh), fresh);
  const stopped = giveUp(step(world, fresh, RIGHT, 5));
  assert.equal(stopped.ending, "gave_up");
  assert.equal(outcomeOf(stopped), "failure");
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
