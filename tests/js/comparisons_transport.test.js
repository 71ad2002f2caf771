import assert from "node:assert/strict";
import test from "node:test";
import { episodeOf, lengthOf, momentAt } from "#js/comparisons/rollouts.js";
import { Transport } from "#js/comparisons/transport.js";
import { makeWorld } from "./factories.js";

const transportOf = (length) => {
  const transport = new Transport();
  transport.load(length);
  return transport;
};

test("at speed 1 four steps pass in a second, at speed 2 eight", () => {
  const transport = transportOf(20);
  transport.play();
  transport.advance(1000);
  assert.equal(transport.step, 4);
  transport.speed = 2;
  transport.advance(1000);
  assert.equal(transport.step, 12);
});

test("paused it does not move, nudged it pauses and moves one step", () => {
  const transport = transportOf(20);
  transport.play();
  transport.nudge(1);
  assert.equal(transport.advance(1000), false);
  assert.equal(transport.step, 1);
  transport.nudge(-5);
  assert.equal(transport.step, 0);
});

test("a loop rests at the end, then starts again", () => {
  const transport = transportOf(4);
  transport.play();
  transport.advance(5000);
  assert.equal(transport.step, 4);
  transport.advance(600);
  assert.equal(transport.step, 4);
  transport.advance(700);
  assert.equal(transport.step, 0);
  assert.equal(transport.isPlaying, true);
});

test("without a loop it stops, and play starts over", () => {
  const transport = transportOf(4);
  transport.loop = false;
  transport.play();
  transport.advance(5000);
  transport.advance(16);
  assert.equal(transport.isPlaying, false);
  transport.play();
  assert.equal(transport.step, 0);
});

const world = makeWorld([
  [-0.5, -0.25],
  [-3, 4],
]);
const walk = { states: [0, 0, 1, 3], total: 3.25, reached_goal: true };

test("totals run along and facing keeps its last real move", () => {
  assert.deepEqual([momentAt(world, walk, 0).total, momentAt(world, walk, 0).facing], [0, null]);
  assert.equal(momentAt(world, walk, 1).total, -0.5);
  assert.equal(momentAt(world, walk, 2).total, -0.75);
  assert.equal(momentAt(world, walk, 2).facing, 1);
  assert.equal(momentAt(world, walk, 3).facing, 2);
});

test("who has arrived waits at the goal with the flag up", () => {
  const moment = momentAt(world, walk, 99);
  assert.deepEqual([moment.state, moment.total, moment.isOver, moment.reachedGoal], [3, 3.25, true, true]);
  assert.equal(momentAt(world, walk, 2).reachedGoal, false);
});

test("a person's attempt comes round again in each of the fifty episodes", () => {
  const cast = [{ episodes: [walk] }, { episodes: [{ ...walk, states: [0, 1, 0, 1, 3] }, walk] }];
  assert.equal(episodeOf(cast[0].episodes, 7), walk);
  assert.equal(lengthOf(cast, 0), 4);
  assert.equal(lengthOf(cast, 1), 3);
  assert.equal(episodeOf(undefined, 0), null);
});
