import assert from "node:assert/strict";
import { test } from "node:test";
import { barAt, landingOf, pushOf } from "#js/rankings/landing.js";
import { place } from "#js/rankings/order.js";

/** a · b c · d, one above the other: each 300 wide and 40 high, 10 apart. */
const GROUPS = [["a"], ["b", "c"], ["d"]].map((ids, i) => ({
  ids,
  box: { left: 100, right: 400, top: 50 * i, bottom: 50 * i + 40 },
}));
const ORDER = GROUPS.map(({ ids }) => ids);
const BOXES = { a: GROUPS[0].box, d: GROUPS[2].box, c: { left: 250, right: 400, top: 50, bottom: 90 } };

/** The order that comes of letting a card go at a point; null where nothing does. */
function letGo(id, x, y, wentAside = true) {
  const landing = landingOf({ x, y }, GROUPS, { id, box: BOXES[id], wentAside });
  return landing && place(ORDER, id, landing);
}

test("between two groups it stands alone, whichever of the two is nearer", () => {
  assert.deepEqual(letGo("d", 150, 41), [["a"], ["d"], ["b", "c"]]);
  assert.deepEqual(letGo("d", 150, 49), [["a"], ["d"], ["b", "c"]]);
  assert.deepEqual(letGo("d", 150, 35), [["a"], ["d"], ["b", "c"]]);
  assert.deepEqual(letGo("a", 150, 85), [["b", "c"], ["a"], ["d"]]);
});

test("beyond the ends it stands first, or last", () => {
  assert.deepEqual(letGo("d", 150, -500), [["d"], ["a"], ["b", "c"]]);
  assert.deepEqual(letGo("a", 150, 5000), [["b", "c"], ["d"], ["a"]]);
});

test("on the right half of a group it is tied with it", () => {
  assert.deepEqual(letGo("d", 300, 70), [["a"], ["b", "c", "d"]]);
  assert.deepEqual(letGo("a", 300, 120), [
    ["b", "c"],
    ["d", "a"],
  ]);
  assert.deepEqual(
    letGo("d", 450, 20),
    [
      ["a", "d"],
      ["b", "c"],
    ],
    "a little beside the list, too",
  );
});

test("straight up and down nothing is tied, wherever on the card the hand is", () => {
  assert.deepEqual(letGo("d", 300, 60, false), [["a"], ["d"], ["b", "c"]]);
  assert.deepEqual(letGo("c", 300, 10, false), [["c"], ["a"], ["b"], ["d"]]);
});

test("out of a tie it stands above or below the rest", () => {
  assert.deepEqual(letGo("c", 150, 55), [["a"], ["c"], ["b"], ["d"]]);
  assert.deepEqual(letGo("c", 150, 85), [["a"], ["b"], ["c"], ["d"]]);
});

test("where it was, in its own tie, and far beside the list it comes home", () => {
  assert.equal(letGo("a", 150, 20), null);
  assert.equal(letGo("a", 150, 52), null, "just above the next is where it stands");
  assert.equal(letGo("d", 150, 88), null);
  assert.equal(letGo("c", 300, 70), null);
  assert.equal(letGo("d", 600, 20), null);
  assert.equal(letGo("d", -80, 20), null);
});

test("the bar lies in the middle between two groups, and just outside the ends", () => {
  const at = (y) => barAt(GROUPS, landingOf({ x: 150, y }, GROUPS, { id: "c", box: BOXES.c, wentAside: false }));
  assert.deepEqual([at(-20), at(48), at(95), at(200)], [-5, 45, 95, 145]);
});

test("near an end of the window the page scrolls, the nearer the faster, and only where the hand has gone", () => {
  const sight = { from: 400, top: 0, bottom: 800 };
  assert.equal(pushOf(400, sight), 0);
  assert.equal(pushOf(44, sight), -0.5);
  assert.equal(pushOf(-10, sight), -1);
  assert.equal(pushOf(756, sight), 0.5);
  assert.equal(pushOf(900, sight), 1);
  assert.equal(pushOf(20, { ...sight, from: 10 }), 0, "taken up there and moved down");
});

test("in any list every point leads to an order of the same cards that can be made", () => {
  const groups = [["p", "q", "r"], ["s"], ["t", "u"], ["v"]].map((ids, i) => ({
    ids,
    box: { left: 0, right: 200, top: 60 * i, bottom: 60 * i + 50 },
  }));
  const order = groups.map(({ ids }) => ids);
  for (const id of order.flat())
    for (let y = -30; y < 270; y += 3)
      for (const x of [10, 90, 110, 190]) {
        const landing = landingOf({ x, y }, groups, {
          id,
          box: { left: -9, right: -8, top: 0, bottom: 0 },
          wentAside: true,
        });
        if (landing) assert.deepEqual(place(order, id, landing).flat().sort(), order.flat().sort());
      }
});
