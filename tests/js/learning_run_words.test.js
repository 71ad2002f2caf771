import assert from "node:assert/strict";
import test from "node:test";
import {
  agoInWords,
  differencesInWords,
  durationInWords,
  learnersInWords,
  standingInWords,
} from "#js/learning/run-words.js";

const setting = (name, symbol, standard) => ({ name, symbol, default: standard, minimum: 0, maximum: null, help: "" });
const SETTINGS = [
  setting("learning_rate", "α", 0.1),
  setting("lambda_min", "λ_min", 5),
  setting("unfinished_failures", "", "leave_out"),
];
const defaults = { learning_rate: 0.1, lambda_min: 5, unfinished_failures: "leave_out" };
const PRESETS = [
  { name: "recommended", title: "Recommended", learners: [], settings: {}, sentence: "" },
  { name: "paper", title: "Paper", learners: [], settings: { lambda_min: 0.5 }, sentence: "" },
];

test("in what a run's settings differ from the defaults is said by the paper's symbols", () => {
  const words = (settings) => differencesInWords({ settings: { ...defaults, ...settings } }, SETTINGS, PRESETS);
  assert.equal(words({}), "default settings");
  assert.equal(words({ learning_rate: 0.5, lambda_min: 2 }), "α 0.5, λ_min 2");
  assert.equal(words({ unfinished_failures: "include" }), "unfinished failures include");
  assert.equal(words({ lambda_min: 0.5 }), "settings of “Paper”");
});

test("a run's place in the queue is said in words", () => {
  const words = (status, more) => standingInWords(status, { share: 0, ahead: null, ...more });
  assert.equal(words("queued", { ahead: 2, worker: "ready" }), "waits, 2 before it");
  assert.equal(words("queued", { ahead: 0, worker: "ready" }), "next in line");
  assert.equal(words("queued", { ahead: 3, worker: "none" }), "waits for a worker");
  assert.equal(words("queued", { ahead: 0, worker: "warming" }), "waits for the warm-up");
  assert.equal(words("running", { share: 0.409 }), "learning, 40 %");
  assert.equal(words("cancelled", {}), "cancelled");
});

test("times are told as people tell them", () => {
  const now = Date.parse("2026-11-22T14:00:00Z");
  assert.equal(agoInWords("2026-11-22T13:59:30Z", now), "just now");
  assert.equal(agoInWords("2026-11-22T13:55:00Z", now), "5 minutes ago");
  assert.match(agoInWords("2026-11-22T09:00:00Z", now), /^at \d\d:\d\d$/);
  assert.match(agoInWords("2026-11-02T09:00:00Z", now), /^on 2 Nov/);
  assert.equal(durationInWords(0.3), "1 ms");
  assert.equal(durationInWords(42.4), "42 ms");
  assert.equal(durationInWords(312), "0.31 s");
  assert.equal(durationInWords(125_000), "2 min 5 s");
});

test("learners go by their titles", () => {
  const known = [{ name: "birlfr", title: "Bayesian IRLFR" }];
  assert.equal(learnersInWords(["birlfr", "newcomer"], known), "Bayesian IRLFR and NEWCOMER");
});
