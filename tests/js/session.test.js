import assert from "node:assert/strict";
import test from "node:test";
import { Recorder } from "#js/worlds/recorder.js";
import { PlaySession } from "#js/worlds/session.js";
import { makeWorld } from "./factories.js";

const [UP, RIGHT, DOWN, LEFT] = [0, 1, 2, 3];
const WORLD = makeWorld([
  [-1, -1, -1],
  [-1, -1, 5],
]);
const CLIENT = { agent: "test" };

function makeSession(world = WORLD) {
  let n = 0;
  return new PlaySession({ world, newId: () => `id-${++n}`, at: 1000 });
}

/** @param {PlaySession} session @param {number[]} actions */
function walk(session, actions, { from = 1100, every = 100 } = {}) {
  actions.forEach((action, i) => {
    session.move(action, { when: from + i * every, device: "key", paintedAt: from + i * every - 80 });
  });
}

test("a step tells what it did", () => {
  const session = makeSession();
  assert.deepEqual(session.move(RIGHT, { when: 1300, device: "key" }), {
    reached: 1,
    reward: -1,
    taken: RIGHT,
    isSlip: false,
    isBump: false,
  });
  assert.equal(session.move(UP, { when: 1400, device: "key" })?.isBump, true);
  assert.deepEqual(session.attempt.stepMs, [300, 100]);
});

test("reaction times count from the frame that showed the position, and are missing where it was not yet shown", () => {
  const session = makeSession();
  session.move(RIGHT, { when: 1300, device: "key", paintedAt: 1050 });
  session.move(LEFT, { when: 1310, device: "gamepad", paintedAt: Number.NaN });
  session.move(RIGHT, { when: 1400, device: "pad", paintedAt: 1420 });
  const { rt, device } = session.record(1500, CLIENT);
  assert.deepEqual(rt, [250, null, null]);
  assert.deepEqual(device, ["key", "gamepad", "pad"]);
});

test("undo takes the step's measures back and says what was undone", () => {
  const session = makeSession();
  walk(session, [RIGHT, DOWN]);
  assert.equal(session.undo(1500), true);
  walk(session, [LEFT], { from: 1700 });
  const record = session.record(2000, CLIENT);
  assert.deepEqual(session.attempt.actions, [RIGHT, LEFT]);
  assert.deepEqual(session.attempt.stepMs, [100, 200]);
  assert.deepEqual(record.rt, [80, 80]);
  assert.deepEqual(record.events, [{ type: "undo", at_ms: 500, step: 2, value: DOWN }]);
  assert.equal(record.elapsed_ms, 1000);
});

test("there is nothing to undo at the start, nor after the end", () => {
  const session = makeSession();
  assert.equal(session.undo(1100), false);
  walk(session, [RIGHT, RIGHT, DOWN]);
  assert.equal(session.isOver, true);
  assert.equal(session.undo(2000), false);
  assert.equal(session.move(UP, { when: 2100, device: "key" }), null);
});

test("restarts are told in the record of the next attempt, until one is finished", () => {
  const session = makeSession();
  walk(session, [RIGHT, DOWN]);
  session.begin(2000);
  session.begin(2000);
  walk(session, [DOWN], { from: 2100 });
  session.begin(3000);
  walk(session, [RIGHT, RIGHT, DOWN], { from: 3100 });
  assert.deepEqual(session.record(3400, CLIENT).abandoned, [
    { n_steps: 2, elapsed_ms: 1000 },
    { n_steps: 1, elapsed_ms: 1000 },
  ]);
  session.begin(4000);
  walk(session, [RIGHT], { from: 4100 });
  assert.deepEqual(session.record(4200, CLIENT).abandoned, []);
});

test("trying again from a step copies what came before and cannot undo it", () => {
  const session = makeSession();
  walk(session, [RIGHT, DOWN]);
  session.giveUp();
  const parent = session.attempt;
  session.beginFrom(parent, 1, 3000);
  assert.equal(session.state, 1);
  assert.equal(session.undo(3100), false);
  assert.equal(session.giveUp(), false);
  walk(session, [RIGHT], { from: 3300 });
  const record = session.record(3400, CLIENT);
  assert.deepEqual([session.attempt.parentId, session.attempt.parentStep], [parent.id, 1]);
  assert.deepEqual(record.device, ["copied", "key"]);
  assert.deepEqual(record.rt, [null, 80]);
  assert.deepEqual(session.attempt.stepMs, [parent.stepMs[0], 300]);
});

test("trying again from a step sets the attempt under way aside, and tells only of what was thrown away", () => {
  const session = makeSession();
  walk(session, [RIGHT, DOWN]);
  session.giveUp();
  const parent = session.attempt;
  session.begin(2000);
  walk(session, [DOWN], { from: 2100 });
  session.begin(3000);
  walk(session, [RIGHT], { from: 3100 });
  session.beginFrom(parent, 1, 4000);
  assert.deepEqual(session.record(4100, CLIENT).abandoned, [{ n_steps: 1, elapsed_ms: 1000 }]);
});

