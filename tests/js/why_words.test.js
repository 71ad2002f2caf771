import assert from "node:assert/strict";
import test from "node:test";
import { voiceOf } from "#js/comparisons/voice.js";
import { attemptsOf, byInfluence } from "#js/comparisons/why/attempts.js";
import { changeWords, doubtWords } from "#js/comparisons/why/square-words.js";
import {
  doubtful,
  doubtSentence,
  mattersSentence,
  methodSentence,
  nameOf,
  ordinal,
  standingOf,
  whatIfSentence,
  withoutSentence,
} from "#js/comparisons/why/words.js";
import { makeWorld } from "./factories.js";

const world = makeWorld([
  [0, -0.5, -3],
  [-0.2, -0.4, -0.1],
  [-2, -0.3, 6],
]);
const played = (id, outcome, more = {}) => ({
  id,
  outcome,
  ending: "goal",
  discarded: false,
  states: [0, 1, 4],
  ...more,
});
const snapshot = {
  demonstrations: [
    played("a", "success"),
    played("b", "success", { states: [0, 3, 4] }),
    played("c", "success"),
    played("f", "failure"),
    played("g", "failure", { ending: "gave_up" }),
  ],
  rankings: { success: { order: [["b"], ["a", "c"]] }, failure: { order: [["f"], ["g"]] } },
};
const attempts = attemptsOf(snapshot);
const irlfr = { title: "IRLFR", uses_failures: true, uses_ranking: true };
const meirl = { title: "MEIRL", uses_failures: false, uses_ranking: false };
const about = { who: irlfr, voice: voiceOf(true), world, leavesOut: true };

const influence = (id, more = {}) => ({
  id,
  outcome: "success",
  n_steps: 2,
  policy_change: 0.1,
  reward_change: 0.2,
  return_change: 2.1,
  sentence: null,
  expected_return: 3.1,
  turned: [1, 4, 5],
  ...more,
});
const nothing = { policy_change: 0, reward_change: 0, return_change: 0, turned: [] };
const answer = (change, more = {}) => ({
  change,
  difference: { policy_change: 0.1, reward_change: 0.1, return_change: -2.1, turned: [1, 2], reward: [] },
  before: { expected_return: 5.2 },
  expected_return: 3.1,
  ...more,
});
const unchanged = { difference: { policy_change: 2e-17, reward_change: 1e-16, turned: [] }, expected_return: 5.2 };

test("attempts are called by their place", () => {
  assert.deepEqual(attempts.map(nameOf), ["1st success", "2nd success", "3rd success", "1st failure", "2nd failure"]);
  assert.deepEqual([11, 12, 13, 21, 22, 23, 101].map(ordinal), [
    "11th",
    "12th",
    "13th",
    "21st",
    "22nd",
    "23rd",
    "101st",
  ]);
  assert.deepEqual(attempts.map(standingOf), ["best", "tied with 1 other", "tied with 1 other", "worst", ""]);
});

test("one attempt of a kind is the only one", () => {
  const [only] = attemptsOf({ demonstrations: [played("a", "success")], rankings: { success: null, failure: null } });
  assert.deepEqual([nameOf(only), standingOf(only)], ["only success", ""]);
});

test("the attempt that mattered most is named with what turns and what it earns", () => {
  const sorted = byInfluence([influence("b", { policy_change: 0.01 }), influence("a")]);
  assert.equal(
    mattersSentence(sorted, attempts, about),
    "Your 2nd success mattered most to IRLFR: without it, 3 of 8 arrows turn and it would earn 2.1 less.",
  );
  assert.equal(
    withoutSentence(influence("a", { turned: [1], return_change: -0.7 }), world),
    "Without it, 1 of 8 arrows turns and it would earn 0.7 more.",
  );
});

test("whose attempts they are is said to who came by a link", () => {
  assert.match(
    mattersSentence([influence("a"), influence("b", nothing)], attempts, { ...about, voice: voiceOf(false) }),
    /^The player's 2nd success mattered most to IRLFR/,
  );
});

test("what nothing can be learned without comes first, and the sentence says so", () => {
  const needed = influence("f", {
    policy_change: null,
    return_change: null,
    turned: null,
    sentence: "IRLF needs one.",
  });
  const sorted = byInfluence([influence("a"), needed]);
  assert.equal(sorted[0], needed);
  assert.equal(mattersSentence(sorted, attempts, about), "Without your 1st failure, IRLFR could learn nothing at all.");
  assert.equal(withoutSentence(needed, world), "Nothing can be learned without it. IRLF needs one.");
});

test("attempts that are alike matter alike, and attempts that change nothing are said to", () => {
  assert.equal(
    mattersSentence(
      [influence("a"), influence("c", { policy_change: 0.1 + 1e-16 }), influence("b", nothing)],
      attempts,
      about,
    ),
    "Your 2nd success and 3rd success mattered most, and alike, to IRLFR: without any one of them, 3 of 8 arrows turn and it would earn 2.1 less.",
  );
  assert.equal(
    mattersSentence([influence("a", nothing), influence("b", nothing)], attempts, about),
    "None of your attempts matters to IRLFR alone: it learns the same without any one of them.",
  );
  assert.equal(withoutSentence(influence("a", nothing), world), "Without it, nothing changes.");
  assert.equal(
    withoutSentence(influence("a", { ...nothing, reward_change: 0.01 }), world),
    "Without it, hardly anything changes.",
  );
});

