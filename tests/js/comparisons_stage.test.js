import assert from "node:assert/strict";
import test from "node:test";
import { castOf } from "#js/comparisons/cast.js";
import { lossEnds, lossLayer, worstOf } from "#js/comparisons/losses.js";
import { bracketed, pText, testSentences } from "#js/comparisons/paired-tests.js";
import { remarks } from "#js/comparisons/remarks.js";
import { intervalText } from "#js/comparisons/result-table.js";
import { backgroundSentence, resultSentence } from "#js/comparisons/sentences.js";
import { squareWords } from "#js/comparisons/square-words.js";
import { TO_YOU, voiceOf } from "#js/comparisons/voice.js";
import { makeWorld } from "./factories.js";

const world = makeWorld([
  [-0.5, -0.25],
  [-3, 4],
]);
const episode = (total, states = [0, 1, 3]) => ({ states, total, reached_goal: true });
const attempt = (id, outcome, states) => ({ id, outcome, states });
const entry = (who, title, mean_return, place, more = {}) => ({
  who,
  title,
  mean_return,
  place,
  standard_error: 0.4,
  expected_return: who === "human" ? null : mean_return,
  greedy_return: null,
  share_of_optimum: 0.5,
  episodes: who === "human" ? 3 : 50,
  ...more,
});
const ENTRIES = [entry("optimal", "Optimum", 7, 1), entry("irlr", "IRLR", 5, 2), entry("human", "You", 2, 3)];

function pageData({ totals = [4, -1, 3], human = { best: "a", mean: "c" }, ...more } = {}) {
  const demonstrations = ["a", "b", "c"].slice(0, totals.length).map((id, i) => attempt(id, "success", [0, i, 3]));
  return {
    world,
    demonstrations,
    rankings: { success: null, failure: null },
    run: { learners: { irlr: { outcome: "converged", reward: [[0.5, 1], [2, 3]] } } }, // biome-ignore format: two rows
    learners: [{ name: "irlr", title: "IRLR" }],
    rollouts: { human: totals.map((total) => episode(total)), irlr: [episode(5)], optimal: [episode(7)] },
    comparison: { human, value_lost: { irlr: [0.3, 0, 6.2, 0] }, value_lost_scale: 4 },
    ...more,
  };
}

const told = (cast) => cast.map(({ key, title, standing }) => [key, title, standing]);

test("the person stands on stage twice: at their best, and nearest their mean", () => {
  assert.deepEqual(told(castOf(pageData(), ENTRIES)), [
    ["human-best", "Your best attempt", "1 of 3, the best"],
    ["human-mean", "Your mean attempt", "3 of 3, nearest the mean 2.0"],
    ["irlr", "IRLR", "5.0 ± 0.4 over 50 episodes"],
    ["optimal", "Optimum", "7.0 ± 0.4 over 50 episodes"],
  ]);
});

test("a comparison of an earlier version still finds both attempts", () => {
  const cast = castOf(pageData({ human: null }), ENTRIES);
  assert.deepEqual(
    cast.slice(0, 2).map(({ episodes }) => episodes[0].total),
    [4, 3],
  );
});

test("one attempt alone, and one that is both, stand on stage once", () => {
  const alone = pageData({ totals: [2], human: { best: "a", mean: "a" } });
  assert.deepEqual(told(castOf(alone, ENTRIES))[0], ["human-best", "Your attempt", "your only one"]);
  const both = castOf(pageData({ human: { best: "a", mean: "a" } }), ENTRIES);
  assert.deepEqual(told(both)[0].at(-1), "1 of 3, also nearest the mean 2.0");
  assert.equal(both.length, 3);
});