test("an attempt that was left goes on where it stood, its closed time left out", () => {
  const before = makeSession();
  walk(before, [RIGHT, DOWN]);
  before.note("blur", 1350);
  const draft = structuredClone(before.draft(1400));
  const after = makeSession();
  assert.equal(after.resume(draft, 50, 3_600_000), true);
  walk(after, [RIGHT], { from: 250 });
  assert.equal(after.attempt.ending, "goal");
  assert.equal(after.attempt.id, draft.id);
  const record = after.record(250, CLIENT);
  assert.equal(record.elapsed_ms, 600);
  assert.deepEqual(record.events, [
    { type: "blur", at_ms: 350, step: 2, value: null },
    { type: "resumed", at_ms: 400, step: 2, value: 3_600_000 },
  ]);
  assert.deepEqual(after.attempt.stepMs, [100, 100, 200]);
});

test("an attempt that is over, or has no step, is not taken up again", () => {
  const session = makeSession();
  const empty = session.draft(1000);
  walk(session, [RIGHT, RIGHT, DOWN]);
  const over = session.draft(2000);
  assert.equal(makeSession().resume(empty, 0, null), false);
  assert.equal(makeSession().resume(over, 0, null), false);
});

test("the time limit begins with the first step and ends the attempt by itself or at the next press", () => {
  const world = { ...WORLD, time_limit_s: 10 };
  const session = makeSession(world);
  assert.equal(session.timeLeft(9_999_999), 10_000);
  assert.equal(session.tick(9_999_999), false);
  session.move(RIGHT, { when: 5000, device: "key" });
  assert.equal(session.timeLeft(8000), 7000);
  assert.equal(session.tick(14_999), false);
  assert.equal(session.tick(15_000), true);
  assert.equal(session.attempt.ending, "out_of_time");
  assert.equal(session.tick(16_000), false);

  const late = makeSession(world);
  late.move(RIGHT, { when: 5000, device: "key" });
  assert.equal(late.move(RIGHT, { when: 15_001, device: "key" }), null);
  assert.equal(late.attempt.ending, "out_of_time");
});

test("a world without a limit has no time left to show", () => {
  assert.equal(makeSession().timeLeft(1_000_000), null);
});

test("a clock that jumps is noted once, with by how much, and the times go on", () => {
  const clocks = { wall: 500_000, now: 1000 };
  const recorder = new Recorder({ at: 1000, wall: () => clocks.wall, now: () => clocks.now });
  clocks.now += 100;
  clocks.wall += 100 + 3_600_000;
  assert.equal(recorder.checkClock(1100), 3_600_000);
  assert.equal(recorder.checkClock(1100), 0);
  clocks.wall -= 3_600_000;
  assert.equal(recorder.checkClock(1200), -3_600_000);
  assert.deepEqual(
    recorder.record(1300, CLIENT).events.map(({ type, at_ms, value }) => [type, at_ms, value]),
    [
      ["clock", 100, 3_600_000],
      ["clock", 200, -3_600_000],
    ],
  );
});

test("a press before the attempt began, on whatever clock, costs no time", () => {
  const session = makeSession();
  session.move(RIGHT, { when: 400, device: "key", paintedAt: 900 });
  assert.deepEqual(session.attempt.stepMs, [0]);
  assert.deepEqual(session.record(300, CLIENT).rt, [null]);
});

test("notes that storage has spoilt lose what is spoilt, lest the attempt be refused for it", () => {
  const sound = { type: "blur", at_ms: 5, step: 0, value: null };
  const notes = /** @type {any} */ ({
    rt: [12, "x", -3, null],
    device: ["key", "mouth"],
    events: [sound, { ...sound, type: "sneeze" }, { ...sound, at_ms: Number.NaN }, { ...sound, value: "1" }, null],
    elapsed_ms: "soon",
    abandoned: [{ n_steps: 2, elapsed_ms: 9 }, { n_steps: -1, elapsed_ms: 9 }, 7],
  });
  const { rt, device, events, abandoned, elapsed_ms } = new Recorder({ at: 0, notes }).record(10, CLIENT);
  assert.deepEqual([rt, device, events, elapsed_ms], [[12, null], ["key"], [sound], 10]);
  assert.deepEqual(abandoned, [{ n_steps: 2, elapsed_ms: 9 }]);
  const none = new Recorder({ at: 0, notes: /** @type {any} */ ({ rt: "x", events: null }) }).record(10, CLIENT);
  assert.deepEqual([none.rt, none.events, none.abandoned], [[], [], []]);
});

test("what is kept of an attempt stays as it was, however long the writing takes", () => {
  const session = makeSession();
  walk(session, [RIGHT]);
  const draft = session.draft(1200);
  walk(session, [LEFT], { from: 1300 });
  assert.deepEqual([draft.actions.length, draft.record.rt.length, draft.record.device.length], [1, 1, 1]);
});

test("an attempt goes on even if nothing is left of its measures", () => {
  const session = makeSession();
  walk(session, [RIGHT, LEFT]);
  const draft = /** @type {any} */ ({ ...session.draft(1300), record: null });
  const next = makeSession();
  assert.ok(next.resume(draft, 50, null));
  assert.deepEqual(next.record(60, CLIENT).device, ["copied", "copied"]);
});
