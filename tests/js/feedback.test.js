import assert from "node:assert/strict";
import test from "node:test";
import { notesOfFinish, notesOfStep, pulsesOfStep } from "#js/worlds/feedback.js";

const LONGEST_NOTE_S = 0.12;
const QUIET = 0.15;

test("a step ticks lower, and knocks longer, the more its square costs", () => {
  const costs = [0, -0.4, -1, -3.5, -7];
  const pitches = costs.map((reward) => notesOfStep(reward, false)[0].hz);
  assert.deepEqual(
    pitches,
    [...pitches].sort((a, b) => b - a),
  );
  const knocks = costs.map((reward) => pulsesOfStep(reward, false)[0]);
  assert.deepEqual(
    knocks,
    [...knocks].sort((a, b) => a - b),
  );
  assert.deepEqual(
    notesOfStep(-20, false),
    notesOfStep(-7, false),
    "painted squares may cost no more than the dearest",
  );
});

test("a slip slides down", () => {
  const [{ hz, toHz }] = notesOfStep(-1, true);
  assert.ok(toHz < hz);
  assert.ok(pulsesOfStep(-1, true).length > 1);
});

test("the goal has two notes that rise, a failure one, and the step onto the goal none of its own", () => {
  const [first, second] = notesOfFinish("success");
  assert.ok(second.hz > first.hz);
  assert.equal(notesOfFinish("failure").length, 1);
  assert.deepEqual(notesOfStep(14, false), []);
});

test("every note is short and soft", () => {
  const all = [notesOfStep(0, false), notesOfStep(-7, true), notesOfFinish("success"), notesOfFinish("failure")].flat();
  for (const { length, gain } of all) assert.ok(length <= LONGEST_NOTE_S && gain <= QUIET);
});
