import assert from "node:assert/strict";
import test from "node:test";
import { heldOn } from "#js/worlds/gamepad.js";

const [UP, RIGHT, DOWN, LEFT] = [0, 1, 2, 3];
const AT_REST = { buttons: new Set(), stick: null };

/** Where the stick points after a way of positions. */
function pushed(...positions) {
  return positions.reduce((before, axes) => heldOn({ axes, buttons: [] }, before), AT_REST).stick;
}

test("the stick points in four directions, and nowhere within its dead zone", () => {
  assert.equal(pushed([0, -1]), UP);
  assert.equal(pushed([1, 0]), RIGHT);
  assert.equal(pushed([0, 1]), DOWN);
  assert.equal(pushed([-1, 0]), LEFT);
  assert.equal(pushed([0.2, -0.55]), null);
});

test("a stick that trembles at the border of its dead zone stays where it points", () => {
  assert.equal(pushed([0.61, 0], [0.5, 0]), RIGHT);
  assert.equal(pushed([0.61, 0], [0.5, 0], [0.39, 0]), null);
  assert.equal(pushed([0.61, 0], [0.39, 0], [0.5, 0]), null);
});

test("a stick held between two directions keeps the one it had, until it leans clearly to the other", () => {
  assert.equal(pushed([0.9, 0], [0.7, 0.7]), RIGHT);
  assert.equal(pushed([0.9, 0], [0.65, 0.75]), RIGHT);
  assert.equal(pushed([0.9, 0], [0.6, 0.8]), DOWN);
});

test("a gamepad without sticks or with few buttons is read all the same", () => {
  const held = heldOn({ axes: [], buttons: [{ pressed: false }, { pressed: true }] }, AT_REST);
  assert.deepEqual([...held.buttons], [1]);
  assert.equal(held.stick, null);
});
