import assert from "node:assert/strict";
import test from "node:test";
import { WatchedRun } from "#js/learning/watched-run.js";

const LEARNERS = [{ name: "meirl", title: "MEIRL", family: "paper", seeks_visits: true }];
const frame = (number, iteration = 10 * number) => ({
  number,
  learner: "meirl",
  iteration,
  iterations: 50_000,
  gap: 1,
  log_likelihood: -1,
  reward: [iteration, 0],
  policy: [],
  visitation: [],
});
const run = (more = {}) => ({
  id: "r",
  status: "queued",
  reason: null,
  settings: { iterations: 50_000 },
  learners: { meirl: { outcome: null } },
  created_at: "2027-01-01T10:00:00Z",
  ...more,
});

/** A server that has frames 1 to `last`, at most 600 an answer, and keeps which it was asked for. */
function record(last, learners = { meirl: { outcome: null } }) {
  const asked = [];
  globalThis.location = { search: "" };
  globalThis.fetch = async (path) => {
    if (!path.includes("/frames")) return new Response(JSON.stringify(run({ learners })));
    asked.push(path);
    const after = Number(new URL(path, "http://here").searchParams.get("after"));
    const frames = Array.from({ length: Math.min(600, last - after) }, (_, i) => frame(after + i + 1));
    return new Response(JSON.stringify({ run_id: "r", frames, last: after + frames.length }));
  };
  return asked;
}

const signal = new AbortController().signal;

test("a page that is 1,000 frames behind shows the newest at once, and soon has the whole time line", async () => {
  const asked = record(1000);
  const watched = new WatchedRun(run(), LEARNERS);
  watched.begin({ status: "running", reason: null, ahead: null, number: 1000, latest: { meirl: frame(1000) } });
  assert.equal(watched.progress.status, "running");
  assert.equal(watched.shownOf("meirl").iteration, 10_000);
  await Promise.all([watched.fill(signal), watched.fill(signal)]);
  assert.deepEqual(
    asked.map((path) => path.split("=")[1]),
    ["0", "600", "1000"],
  );
  assert.equal(watched.store.size, 1000);
  watched.timeline.moveTo(5_004);
  assert.equal(watched.shownOf("meirl").iteration, 5_000);
});

test("only what did not come is asked for", async () => {
  const asked = record(6);
  const watched = new WatchedRun(run(), LEARNERS);
  for (const number of [1, 2, 5]) watched.see(frame(number));
  watched.settle({ learner: "meirl", outcome: "converged", number: 3 });
  await watched.fill(signal);
  watched.see(frame(7));
  await watched.fill(signal);
  assert.deepEqual(asked, ["/api/v1/runs/r/frames?after=3", "/api/v1/runs/r/frames?after=7"]);
});

test("a learner that came to its end in what was left out is known to have", async () => {
  record(3, { meirl: { outcome: "converged", sentence: "It settled." } });
  const watched = new WatchedRun(run(), LEARNERS);
  watched.begin({ status: "running", reason: null, ahead: null, number: 3, latest: { meirl: frame(3) } });
  assert.equal(watched.progress.stageOf("meirl"), "learning");
  await watched.fill(signal);
  assert.equal(watched.progress.outcomeOf("meirl"), "It settled.");
});

test("a record that cannot be had costs nothing that came", async () => {
  globalThis.fetch = async () => {
    throw new TypeError("no network");
  };
  const watched = new WatchedRun(run(), LEARNERS);
  watched.see(frame(1));
  await watched.fill(signal);
  assert.equal(watched.store.size, 1);
});

test("a finished learner is on its board before the record has come, diverged ones with their last finite weights", () => {
  const result = {
    outcome: "diverged",
    sentence: "It ran away.",
    iterations: 40,
    gap: null,
    reward: [[3, 4]],
    policy: [[], []],
    visitation: [[1, 1]],
  };
  const watched = new WatchedRun(run({ status: "done", learners: { meirl: result } }), LEARNERS);
  assert.deepEqual(watched.shownOf("meirl").reward, [3, 4]);
  assert.equal(watched.lastIteration, 40);
  assert.equal(
    watched.progress.sentenceOf("meirl", watched.shownOf("meirl")),
    "iteration 40 of 40 · the gap has no bound",
  );
});
