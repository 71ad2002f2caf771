import assert from "node:assert/strict";
import test from "node:test";
import { RunProgress } from "#js/learning/progress.js";

const known = (name, title, more = {}) => ({ name, title, family: "paper", seeks_visits: true, ...more });
const LEARNERS = [
  known("meirl", "MEIRL"),
  known("irlr", "IRLR"),
  known("irlf", "IRLF"),
  known("birlfr", "Bayesian IRLFR", { family: "ours", seeks_visits: false }),
  known("random", "Random", { family: "baseline", seeks_visits: false }),
];
const queued = () =>
  new RunProgress(
    { status: "queued", reason: null, learners: { meirl: { outcome: null }, irlr: { outcome: null } } },
    LEARNERS,
  );
const frame = (learner, iteration) => ({ learner, iteration, iterations: 500, gap: 0.4 });

test("a queued run says what it waits for", () => {
  const progress = queued();
  progress.wait({ ahead: 2, worker: "ready" });
  assert.equal(progress.sentence, "2 runs are before yours.");
  progress.wait({ ahead: 1 });
  assert.equal(progress.sentence, "1 run is before yours.");
  progress.wait({ ahead: 0 });
  assert.equal(progress.sentence, "Your run is next: learning starts in a moment.");
  progress.wait({ ahead: 0, worker: "warming" });
  assert.match(progress.sentence, /^The learners are being warmed up: .* takes up to a minute\.$/);
  progress.wait({ ahead: 0, worker: "none" });
  assert.equal(progress.sentence, "No worker is running at the moment; your run waits and nothing is lost.");
  assert.equal(progress.stageOf("meirl"), "waiting");
});

test("a learner's line names iteration and gap", () => {
  const progress = queued();
  progress.see(frame("meirl", 120));
  assert.equal(progress.sentenceOf("meirl"), "iteration 120 of 500 · gap 0.40 visits");
  progress.see({ ...frame("meirl", 120), compute_ms: 312.5 });
  assert.equal(progress.sentenceOf("meirl"), "iteration 120 of 500 · 0.31 s · gap 0.40 visits");
  assert.equal(progress.sentence, "MEIRL is learning, the first of 2 learners.");
  assert.equal(progress.sentenceOf("irlr"), "waiting its turn");
  assert.equal(progress.shareOf("meirl"), 0.24);
});

test("learners follow each other", () => {
  const progress = queued();
  progress.see(frame("meirl", 500));
  progress.settle("meirl", { outcome: "iteration_limit", sentence: "The limit came first." });
  progress.see(frame("irlr", 0));
  assert.equal(progress.sentence, "IRLR is learning, the second of 2 learners.");
  assert.equal(progress.outcomeOf("meirl"), "The limit came first.");
  assert.equal(progress.stageOf("meirl"), "learned");
});

test("the end is told, with what was left out and who ran away", () => {
  const progress = queued();
  progress.settle("meirl", { outcome: "converged", n_left_out: 1 });
  progress.settle("irlr", { outcome: "converged", n_left_out: 0 });
  progress.end("done");
  assert.equal(
    progress.sentence,
    "Both learners have learned from your play. 1 failure that never reached the goal was left out.",
  );
  progress.settle("irlr", { outcome: "diverged" });
  assert.match(progress.sentence, /^The run is done\. IRLR ran away .* the last weights that were finite numbers\./);
  assert.equal(progress.endingOf("irlr"), "diverged");
});

test("a failed run says why, a cancelled one how far it came", () => {
  const failed = queued();
  failed.end("failed", "The worker ran out of memory.");
  assert.equal(failed.sentence, "The run failed: The worker ran out of memory.");
  const cancelled = queued();
  cancelled.settle("meirl", { outcome: "converged" });
  cancelled.end("cancelled");
  assert.match(cancelled.sentence, /^Cancelled after 1 of 2 learners\./);
  assert.equal(cancelled.stageOf("irlr"), "ended");
});

test("a learner that ended far from the play is named", () => {
  const learners = { meirl: { outcome: "converged", gap: 0.0001 }, irlf: { outcome: "iteration_limit", gap: 84 } };
  const progress = new RunProgress({ status: "done", reason: null, learners }, LEARNERS);
  assert.equal(progress.sentence, "The run is done. IRLF ended far from your play.");
});

test("a learner that does not seek the gap is not told off for it", () => {
  const learners = { meirl: { outcome: "converged", gap: 0.0001 }, birlfr: { outcome: "converged", gap: 3 } };
  const progress = new RunProgress({ status: "done", reason: null, learners }, LEARNERS);
  assert.equal(progress.sentence, "Both learners have learned from your play.");
});

test("nobody claims that random play has learned", () => {
  const random = { random: { outcome: "converged", gap: 5 } };
  assert.equal(
    new RunProgress({ status: "done", reason: null, learners: random }, LEARNERS).sentence,
    "Random is done.",
  );
  const learners = { meirl: { outcome: "converged", gap: 0 }, ...random };
  const both = new RunProgress({ status: "done", reason: null, learners }, LEARNERS);
  assert.equal(both.sentence, "Both learners are done.");
});

test("who takes no iterations does not count them, and the time line is as long as the longest", () => {
  const progress = queued();
  progress.see({ ...frame("random", 0), iterations: 0 });
  assert.equal(progress.sentenceOf("random"), "gap 0.40 visits");
  progress.see({ ...frame("birlfr", 3), iterations: 400 });
  assert.equal(progress.limit, 400);
});

test("of a run whose frames nobody looks at it is known how far it is", () => {
  const progress = queued();
  progress.see({ learner: "meirl", iteration: 250, iterations: 500 });
  assert.equal(progress.status, "running");
  assert.equal(progress.share, 0.25);
  progress.end("done");
  assert.equal(progress.share, 1);
});

test("who looks at another's run is not told it were theirs", () => {
  const learners = { meirl: { outcome: "converged", gap: 0 } };
  const progress = new RunProgress({ status: "done", reason: null, learners }, LEARNERS, false);
  assert.equal(progress.sentence, "MEIRL has learned from the player’s play.");
});

test("a run that was deleted elsewhere is said to be gone", () => {
  const progress = queued();
  progress.end("deleted");
  assert.ok(progress.isOver);
  assert.match(progress.sentence, /was deleted/);
});
