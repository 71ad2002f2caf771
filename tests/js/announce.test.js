import assert from "node:assert/strict";
import test from "node:test";

/** A page with nothing but its live region; `breathe` lets the 80 ms pass. */
const region = { textContent: "" };
let speak = () => {};
Object.assign(globalThis, {
  document: { querySelector: () => null, getElementById: () => region },
  window: {
    setTimeout: (/** @type {() => void} */ run) => {
      speak = run;
      return 0;
    },
  },
});
const { announce, announceToo } = await import("#js/lib/announce.js");
const said = () => {
  speak();
  return region.textContent;
};

test("of sentences within one breath the last is heard", () => {
  announce("Row 1.");
  announce("Row 2.");
  assert.equal(said(), "Row 2.");
});

test("what comes by itself does not take the place of what is said just now", () => {
  announceToo("10 seconds left.");
  announce("Row 3.");
  announceToo("The server cannot be reached.");
  assert.equal(said(), "Row 3. 10 seconds left. The server cannot be reached.");
});

test("what was said is over", () => {
  announce("Row 4.");
  said();
  announceToo("Everything is saved again.");
  assert.equal(said(), "Everything is saved again.");
});

test("the same sentence again is heard again", () => {
  announce("Bumped.");
  const first = said();
  announce("Bumped.");
  assert.notEqual(said(), first);
});
