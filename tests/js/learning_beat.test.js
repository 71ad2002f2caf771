import assert from "node:assert/strict";
import test from "node:test";
import { Beat } from "#js/learning/beat.js";

/** A browser whose animation frames come when the test says so; a tab that nobody sees gets none. */
function frames() {
  const waiting = new Map();
  let last = 0;
  globalThis.requestAnimationFrame = (act) => {
    last += 1;
    waiting.set(last, act);
    return last;
  };
  globalThis.cancelAnimationFrame = (id) => waiting.delete(id);
  return {
    waiting,
    next(now) {
      const due = [...waiting.values()];
      waiting.clear();
      for (const act of due) act(now);
    },
  };
}

test("however much comes while nobody looks, one paint waits, and shows how things stand then", () => {
  const browser = frames();
  const painted = [];
  let iteration = 0;
  const beat = new Beat(() => {
    painted.push(iteration);
    return false;
  });
  for (iteration = 1; iteration <= 1000; iteration++) beat.ask();
  assert.equal(browser.waiting.size, 1);
  browser.next(16);
  assert.deepEqual(painted, [1001]);
  assert.equal(browser.waiting.size, 0, "nothing is painted while nothing comes");
});

test("what moves by itself gets frame after frame, until it stands or the page is left", () => {
  const browser = frames();
  const times = [];
  const beat = new Beat((now) => times.push(now) < 3);
  beat.ask();
  for (const now of [16, 32, 48, 64]) browser.next(now);
  assert.deepEqual(times, [16, 32, 48]);
  beat.ask();
  beat.stop();
  assert.equal(browser.waiting.size, 0);
});