test("a what-if says what turns, what it would earn, and what it earns", () => {
  assert.equal(
    whatIfSentence(answer({ relabel: "a" }), attempts, about),
    "With your 2nd success called a failure, 2 of 8 arrows turn and IRLFR would earn 2.1 less: 3.1 instead of 5.2.",
  );
  assert.equal(
    whatIfSentence(answer({ swap: ["b", "a"] }, { expected_return: 5.21 }), attempts, about),
    "With your 1st success and 2nd success trading places, 2 of 8 arrows turn and IRLFR would earn about as much: 5.2.",
  );
  assert.equal(
    whatIfSentence(
      answer({ relabel: "a" }, { expected_return: 5.24, before: { expected_return: 5.16 } }),
      attempts,
      about,
    ),
    "With your 2nd success called a failure, 2 of 8 arrows turn and IRLFR would earn 0.1 more: 5.24 instead of 5.16.",
  );
});

test("where nothing changes the sentence says why", () => {
  const told = (change, more = {}) => whatIfSentence(answer(change, unchanged), attempts, { ...about, ...more });
  assert.match(told({ swap: ["a", "c"] }), /nothing changes: they are tied\.$/);
  assert.match(told({ swap: ["b", "a"] }, { who: meirl }), /nothing changes: MEIRL does not look at the order\.$/);
  assert.match(told({ drop: "f" }, { who: meirl }), /nothing changes: MEIRL does not look at failures\.$/);
  assert.match(
    told({ drop: "g" }),
    /nothing changes: a failure that never reached the goal is left out at these settings\.$/,
  );
  assert.match(told({ drop: "a" }), /^Without your 2nd success, nothing changes\.$/);
});

test("identical attempts that trade places are the same walk", () => {
  const twins = { ...snapshot, rankings: { ...snapshot.rankings, success: { order: [["b"], ["a"], ["c"]] } } };
  assert.match(
    whatIfSentence(answer({ swap: ["a", "c"] }, unchanged), attemptsOf(twins), about),
    /nothing changes: they are the same walk\.$/,
  );
});

const found = (more = {}) => ({
  method: "bootstrap",
  n_draws: 60,
  seed: 7,
  policy_agreement: [1, 0.7, 0.75, 1, 1, 1, 1, 1, 0.2],
  reward_low: [0],
  reward_high: [1],
  ...more,
});

test("squares in doubt are those where fewer than three draws in four agree; a goal has no arrow to doubt", () => {
  assert.deepEqual(
    doubtful(found().policy_agreement, world).flatMap((is, state) => (is ? [state] : [])),
    [1],
  );
  assert.equal(
    doubtSentence(found(), about),
    "On 1 of 8 squares IRLFR is not sure of its step: fewer than three draws in four take the same.",
  );
});

test("draws that are all alike claim no certainty", () => {
  const same = found({ policy_agreement: [1, 1], reward_high: [0] });
  assert.equal(doubtSentence(same, about), "All draws came out the same, which says nothing of how sure IRLFR may be.");
  assert.match(doubtSentence(found({ policy_agreement: [1, 1] }), about), /^IRLFR is sure of its step on every square/);
});

test("the method and the number of draws are told", () => {
  assert.match(methodSentence(found()), /as many attempts.*\(bootstrap, 60 draws, seed 7\)/);
  assert.match(
    methodSentence(found({ method: "posterior", n_draws: 400 })),
    /holds possible after the attempts \(posterior, 400 draws\)/,
  );
});

test("a square is told in words: its step, the one before, its reward", () => {
  const belief = {
    reward: [0.31, -1, 0, 0, 0, 0, 0, 0, 6],
    policy: [
      [0.1, 0.6, 0.2, 0.1],
      [0.25, 0.25, 0.25, 0.25],
    ],
  };
  const before = {
    reward: [0.11, -1, 0, 0, 0, 0, 0, 0, 5],
    policy: [
      [0.5, 0.1, 0.5, 0.1],
      [0, 1, 0, 0],
    ],
  };
  const told = (state) => changeWords(world, state, before, belief);
  assert.equal(told(0), "Row 1, column 1: goes right, went up or down before; reward 0.11 → 0.31.");
  assert.equal(told(1), "Row 1, column 2: goes anywhere; reward −1.0.");
  assert.equal(told(8), "Row 3, column 3: the goal; reward 5.0 → 6.0.");
  assert.equal(
    doubtWords(world, 0, belief, { policy_agreement: [0.64], reward_low: [-0.3], reward_high: [0.8] }),
    "Row 1, column 1: goes right, as in 64 % of the draws; reward −0.30 to 0.80.",
  );
});
