import assert from "node:assert/strict";
import test from "node:test";
import { RULES, readNumber, writeNumber } from "#js/worlds/editor/rules.js";
import { limitWords, refusalOf, shortestWay, squareSentence, verdictOf } from "#js/worlds/editor/sentences.js";
import { makeWorld } from "./factories.js";

const SMALL = makeWorld([
  [-0.25, -2, -0.1],
  [-0.3, -7, -0.4],
  [-0.5, -0.6, 6],
]);

test("numbers are read as they are typed: percent, costs, nothing at all", () => {
  assert.deepEqual(readNumber(RULES.red_probability, "30"), { value: 0.3 });
  assert.deepEqual(readNumber(RULES.red_probability, "33.3"), { value: 0.333 });
  assert.deepEqual(readNumber(RULES.reward, "3.5"), { value: -3.5 });
  assert.ok(Object.is(readNumber(RULES.reward, "0").value, 0));
  assert.deepEqual(readNumber(RULES.step_limit, ""), { value: null });
  assert.deepEqual(readNumber(RULES.seed, "9007199254740991"), { value: 9007199254740991 });
});

test("whatever is written is read back as it was", () => {
  for (const value of [0, 0.07, 0.1, 0.29, 0.3, 0.57, 1 / 3, 0.9]) {
    const again = readNumber(RULES.slip, writeNumber(RULES.slip, value));
    assert.ok(Math.abs(again.value - value) < 1e-15, String(value));
  }
  for (let n = 0; n <= 90; n++)
    assert.equal(writeNumber(RULES.slip, readNumber(RULES.slip, String(n)).value), String(n));
  assert.equal(writeNumber(RULES.time_limit_s, null), "");
});

test("what cannot be is answered with what would be right", () => {
  const wrong = [
    ["rows", "1", /2 to 100 rows/],
    ["cols", "", /2 to 100 columns/],
    ["rows", "7.5", /2 to 100 rows/],
    ["seed", "-1", /whole number/],
    ["slip", "91", /0 to 90 %/],
    ["time_limit_s", "4", /5 to 3600/],
    ["reward", "8", /0 to 7/],
    ["pay", "201", /0 to 200/],
  ];
  for (const [name, text, sentence] of wrong) assert.match(readNumber(RULES[name], text).problem ?? "", sentence, name);
  assert.match(readNumber(RULES.step_limit, "", true).problem, /leave it empty/);
});

test("the shortest way goes round walls, and there may be none", () => {
  assert.equal(shortestWay(SMALL), 4);
  assert.equal(shortestWay({ ...SMALL, goals: [8, 1] }), 1);
  assert.equal(shortestWay({ ...SMALL, walls: [1, 4, 5] }), 4);
  assert.equal(shortestWay({ ...SMALL, walls: [1, 3] }), null);
});

test("a closed way and a step limit that nobody can keep are told without asking", () => {
  const plan = { rows: 3, cols: 3, stepLimit: null };
  assert.equal(refusalOf(plan, 4), null);
  assert.match(refusalOf(plan, null).fields.walls, /close every way/);
  assert.match(refusalOf({ ...plan, stepLimit: 3 }, 4).fields.step_limit, /from 4, the shortest way, to 18/);
  assert.equal(refusalOf({ ...plan, stepLimit: 18 }, 4), null);
});

test("the verdict says what would help", () => {
  assert.equal(verdictOf({ ...SMALL, success_possible: true }, false).text, "A success is possible.");
  assert.match(verdictOf({ ...SMALL, success_possible: true, slip: 0.1 }, false).text, /luck/);
  const hopeless = verdictOf({ ...SMALL, success_possible: false }, false);
  assert.equal(hopeless.state, "hopeless");
  assert.match(hopeless.text, /costs more than the goal pays.*cheaper way, or let the goal pay more\.$/);
  const short = verdictOf({ ...SMALL, success_possible: false, horizon: 8 }, true).text;
  assert.match(short, /within 8 steps.*or allow more steps\.$/);
});

test("a square is told as on every board, and whether somebody painted it", () => {
  assert.equal(squareSentence(SMALL, 4, true), "Row 2, column 2: red, \u22127.0. Painted.");
  assert.equal(squareSentence(SMALL, 5, false), "Row 2, column 3: blue, \u22120.4.");
});

test("limits are told in words", () => {
  assert.equal(limitWords({ horizon: 98, timeLimitS: null }), "98 steps");
  assert.equal(limitWords({ horizon: 98, timeLimitS: 90 }), "98 steps, 90 seconds");
});
