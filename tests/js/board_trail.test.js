import assert from "node:assert/strict";
import test from "node:test";
import { nextState } from "#js/board/state.js";
import { changedSquares, edgesOf, FADED_AFTER, strengthOf } from "#js/board/trail.js";
import { makeWorld } from "./factories.js";

const world = makeWorld(Array.from({ length: 30 }, () => Array.from({ length: 30 }, () => -1)));

/** A walk that turns about a lot and bumps at times. @param {number} n steps */
function wander(n) {
  const states = [0];
  for (let i = 0, seed = 7; i < n; i++) {
    seed = (seed * 1103515245 + 12345) % 2147483648;
    states.push(nextState(world, states[i], Math.floor(seed / 256) % 4));
  }
  return states;
}

const path = (states, more = {}) => ({ states, who: "human", fade: true, ...more });
const keyOf = ({ from, to, age }) => `${Math.min(from, to)}–${Math.max(from, to)} ${strengthOf(age).toFixed(3)}`;
/** Every line as it looks, whether it still fades or not. */
const looksOf = ({ settled, fading }) => new Set([...settled, ...fading].map(keyOf));

test("a step changes no line outside the squares that are painted anew", () => {
  const states = wander(400);
  for (const [n, m] of [
    [200, 201],
    [201, 200],
    [200, 230],
    [300, 3],
    [1, 2],
  ]) {
    const [before, after] = [path(states.slice(0, n)), path(states.slice(0, m))];
    const box = changedSquares(world, before, after);
    const isInside = (state) => {
      const [row, col] = [Math.floor(state / 30), state % 30];
      return row >= box.top && row <= box.bottom && col >= box.left && col <= box.right;
    };
    const [old, fresh] = [looksOf(edgesOf(world, before, null)), looksOf(edgesOf(world, after, null))];
    for (const edge of difference(old, fresh)) {
      const [from, to] = edge.split(" ")[0].split("–").map(Number);
      assert.ok(isInside(from) && isInside(to), `${n} → ${m}: ${edge}`);
    }
  }
});

/** @param {Set<string>} a @param {Set<string>} b */
function difference(a, b) {
  return [...a, ...b].filter((one) => a.has(one) !== b.has(one));
}

test("what is painted anew does not grow with the length of a path", () => {
  const there = Array.from({ length: 30 }, (_, i) => i);
  const states = Array.from({ length: 200 }, () => [...there, ...there.slice(1, -1).reverse()]).flat();
  const before = path(states.slice(0, 9_000));
  const after = path(states.slice(0, 9_001));
  const box = changedSquares(world, before, after);
  assert.ok(box.right - box.left <= FADED_AFTER + 2);
  const { settled, fading } = edgesOf(world, after, box);
  assert.ok(settled.length + fading.length <= 2 * FADED_AFTER);
});

test("a line walked often is drawn once, as strong as it was walked last", () => {
  const { settled, fading } = edgesOf(world, path([0, 1, 0, 1, 2]), null);
  assert.deepEqual(settled, []);
  assert.deepEqual(fading, [
    { from: 0, to: 1, age: 1 },
    { from: 1, to: 2, age: 0 },
  ]);
});

test("in a world of one column too the way down and the way right are different lines", () => {
  const column = makeWorld([[-1], [-1], [5]]);
  const { settled } = edgesOf(column, path([0, 1, 2], { fade: false }), null);
  assert.equal(settled.length, 2);
});

test("the same path again paints nothing; another look paints all of it", () => {
  const states = wander(50);
  assert.equal(changedSquares(world, path(states), path([...states])), null);
  assert.equal(changedSquares(world, null, null), null);
  const box = changedSquares(world, path(states), path(states, { who: "meirl" }));
  assert.deepEqual(box, changedSquares(world, null, path(states)));
});

test("lines pale with every step, never wholly", () => {
  assert.equal(strengthOf(0), 1);
  for (let age = 1; age < 30; age++) assert.ok(strengthOf(age) <= strengthOf(age - 1));
  assert.ok(strengthOf(1000) > 0.2);
});
