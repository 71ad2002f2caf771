import assert from "node:assert/strict";
import test from "node:test";
import { number, plural, signed } from "#js/lib/format.js";
import { clockJumpSentence } from "#js/worlds/attention.js";
import { clock } from "#js/worlds/scoreboard.js";
import { canRank, finishSentence, missingSentence } from "#js/worlds/sentences.js";

test("numbers carry a true minus, and zero has no sign", () => {
  assert.equal(number(-3.14), "\u22123.1");
  assert.equal(number(-0.01), "0.0");
  assert.equal(signed(4.25, 2), "+4.25");
  assert.equal(signed(0), "0.0");
  assert.equal(plural(1, "step"), "1 step");
});

test("a failure is counted with the same warmth as a success", () => {
  const shared = { nSteps: 9, nSame: 3, nWanted: 3 };
  assert.equal(
    finishSentence({ outcome: "success", ending: "goal", total: 4.2, ...shared }).title,
    "A success: 3 of 3",
  );
  assert.equal(
    finishSentence({ outcome: "failure", ending: "gave_up", total: -2, ...shared }).title,
    "A useful failure: 3 of 3",
  );
  assert.equal(
    finishSentence({ outcome: "failure", ending: "gave_up", total: -2, ...shared, nSame: 4 }).title,
    "A useful failure: number 4",
  );
});

test("the sentence says how a failure ended", () => {
  const text = (ending, total = -3.1) =>
    finishSentence({ outcome: "failure", ending, total, nSteps: 98, nSame: 1, nWanted: 3 }).text;
  assert.equal(text("goal"), "You reached the goal, but the way cost more than the goal gave: \u22123.1.");
  assert.equal(text("gave_up"), "You stopped after 98 steps, at \u22123.1.");
  assert.equal(text("out_of_steps"), "All 98 steps are used up, at \u22123.1.");
  assert.equal(text("out_of_time"), "The time is up after 98 steps, at \u22123.1.");
});

test("where totals are not shown, no sentence tells one", () => {
  for (const ending of ["goal", "gave_up", "out_of_steps", "out_of_time"]) {
    for (const outcome of ["success", "failure"]) {
      const { title, text } = finishSentence({ outcome, ending, total: null, nSteps: 98, nSame: 1, nWanted: 3 });
      assert.doesNotMatch(title + text, /null|[+\u2212]|\d\.\d/);
    }
  }
});

test("a jump of the clock is told in its own size", () => {
  assert.match(clockJumpSentence(3_000), /ahead by 3 seconds/);
  assert.match(clockJumpSentence(600_000), /ahead by 10 minutes/);
  assert.match(clockJumpSentence(-86_400_000), /set back by 24 hours/);
});

test("time left reads as minutes and seconds", () => {
  assert.deepEqual([90, 60, 9, 0].map(clock), ["1:30", "1:00", "0:09", "0:00"]);
});

test("what is missing is said, and ranking opens with one of each", () => {
  const say = (nSuccesses, nFailures) => missingSentence({ nSuccesses, nFailures, nWanted: 3 });
  assert.equal(say(0, 0), "3 successes and 3 failures to go.");
  assert.equal(say(3, 2), "1 failure to go, or rank now.");
  assert.match(say(3, 3), /complete/);
  assert.ok(!canRank({ nSuccesses: 3, nFailures: 0 }));
  assert.ok(canRank({ nSuccesses: 1, nFailures: 1 }));
});