test("a shared link speaks of the player", () => {
  const [best] = castOf(pageData({ is_own: false }), ENTRIES);
  assert.equal(best.title, "The player's best attempt");
  const voice = voiceOf(false);
  assert.match(
    resultSentence(ENTRIES, voice),
    /^IRLR earned more than the player in this world: 5\.0 ± 0\.4 against 2\.0/,
  );
  assert.match(backgroundSentence(ENTRIES, [4, -1, 3], voice), /^The player's figure is the mean of all 3 attempts/);
  assert.equal(voiceOf(undefined), TO_YOU);
});

test("what is lost is drawn on one scale, red and hatched, and ends where the legend says", () => {
  const { comparison } = pageData();
  assert.deepEqual(lossLayer(comparison, "irlr"), { values: [-0.3, -0, -6.2, -0], scale: [-4, 4] });
  assert.deepEqual(lossLayer(comparison, "optimal").values, [-0, -0, -0, -0]);
  assert.equal(lossLayer(comparison, "human"), null);
  assert.deepEqual(lossEnds(comparison), { none: "0", all: "4.0 or more" });
  assert.deepEqual(lossEnds({ value_lost: { irlr: [4] }, value_lost_scale: 4 }), { none: "0", all: "4.0" });
});

test("where a learner loses most is said in words", () => {
  const { comparison } = pageData();
  assert.equal(worstOf(world, comparison, "irlr").sentence, "Loses most at row 2, column 1: 6.2.");
  assert.equal(worstOf(world, comparison, "irlr").short, "Worst at row 2, column 1: −6.2");
  assert.equal(worstOf(world, comparison, "optimal").sentence, "Loses nothing anywhere.");
  assert.equal(worstOf(world, { value_lost: null }, "irlr").sentence, "");
});

test("a square says what lies under the walkers, of everybody who has something to say", () => {
  const data = pageData();
  const cast = castOf(data, ENTRIES);
  assert.equal(squareWords(data, cast, 2, "true"), "Row 2, column 1: red, −3.0.");
  assert.equal(squareWords(data, cast, 2, "lost"), "Row 2, column 1: red, −3.0. Lost from here on: IRLR 6.2.");
  assert.equal(squareWords(data, cast, 2, "learned"), "Row 2, column 1: red, −3.0. Learned reward: IRLR 2.00.");
});

const pair = (a, b, mean_difference, low, high, p_adjusted) => ({ a, b, mean_difference, low, high, p_value: p_adjusted, p_adjusted }); // biome-ignore format: one line

test("the best learner is held against each other one, whichever way round the test was kept", () => {
  const entries = [
    entry("optimal", "Optimum", 7, 1),
    entry("irlfr", "IRLFR", 5, 2),
    entry("irlr", "IRLR", 4, 3),
    entry("irlf", "IRLF", 4, 4),
    entry("meirl", "MEIRL", 4, 5),
    entry("human", "You", 1, 6),
  ];
  const tests = [
    pair("irlr", "irlfr", -1.3, -1.9, -0.8, 0.002),
    pair("irlfr", "irlf", 0.2, -0.3, 0.7, 0.41),
    pair("meirl", "irlfr", 0, 0, 0, 1),
  ];
  assert.deepEqual(testSentences(entries, tests), [
    "IRLFR earned 1.3 more an episode than IRLR [0.8, 1.9], p = 0.002.",
    "IRLFR earned 0.2 more an episode than IRLF [−0.3, 0.7], p = 0.41: these episodes do not tell them apart.",
    "IRLFR and MEIRL earned the same in every episode.",
  ]);
  assert.deepEqual(testSentences(entries, []), []);
  assert.deepEqual([pText(0.0004), pText(0.049), pText(1)], ["p < 0.001", "p = 0.049", "p = 1.00"]);
  assert.equal(bracketed(null, null), "");
});

test("an interval of one episode is a dash", () => {
  assert.equal(intervalText(4.31, 5.88), "4.3 to 5.9");
  assert.equal(intervalText(null, null), "–");
});

test("what the material cannot tell is said: ties, one walk, no success, a learner that diverged", () => {
  assert.deepEqual(remarks(pageData(), TO_YOU), []);
  const odd = pageData({
    demonstrations: [attempt("a", "failure", [0, 2]), attempt("b", "failure", [0, 2])],
    rankings: { success: null, failure: { order: [["a", "b"]] } },
    run: { learners: { irlr: { outcome: "diverged" } } },
  });
  assert.deepEqual(remarks(odd, TO_YOU), [
    "IRLR diverged: measured here are the last figures that were still finite. A smaller learning rate may help.",
    "None of your attempts is a success, so only learners that can do without one are here.",
    "Your 2 attempts are all the same walk: they say as much as one.",
    "Your failures are all tied, so their order tells no learner which was better.",
  ]);
});
