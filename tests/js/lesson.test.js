import assert from "node:assert/strict";
import test from "node:test";
import { Lesson, PRACTICE_WORLD } from "#js/worlds/lesson.js";

const [UP, RIGHT, DOWN, LEFT] = [0, 1, 2, 3];
const OVER_BLUE = [UP, RIGHT, RIGHT, RIGHT, DOWN];
const THROUGH_RED = [RIGHT, RIGHT, RIGHT];

/** A lesson in which these actions have been done. */
function after(...actions) {
  const lesson = new Lesson("keys");
  for (const action of actions) lesson.move(action);
  return lesson;
}

/** A lesson in which the goal has been reached over blue, and failing comes next. */
function readyToFail() {
  const lesson = after(...OVER_BLUE);
  lesson.goOn();
  return lesson;
}

test("moving, succeeding and failing, each done once, is the whole practice", () => {
  const lesson = after();
  assert.equal(lesson.part, "move");
  lesson.move(UP);
  assert.equal(lesson.part, "goal");
  for (const action of OVER_BLUE.slice(1)) lesson.move(action);
  assert.match(lesson.words, /^A success: the goal paid 7, and \+5\.6 is left/);
  assert.equal(lesson.next, "Go on");
  lesson.goOn();
  assert.equal(lesson.part, "fail");
  for (const action of THROUGH_RED) lesson.move(action);
  assert.equal(lesson.part, "done");
  assert.match(lesson.words, /^A useful failure/);
  assert.equal(lesson.next, "Play for real");
});

test("a bump against the edge is not yet a move", () => {
  const lesson = after(LEFT);
  assert.equal(lesson.part, "move");
  assert.match(lesson.words, /edge/);
});

test("who goes through the red when asked to succeed tries once more", () => {
  const lesson = after(...THROUGH_RED);
  assert.equal(lesson.part, "goal");
  assert.match(lesson.words, /red took more than the goal paid, −2\.3 in all/);
  assert.equal(lesson.next, "Once more");
  lesson.goOn();
  assert.equal(lesson.attempt.actions.length, 0);
  assert.equal(lesson.part, "goal");
});

test("who succeeds when asked to fail tries once more, too", () => {
  const lesson = readyToFail();
  for (const action of OVER_BLUE) lesson.move(action);
  assert.equal(lesson.part, "fail");
  assert.equal(lesson.next, "Once more");
});

test("giving up is a failure as good as any, once there is a step to give up", () => {
  const lesson = readyToFail();
  assert.equal(lesson.canGiveUp, false);
  lesson.move(UP);
  lesson.giveUp();
  assert.equal(lesson.part, "done");
});

test("one red square alone is a success: what counts is the total", () => {
  const lesson = after(UP, RIGHT, RIGHT, DOWN, RIGHT);
  assert.match(lesson.words, /^A success/);
});

test("using up all steps is told and tried once more", () => {
  const lesson = after(UP, ...Array(PRACTICE_WORLD.horizon - 1).fill(UP));
  assert.match(lesson.words, /All 24 steps are used up/);
  assert.equal(lesson.next, "Once more");
});

test("bumping all the way is tried once more from the first sentence", () => {
  const lesson = after(...Array(PRACTICE_WORLD.horizon).fill(LEFT));
  lesson.goOn();
  assert.equal(lesson.part, "move");
  assert.equal(lesson.attempt.actions.length, 0);
});

test("steps can be taken back, and an attempt begun anew", () => {
  const lesson = after(UP, RIGHT);
  lesson.undo();
  assert.deepEqual(lesson.attempt.actions, [UP]);
  lesson.restart();
  assert.deepEqual(lesson.attempt.actions, []);
  assert.equal(lesson.part, "goal");
});

test("everybody is told how in terms of what they have in hand", () => {
  assert.match(new Lesson("keys").words, /arrow key/);
  assert.match(new Lesson("touch").words, /swipe/);
  assert.match(new Lesson("gamepad").words, /stick/);
});

test("the colours of the practice world are those its rewards have everywhere", () => {
  PRACTICE_WORLD.rewards.flat().forEach((reward, state) => {
    const colour = state === PRACTICE_WORLD.goal ? "goal" : reward < -1 ? "red" : "blue";
    assert.equal(PRACTICE_WORLD.colours.flat()[state], colour);
  });
});
