import assert from "node:assert/strict";
import test from "node:test";
import {
  describeMaterial,
  isOtherMaterial,
  isOutdated,
  missingWith,
  snapshotOf,
  untouched,
  wayThere,
  weighted,
} from "#js/learning/material.js";
import { readSetting } from "#js/learning/settings.js";
import { makeWorld } from "./factories.js";

const world = makeWorld([
  [-0.5, -0.5],
  [-3, 4],
]);
const attempt = (id, outcome, states, more = {}) => ({
  id,
  outcome,
  states,
  discarded: false,
  created_at: "2027-01-01T10:00:00Z",
  ...more,
});
const success = attempt("a", "success", [0, 1, 3]);
const other = attempt("b", "success", [0, 1, 0, 1, 3]);
const failure = attempt("c", "failure", [0, 2]);
const ranking = (outcome, order, weights) => ({
  outcome,
  order,
  weights,
  version: 1,
  confirmed: true,
  created_at: "2027-01-01T11:00:00Z",
});

test("squares only a failure touched are unknown to learners that do not look at failures", () => {
  assert.deepEqual(untouched(world, [success, failure], { uses_failures: false }), [false, false, true, false]);
  assert.deepEqual(untouched(world, [success, failure], { uses_failures: true }), [false, false, false, false]);
});

test("weights come from the ranking, heaviest first", () => {
  const rankings = { success: ranking("success", [["b"], ["a"]], { a: 1 / 3, b: 2 / 3 }), failure: null };
  assert.deepEqual(
    weighted([success, other], rankings, "success").map(({ demonstration, weight }) => [demonstration.id, weight]),
    [
      ["b", 2 / 3],
      ["a", 1 / 3],
    ],
  );
});

test("a ranking that misses an attempt does not count", () => {
  const rankings = { success: ranking("success", [["a"]], { a: 1 }), failure: null };
  assert.deepEqual(
    weighted([success, other], rankings, "success").map(({ weight }) => weight),
    [0.5, 0.5],
  );
  assert.equal(
    describeMaterial([success, other, failure], rankings),
    "To learn from: 2 successes and 1 failure, the successes not in order yet.",
  );
});

test("where nothing was played the page says so once", () => {
  const nothing = describeMaterial([], { success: null, failure: null });
  assert.equal(nothing, "There is nothing to learn from yet: play first, then put your attempts in order.");
});

test("a run is old once something was played or ranked after it", () => {
  const rankings = { success: ranking("success", [["a"]], { a: 1 }), failure: null };
  assert.equal(isOutdated({ created_at: "2027-01-01T12:00:00Z" }, [success], rankings), false);
  assert.equal(isOutdated({ created_at: "2027-01-01T10:30:00Z" }, [success], rankings), true);
});

test("who misses attempts is led to play, who misses the order is led to rank", () => {
  assert.equal(wayThere(world, [], { uses_failures: false }).href, "/worlds/world");
  assert.equal(wayThere(world, [success, other], { uses_failures: false }).href, "/worlds/world/rank");
});

test("what an older run learned from is known from its file, and that it is something else by now", () => {
  const lines = [
    { kind: "world", rows: 2 },
    { kind: "demonstration", ...success },
    { kind: "demonstration", ...failure },
    { kind: "ranking", outcome: "success", order: [["a"]], weights: { a: 1 } },
  ];
  const material = snapshotOf(`${lines.map((line) => JSON.stringify(line)).join("\n")}\n`);
  assert.deepEqual(
    material.demonstrations.map(({ id, discarded }) => [id, discarded]),
    [
      ["a", false],
      ["c", false],
    ],
  );
  assert.deepEqual(material.rankings.success.weights, { a: 1 });
  assert.equal(material.rankings.failure, null);
  const rankings = { success: null, failure: null };
  const run = { created_at: "2027-01-01T12:00:00Z", n_demonstrations: 2 };
  assert.equal(isOtherMaterial(run, { demonstrations: [success, failure], rankings }), false);
  const withoutOne = [success, { ...failure, discarded: true }];
  assert.equal(isOtherMaterial(run, { demonstrations: withoutOne, rankings }), true);
});

test("a setting is read, or refused with what would be right", () => {
  const alpha = { name: "learning_rate", symbol: "α", default: 0.1, minimum: 0, maximum: 10, help: "" };
  assert.deepEqual(readSetting(alpha, " 0,25 "), { value: 0.25, problem: "" });
  assert.deepEqual(readSetting(alpha, ""), { value: 0.1, problem: "" });
  assert.equal(readSetting(alpha, "eleven").problem, "A number from 0 to 10 is needed here.");
  assert.equal(
    readSetting({ ...alpha, name: "iterations", maximum: 1000, whole: true }, "1.5").problem,
    "A whole number is needed here.",
  );
});

test("unfinished failures are asked for, or included, never a dead end", () => {
  const success = { id: "a", outcome: "success", ending: "goal", states: [0], discarded: false, created_at: "" };
  const failure = { id: "b", outcome: "failure", ending: "gave_up", states: [0], discarded: false, created_at: "" };
  const learner = { title: "IRLFR", uses_failures: true, uses_ranking: true, missing: "the server's sentence" };
  const rankings = { success: null, failure: null };
  assert.match(missingWith(learner, [success, failure], rankings, "leave_out"), /play one, or include them/);
  assert.equal(missingWith(learner, [success, failure], rankings, "include"), null);
  assert.match(missingWith(learner, [success, failure, { ...failure, id: "c" }], rankings, "include"), /in order/);
  assert.equal(missingWith(learner, [success, { ...failure, ending: "goal" }], rankings, "include"), learner.missing);
  assert.equal(wayThere({ id: "w" }, [success, failure], learner).href, "/worlds/w");
  assert.equal(wayThere({ id: "w" }, [success, failure], learner, "include").href, "/worlds/w/rank");
});
