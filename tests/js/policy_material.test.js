import assert from "node:assert/strict";
import test from "node:test";
import * as material from "#js/rankings/policy-material.js";
import { makeWorld } from "./factories.js";

/** Attempts s1, s2, … that succeeded, f1, … that reached the goal too late, g1, … that gave up; all ordered. */
function makeOrders({ s = 0, f = 0, g = 0 }) {
  const ids = (letter, n) => Array.from({ length: n }, (_, i) => `${letter}${i + 1}`);
  const failures = [...ids("f", f), ...ids("g", g)];
  const orders = { success: ids("s", s).map((id) => [id]), failure: failures.map((id) => [id]) };
  const endings = [...ids("s", s), ...failures].map((id) => [id, { ending: id.startsWith("g") ? "gave_up" : "goal" }]);
  return { orders, demonstrations: new Map(endings) };
}

const foundIn = (played) => {
  const { orders, demonstrations } = makeOrders(played);
  return material.materialOf(orders, demonstrations);
};
const able = (played) => material.BY_PREFERENCE.filter((learner) => material.canLearn(foundIn(played), learner));

test("who can learn is the first of those that the attempts allow", () => {
  assert.deepEqual(able({ s: 2, f: 1 }), ["irlfr", "irlr", "birlfr"]);
  assert.deepEqual(able({ s: 2, g: 3 }), ["irlr", "birlfr"]);
  assert.deepEqual(able({ f: 1 }), ["birlfr"]);
  assert.deepEqual(able({ g: 4 }), []);
  assert.deepEqual(able({}), []);
});

test("where nobody can learn, a sentence says what is missing", () => {
  assert.match(material.missingWords(foundIn({})), /play some attempts/);
  assert.match(material.missingWords(foundIn({ g: 2 })), /Reach it once/);
});

test("what does not count is said to whoever ordered it", () => {
  assert.equal(material.usedWords("irlfr", foundIn({ s: 1, f: 2 })), "From 1 success and 2 failures.");
  assert.match(material.usedWords("irlfr", foundIn({ s: 1, f: 2, g: 1 })), /1 failure that never reached the goal/);
  assert.match(
    material.usedWords("irlr", foundIn({ s: 3, f: 2 })),
    /^From 3 successes\. IRLR looks at successes alone/,
  );
  assert.match(material.usedWords("irlr", foundIn({ s: 3, g: 2 })), /Failures teach it something once they reach/);
  assert.equal(material.usedWords("birlfr", foundIn({ f: 1 })), "From 1 failure.");
});

test("a learner that looks at successes alone is asked about nothing else", () => {
  const { orders } = makeOrders({ s: 2, f: 2 });
  assert.deepEqual(material.questionOf("irlr", orders), { learner: "irlr", orders: { success: [["s1"], ["s2"]] } });
  assert.deepEqual(material.questionOf("irlfr", orders), { learner: "irlfr", orders });
});

const [UP, RIGHT, DOWN] = [
  [0.7, 0.1, 0.1, 0.1],
  [0.1, 0.7, 0.1, 0.1],
  [0.1, 0.1, 0.7, 0.1],
];
const WORLD = makeWorld([
  [-0.5, -0.5],
  [-0.5, 14],
]);

test("an arrow has turned where another is longest now, and noise between equals turns none", () => {
  const alike = [0.2501, 0.25, 0.25, 0.2499];
  const before = [RIGHT, DOWN, alike, UP];
  const after = [DOWN, DOWN, alike.toReversed(), DOWN];
  assert.deepEqual(material.turnedIn(WORLD, before, after), [0], "the goal has no arrow");
  assert.deepEqual(material.turnedIn(WORLD, before, before), []);
  assert.deepEqual([0, 1, 3].map(material.turnedWords), ["No arrow turned.", "1 arrow turned.", "3 arrows turned."]);
});

test("where the arrows lead is said in words", () => {
  assert.equal(material.leadWords(WORLD, [RIGHT, DOWN, UP, UP]), "Its longest arrows lead to the goal in 2 steps.");
  assert.equal(material.leadWords(WORLD, [UP, DOWN, UP, UP]), "Its longest arrows go round in circles.");
  const reward = [
    [-1, -2],
    [0, 3],
  ];
  const words = material.boardWords(WORLD, { title: "IRLR", reward, policy: [RIGHT, DOWN, UP, UP] });
  assert.match(words, /IRLR .* in 2 steps\. It values row 2, column 2 most and row 1, column 2 least\./);
});
