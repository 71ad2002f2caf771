import assert from "node:assert/strict";
import test from "node:test";
import { heldOn, listenToGamepad } from "#js/worlds/gamepad.js";

const [UP, RIGHT, DOWN, LEFT] = [0, 1, 2, 3];
const AT_REST = { buttons: new Set(), stick: null };

/** Where the stick points after a way of positions. */
function pushed(...positions) {
  return positions.reduce((before, axes) => heldOn({ axes, buttons: [] }, before), AT_REST).stick;
}

/** A page with one gamepad, whose frames we draw; and a player who writes down what happens. */
function playing() {
  const frames = [];
  const pad = {
    index: 0,
    connected: true,
    timestamp: 0,
    axes: [0, 0],
    buttons: Array.from({ length: 16 }, () => ({ pressed: false })),
  };
  const page = { hidden: false, open: [], hasFocus: () => true, querySelectorAll: () => document.open };
  globalThis.document = Object.assign(new EventTarget(), page);
  globalThis.window = new EventTarget();
  globalThis.requestAnimationFrame = (callback) => frames.push(callback);
  Object.defineProperty(globalThis, "navigator", { value: { getGamepads: () => [pad] }, configurable: true });
  const told = [];
  const life = new AbortController();
  const player = {
    move: (action, press) => void told.push({ action, ...press }),
    command: (name) => told.push(name),
    look() {},
  };
  const frame = () => {
    for (const callback of frames.splice(0)) callback();
  };
  const leave = () => {
    life.abort();
    frame();
  };
  return { pad, told, life, player, frame, frames, leave };
}

/** @param {{buttons: {pressed: boolean}[], timestamp: number}} pad */
function hold(pad, button, timestamp = performance.now()) {
  pad.buttons[button] = { pressed: true };
  pad.timestamp = timestamp;
}

test("a press counts from when the gamepad says it was, one frame or less ago", () => {
  const { pad, told, life, player, frame, leave } = playing();
  listenToGamepad(player, life.signal);
  const pressedAt = performance.now();
  hold(pad, 15, pressedAt);
  frame();
  frame();
  assert.deepEqual(told, [{ action: RIGHT, when: pressedAt, device: "gamepad" }]);
  leave();
});

test("a gamepad with a clock of its own, or none, is timed by the frame that saw the press", () => {
  for (const strange of [0, -5, performance.now() + 1e6]) {
    const { pad, told, life, player, frame, leave } = playing();
    listenToGamepad(player, life.signal);
    const before = performance.now();
    hold(pad, 13, strange);
    frame();
    assert.ok(told[0].when >= before && told[0].when <= performance.now());
    leave();
  }
});

test("a button that was down before anybody listened, or before the page was seen again, is no press", () => {
  const { pad, told, life, player, frame, leave } = playing();
  hold(pad, 0);
  listenToGamepad(player, life.signal);
  frame();
  hold(pad, 3);
  document.dispatchEvent(new Event("visibilitychange"));
  frame();
  assert.deepEqual(told, []);
  leave();
});

test("the press that closes a dialog is no press for the board beneath", () => {
  const { pad, told, life, player, frame, leave } = playing();
  const dialog = {};
  document.open = [dialog];
  const inside = new AbortController();
  const closing = {
    ...player,
    command: () => {
      document.open = [];
      inside.abort();
    },
  };
  listenToGamepad(closing, inside.signal, { root: dialog });
  listenToGamepad(player, life.signal);
  hold(pad, 0);
  frame();
  frame();
  assert.deepEqual(told, []);
  leave();
});

test("nothing is read once nobody listens, nor while the page is hidden", () => {
  const { life, player, frame, frames, leave } = playing();
  listenToGamepad(player, life.signal);
  frame();
  assert.equal(frames.length, 1);
  document.hidden = true;
  frame();
  assert.equal(frames.length, 0);
  document.hidden = false;
  document.dispatchEvent(new Event("visibilitychange"));
  assert.equal(frames.length, 1);
  leave();
  assert.equal(frames.length, 0);
});

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
