import assert from "node:assert/strict";
import test from "node:test";
import { reproduceCommand } from "#js/comparisons/reproduce.js";
import {
  backgroundSentence,
  onStage,
  posteriorSentences,
  resultSentence,
  softSentence,
} from "#js/comparisons/sentences.js";

const entry = (who, title, mean_return, place, standard_error = 0.4) => ({
  who,
  title,
  mean_return,
  standard_error,
  expected_return: who === "human" ? null : mean_return,
  greedy_return: null,
  share_of_optimum: null,
  place,
  episodes: 50,
});
const you = (mean, place = 9) => entry("human", "You", mean, place, 3);
const optimum = (mean) => entry("optimal", "Optimum", mean, 1, 0);

test("a learner that earned more is named with both figures and the optimum", () => {
  assert.equal(
    resultSentence([optimum(7.7), entry("irlfr", "IRLFR", 5.1, 2), entry("meirl", "MEIRL", 2, 3), you(0.2)]),
    "IRLFR earned more than you in this world: 5.1 ± 0.4 against 0.2. The optimum is 7.7.",
  );
});

test("a person who beat every learner is told so", () => {
  assert.equal(
    resultSentence([optimum(7.7), you(6, 2), entry("irlfr", "IRLFR", 3.1, 3), entry("meirl", "MEIRL", 2, 4)]),
    "You earned more than every learner in this world: 6.0 against 3.1 ± 0.4 for IRLFR, the best of them. The optimum is 7.7.",
  );
});

test("learners that all did alike are none of them the best", () => {
  assert.match(
    resultSentence([optimum(7.7), you(6, 2), entry("irlr", "IRLR", -3, 3), entry("meirl", "MEIRL", -3, 3)]),
    /^You earned more than every learner in this world: 6\.0 against −3\.0 ± 0\.4 for each of them\./,
  );
});

test("what lies within two standard errors is about the same", () => {
  assert.equal(
    resultSentence([optimum(7.7), entry("irlfr", "IRLFR", 5.1, 2), you(4.5)]),
    "IRLFR and you earned about the same in this world: 5.1 ± 0.4 and 4.5. The optimum is 7.7.",
  );
});

test("learners that share the first place are named together", () => {
  assert.match(
    resultSentence([optimum(7.7), entry("irlr", "IRLR", 5.1, 2), entry("irlfr", "IRLFR", 5.1, 2), you(0)]),
    /^IRLR and IRLFR each earned more than you in this world: 5\.1 ± 0\.4 against 0\.0\./,
  );
});

test("an optimum that does not earn is said, and makes no shares", () => {
  assert.match(
    resultSentence([optimum(-1.2), entry("irlr", "IRLR", -3, 2, 0.1), you(-9)]),
    /Even the optimum only gets −1\.2 here, so a share of it would mean nothing\.$/,
  );
});

test("the background says what the person's figure is", () => {
  const entries = [entry("irlr", "IRLR", 5, 2), entry("irlf", "IRLF", 0.3, 3), you(0.2)];
  assert.equal(
    backgroundSentence(entries, [6.1, -5.7]),
    "Your figure is the mean of all 2 attempts, failures included. 1 of 2 learners earned more than that mean. " +
      "Your best attempt alone earned 6.1.",
  );
});

test("on stage the person comes first and the optimum last", () => {
  const entries = [optimum(7), entry("irlfr", "IRLFR", 5, 2), entry("meirl", "MEIRL", 3, 3), you(0)];
  assert.deepEqual(
    onStage(entries, ["meirl", "irlfr"]).map(({ who }) => who),
    ["human", "meirl", "irlfr", "optimal"],
  );
});

test("the command names seed, learners and every setting", () => {
  const run = {
    id: "7123f95a-57b5-41c1-86dd-8949cd09cdc1",
    seed: 12,
    learners: { meirl: {}, irlr: {} },
    settings: { learning_rate: 0.2, initial_weights: "zero" },
  };
  assert.equal(
    reproduceCommand(run),
    "irlfr learn irlfr-7123f95a.jsonl --seed 12 --learners meirl,irlr --set learning_rate=0.2 --set initial_weights=zero",
  );
});

const SOFT = [
  [0.7, 0.1, 0.1, 0.1],
  [0.25, 0.25, 0.25, 0.25],
];
const PLAN = [
  [0, 1, 0, 0],
  [0.25, 0.25, 0.25, 0.25],
];
const RANDOM = [SOFT[1], SOFT[1]];

test("who walks softly and who plans is seen from the policies", () => {
  const entries = [entry("trex", "T-REX", 5, 2), entry("meirl", "MEIRL", 3, 3), entry("random", "Random", -9, 4)];
  const results = { trex: { policy: PLAN }, meirl: { policy: SOFT }, random: { policy: RANDOM } };
  assert.equal(
    softSentence([optimum(7), ...entries, you(1)], results),
    "MEIRL walks softly: likelier steps more often, none always. T-REX plans, and always takes the step it thinks best.",
  );
  assert.equal(
    softSentence([...entries, entry("birlfr", "Bayesian IRLFR", 6, 1)], { ...results, birlfr: { policy: PLAN } }),
    "MEIRL walks softly: likelier steps more often, none always. " +
      "Bayesian IRLFR and T-REX plan, and always take the step they think best.",
  );
});

test("what a posterior expects is told in the world's own units", () => {
  const world = { rewards: [[-1, 14]], goal: 1 };
  const posterior = { level: 0.9, n_draws: 250, return_low: 0.25, return_high: 0.5 };
  const results = { birlfr: { reward: [[-0.1, 1]], posterior }, meirl: { reward: [[0, 1]], posterior: null } };
  const entries = [entry("birlfr", "Bayesian IRLFR", 6, 1), entry("meirl", "MEIRL", 3, 2), you(1)];
  assert.deepEqual(posteriorSentences(entries, results, world), [
    "Bayesian IRLFR itself expects its plan to earn 3.5 to 7.0 (90 % of its 250 draws).",
  ]);
  const without = { birlfr: { reward: [[-0.1, 0]], posterior } };
  assert.deepEqual(posteriorSentences(entries, without, world), [], "a goal worth nothing sets no scale");
});
