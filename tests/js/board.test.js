import assert from "node:assert/strict";
import test from "node:test";
import {
  fromOklab,
  luminance,
  makeScale,
  parseColour,
  shade,
  symmetricRange,
  toOklab,
  valueDepth,
  wantsDarkInk,
  worldDepth,
} from "#js/board/colours.js";
import { describePosition } from "#js/board/describe.js";
import { facingOf } from "#js/board/facing.js";
import { makeWorld } from "./factories.js";

const scale = makeScale({
  red: parseColour("#b2182b"),
  middle: parseColour("rgb(247, 247, 247)"),
  blue: parseColour("#2166ac"),
});

test("OKLab and back gives the same colour", () => {
  for (const colour of [
    [178, 24, 43],
    [0, 0, 0],
    [255, 255, 255],
    [33, 102, 172],
  ]) {
    assert.deepEqual(fromOklab(toOklab(colour)), colour);
  }
});

test("the ends of the scale are the colours asked for", () => {
  assert.deepEqual(shade(scale, "red", 1), [178, 24, 43]);
  assert.deepEqual(shade(scale, "blue", 1), [33, 102, 172]);
  assert.deepEqual(shade(scale, "red", 0), shade(scale, "blue", 0));
});

test("a square that costs more is deeper, within its kind", () => {
  assert.ok(worldDepth("red", -7).depth > worldDepth("red", -1).depth);
  assert.ok(worldDepth("blue", -1).depth > worldDepth("blue", -0.1).depth);
  assert.equal(worldDepth("red", -7).depth, 1);
});

test("the palest red and the palest blue are told apart", () => {
  const red = shade(scale, "red", worldDepth("red", -1).depth);
  const blue = shade(scale, "blue", worldDepth("blue", 0).depth);
  const [a, b] = [toOklab(red), toOklab(blue)];
  assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) > 0.08);
});

test("ink holds a contrast of at least 3.8 on every shade", () => {
  for (const arm of ["red", "blue"]) {
    for (let depth = 0; depth <= 1; depth += 0.01) {
      const ground = shade(scale, arm, depth);
      const ink = luminance(wantsDarkInk(ground) ? parseColour("#16191b") : [255, 255, 255]);
      const [light, dark] = [Math.max(ink, luminance(ground)), Math.min(ink, luminance(ground))];
      assert.ok((light + 0.05) / (dark + 0.05) >= 3.8, `${arm} ${depth}`);
    }
  }
});

test("learned values diverge about zero", () => {
  assert.deepEqual(symmetricRange([-2, 1]), [-2, 2]);
  assert.deepEqual(symmetricRange([0, 0]), [-1, 1]);
  assert.deepEqual(valueDepth(-1, [-2, 2]), { arm: "red", depth: 0.5 });
  assert.deepEqual(valueDepth(3, [-2, 2]), { arm: "blue", depth: 1 });
});

test("a position is told with its four neighbours", () => {
  const world = makeWorld(
    [
      [0, -3.14, -1],
      [-0.5, -0.2, 5],
    ],
    { walls: [3] },
  );
  assert.equal(
    describePosition(world, 0),
    "Row 1, column 1. Up: the edge; right: red \u22123.1; down: a wall; left: the edge.",
  );
  assert.equal(
    describePosition(world, 4),
    "Row 2, column 2. Up: red \u22123.1; right: the goal, plus 5; down: the edge; left: a wall.",
  );
});

test("an agent looks where it went, and where it meant to go when it bumped", () => {
  const world = makeWorld([
    [0, -1],
    [-1, 5],
  ]);
  assert.equal(facingOf(world, { states: [0, 1] }, 1), 1);
  assert.equal(facingOf(world, { states: [0, 2] }, 1), 2);
  assert.equal(facingOf(world, { states: [0, 0], actions: [3] }, 1), 3);
  assert.equal(facingOf(world, { states: [0] }, 0), null);
});
